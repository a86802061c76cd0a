//! Detection of the vector instructions of x86-64 machines at their first use.

#![allow(unsafe_code)]

use core::slice;
use core::sync::atomic::{AtomicU8, Ordering};

use super::super::{Kernel, Simd};
use super::{InstructionSet, StateKernel};
use crate::scalar::Lane;

/// Detected instruction set: 0 before the first detection, then 1 + the index of the set.
static WIDEST: AtomicU8 = AtomicU8::new(0);

/// Instructions that this machine has. A value of this type can only be created by the detection.
#[derive(Clone, Copy)]
pub(in crate::simd) struct Present(InstructionSet);

impl Present {
    /// Returns the widest set of the machine.
    #[inline(always)]
    pub(super) fn widest() -> Self {
        // Several threads may detect at the same time; they find the same result.
        Self(match WIDEST.load(Ordering::Relaxed) {
            0 => detect(),
            1 => InstructionSet::Build,
            2 => InstructionSet::Avx2,
            _ => InstructionSet::Avx512,
        })
    }

    /// Returns the instructions of `set`, or the machine's widest if these are narrower; each set
    /// includes the ones before it.
    #[inline(always)]
    pub(super) fn at_most(set: InstructionSet) -> Self {
        Self(set.min(Self::widest().0))
    }

    /// Returns the instruction set.
    #[inline(always)]
    pub(super) fn set(self) -> InstructionSet {
        self.0
    }
}

#[cold]
#[inline(never)]
fn detect() -> InstructionSet {
    let (code, set) = if has_avx512() {
        (3, InstructionSet::Avx512)
    } else if has_avx2() {
        (2, InstructionSet::Avx2)
    } else {
        (1, InstructionSet::Build)
    };
    WIDEST.store(code, Ordering::Relaxed);
    set
}

fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

fn has_avx512() -> bool {
    has_avx2()
        && std::is_x86_feature_detected!("avx512f")
        && std::is_x86_feature_detected!("avx512vl")
        && std::is_x86_feature_detected!("avx512dq")
        && std::is_x86_feature_detected!("avx512bw")
}

/// Runs `kernel` with the instructions `set`, in numbers of type `B` for the instructions of the
/// build, `A` for AVX2, or `W` for AVX-512. These types need no other instructions.
#[inline(always)]
pub(super) fn run<T, B: Simd<T>, A: Simd<T>, W: Simd<T>, K: Kernel<T>>(
    set: Present,
    kernel: K,
) -> K::Output {
    match set.0 {
        InstructionSet::Build => kernel.in_build::<B>(),
        // SAFETY: the machine has AVX2 and FMA, because they are `Present`.
        InstructionSet::Avx2 => unsafe { kernel.in_avx2::<A>() },
        // SAFETY: the machine has these instructions of AVX-512, because they are `Present`.
        InstructionSet::Avx512 => unsafe { kernel.in_avx512::<W>() },
    }
}

/// Runs `kernel` with wide numbers. With SSE2 only, single numbers are used: registers of two
/// numbers would require every model to be compiled once more, and hardly any machine would use
/// them.
#[inline(always)]
pub(super) fn run_wide<T: Lane, K: Kernel<T>>(set: Present, kernel: K) -> K::Output {
    run::<T, T, T::Avx2, T::Avx512, K>(set, kernel)
}

/// Runs `K` on one state with the widest instructions that have fused multiply–add. AVX-512 has
/// twice as many registers, which helps single numbers too. Returns false, without computing
/// anything, if the machine has no fused multiply–add or if a slice has a wrong length.
#[inline(always)]
pub(super) fn run_state<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: &[T],
    omega: &[T],
    out: &mut [T],
) -> bool {
    if theta.len() != K::LINKS || omega.len() != K::LINKS || out.len() != K::LINKS {
        return false;
    }
    let (theta, omega, out) = (theta.as_ptr(), omega.as_ptr(), out.as_mut_ptr());
    let widest = if K::IN_PARTS {
        Present::at_most(InstructionSet::Avx2)
    } else {
        Present::widest()
    };
    match widest.0 {
        InstructionSet::Build => return false,
        // SAFETY: AVX2 and FMA are `Present`; the pointers are those of slices of `K::LINKS`
        // numbers, the last of which is mutably borrowed.
        InstructionSet::Avx2 => unsafe {
            state_avx2::<T, K>(model, time, theta, omega, out);
        },
        // SAFETY: AVX-512 is `Present` too; the pointers are those of slices of `K::LINKS` numbers,
        // the last of which is mutably borrowed.
        InstructionSet::Avx512 => unsafe {
            state_avx512::<T, K>(model, time, theta, omega, out);
        },
    }
    true
}

/// Runs [`state`], compiled for AVX2, with the same conditions for safety.
#[target_feature(enable = "avx2,fma")]
unsafe fn state_avx2<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: guaranteed by the caller.
    unsafe { state::<T, K>(model, time, theta, omega, out) }
}

/// Runs [`state`], compiled for AVX-512, with the same conditions for safety.
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
unsafe fn state_avx512<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: guaranteed by the caller.
    unsafe { state::<T, K>(model, time, theta, omega, out) }
}

/// Runs the computation `K` on one state, given pointers instead of slices. For three links,
/// passing and checking the lengths would take a thirtieth of an evaluation.
///
/// # Safety
/// The pointers must be those of slices of `K::LINKS` numbers that outlive the call; the last one
/// must be mutably borrowed.
#[inline(always)]
unsafe fn state<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: guaranteed by the caller.
    let (theta, omega, out) = unsafe {
        (
            slice::from_raw_parts(theta, K::LINKS),
            slice::from_raw_parts(omega, K::LINKS),
            slice::from_raw_parts_mut(out, K::LINKS),
        )
    };
    K::run::<T::Fused>(model, time, theta, omega, out);
}

#[inline(always)]
pub(super) fn outlined_avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    // SAFETY: called by methods of types that exist only in computations which `run_state` or `run`
    // has started, where these instructions are `Present` (see `simd`).
    unsafe { avx2::<T, V, K>(kernel) }
}

#[inline(always)]
pub(super) fn outlined_avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    // SAFETY: as in `outlined_avx2`, with AVX-512 `Present`.
    unsafe { avx512::<T, V, K>(kernel) }
}

// Functions of this module, unlike those of `InSet`: as parts of one state they must be in the same
// module as `state_avx2` and `state_avx512`. In another module, one state of 127 links written out
// takes 1.36 times as long.

#[target_feature(enable = "avx2,fma")]
fn avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}

#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
fn avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}

/// A computation that can run in the instructions of each set. It is a trait, because compilers
/// place a method in the module of its type, and compile different modules in parallel.
trait InSet<T>: Kernel<T> + Sized {
    #[inline(never)]
    fn in_build<V: Simd<T>>(self) -> Self::Output {
        self.run::<V>()
    }

    /// # Safety
    /// The machine must have AVX2 and FMA.
    #[target_feature(enable = "avx2,fma")]
    unsafe fn in_avx2<V: Simd<T>>(self) -> Self::Output {
        self.run::<V>()
    }

    /// # Safety
    /// The machine must have these instructions of AVX-512, AVX2 and FMA.
    #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
    unsafe fn in_avx512<V: Simd<T>>(self) -> Self::Output {
        self.run::<V>()
    }
}

impl<T, K: Kernel<T>> InSet<T> for K {}
