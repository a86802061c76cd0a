//! Sines and cosines where they are needed.
//!
//! One state gains by asking for all of them at once: several angles share a
//! register. A lane has its register already, and long code more values than
//! there are registers: there they are computed when they are asked for. All
//! angles are looked at before, so that what is computed late needs no way out to
//! a slower function.

use super::Scalar;
use super::kind::ByKind;
use crate::simd::Simd;

/// Sines and cosines, in the order of their angles.
pub(crate) type Turned<T, const N: usize> = ([T; N], [T; N]);

/// Sines and cosines of angles that code asks for a few at a time, where it needs
/// them.
#[derive(Clone, Copy, Debug)]
pub struct Turns<T, const N: usize>(Option<Turned<T, N>>);

impl<T: Scalar, const N: usize> Turns<T, N> {
    /// Sines and cosines of all these angles.
    #[inline(always)]
    pub fn among(angles: [T; N]) -> Self {
        Self(T::by_kind(SinesAhead(&angles)))
    }

    /// Sines and cosines of `angles`, which are those with the numbers `which`
    /// among all; NaN for a number that none has.
    #[inline(always)]
    pub fn of<const G: usize>(&self, which: [usize; G], angles: [T; G]) -> Turned<T, G> {
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

/// Asks for the sines and cosines of all angles, if they are computed at once; none if
/// they are computed when asked for, and may be by [`SinesNear`].
struct SinesAhead<'a, T, const N: usize>(&'a [T; N]);

impl<S: Scalar, const N: usize> ByKind<S> for SinesAhead<'_, S, N> {
    type Output = Option<Turned<S, N>>;

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

/// Asks for those of some angles among those of which [`SinesAhead`] gave none.
struct SinesNear<'a, T, const N: usize>(&'a [T; N]);

impl<S: Scalar, const N: usize> ByKind<S> for SinesNear<'_, S, N> {
    type Output = Turned<S, N>;

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

/// The element at an index, or NaN beyond the end: in place of a panic in what
/// emitted code never does.
#[inline(always)]
pub(crate) fn at<T: Scalar>(numbers: &[T], index: usize) -> T {
    match numbers.get(index) {
        Some(number) => *number,
        None => T::from_f64(f64::NAN),
    }
}
