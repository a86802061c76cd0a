//! Neighbours in a slice, as many as fit a register.

use crate::scalar::{Lane, Lanes, Scalar};

/// Several consecutive numbers of a slice of `T`, computed in step; a plain
/// number is a vector of one.
pub trait Vector<T>: Scalar {
    /// How many numbers it holds.
    const LANES: usize;

    /// The numbers from `slice[at]` on. NaN where they do not lie in the slice.
    fn load(slice: &[T], at: usize) -> Self;

    /// Writes the numbers from `slice[at]` on; nothing where they do not fit.
    fn store(self, slice: &mut [T], at: usize);

    /// The same number in every lane.
    fn splat(value: T) -> Self;
}

impl<T: Scalar> Vector<T> for T {
    const LANES: usize = 1;

    #[inline(always)]
    fn load(slice: &[T], at: usize) -> Self {
        match slice.get(at) {
            Some(&value) => value,
            None => T::from_f64(f64::NAN),
        }
    }

    #[inline(always)]
    fn store(self, slice: &mut [T], at: usize) {
        if let Some(place) = slice.get_mut(at) {
            *place = self;
        }
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        value
    }
}

impl<T: Lane, const N: usize> Vector<T> for Lanes<T, N> {
    const LANES: usize = N;

    #[inline(always)]
    fn load(slice: &[T], at: usize) -> Self {
        match slice.get(at..).and_then(|rest| rest.first_chunk()) {
            Some(numbers) => Lanes(*numbers),
            None => Lanes::from_f64(f64::NAN),
        }
    }

    #[inline(always)]
    fn store(self, slice: &mut [T], at: usize) {
        if let Some(place) = slice.get_mut(at..).and_then(|rest| rest.first_chunk_mut()) {
            *place = self.0;
        }
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        Lanes::splat(value)
    }
}

/// The vectors that slices of `T` are computed in: the widest where there are
/// enough numbers, narrower ones for few.
pub trait Vectors<T>: 'static {
    /// The widest.
    type Wide: Vector<T>;
    /// Narrower ones.
    type Narrow: Vector<T>;
    /// One number.
    type One: Vector<T>;
}

/// Numbers one by one.
#[derive(Clone, Copy, Debug)]
pub struct Single;

impl<T: Scalar> Vectors<T> for Single {
    type Wide = T;
    type Narrow = T;
    type One = T;
}

/// A computation over slices that is compiled for several vectors.
pub trait SliceKernel<T> {
    /// Computes in the given vectors.
    fn run<W: Vectors<T>>(self);
}

/// What is done to `V::LANES` neighbours from an index on.
pub(super) trait Step<T> {
    fn at<V: Vector<T>>(&mut self, index: usize);
}

/// Takes a step over all indices below `count`. Where vectors do not divide
/// them, the last vector overlaps the one before: a step must give the same
/// result when it is taken twice.
#[inline(always)]
pub(super) fn each<T: Scalar, W: Vectors<T>>(count: usize, step: &mut impl Step<T>) {
    if count >= W::Wide::LANES {
        cover::<T, W::Wide>(count, step);
    } else if count >= W::Narrow::LANES {
        cover::<T, W::Narrow>(count, step);
    } else {
        cover::<T, W::One>(count, step);
    }
}

#[inline(always)]
fn cover<T, V: Vector<T>>(count: usize, step: &mut impl Step<T>) {
    let mut index = 0;
    while index < count {
        step.at::<V>(index.min(count - V::LANES));
        index += V::LANES;
    }
}
