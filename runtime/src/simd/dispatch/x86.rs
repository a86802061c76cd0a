//! The instructions of x86-64 machines, asked for when first used.

#![allow(unsafe_code)]

use core::slice;
use core::sync::atomic::{AtomicU8, Ordering};

use super::super::{Kernel, Simd};
use super::{InstructionSet, StateKernel};
use crate::scalar::Lane;

/// 0 before the first question, then 1 + the answer.
static WIDEST: AtomicU8 = AtomicU8::new(0);

/// Instructions that this machine has: nothing but the question whether it has them makes
/// one.
#[derive(Clone, Copy)]
pub(in crate::simd) struct Present(InstructionSet);

impl Present {
    /// The widest.
    #[inline(always)]
    pub(super) fn widest() -> Self {
        // Each thread that comes first finds the same answer.
        Self(match WIDEST.load(Ordering::Relaxed) {
            0 => detect(),
            1 => InstructionSet::Build,
            2 => InstructionSet::Avx2,
            _ => InstructionSet::Avx512,
        })
    }

    /// Instructions of `set`, or the widest, if these are narrower: each set holds those before.
    #[inline(always)]
    pub(super) fn at_most(set: InstructionSet) -> Self {
        Self(set.min(Self::widest().0))
    }

    /// Which they are.
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

/// Runs `kernel` with instructions of the machine, in numbers `B` for those of the build,
/// `A` for AVX2 and `W` for AVX-512, which need no more than these.
#[inline(always)]
pub(super) fn run<T, B: Simd<T>, A: Simd<T>, W: Simd<T>, K: Kernel<T>>(
    set: Present,
    kernel: K,
) -> K::Output {
    match set.0 {
        InstructionSet::Build => kernel.in_build::<B>(),
        // SAFETY: the machine has AVX2 and FMA: they are `Present`.
        InstructionSet::Avx2 => unsafe { kernel.in_avx2::<A>() },
        // SAFETY: the machine has these instructions of AVX-512: they are `Present`.
        InstructionSet::Avx512 => unsafe { kernel.in_avx512::<W>() },
    }
}

/// With SSE2 in single numbers: every model would be compiled once more for registers of
/// two, and hardly a machine runs them.
#[inline(always)]
pub(super) fn run_wide<T: Lane, K: Kernel<T>>(set: Present, kernel: K) -> K::Output {
    run::<T, T, T::Avx2, T::Avx512, K>(set, kernel)
}

/// Runs `K` with the widest instructions that fuse: 512 bits have twice as many
/// registers, which single numbers gain by too. False, and nothing done, if the machine
/// has none that do, or if a slice has another length.
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
        // SAFETY: AVX2 and FMA are `Present`; the pointers are those of slices of
        // `K::LINKS` numbers, the last one borrowed mutably.
        InstructionSet::Avx2 => unsafe {
            state_avx2::<T, K>(model, time, theta, omega, out);
        },
        // SAFETY: AVX-512 is `Present` too; the pointers are those of slices of
        // `K::LINKS` numbers, the last one borrowed mutably.
        InstructionSet::Avx512 => unsafe {
            state_avx512::<T, K>(model, time, theta, omega, out);
        },
    }
    true
}

/// As `state`.
#[target_feature(enable = "avx2,fma")]
unsafe fn state_avx2<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: the caller's.
    unsafe { state::<T, K>(model, time, theta, omega, out) }
}

/// As `state`.
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
unsafe fn state_avx512<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: the caller's.
    unsafe { state::<T, K>(model, time, theta, omega, out) }
}

/// Without the lengths of the slices, which are known: for three links these, and
/// asking for them again, are a thirtieth of an evaluation.
///
/// # Safety
/// The pointers must be those of slices of `K::LINKS` numbers, of which the last
/// one is borrowed mutably, and outlives the call like the others.
#[inline(always)]
unsafe fn state<T: Lane, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: *const T,
    omega: *const T,
    out: *mut T,
) {
    // SAFETY: the caller's.
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
    // SAFETY: methods of types ask for it that exist in computations alone which `run_state`
    // or `run` has started, where these instructions are `Present` (see `simd`).
    unsafe { avx2::<T, V, K>(kernel) }
}

#[inline(always)]
pub(super) fn outlined_avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    // SAFETY: likewise where AVX-512 is `Present`.
    unsafe { avx512::<T, V, K>(kernel) }
}

// Functions of this module, unlike those of `InSet`: as parts of one state they must stand with
// `state_avx2` and `state_avx512`. Apart, one state of 127 links written out takes 1.36 times as
// long.

#[target_feature(enable = "avx2,fma")]
fn avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}

#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
fn avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    kernel.run::<V>()
}

/// A computation in the instructions of each set: methods of its own, since compilers put a
/// method beside its type, and compile side by side what stands in different modules.
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
