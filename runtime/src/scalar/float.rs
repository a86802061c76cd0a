//! The scalars `f64` and `f32`.

use super::kind::{ByKind, Compiled};
use super::lanes::{Lane, Registers};
use super::{Real, Scalar, sincos};
use crate::simd::Fused;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use crate::simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
use crate::simd::{F32x4, F64x2};

/// Selects the vector register type with this name, or an array with the same number of lanes if
/// the target has no such register.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
macro_rules! register {
    ($name:ty, $lanes:literal of $float:ident) => {
        $name
    };
}

#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
macro_rules! register {
    ($name:ty, $lanes:literal of f64) => {
        F64x2
    };
    ($name:ty, $lanes:literal of f32) => {
        F32x4
    };
}

#[cfg(not(any(
    all(target_arch = "x86_64", target_feature = "sse2"),
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
macro_rules! register {
    ($name:ty, $lanes:literal of $float:ident) => {
        crate::scalar::Lanes<$float, $lanes>
    };
}

macro_rules! implement_scalar {
    ($float:ident, $sin_cos:path, $several:path, $sqrt:ident, $pow:ident,
     $lanes:literal, $build:ty, $avx2:ty, $avx512:ty, $four:ty, $compiled:ident) => {
        impl Scalar for $float {
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation)]
            fn from_f64(value: f64) -> Self {
                value as $float
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let ([sine], [cosine]) = $sin_cos([self]);
                (sine, cosine)
            }

            #[inline(always)]
            fn sin_cos_each<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
                $several(angles)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return $float::sqrt(self);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return libm::$sqrt(self);
            }

            #[inline(always)]
            fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
                question.of_plain()
            }
        }

        impl Lane for $float {}

        impl Registers for $float {
            type Build = register!($build, $lanes of $float);
            type Avx2 = register!($avx2, $lanes of $float);
            type Avx512 = register!($avx512, $lanes of $float);
            type Fused = Fused<$float>;
            type Four = register!($four, 4 of $float);

            #[inline(always)]
            fn compiled<C: Compiled>() -> C::Function<Self> {
                C::$compiled()
            }
        }

        impl Real for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: Self = $float::EPSILON;
            const NAN: Self = $float::NAN;

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }

            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                #[cfg(feature = "std")]
                return $float::powf(self, exponent);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return libm::$pow(self, exponent);
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
        }
    };
}

implement_scalar!(
    f64,
    sincos::sin_cos_f64,
    sincos::several_f64,
    sqrt,
    pow,
    4,
    F64x2,
    F64x4,
    F64x8,
    F64x4,
    of_f64
);
implement_scalar!(
    f32,
    sincos::sin_cos_f32,
    sincos::several_f32,
    sqrtf,
    powf,
    8,
    F32x4,
    F32x8,
    F32x16,
    crate::scalar::Lanes<f32, 4>,
    of_f32
);

#[cfg(test)]
mod tests {
    use crate::scalar::{Real, Scalar};

    fn laws<T: Real>() {
        let angle = T::from_f64(0.7);
        let (sine, cosine) = Scalar::sin_cos(angle);
        let defect = sine * sine + cosine * cosine - T::ONE;
        assert!(Real::abs(defect) <= T::EPSILON + T::EPSILON);
        let two = T::ONE + T::ONE;
        assert_eq!(Scalar::sqrt(two * two), two);
        assert_eq!(Real::powf(two, two), two * two);
        assert!(!Real::is_finite(T::ONE / T::ZERO));
        assert!(Real::is_finite(T::ONE));
        assert!(T::ONE + T::EPSILON > T::ONE);
        assert_eq!(Real::to_f64(two), 2.0);
    }

    #[test]
    fn f64_and_f32_obey_the_same_laws() {
        laws::<f64>();
        laws::<f32>();
    }

    #[test]
    fn constants_round_once_to_the_nearest_value() {
        // 0.1 is not exactly an `f32`: the result must be the nearest one, not a truncation.
        assert_eq!(<f32 as Scalar>::from_f64(0.1), 0.1_f32);
        assert_eq!(<f64 as Scalar>::from_f64(0.1), 0.1_f64);
    }

    #[test]
    fn maximum_and_minimum_keep_self_beside_nan() {
        assert_eq!(Real::max(1.0_f64, f64::NAN), 1.0);
        assert_eq!(Real::min(1.0_f64, f64::NAN), 1.0);
        assert_eq!(Real::max(1.0_f64, 2.0), 2.0);
        assert_eq!(Real::min(1.0_f64, 2.0), 1.0);
    }
}
