//! Choice of instructions for targets that have a single instruction set.

use super::super::{Kernel, Simd};
use super::{InstructionSet, StateKernel};
use crate::scalar::Lane;

/// Proof that the machine has the instructions of the build, which it always has.
#[derive(Clone, Copy)]
pub(in crate::simd) struct Present;

impl Present {
    #[inline(always)]
    pub(super) fn widest() -> Self {
        Self
    }

    #[inline(always)]
    pub(super) fn at_most(_set: InstructionSet) -> Self {
        Self
    }

    #[inline(always)]
    pub(super) fn set(self) -> InstructionSet {
        InstructionSet::Build
    }
}

#[inline(always)]
#[allow(clippy::extra_unused_type_parameters)] // Registers that there are none of here.
pub(super) fn run<T, B: Simd<T>, A: Simd<T>, W: Simd<T>, K: Kernel<T>>(
    _set: Present,
    kernel: K,
) -> K::Output {
    kernel.run::<B>()
}

#[inline(always)]
pub(super) fn run_wide<T: Lane, K: Kernel<T>>(_set: Present, kernel: K) -> K::Output {
    // On a target without vector instructions, registers would be arrays: more code, and no faster.
    #[cfg(all(target_family = "wasm", not(target_feature = "simd128")))]
    return kernel.run::<T>();
    #[cfg(not(all(target_family = "wasm", not(target_feature = "simd128"))))]
    kernel.run::<T::Build>()
}

#[inline(always)]
pub(super) fn run_state<T, K: StateKernel<T>>(
    _model: &K::Model,
    _time: T,
    _theta: &[T],
    _omega: &[T],
    _out: &mut [T],
) -> bool {
    false
}

#[inline(always)]
pub(super) fn outlined_avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[inline(always)]
pub(super) fn outlined_avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}
