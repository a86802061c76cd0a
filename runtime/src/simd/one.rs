//! One number that fuses.

#![allow(unsafe_code)]

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Register, Simd, dispatch};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::scalar::sincos::fused;

/// A plain number whose [`Scalar::mul_add`] is fused: what a lane of the wide
/// registers computes, for one state.
///
/// Exists only in functions compiled for AVX2 and FMA ([`dispatch`]); elsewhere
/// its products would be right, but slow.
///
/// [`dispatch`]: super::dispatch
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Fused<T>(pub T);

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

        impl Register for Fused<$float> {
            type Lane = $float;
        }

        impl Simd<$float> for Fused<$float> {
            type One = Self;
            type Mask = bool;
            type Chunk = $float;

            const LANES: usize = 1;

            #[inline(always)]
            fn in_own_function<K: dispatch::Routine>(kernel: K) -> K::Output {
                dispatch::outlined_avx2(kernel)
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
            fn load(numbers: &[$float]) -> Option<Self> {
                numbers.first().copied().map(Self)
            }

            #[inline(always)]
            fn store(self, numbers: &mut [$float]) {
                if let Some(front) = numbers.first_mut() {
                    *front = self.0;
                }
            }

            #[inline(always)]
            fn last_chunk(numbers: &[$float]) -> Option<&$float> {
                numbers.last()
            }

            #[inline(always)]
            fn from_chunk(number: &$float) -> Self {
                Self(*number)
            }

            #[inline(always)]
            fn to_chunk(self) -> $float {
                self.0
            }

            #[inline(always)]
            fn store_last(self, numbers: &mut [$float]) {
                if let Some(back) = numbers.last_mut() {
                    *back = self.0;
                }
            }

            #[inline(always)]
            unsafe fn read(start: *const $float) -> Self {
                // SAFETY: the caller's. The type is transparent, and a register is
                // made of its lanes. They need not lie where registers would.
                unsafe { start.cast::<Self>().read_unaligned() }
            }

            #[inline(always)]
            unsafe fn write(self, start: *mut $float) {
                // SAFETY: the caller's. The type is transparent, and may lie anywhere.
                unsafe { start.cast::<Self>().write_unaligned(self) }
            }

            #[inline(always)]
            unsafe fn write_some(self, start: *mut $float, count: usize) {
                if count > 0 {
                    // SAFETY: the caller's. The type is transparent, and may lie anywhere.
                    unsafe { self.write(start) }
                }
            }

            #[inline(always)]
            fn first(self) -> $float {
                self.0
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

        impl fused::Pack for Fused<$float> {
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
                self.0.to_bits() & <$float as fused::Float>::ABOVE.to_bits() == 0
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
