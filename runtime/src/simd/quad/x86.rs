//! Packs of x86-64: a register of AVX2.

#![allow(unsafe_code)]

use core::arch::x86_64::{
    __m256d, _mm256_add_pd, _mm256_div_pd, _mm256_fmadd_pd, _mm256_fnmadd_pd, _mm256_load_pd,
    _mm256_mul_pd, _mm256_permute4x64_pd, _mm256_set1_pd, _mm256_store_pd, _mm256_sub_pd,
};

use super::{OneLink, Pack, PackKernel, Quad};
use crate::simd::{Fused, InstructionSet};

#[inline(always)]
pub(super) fn run<K: PackKernel<f64>>(kernel: K) {
    match InstructionSet::widest() {
        InstructionSet::Build => kernel.run::<Quad<f64>>(),
        // SAFETY: the machine has what the functions are compiled for, since
        // `widest` has asked for it.
        InstructionSet::Avx2 => unsafe { fused(kernel) },
        // SAFETY: `widest` has asked for AVX-512.
        InstructionSet::Avx512 => unsafe { in_more_registers(kernel) },
    }
}

/// As [`fused`], bit for bit, with thirty-two registers instead of sixteen:
/// what does not fit waits for the memory.
#[target_feature(enable = "avx512f,avx512vl")]
fn in_more_registers<K: PackKernel<f64>>(kernel: K) {
    kernel.run::<Register>();
}

#[target_feature(enable = "avx2,fma")]
fn fused<K: PackKernel<f64>>(kernel: K) {
    kernel.run::<Register>();
}

/// A register of AVX2. Products are fused with the sums they go into.
///
/// Its functions ask for AVX2 and FMA: this type does not leave the module
/// but as the parameter of a kernel that [`run`] has seen the features for.
#[derive(Clone, Copy)]
struct Register(__m256d);

impl Pack<f64> for Register {
    type Single = OneLink<Fused<f64>>;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn load(numbers: &[Quad<f64>], index: usize) -> Self {
        // SAFETY: AVX2 is there where this type is named; a `Quad<f64>` is 32 bytes,
        // aligned to 32 bytes.
        Self(unsafe { _mm256_load_pd(numbers[index].0.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, numbers: &mut [Quad<f64>], index: usize) {
        // SAFETY: AVX2 is there where this type is named; a `Quad<f64>` is 32 bytes,
        // aligned to 32 bytes.
        unsafe { _mm256_store_pd(numbers[index].0.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_add_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_sub_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_mul_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_fmadd_pd(a.0, b.0, self.0) })
    }

    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_fnmadd_pd(a.0, b.0, self.0) })
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe { _mm256_div_pd(_mm256_set1_pd(1.0), self.0) })
    }

    #[inline(always)]
    fn broadcast<const INDEX: usize>(self) -> Self {
        // SAFETY: AVX2 and FMA are there where this type is named.
        Self(unsafe {
            match INDEX {
                0 => _mm256_permute4x64_pd::<0b00_00_00_00>(self.0),
                1 => _mm256_permute4x64_pd::<0b01_01_01_01>(self.0),
                2 => _mm256_permute4x64_pd::<0b10_10_10_10>(self.0),
                _ => _mm256_permute4x64_pd::<0b11_11_11_11>(self.0),
            }
        })
    }
}
