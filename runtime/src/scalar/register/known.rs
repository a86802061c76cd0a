//! Angles whose sines and cosines have been computed before.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::super::Scalar;

/// A number that may bring its sine and cosine along: what computes with it does
/// not compute them. Numbers that come of others bring none.
#[derive(Clone, Copy, Debug)]
pub struct Known<S> {
    pub(crate) value: S,
    turn: (S, S),
}

impl<S: Scalar> Known<S> {
    /// An angle of this sine and cosine.
    #[inline(always)]
    pub(crate) fn angle(value: S, sine: S, cosine: S) -> Self {
        Self { value, turn: (sine, cosine) }
    }

    /// A number that is no angle.
    #[inline(always)]
    pub(crate) fn number(value: S) -> Self {
        let zero = S::from_f64(0.0);
        Self { value, turn: (zero, zero) }
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<S: Scalar> $trait for Known<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self::number(self.value $operator other.value)
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
        Self::number(-self.value)
    }
}

impl<S: Scalar> Scalar for Known<S> {
    const SEVERAL: bool = S::SEVERAL;

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::number(S::from_f64(value))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        (Self::number(self.turn.0), Self::number(self.turn.1))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::number(self.value.sqrt())
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self::number(self.value.mul_add(factor.value, addend.value))
    }
}
