//! Registers in step.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Register;
use crate::scalar::Scalar;

/// `N` registers that go through one computation in step: while an operation on
/// one awaits the last, the others keep the processor busy.
#[derive(Clone, Copy, Debug)]
pub struct Block<R, const N: usize>(pub [R; N]);

impl<R: Register, const N: usize> Block<R, N> {
    #[inline(always)]
    pub(crate) fn splat(value: R::Lane) -> Self {
        Self([R::splat(value); N])
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<R: Register, const N: usize> $trait for Block<R, N> {
            type Output = Self;

            #[inline(always)]
            fn $function(mut self, other: Self) -> Self {
                for i in 0..N {
                    self.0[i] = self.0[i] $operator other.0[i];
                }
                self
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<R: Register, const N: usize> Neg for Block<R, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for i in 0..N {
            self.0[i] = -self.0[i];
        }
        self
    }
}

impl<R: Register, const N: usize> Scalar for Block<R, N> {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self([R::from_f64(value); N])
    }

    #[inline(always)]
    fn mul_add(mut self, factor: Self, addend: Self) -> Self {
        for i in 0..N {
            self.0[i] = self.0[i].mul_add(factor.0[i], addend.0[i]);
        }
        self
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sines, cosines) = R::sin_cos_each(&self.0);
        (Self(sines), Self(cosines))
    }

    #[inline(always)]
    fn sin_cos_each<const M: usize>(angles: &[Self; M]) -> ([Self; M], [Self; M]) {
        let mut own = [[R::from_f64(0.0); N]; M];
        for j in 0..M {
            own[j] = angles[j].0;
        }
        let (own_sines, own_cosines) = R::sin_cos_blocks(&own);
        let (mut sines, mut cosines) = (*angles, *angles);
        for j in 0..M {
            (sines[j].0, cosines[j].0) = (own_sines[j], own_cosines[j]);
        }
        (sines, cosines)
    }

    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for i in 0..N {
            self.0[i] = self.0[i].sqrt();
        }
        self
    }
}
