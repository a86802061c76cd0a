//! Sines and cosines that are computed when they are needed.
//!
//! A single state profits if all of them are computed at once: several angles share a register.
//! Numbers with several lanes fill a register already, and long code has more values than
//! registers; each sine is then computed when it is needed. The range of all angles is checked in
//! advance, so that no later computation needs a branch to a slower function.

use super::Scalar;
use super::kind::ByKind;
use crate::simd::Simd;

/// Sines and cosines, in the order of their angles.
pub(crate) type SinesAndCosines<T, const N: usize> = ([T; N], [T; N]);

/// Sines and cosines of angles, for code that needs a few of them at a time.
#[derive(Clone, Copy, Debug)]
pub struct SinCosPairs<T, const N: usize>(Option<SinesAndCosines<T, N>>);

impl<T: Scalar, const N: usize> SinCosPairs<T, N> {
    /// Prepares the sines and cosines of all angles in `angles`.
    #[inline(always)]
    pub fn among(angles: [T; N]) -> Self {
        Self(T::by_kind(SinesAhead(&angles)))
    }

    /// Returns sines and cosines of `angles`, which have the indices `which` among all angles; NaN
    /// for an index out of range.
    #[inline(always)]
    pub fn of<const G: usize>(&self, which: [usize; G], angles: [T; G]) -> SinesAndCosines<T, G> {
        let Some((sines, cosines)) = &self.0 else {
            return T::by_kind(SinesNear(&angles));
        };
        let mut turned = (angles, angles);
        for (place, index) in which.into_iter().enumerate() {
            turned.0[place] = at(sines, index);
            turned.1[place] = at(cosines, index);
        }
        turned
    }
}

/// Operation that computes the sines and cosines of all angles, if the number type computes them at
/// once. Otherwise it returns `None`, and [`SinesNear`] computes them when needed.
struct SinesAhead<'a, T, const N: usize>(&'a [T; N]);

impl<S: Scalar, const N: usize> ByKind<S> for SinesAhead<'_, S, N> {
    type Output = Option<SinesAndCosines<S, N>>;

    #[inline(always)]
    fn of_any(self) -> Self::Output {
        Some(S::sin_cos_each(self.0))
    }

    #[inline(always)]
    fn of_wide<T: Scalar>(self) -> Self::Output
    where
        S: Simd<T>,
    {
        S::sin_cos_ahead(self.0)
    }
}

/// Operation that computes the sines and cosines of some of the angles for which [`SinesAhead`]
/// returned `None`.
struct SinesNear<'a, T, const N: usize>(&'a [T; N]);

impl<S: Scalar, const N: usize> ByKind<S> for SinesNear<'_, S, N> {
    type Output = SinesAndCosines<S, N>;

    #[inline(always)]
    fn of_any(self) -> Self::Output {
        S::sin_cos_each(self.0)
    }

    #[inline(always)]
    fn of_wide<T: Scalar>(self) -> Self::Output
    where
        S: Simd<T>,
    {
        S::sin_cos_near(self.0)
    }
}

/// Returns the element at an index, or NaN beyond the end. Emitted code uses it instead of
/// indexing, which could panic; the end is never exceeded there.
#[inline(always)]
pub(crate) fn at<T: Scalar>(numbers: &[T], index: usize) -> T {
    match numbers.get(index) {
        Some(number) => *number,
        None => T::from_f64(f64::NAN),
    }
}
