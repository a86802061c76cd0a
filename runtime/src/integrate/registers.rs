//! The numbers in registers, one by one. A single number is a register of one lane.

use alloc::vec::Vec;

use crate::scalar::Real;
use crate::simd::Simd;
pub(crate) use crate::simd::WIDEST;

/// One number a lane; those beyond the last lane mean nothing.
pub(crate) type Numbers<T> = [T; WIDEST];

/// The numbers of a register.
#[inline(always)]
pub(crate) fn numbers<T: Real, R: Simd<T>>(register: R) -> Numbers<T> {
    const { assert!(R::LANES <= WIDEST) }
    let mut numbers = [T::ZERO; WIDEST];
    register.store(&mut numbers);
    numbers
}

/// The register of these numbers.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn register<T: Real, R: Simd<T>>(numbers: &Numbers<T>) -> R {
    const { assert!(R::LANES <= WIDEST) }
    match R::load(numbers) {
        Some(register) => register,
        // There are enough numbers: asserted.
        None => R::from_f64(f64::NAN),
    }
}

/// The numbers that these registers have in a lane.
pub(crate) fn numbers_in<T: Real, R: Simd<T>>(registers: &[R], lane: usize) -> Vec<T> {
    registers.iter().map(|&r| numbers(r)[lane]).collect()
}

/// Writes them to `out`.
#[cfg(feature = "std")]
pub(crate) fn copy_lane<T: Real, R: Simd<T>>(registers: &[R], lane: usize, out: &mut [T]) {
    for (out, &register) in out.iter_mut().zip(registers) {
        *out = numbers(register)[lane];
    }
}

/// Changes one of the numbers.
#[cfg(feature = "std")]
pub(crate) fn set_lane<T: Real, R: Simd<T>>(target: &mut R, lane: usize, value: T) {
    let mut changed = numbers(*target);
    changed[lane] = value;
    *target = register(&changed);
}

/// Zero where all these numbers are finite and `check` is zero, NaN elsewhere.
#[inline(always)]
pub(crate) fn check_finite<T: Real, R: Simd<T>>(mut check: R, values: &[R]) -> R {
    for value in values {
        // Infinity times zero is NaN.
        check = value.mul_add(R::from_f64(0.0), check);
    }
    check
}

/// The smallest power of two whose inverse is finite.
pub(crate) fn smallest_divisor<T: Real>() -> T {
    let half = T::from_f64(0.5);
    let mut smallest = T::ONE;
    while (T::ONE / (smallest * half)).is_finite() {
        smallest = smallest * half;
    }
    smallest
}
