//! Where there is nothing to choose from.

use core::marker::PhantomData;

use super::super::{Fused, Kernel, Simd};
use super::{Chosen, InstructionSet, RegisterKernel, Routine, Sealed, StateKernel, Wide};
use crate::scalar::Lane;

#[inline(always)]
pub(super) fn widest() -> InstructionSet {
    InstructionSet::Build
}

#[inline(always)]
pub(super) fn run<K: Routine>(_set: InstructionSet, kernel: K) -> K::Output {
    kernel.run()
}

#[inline(always)]
pub(super) fn run_state<T, K: StateKernel<T>>(
    _model: &K::Model,
    _time: T,
    _theta: &[T],
    _omega: &[T],
    _out: &mut [T],
) -> bool
where
    Fused<T>: Simd<T>,
{
    false
}

#[inline(always)]
pub(super) fn run_in_registers<T: Sealed, K: RegisterKernel<T>>(
    _set: InstructionSet,
    kernel: K,
) -> K::Output {
    Chosen::<K, T::Build>(kernel, PhantomData).run()
}

#[inline(always)]
pub(super) fn run_wide<T: Lane, K: Kernel<T>>(_set: InstructionSet, kernel: K) -> K::Output {
    Chosen::<Wide<K>, T::Build>(Wide(kernel), PhantomData).run()
}

#[inline(always)]
pub(super) fn outlined_avx2<K: Routine>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn outlined_avx512<K: Routine>(kernel: K) -> K::Output {
    kernel.run()
}
