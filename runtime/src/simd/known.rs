//! Angles whose sines and cosines have been computed before.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::Scalar;

/// A number, which may bring its sine and cosine along: code written for any number
/// takes these then, and does not compute them. What comes of numbers brings none.
///
/// The compiler sees which do, and nothing is left of the question.
#[derive(Clone, Copy, Debug)]
pub struct Known<S> {
    /// Without them.
    pub(crate) number: S,
    turned: Option<(S, S)>,
}

impl<S: Scalar> Known<S> {
    /// Brings none.
    #[inline(always)]
    pub(crate) fn number(number: S) -> Self {
        let turned = None;
        Self { number, turned }
    }

    /// An angle, whose sine and cosine stand in place `index`; none if nothing does.
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
        impl<S: Scalar> $trait for Known<S> {
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

impl<S: Scalar> Neg for Known<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::number(-self.number)
    }
}

impl<S: Scalar> Scalar for Known<S> {
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
