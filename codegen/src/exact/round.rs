//! Rounding of an exact quotient to the nearest `f64`.

use super::integers::Integer;

/// Returns the `f64` nearest to `numerator / denominator`, ties to even; both are non-negative.
pub(super) fn magnitude_to_f64(numerator: &Integer, denominator: &Integer) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    // Scale by a power of two so that the integer quotient has 66 or 67 bits: more than a mantissa,
    // less than a machine word. The remainder matters only in that it is zero or not.
    let shift = 66 - numerator.significant_bits() as i64 + denominator.significant_bits() as i64;
    // A multiplication, because shifts in numerica 3.0.0 drop the bits that leave the word.
    let scale = Integer::from(2).pow(shift.unsigned_abs());
    let (quotient, rest) = if shift >= 0 {
        (numerator * &scale).quot_rem(denominator)
    } else {
        numerator.quot_rem(&(denominator * &scale))
    };
    let Ok(quotient) = quotient.to_string().parse::<u128>() else {
        return f64::NAN;
    };
    round_to_f64(quotient, !rest.is_zero(), -shift)
}

/// Rounds `(quotient + r) 2^exponent` to the nearest `f64`, ties to even. The unknown fraction r
/// lies between 0 and 1 if `inexact`, and is 0 otherwise; `quotient` has at least 55 bits.
fn round_to_f64(quotient: u128, inexact: bool, exponent: i64) -> f64 {
    const MIN_EXPONENT: i64 = -1022;
    let length = 128 - i64::from(quotient.leading_zeros());
    let leading = length - 1 + exponent;
    if leading > 1023 {
        return f64::INFINITY;
    }
    // Subnormal numbers have fewer bits: their last one has the value 2^-1074.
    let precision = 53 - (MIN_EXPONENT - leading).max(0);
    if precision < 0 {
        return 0.0;
    }
    let dropped = (length - precision) as u32;
    let (kept, rest) = match dropped {
        128.. => (0, quotient),
        _ => (quotient >> dropped, quotient & ((1 << dropped) - 1)),
    };
    let half = 1_u128 << (dropped - 1);
    let above = rest > half || (rest == half && (inexact || kept % 2 == 1));
    let mantissa = kept as u64 + u64::from(above);
    // If rounding carries the mantissa to the next power of two, the addition below carries into
    // the exponent field, up to infinity.
    if leading < MIN_EXPONENT {
        f64::from_bits(mantissa)
    } else {
        let biased = (leading - MIN_EXPONENT) as u64;
        f64::from_bits((biased << 52) + mantissa)
    }
}
