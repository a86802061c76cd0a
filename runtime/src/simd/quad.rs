//! Four numbers side by side: what the recurrences work on.

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod x86;

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use x86 as machine;

use super::Simd;
use crate::scalar::kind::ByKind;
use crate::scalar::{Lane, Scalar};

/// Four numbers side by side in memory, aligned as vector instructions like it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Quad<T>(
    /// The numbers.
    pub [T; 4],
);

impl<T: Scalar> Quad<T> {
    /// The same number four times.
    #[inline(always)]
    #[must_use]
    pub fn splat(value: T) -> Self {
        Self([value; 4])
    }
}

/// The arithmetic of the numbers of one or more links at once, in registers.
pub trait Pack<T>: Copy {
    /// The same arithmetic for one link.
    type Single: Pack<T>;

    /// The same number for each link.
    fn splat(value: T) -> Self;
    /// From memory: the pack with this index.
    fn load(numbers: &[Quad<T>], index: usize) -> Self;
    /// To memory.
    fn store(self, numbers: &mut [Quad<T>], index: usize);
    /// Sum.
    fn plus(self, other: Self) -> Self;
    /// Difference.
    fn minus(self, other: Self) -> Self;
    /// Product.
    fn times(self, other: Self) -> Self;
    /// `self` + a b, rounded once or twice.
    fn plus_product(self, a: Self, b: Self) -> Self;
    /// `self` − a b, rounded once or twice.
    fn minus_product(self, a: Self, b: Self) -> Self;
    /// 1 / `self`.
    fn reciprocal(self) -> Self;
    /// The number of the link with this index in the pack, for each.
    fn broadcast<const INDEX: usize>(self) -> Self;
}

/// For every number type: operation by operation. Loops and no closures: what
/// is not inlined into a function with wider registers is slow.
impl<T: Scalar> Pack<T> for Quad<T> {
    type Single = OneLink<T>;

    #[inline(always)]
    fn splat(value: T) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    fn load(numbers: &[Quad<T>], index: usize) -> Self {
        numbers[index]
    }

    #[inline(always)]
    fn store(self, numbers: &mut [Quad<T>], index: usize) {
        numbers[index] = self;
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = self.0[i] + other.0[i];
        }
        result
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = self.0[i] - other.0[i];
        }
        result
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = self.0[i] * other.0[i];
        }
        result
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = self.0[i] + a.0[i] * b.0[i];
        }
        result
    }

    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = self.0[i] - a.0[i] * b.0[i];
        }
        result
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        let mut result = self;
        for i in 0..4 {
            result.0[i] = T::from_f64(1.0) / self.0[i];
        }
        result
    }

    #[inline(always)]
    fn broadcast<const INDEX: usize>(self) -> Self {
        Self([self.0[INDEX]; 4])
    }
}

/// The number of one link, perhaps of several states at once, in the arithmetic of `V`.
#[derive(Clone, Copy)]
#[allow(unreachable_pub)]
pub struct OneLink<V>(V);

impl<T: Scalar, V: Simd<T>> Pack<T> for OneLink<V> {
    type Single = Self;

    #[inline(always)]
    fn splat(value: T) -> Self {
        Self(V::splat(value))
    }

    #[inline(always)]
    fn load(numbers: &[Quad<T>], index: usize) -> Self {
        Self(V::splat(numbers[index / 4].0[index % 4]))
    }

    #[inline(always)]
    fn store(self, numbers: &mut [Quad<T>], index: usize) {
        numbers[index / 4].0[index % 4] = self.0.first();
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        Self(a.0.mul_add(b.0, self.0))
    }

    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        Self((-a.0).mul_add(b.0, self.0))
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self(V::from_f64(1.0) / self.0)
    }

    #[inline(always)]
    fn broadcast<const INDEX: usize>(self) -> Self {
        self
    }
}

/// Knuth's two-sum, the rounded sum and its rounding error.
#[inline(always)]
pub(crate) fn two_sum<T, P: Pack<T>>(a: P, b: P) -> (P, P) {
    let sum = a.plus(b);
    let part = sum.minus(a);
    (sum, a.minus(sum.minus(part)).plus(b.minus(part)))
}

/// Runs `kernel` with the vector instructions that the machine has for `f64`.
#[inline(always)]
pub(crate) fn run_f64<K: PackKernel<f64>>(kernel: K) {
    machine::run(kernel);
}

/// Runs `kernel` in packs of plain numbers: there are no others for `f32`.
#[inline(always)]
pub(crate) fn run_f32<K: PackKernel<f32>>(kernel: K) {
    kernel.run::<Quad<f32>>();
}

/// Runs `kernel` with the vector instructions that the machine has for such numbers.
#[inline(always)]
pub(crate) fn run_packs<T: Scalar, K: PackKernel<T>>(kernel: K) {
    T::by_kind(InPacks(kernel));
}

/// Asks for packs.
struct InPacks<K>(K);

impl<S: Scalar, K: PackKernel<S>> ByKind<S> for InPacks<K> {
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        self.0.run::<Quad<S>>();
    }

    #[inline(always)]
    fn of_plain(self)
    where
        S: Lane,
    {
        S::run_packs(self.0);
    }
}

/// A computation in packs.
pub trait PackKernel<T> {
    /// Computes.
    fn run<P: Pack<T>>(self);
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
mod machine {
    use super::{PackKernel, Quad};

    #[inline(always)]
    pub(super) fn run<K: PackKernel<f64>>(kernel: K) {
        kernel.run::<Quad<f64>>();
    }
}
