//! The widest vector instructions of the machine, chosen at run time.
//!
//! A build for x86-64 may use SSE2 only, unless it names a newer processor.
//! [`run`] compiles a computation three times, with wider instructions allowed,
//! and takes the copy that the machine can run. The results have equal bits: each
//! instruction set computes the same IEEE 754 operations.
//!
//! [`run_in_registers`] hands a computation the registers to compute with. The
//! wide ones fuse products with sums, and so does [`run_state`] for one number at
//! a time: these two have equal bits for AVX2 and AVX-512, and others without.

use core::fmt;

use super::lanes::Sealed;
use super::register::Register;

/// Vector instructions that a build can choose among at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum InstructionSet {
    /// Those that the build was made for: SSE2 for x86-64 by default.
    Build,
    /// AVX2 and FMA, registers of 256 bits.
    Avx2,
    /// AVX-512 (F, VL, DQ and BW) besides, registers of 512 bits.
    Avx512,
}

impl InstructionSet {
    /// All of them, from narrow to wide.
    pub const ALL: [Self; 3] = [Self::Build, Self::Avx2, Self::Avx512];

    /// The widest that this machine has. Without the feature `std`, and on
    /// other architectures than x86-64, that is [`Build`](Self::Build).
    #[inline(always)]
    #[must_use]
    pub fn widest() -> Self {
        machine::widest()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Build => "the build's own instructions",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        })
    }
}

/// A computation that is compiled for several instruction sets. What it calls
/// profits only as far as it is inlined: write `#[inline(always)]`.
pub(crate) trait Kernel {
    /// What it returns.
    type Output;

    /// Computes.
    fn run(self) -> Self::Output;
}

/// Runs `kernel` with the instructions of `set`, or with the widest that the
/// machine has, if these are narrower.
#[cfg(test)]
pub(crate) fn run<K: Kernel>(set: InstructionSet, kernel: K) -> K::Output {
    machine::run(set.min(InstructionSet::widest()), kernel)
}

/// Runs `kernel` with the widest instructions of the machine.
#[inline(always)]
pub(crate) fn run_widest<K: Kernel>(kernel: K) -> K::Output {
    machine::run(InstructionSet::widest(), kernel)
}

/// Runs `kernel` with the widest instructions that fuse, for
/// [`Fused`](super::register::Fused) numbers.
///
/// # Errors
/// Gives the kernel back if the machine has none.
#[cfg(test)]
pub(crate) fn run_fused<K: Kernel>(kernel: K) -> Result<K::Output, K> {
    match InstructionSet::widest() {
        InstructionSet::Build => Err(kernel),
        set => Ok(machine::run(set, kernel)),
    }
}

/// A computation on one state in fused arithmetic. What it needs is told one by one:
/// that goes in the processor's registers, where a structure would go through memory.
// Where there is nothing to choose from, nothing calls it.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub(crate) trait StateKernel<T> {
    /// Whose state it is.
    type Model;

    /// How long its slices are.
    const LINKS: usize;

    /// Whether its functions are so long that parts of them are functions of their
    /// own, which are compiled for AVX2: then so is the rest.
    const IN_PARTS: bool = Self::LINKS > 63;

    /// Computes `out`. What it calls profits only as far as it is inlined.
    fn run(model: &Self::Model, time: T, theta: &[T], omega: &[T], out: &mut [T]);
}

/// Runs `K` with the widest instructions that fuse: 512 bits have twice as many
/// registers, which plain numbers gain by too. False, and nothing done, if the machine has
/// none that do, or if a slice has another length.
#[inline(always)]
pub(crate) fn run_state<T, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: &[T],
    omega: &[T],
    out: &mut [T],
) -> bool {
    machine::run_state::<T, K>(model, time, theta, omega, out)
}

/// Runs `kernel` in a function of its own with AVX2 and FMA. For types that exist
/// where the machine has them, and for their methods alone.
#[inline(always)]
pub(crate) fn outlined_avx2<K: Kernel>(kernel: K) -> K::Output {
    machine::outlined_avx2(kernel)
}

/// The same with AVX-512.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(crate) fn outlined_avx512<K: Kernel>(kernel: K) -> K::Output {
    machine::outlined_avx512(kernel)
}

/// A computation in registers.
pub(crate) trait RegisterKernel<T> {
    /// What it returns.
    type Output;

    /// Computes with one kind of registers.
    fn run<R: Register<Lane = T>>(self) -> Self::Output;
}

/// Runs `kernel` with the registers of `set`, or with the widest that the
/// machine has, if these are narrower.
#[inline(always)]
pub(crate) fn run_in_registers<T: Sealed, K: RegisterKernel<T>>(
    set: InstructionSet,
    kernel: K,
) -> K::Output {
    machine::run_in_registers(set.min(InstructionSet::widest()), kernel)
}

/// A kernel whose registers are chosen.
struct Chosen<K, R>(K, core::marker::PhantomData<R>);

impl<K: RegisterKernel<R::Lane>, R: Register> Kernel for Chosen<K, R> {
    type Output = K::Output;

    #[inline(always)]
    fn run(self) -> K::Output {
        self.0.run::<R>()
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[allow(unsafe_code)]
mod machine {
    use core::marker::PhantomData;
    use core::slice;
    use core::sync::atomic::{AtomicU8, Ordering};

    use super::{Chosen, InstructionSet, Kernel, RegisterKernel, Sealed, StateKernel};

    /// 0 before the first question, then 1 + the answer.
    static WIDEST: AtomicU8 = AtomicU8::new(0);

    #[inline(always)]
    pub(super) fn widest() -> InstructionSet {
        // Each thread that comes first finds the same answer.
        match WIDEST.load(Ordering::Relaxed) {
            0 => detect(),
            1 => InstructionSet::Build,
            2 => InstructionSet::Avx2,
            _ => InstructionSet::Avx512,
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

    /// `set` must have come from `widest`, or be narrower: this module is
    /// private, and the two functions above see to it.
    #[inline(always)]
    pub(super) fn run<K: Kernel>(set: InstructionSet, kernel: K) -> K::Output {
        match set {
            InstructionSet::Build => build(kernel),
            // SAFETY: the call is sound on machines that have the features
            // which the function enables. `widest` has asked for each of them,
            // and `set` is not wider.
            InstructionSet::Avx2 => unsafe { avx2(kernel) },
            // SAFETY: likewise.
            InstructionSet::Avx512 => unsafe { avx512(kernel) },
        }
    }

    #[inline(always)]
    pub(super) fn run_state<T, K: StateKernel<T>>(
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
            widest().min(InstructionSet::Avx2)
        } else {
            widest()
        };
        match widest {
            InstructionSet::Build => return false,
            // SAFETY: `widest` has asked for AVX2 and FMA; the pointers are those of
            // slices of `K::LINKS` numbers, the last one borrowed mutably.
            InstructionSet::Avx2 => unsafe {
                state_avx2::<T, K>(model, time, theta, omega, out);
            },
            // SAFETY: likewise, and AVX-512.
            InstructionSet::Avx512 => unsafe {
                state_avx512::<T, K>(model, time, theta, omega, out);
            },
        }
        true
    }

    /// As `state`.
    #[target_feature(enable = "avx2,fma")]
    unsafe fn state_avx2<T, K: StateKernel<T>>(
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
    unsafe fn state_avx512<T, K: StateKernel<T>>(
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
    unsafe fn state<T, K: StateKernel<T>>(
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
        K::run(model, time, theta, omega, out);
    }

    #[inline(always)]
    pub(super) fn outlined_avx2<K: Kernel>(kernel: K) -> K::Output {
        // SAFETY: asked for by types that exist in computations alone which
        // `run_state` or `run_in_registers` has started, where the machine has
        // these instructions.
        unsafe { avx2(kernel) }
    }

    #[inline(always)]
    pub(super) fn outlined_avx512<K: Kernel>(kernel: K) -> K::Output {
        // SAFETY: likewise.
        unsafe { avx512(kernel) }
    }

    /// As for `run`.
    #[inline(always)]
    pub(super) fn run_in_registers<T: Sealed, K: RegisterKernel<T>>(
        set: InstructionSet,
        kernel: K,
    ) -> K::Output {
        match set {
            InstructionSet::Build => build(Chosen::<K, T::Build>(kernel, PhantomData)),
            // SAFETY: as in `run`.
            InstructionSet::Avx2 => unsafe { avx2(Chosen::<K, T::Avx2>(kernel, PhantomData)) },
            // SAFETY: likewise.
            InstructionSet::Avx512 => unsafe {
                avx512(Chosen::<K, T::Avx512>(kernel, PhantomData))
            },
        }
    }

    #[inline(never)]
    fn build<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[target_feature(enable = "avx2,fma")]
    fn avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
    fn avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
mod machine {
    use core::marker::PhantomData;

    use super::{Chosen, InstructionSet, Kernel, RegisterKernel, Sealed, StateKernel};

    #[inline(always)]
    pub(super) fn widest() -> InstructionSet {
        InstructionSet::Build
    }

    #[inline(always)]
    pub(super) fn run<K: Kernel>(_set: InstructionSet, kernel: K) -> K::Output {
        kernel.run()
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
    pub(super) fn run_in_registers<T: Sealed, K: RegisterKernel<T>>(
        _set: InstructionSet,
        kernel: K,
    ) -> K::Output {
        Chosen::<K, T::Build>(kernel, PhantomData).run()
    }

    #[inline(always)]
    pub(super) fn outlined_avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(super) fn outlined_avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}
