//! Roots from which the Taylor method computes its step length.

use crate::scalar::Real;

/// Returns, in each of the first `lanes` lanes, the smaller of x^(−1/n) for two pairs of x ≥ 0 and
/// n ≥ 2, to four digits: infinite if both x are zero, zero if one is infinite, NaN if one is NaN.
///
/// A step length needs no more digits, and a logarithm and an exponential of full accuracy would
/// take longer than an order of the series. Every step waits for this result, so it uses
/// polynomials, in pairs of terms that do not wait for each other, and no branches, so that the
/// compiler emits vector instructions.
#[inline(always)]
pub(super) fn least_inverse_roots<T: Real, const N: usize>(
    lanes: usize,
    (before, order_before): (&[T; N], usize),
    (last, order): (&[T; N], usize),
) -> [T; N] {
    let mut steps = [T::ZERO; N];
    let over = [-1.0 / order_before as f64, -1.0 / order as f64];
    for lane in 0..lanes.min(N) {
        let [before, last] = [before[lane].to_f64(), last[lane].to_f64()];
        let [of_before, of_last] = [log2(before) * over[0], log2(last) * over[1]];
        let infinite = f64::INFINITY;
        let of_before = if before > f64::MIN_POSITIVE {
            of_before
        } else {
            infinite
        };
        let of_last = if last > f64::MIN_POSITIVE {
            of_last
        } else {
            infinite
        };
        let least = if of_before < of_last {
            of_before
        } else {
            of_last
        };
        let power = exp2(least);
        let step = if least < infinite { power } else { infinite };
        // Zero where one of them is infinite, NaN where one is NaN.
        let sum = before + last;
        let step = if sum < infinite { step } else { 1.0 / sum };
        steps[lane] = T::from_f64(step);
    }
    steps
}

/// Returns log₂ x = e + log₂ m for x = 2ᵉ m with √½ ≤ m < √2, with an error up to 3e-5.
fn log2(x: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    // Moves the boundary between exponents to √2.
    const SHIFT: u64 = 0x3FF0_0000_0000_0000 - 0x3FE6_A09E_667F_3BCD;
    // Whole numbers below are its last bits.
    const EXPONENT: f64 = 4_503_599_627_370_496.0;
    // Of the polynomial that is log₂(1 + t)/t at the Chebyshev nodes of the range.
    const TERMS: [f64; 5] = [
        1.442_640_464_283_215,
        -0.720_629_215_859_913,
        0.485_737_842_442_622,
        -0.389_675_223_791_798,
        0.250_287_846_961_010,
    ];
    let shifted = x.to_bits().wrapping_add(SHIFT);
    let exponent = f64::from_bits((shifted >> 52) | EXPONENT.to_bits()) - (EXPONENT + 1023.0);
    let t = f64::from_bits((shifted & FRACTION) + 0x3FE6_A09E_667F_3BCD) - 1.0;
    let square = t * t;
    let [a, b, c, d, e] = TERMS;
    (exponent + a * t) + square * ((b + c * t) + square * (d + e * t))
}

/// Returns 2ˣ for |x| < 1,000, with an error up to 5e-5: the series of e^(x ln 2) is used for the
/// distance of x from a whole number.
fn exp2(x: f64) -> f64 {
    // Adding and subtracting it rounds to a whole number.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let shifted = x + ROUND;
    let whole = shifted - ROUND;
    let r = (x - whole) * core::f64::consts::LN_2;
    let square = r * r;
    let series = (1.0 + r) + square * ((0.5 + r * (1.0 / 6.0)) + square * (1.0 / 24.0));
    // Its last bits are that number.
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0_f64.to_bits()));
    power * series
}

#[cfg(test)]
mod tests {
    use super::least_inverse_roots;

    fn least(first: (f64, usize), second: (f64, usize)) -> f64 {
        least_inverse_roots(1, (&[first.0], first.1), (&[second.0], second.1))[0]
    }

    #[test]
    fn roots_are_roots() {
        for n in [2, 3, 7, 20, 100] {
            let mut x = f64::MIN_POSITIVE * 2.0;
            while x < 1e308 {
                let root = least((x, n), (0.0, n));
                let expected = x.powf(-1.0 / n as f64);
                assert!((root / expected - 1.0).abs() < 1e-4, "{x:e} {n}");
                x *= 1.37;
            }
        }
    }

    #[test]
    fn ends_of_the_range() {
        let roots = |x| least((1.0, 20), (x, 25));
        assert_eq!(least((0.0, 20), (0.0, 20)), f64::INFINITY);
        assert_eq!(roots(0.0), 1.0);
        assert_eq!(roots(f64::INFINITY), 0.0);
        assert!(roots(f64::NAN).is_nan());
    }
}
