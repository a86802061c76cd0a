//! Access to the single numbers in vector registers. A single number is a register of one lane.

use alloc::vec::Vec;

use crate::scalar::Real;
use crate::simd::Simd;
pub(crate) use crate::simd::WIDEST;

/// One number for each lane; entries after the last lane are unused.
pub(crate) type Numbers<T> = [T; WIDEST];

/// Returns the numbers in the lanes of a register.
#[inline(always)]
pub(crate) fn numbers<T: Real, R: Simd<T>>(register: R) -> Numbers<T> {
    const { assert!(R::LANES <= WIDEST) }
    let mut numbers = [T::ZERO; WIDEST];
    register.store(&mut numbers);
    numbers
}

/// Returns the register that holds these numbers.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn register<T: Real, R: Simd<T>>(numbers: &Numbers<T>) -> R {
    const { assert!(R::LANES <= WIDEST) }
    match R::load(numbers) {
        Some(register) => register,
        // Unreachable: the array is long enough, which is asserted.
        None => R::from_f64(f64::NAN),
    }
}

/// Returns the numbers in one lane of several registers.
pub(crate) fn numbers_in<T: Real, R: Simd<T>>(registers: &[R], lane: usize) -> Vec<T> {
    registers.iter().map(|&r| numbers(r)[lane]).collect()
}

/// Writes the numbers in one lane of several registers to `out`.
#[cfg(feature = "std")]
pub(crate) fn copy_lane<T: Real, R: Simd<T>>(registers: &[R], lane: usize, out: &mut [T]) {
    for (out, &register) in out.iter_mut().zip(registers) {
        *out = numbers(register)[lane];
    }
}

/// Sets the number in one lane of a register.
#[cfg(feature = "std")]
pub(crate) fn set_lane<T: Real, R: Simd<T>>(target: &mut R, lane: usize, value: T) {
    let mut changed = numbers(*target);
    changed[lane] = value;
    *target = register(&changed);
}

/// Returns, for each lane, zero if all values are finite and `check` is zero, and NaN otherwise.
#[inline(always)]
pub(crate) fn check_finite<T: Real, R: Simd<T>>(mut check: R, values: &[R]) -> R {
    for value in values {
        // Infinity times zero is NaN.
        check = value.mul_add(R::from_f64(0.0), check);
    }
    check
}

/// Returns the smallest power of two whose reciprocal is finite.
pub(crate) fn smallest_divisor<T: Real>() -> T {
    let half = T::from_f64(0.5);
    let mut smallest = T::ONE;
    while (T::ONE / (smallest * half)).is_finite() {
        smallest = smallest * half;
    }
    smallest
}
