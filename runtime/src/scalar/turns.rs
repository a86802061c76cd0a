//! Sines and cosines where they are needed.
//!
//! One state gains by asking for all of them at once: several angles share a
//! register. A lane has its register already, and long code more values than
//! there are registers: there they are computed when they are asked for. All
//! angles are looked at before, so that what is computed late needs no way out to
//! a slower function.

use super::Scalar;

/// Sines and cosines, in the order of their angles.
pub type Turned<T, const N: usize> = ([T; N], [T; N]);

/// What [`Scalar::turns`] gives.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Turns<T, const N: usize>(Option<Turned<T, N>>);

impl<T: Scalar, const N: usize> Turns<T, N> {
    /// From those that are known.
    #[inline(always)]
    pub(super) fn new(known: Option<Turned<T, N>>) -> Self {
        Self(known)
    }

    /// Sines and cosines of `angles`, which are those with the numbers `which`
    /// among all; NaN for a number that none has.
    #[inline(always)]
    pub fn of<const G: usize>(&self, which: [usize; G], angles: [T; G]) -> Turned<T, G> {
        let Some((sines, cosines)) = &self.0 else {
            return T::sin_cos_near(&angles);
        };
        let mut turned = (angles, angles);
        for (place, index) in which.into_iter().enumerate() {
            turned.0[place] = at(sines, index);
            turned.1[place] = at(cosines, index);
        }
        turned
    }
}

/// The element at an index, or NaN beyond the end: in place of a panic in what
/// emitted code never does.
#[inline(always)]
pub(crate) fn at<T: Scalar>(numbers: &[T], index: usize) -> T {
    match numbers.get(index) {
        Some(number) => *number,
        None => T::from_f64(f64::NAN),
    }
}
