//! Registers of 128 bits that every build for the target has: NEON on AArch64, and `simd128` in
//! WebAssembly.
//!
//! They have no fused multiply–add here, so that each lane has the same bits as a plain number.

#![allow(unsafe_code)]

#[cfg(target_arch = "aarch64")]
mod neon;
#[cfg(target_arch = "wasm32")]
mod wasm;

#[cfg(target_arch = "aarch64")]
use neon as machine;
#[cfg(target_arch = "wasm32")]
use wasm as machine;

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::permutation::{rotated, tiled};
use super::{Sealed, Simd};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::scalar::sincos::{double, sin_cos_f32};

macro_rules! register {
    (
        $(#[$docs:meta])*
        $name:ident = $lanes:literal of $lane:ident, in $float:ident, bits: $bits:ident
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub(crate) struct $name(machine::$float::Vector);

        register!($name, Add, add, $float);
        register!($name, Sub, sub, $float);
        register!($name, Mul, mul, $float);
        register!($name, Div, div, $float);

        impl Neg for $name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                Self(machine::$float::neg(self.0))
            }
        }

        impl $name {
            #[inline(always)]
            fn from_array(numbers: [$lane; $lanes]) -> Self {
                // SAFETY: the register holds exactly these numbers, in order and without padding.
                Self(unsafe { core::mem::transmute::<[$lane; $lanes], machine::$float::Vector>(numbers) })
            }

            #[inline(always)]
            fn to_array(self) -> [$lane; $lanes] {
                // SAFETY: as in `from_array`.
                unsafe { core::mem::transmute::<machine::$float::Vector, [$lane; $lanes]>(self.0) }
            }

            #[inline(always)]
            fn permuted(self, lanes: &[u32; $lanes]) -> Self {
                let own = self.to_array();
                Self::from_array(lanes.map(|lane| own[lane as usize % $lanes]))
            }
        }

        impl Sealed<$lane> for $name {}

        impl Simd<$lane> for $name {
            type One = $lane;
            /// Mask of lanes: in each lane, all bits are set or none.
            type Mask = machine::$float::Mask;
            type Chunk = [$lane; $lanes];

            #[inline(always)]
            fn mask(meant: impl Fn(usize) -> bool) -> machine::$float::Mask {
                let lanes: [$bits; $lanes] =
                    core::array::from_fn(|lane| if meant(lane) { !0 } else { 0 });
                // SAFETY: the sizes are equal, and all bit patterns are valid masks.
                unsafe { core::mem::transmute::<[$bits; $lanes], machine::$float::Mask>(lanes) }
            }

            #[inline(always)]
            fn choose(self, other: Self, mask: machine::$float::Mask) -> Self {
                Self(machine::$float::choose(mask, self.0, other.0))
            }

            #[inline(always)]
            fn larger_size(self, other: Self) -> Self {
                Self(machine::$float::larger_size(self.0, other.0))
            }

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                Self(machine::$float::splat(value))
            }

            #[inline(always)]
            fn rotate_lanes(self, first: usize) -> Self {
                static LANES: [[u32; $lanes]; $lanes] = rotated();
                self.permuted(&LANES[first % $lanes])
            }

            #[inline(always)]
            fn tile_lanes(self, count: usize) -> Self {
                static LANES: [[u32; $lanes]; $lanes] = tiled();
                self.permuted(&LANES[count.wrapping_sub(1) % $lanes])
            }
        }
    };
    ($name:ident, $trait:ident, $function:ident, $float:ident) => {
        impl $trait for $name {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(machine::$float::$function(self.0, other.0))
            }
        }
    };
}

register! {
    /// Register of two `f64`.
    F64x2 = 2 of f64, in double, bits: u64
}

register! {
    /// Register of four `f32`.
    F32x4 = 4 of f32, in single, bits: u32
}

impl Scalar for F64x2 {
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f64>()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        <Self as Simd<f64>>::splat(value)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if machine::double::all_below(self.0, double::LIMIT) {
            return double::sin_cos_of(double::reduce(self));
        }
        let (sines, cosines) = double::far(self.to_array());
        (Self::from_array(sines), Self::from_array(cosines))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(machine::double::sqrt(self.0))
    }
}

impl Scalar for F32x4 {
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f32>()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        <Self as Simd<f32>>::splat(<f32 as Scalar>::from_f64(value))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sines, cosines) = sin_cos_f32(self.to_array());
        (Self::from_array(sines), Self::from_array(cosines))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(machine::single::sqrt(self.0))
    }
}

impl double::UnfusedNumber for F64x2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        <Self as Simd<f64>>::splat(value)
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let (sine, cosine) = machine::double::exchange(quarter.0, sine.0, cosine.0);
        (Self(sine), Self(cosine))
    }
}
