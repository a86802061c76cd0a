//! The widest vector instructions of the machine, chosen at run time.
//!
//! A build for x86-64 may use SSE2 only, unless it names a newer processor.
//! A [`Kernel`] is compiled three times, each with wider instructions allowed and with
//! the numbers to compute with, and the copy runs that the machine can.
//!
//! The wide registers fuse products with sums, and so does [`in_fused`] for one number
//! at a time: they have equal bits for AVX2 and AVX-512, and others without.

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

/// Vector instructions that a build can choose among at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum InstructionSet {
    /// Instructions that the build was made for: SSE2 for x86-64 by default, NEON for AArch64.
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

/// Runs `kernel` with single numbers that fuse, where the type and the machine have some,
/// and with plain ones elsewhere.
#[inline(always)]
pub(crate) fn in_fused_numbers<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InFusedNumbers(kernel))
}

/// Asks for single numbers that fuse.
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

/// Runs `kernel` with fused single numbers and the widest instructions that fuse.
///
/// # Errors
/// Gives the kernel back if the machine has none.
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

/// A computation on one state in fused arithmetic. What it needs is told one by one:
/// that goes in the processor's registers, where a structure would go through memory.
// Where there is nothing to choose from, nothing calls it.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub trait StateKernel<T> {
    /// Whose state it is.
    type Model;

    /// How long its slices are.
    const LINKS: usize;

    /// True if its functions are so long that parts of them are functions of their
    /// own, which are compiled for AVX2: then so is the rest.
    const IN_PARTS: bool = Self::LINKS > 63;

    /// Computes `out` in one kind of numbers. What it calls profits only as far as it is
    /// inlined.
    fn run<V: Simd<T>>(model: &Self::Model, time: T, theta: &[T], omega: &[T], out: &mut [T]);
}

/// Computes one state of the model in fused arithmetic. False, and nothing done, where
/// the type or the machine has none.
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

/// Asks for fused arithmetic.
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

/// Runs `kernel` in a function of its own with AVX2 and FMA, in numbers `V`. For the methods
/// of types alone that exist where the machine has these.
#[inline(always)]
pub(crate) fn outlined_avx2<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    machine::outlined_avx2::<T, V, K>(kernel)
}

/// Does so with AVX-512.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[inline(always)]
pub(crate) fn outlined_avx512<T, V: Simd<T>, K: Kernel<T>>(kernel: K) -> K::Output {
    machine::outlined_avx512::<T, V, K>(kernel)
}

/// Runs `kernel` with the registers of `set`, or with the widest that the
/// machine has, if these are narrower.
#[inline(always)]
pub(crate) fn run_in_registers<T: Lane, K: Kernel<T>>(set: InstructionSet, kernel: K) -> K::Output {
    machine::run::<T, T::Build, T::Avx2, T::Avx512, K>(Present::at_most(set), kernel)
}

/// Runs `kernel` with the wide numbers of `set`, or with the widest that the machine
/// has, if these are narrower.
#[inline(always)]
pub(crate) fn run_wide<T: Lane, K: Kernel<T>>(set: InstructionSet, kernel: K) -> K::Output {
    machine::run_wide(Present::at_most(set), kernel)
}

/// Runs `kernel` with the widest numbers of the machine that are made of `T`.
#[inline(always)]
pub(crate) fn in_widest<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InWidest(kernel))
}

/// Asks for the widest numbers.
struct InWidest<K>(K);

impl<S: Scalar, K: Kernel<S>> ByKind<S> for InWidest<K> {
    type Output = K::Output;

    #[inline(always)]
    fn of_any(self) -> K::Output {
        self.0.run::<S>()
    }

    // Not everywhere where it is asked for.
    #[inline]
    fn of_plain(self) -> K::Output
    where
        S: Lane,
    {
        run_wide(InstructionSet::widest(), self.0)
    }
}

/// Runs `kernel` with the machine's numbers of four lanes that are made of `T`.
#[inline(always)]
pub(crate) fn in_fours<T: Scalar, K: Kernel<T>>(kernel: K) -> K::Output {
    T::by_kind(InFours(kernel))
}

/// Asks for numbers of four lanes.
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

/// Says that a check is skipped which needs these instructions.
///
/// # Panics
/// Where the environment variable `CI` is set, which promises AVX2.
#[cfg(test)]
pub(crate) fn or_skip(set: InstructionSet) {
    let promised = set <= InstructionSet::Avx2 && std::env::var_os("CI").is_some();
    assert!(!promised, "CI promises {set}");
    std::println!("skipped: no {set}");
}

/// Says of each set of instructions that this machine lacks that it is not checked.
#[cfg(test)]
pub(crate) fn skip_missing() {
    for set in InstructionSet::ALL {
        if set > InstructionSet::widest() {
            or_skip(set);
        }
    }
}
