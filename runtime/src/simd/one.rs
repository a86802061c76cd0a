//! A single number with fused multiply-add.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Kernel, Sealed, Simd, dispatch};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::scalar::sincos::fused;

/// A plain number whose [`Scalar::mul_add`] is fused. It computes for one state exactly what a lane
/// of the wide registers computes.
///
/// It exists only in functions compiled for AVX2 and FMA ([`dispatch`]).
///
/// [`dispatch`]: super::dispatch
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(crate) struct Fused<T>(pub(crate) T);

macro_rules! fused {
    ($float:ident, $sign:literal) => {
        fused!($float, Add, add, +);
        fused!($float, Sub, sub, -);
        fused!($float, Mul, mul, *);
        fused!($float, Div, div, /);

        impl Neg for Fused<$float> {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Scalar for Fused<$float> {
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                Self(<$float as Scalar>::from_f64(value))
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                Self(fused::Float::fused(self.0, factor.0, addend.0))
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let ([sine], [cosine]) = Self::sin_cos_each(&[self]);
                (sine, cosine)
            }

            #[inline(always)]
            fn sin_cos_each<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
                fused::several(angles)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(Scalar::sqrt(self.0))
            }

            #[inline(always)]
            fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
                question.of_wide::<$float>()
            }
        }

        impl Sealed<$float> for Fused<$float> {}

        impl Simd<$float> for Fused<$float> {
            type One = Self;
            type Mask = bool;
            type Chunk = [$float; 1];

            #[inline(always)]
            fn in_own_function<K: Kernel<$float>>(kernel: K) -> K::Output {
                dispatch::outlined_avx2::<$float, Self, K>(kernel)
            }

            #[inline(always)]
            fn mask(meant: impl Fn(usize) -> bool) -> bool {
                meant(0)
            }

            #[inline(always)]
            fn choose(self, other: Self, mask: bool) -> Self {
                if mask { self } else { other }
            }

            #[inline(always)]
            fn larger_size(self, other: Self) -> Self {
                Self(self.0.abs().max(other.0.abs()))
            }

            #[inline(always)]
            fn splat(value: $float) -> Self {
                Self(value)
            }

            #[inline(always)]
            fn rotate_lanes(self, _first: usize) -> Self {
                self
            }

            #[inline(always)]
            fn tile_lanes(self, _count: usize) -> Self {
                self
            }
        }

        impl fused::FusingNumber for Fused<$float> {
            type Lane = $float;
            type Array = [$float; 1];

            #[inline(always)]
            fn exchange(quarter: Self, high: Self, lost: Self, cosine: Self) -> (Self, Self) {
                let sine = high - lost;
                let (quarter, sine, cosine) =
                    (quarter.0.to_bits(), sine.0.to_bits(), cosine.0.to_bits());
                let sign = (-0.0 as $float).to_bits();
                let exchange = (quarter & 1).wrapping_neg() & (sine ^ cosine);
                let sine = sine ^ exchange ^ ((quarter << $sign) & sign);
                let cosine = cosine ^ exchange ^ ((quarter.wrapping_add(1) << $sign) & sign);
                (Self($float::from_bits(sine)), Self($float::from_bits(cosine)))
            }

            #[inline(always)]
            fn or_differing(self, one: Self, other: Self) -> Self {
                let differing = one.0.to_bits() ^ other.0.to_bits();
                Self($float::from_bits(self.0.to_bits() | differing))
            }

            #[inline(always)]
            fn only_low_bits(self) -> bool {
                self.0.to_bits() & <$float as fused::Float>::HIGH_BITS.to_bits() == 0
            }

            #[inline(always)]
            fn all_below(self, limit: $float) -> bool {
                self.0 < limit
            }

            #[inline(always)]
            fn from_numbers([number]: [$float; 1]) -> Self {
                Self(number)
            }

            #[inline(always)]
            fn to_numbers(self) -> [$float; 1] {
                [self.0]
            }
        }
    };
    ($float:ident, $trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Fused<$float> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    };
}

fused!(f64, 62);
fused!(f32, 30);
