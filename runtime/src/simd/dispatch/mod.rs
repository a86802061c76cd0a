//! Run-time choice of the widest vector instructions of the machine.
//!
//! A build for x86-64 may use SSE2 only, unless it is made for a newer processor. A [`Kernel`] is
//! compiled three times, each time with wider instructions and with the matching number types, and
//! the widest copy that the machine supports runs.
//!
//! The wide registers use fused multiply–add, and so does [`in_fused`] for one number at a time.
//! Results with AVX2 and AVX-512 are identical bit for bit, but differ from results without fused
//! multiply–add.

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
mod portable;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod x86;

use core::fmt;

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
use portable as machine;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use x86 as machine;

pub(super) use machine::Present;

use super::{Kernel, Simd};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lane, Lanes, Scalar};

/// Sets of vector instructions among which a build can choose at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum InstructionSet {
    /// Instructions for which the build was made: SSE2 for x86-64 by default, NEON for AArch64.
    Build,
    /// AVX2 and FMA, with registers of 256 bits.
    Avx2,
    /// AVX-512 (F, VL, DQ and BW), AVX2 and FMA, with registers of 512 bits.
    Avx512,
}

impl InstructionSet {
    /// All instruction sets, from narrow to wide.
    pub const ALL: [Self; 3] = [Self::Build, Self::Avx2, Self::Avx512];

    /// Returns the widest instruction set that this machine supports. Without the feature `std`,
    /// and on architectures other than x86-64, this is [`Build`](Self::Build).
    #[inline(always)]
    #[must_use]
    pub fn widest() -> Self {
        Present::widest().set()
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

/// Runs `kernel` with single numbers that use fused multiply–add, if the type and the machine
/// support it, and with plain numbers otherwise.
#[inline(always)]
pub(crate) fn in_fused_numbers<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InFusedNumbers(kernel))
}

/// Step of [`in_fused_numbers`] for a known lane type: runs a kernel with single numbers that use
/// fused multiply–add.
struct InFusedNumbers<K>(K);

impl<S: Scalar, K: Kernel<S>> ByKind<S> for InFusedNumbers<K> {
    type Output = K::Output;

    #[inline(always)]
    fn of_any(self) -> K::Output {
        self.0.run::<S>()
    }

    #[inline(always)]
    fn of_plain(self) -> K::Output
    where
        S: Lane,
    {
        machine::run::<S, S, S::Fused, S::Fused, K>(Present::widest(), self.0)
    }
}

/// Runs `kernel` with single numbers that use fused multiply–add, and the widest instructions that
/// have it.
///
/// # Errors
/// Returns the kernel unchanged if the machine has no such instructions.
#[cfg(test)]
pub(crate) fn run_fused<T: Lane, K: Kernel<T>>(kernel: K) -> Result<K::Output, K> {
    match InstructionSet::widest() {
        InstructionSet::Build => Err(kernel),
        _ => Ok(machine::run::<T, T, T::Fused, T::Fused, K>(
            Present::widest(),
            kernel,
        )),
    }
}

/// A computation on one state that uses fused multiply–add. Its inputs are separate arguments,
/// which are passed in the processor's registers; a struct would be passed in memory.
// Unused on targets with a single instruction set.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub trait StateKernel<T> {
    /// Type of the model to which the state belongs.
    type Model;

    /// Length of the slices.
    const LINKS: usize;

    /// True if the model's functions are so long that parts of them are compiled as separate
    /// functions. These parts are compiled for AVX2, and then the rest must be too.
    const IN_PARTS: bool = Self::LINKS > 63;

    /// Computes `out` in one kind of numbers. Called code profits only if it is inlined.
    fn run<V: Simd<T>>(model: &Self::Model, time: T, theta: &[T], omega: &[T], out: &mut [T]);
}

/// Runs the computation `K` on one state of the model with fused multiply–add. Returns false,
/// without computing anything, if the type or the machine has no such arithmetic.
#[inline(always)]
pub(crate) fn in_fused<T: Scalar, K: StateKernel<T>>(
    model: &K::Model,
    time: T,
    theta: &[T],
    omega: &[T],
    out: &mut [T],
) -> bool {
    T::by_kind(InFused::<'_, K, T> {
        model,
        time,
        theta,
        omega,
        out,
    })
}

/// Step of [`in_fused`] for a known lane type: runs a computation with fused multiply–add.
struct InFused<'a, K: StateKernel<T>, T> {
    model: &'a K::Model,
    time: T,
    theta: &'a [T],
    omega: &'a [T],
    out: &'a mut [T],
}

impl<S: Scalar, K: StateKernel<S>> ByKind<S> for InFused<'_, K, S> {
    type Output = bool;

    #[inline(always)]
    fn of_any(self) -> bool {
        false
    }

    #[inline(always)]
    fn of_plain(self) -> bool
    where
        S: Lane,
    {
        machine::run_state::<S, K>(self.model, self.time, self.theta, self.omega, self.out)
    }
}

/// Runs `kernel` in a separate function with AVX2 and FMA, in numbers `V`. It may be called only by
/// methods of types that exist only on machines with these instructions.
#[inline(always)]
pub(crate) fn outlined_avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    machine::outlined_avx2::<T, V, K>(kernel)
}

/// Runs `kernel` like [`outlined_avx2`], but with AVX-512.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[inline(always)]
pub(crate) fn outlined_avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    machine::outlined_avx512::<T, V, K>(kernel)
}

/// Runs `kernel` with the registers of `set`, or with the widest registers of the machine if these
/// are narrower.
#[inline(always)]
pub(crate) fn run_in_registers<T: Lane, K: Kernel<T>>(set: InstructionSet, kernel: K) -> K::Output {
    machine::run::<T, T::Build, T::Avx2, T::Avx512, K>(Present::at_most(set), kernel)
}

/// Runs `kernel` with the wide numbers of `set`, or with the widest numbers of the machine if these
/// are narrower.
#[inline(always)]
pub(crate) fn run_wide<T: Lane, K: Kernel<T>>(set: InstructionSet, kernel: K) -> K::Output {
    machine::run_wide(Present::at_most(set), kernel)
}

/// Runs `kernel` with the machine's widest numbers that consist of `T`.
#[inline(always)]
pub(crate) fn in_widest<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InWidest(kernel))
}

/// Step of [`in_widest`] for a known lane type: runs a kernel with the widest numbers.
struct InWidest<K>(K);

impl<S: Scalar, K: Kernel<S>> ByKind<S> for InWidest<K> {
    type Output = K::Output;

    #[inline(always)]
    fn of_any(self) -> K::Output {
        self.0.run::<S>()
    }

    // Not every caller can run a kernel with plain numbers.
    #[inline]
    fn of_plain(self) -> K::Output
    where
        S: Lane,
    {
        run_wide(InstructionSet::widest(), self.0)
    }
}

/// Runs `kernel` with the machine's numbers that consist of four lanes of `T`.
#[inline(always)]
pub(crate) fn in_fours<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InFours(kernel))
}

/// Step of [`in_fours`] for a known lane type: runs a kernel with numbers of four lanes.
struct InFours<K>(K);

impl<S: Scalar, K: Kernel<S>> ByKind<S> for InFours<K> {
    type Output = K::Output;

    #[inline(always)]
    fn of_any(self) -> K::Output {
        self.0.run::<Lanes<S, 4>>()
    }

    #[inline(always)]
    fn of_plain(self) -> K::Output
    where
        S: Lane,
    {
        machine::run::<S, Lanes<S, 4>, S::Four, S::Four, K>(Present::widest(), self.0)
    }
}

/// Prints that a check is skipped because the machine lacks the instructions that it needs.
///
/// # Panics
/// If the environment variable `CI` is set, because machines of continuous integration have AVX2.
#[cfg(test)]
pub(crate) fn or_skip(set: InstructionSet) {
    let promised = set <= InstructionSet::Avx2 && std::env::var_os("CI").is_some();
    assert!(!promised, "CI promises {set}");
    std::println!("skipped: no {set}");
}

/// Prints, for each instruction set that this machine lacks, that it is not checked.
#[cfg(test)]
pub(crate) fn skip_missing() {
    for set in InstructionSet::ALL {
        if set > InstructionSet::widest() {
            or_skip(set);
        }
    }
}
