//! Angles whose sines and cosines are already known.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::Scalar;

/// A number that may carry its sine and cosine, which generic code then uses instead of computing
/// them. Results of arithmetic carry none.
///
/// The compiler resolves which numbers carry them, so that no check remains at run time.
#[derive(Clone, Copy, Debug)]
pub struct WithSinCos<S> {
    /// The number itself.
    pub(crate) number: S,
    turned: Option<(S, S)>,
}

impl<S: Scalar> WithSinCos<S> {
    /// Creates a number without sine and cosine.
    #[inline(always)]
    pub(crate) fn number(number: S) -> Self {
        let turned = None;
        Self { number, turned }
    }

    /// Creates an angle whose sine and cosine are at `index` of the slices; without them if the
    /// index is out of range.
    #[inline(always)]
    pub(crate) fn angle(number: S, index: usize, sines: &[S], cosines: &[S]) -> Self {
        let turned = match (sines.get(index), cosines.get(index)) {
            (Some(sine), Some(cosine)) => Some((*sine, *cosine)),
            _ => None,
        };
        Self { number, turned }
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<S: Scalar> $trait for WithSinCos<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self::number(self.number $operator other.number)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<S: Scalar> Neg for WithSinCos<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::number(-self.number)
    }
}

impl<S: Scalar> Scalar for WithSinCos<S> {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::number(S::from_f64(value))
    }

    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::number(S::from_parts(high, low))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = match self.turned {
            Some(turned) => turned,
            None => self.number.sin_cos(),
        };
        (Self::number(sine), Self::number(cosine))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::number(self.number.sqrt())
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self::number(self.number.mul_add(factor.number, addend.number))
    }
}
