//! A common factor of constants that an equation is free to choose.
//!
//! A rounded constant is wrong by the same amount in every step of a long
//! motion: these errors add up, where those of the steps cancel each other. A
//! factor common to all constants changes nothing but how they round.

use crate::exact::Rational;

/// Factors that are tried. With n constants, the best of N factors makes the errors
/// about N^(1/n) times smaller.
const FACTORS: i64 = 1 << 18;

/// The factor, a fraction of few digits, that brings all of these constants, and the
/// reciprocals of those that are divided by, nearest to numbers of `f64`. None of
/// them is zero.
pub(super) fn factor(constants: &[Rational], divisors: &[Rational]) -> Option<Rational> {
    let parts = |numbers: &[Rational]| -> Vec<(f64, f64)> {
        let mut parts: Vec<_> = numbers.iter().map(Rational::to_parts).collect();
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        parts.dedup();
        parts
    };
    let (constants, divisors) = (parts(constants), parts(divisors));
    let mut best = (f64::INFINITY, FACTORS);
    for factor in FACTORS..2 * FACTORS {
        let times = |&constant| scaled(constant, factor as f64);
        let products = constants.iter().map(|constant| relative(times(constant)));
        let quotients = divisors.iter().map(|divisor| reciprocal(times(divisor)));
        // Most are out after a constant or two.
        let mut squares = 0.0;
        for error in products.chain(quotients) {
            squares += error * error;
            if squares >= best.0 {
                break;
            }
        }
        if squares < best.0 {
            best = (squares, factor);
        }
    }
    Rational::from_ratio(best.1, FACTORS)
}

/// Returns the largest number of which all of these are whole multiples, zeros aside, if
/// they have one whose multiples `f64` holds exactly.
pub(super) fn common_measure(lengths: &[Rational]) -> Option<Rational> {
    let whole = |text: String| text.parse::<i64>().ok();
    let mut measure: Option<(i64, i64)> = None;
    for length in lengths.iter().filter(|length| !length.is_zero()) {
        let numerator = whole(length.numerator_text())?.checked_abs()?;
        let denominator = whole(length.denominator_text())?;
        measure = Some(match measure {
            None => (numerator, denominator),
            Some((n, d)) => {
                let common = d.checked_mul(denominator / divisor(d, denominator))?;
                let known = n.checked_mul(common / d)?;
                let own = numerator.checked_mul(common / denominator)?;
                (divisor(known, own), common)
            }
        });
    }
    let (numerator, denominator) = measure?;
    let measure = Rational::from_ratio(numerator, denominator)?;
    let exact = |length: &Rational| {
        let multiple = length.checked_div(&measure);
        multiple.is_some_and(|multiple| multiple.to_parts().1 == 0.0)
    };
    lengths.iter().all(exact).then_some(measure)
}

/// Greatest common divisor of two positive numbers.
fn divisor(mut a: i64, mut b: i64) -> i64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// A constant in two parts times a whole number of few digits.
fn scaled((high, low): (f64, f64), factor: f64) -> (f64, f64) {
    let product = high * factor;
    let rest = high.mul_add(factor, -product) + low * factor;
    (product, rest)
}

/// Rounding error of a number in two parts, relative to its size.
fn relative((high, low): (f64, f64)) -> f64 {
    low / high
}

/// Rounding error of its reciprocal, relative to the size of that.
fn reciprocal((high, low): (f64, f64)) -> f64 {
    let reciprocal = 1.0 / high;
    high.mul_add(reciprocal, -1.0) + low * reciprocal
}

#[cfg(test)]
mod tests {
    use super::{common_measure, factor};
    use crate::exact::Rational;

    /// Relative rounding error of a number, by exact arithmetic.
    fn rounding(number: &Rational) -> f64 {
        let (high, low) = number.to_parts();
        (low / high).abs()
    }

    #[test]
    fn constants_come_nearer_to_numbers() {
        let decimals = ["0.0181430108", "0.0012226491", "0.66377879589"];
        let constants = decimals.map(|text| Rational::parse_decimal(text).expect("a decimal"));
        let divisor = Rational::parse_decimal("0.00071071819").expect("a decimal");
        let divisors = [divisor];
        let factor = factor(&constants, &divisors).expect("a fraction");
        let one = Rational::one();
        let reciprocals = divisors.iter().map(|divisor| {
            let scaled = divisor.clone() * factor.clone();
            one.checked_div(&scaled).expect("not zero")
        });
        let products = constants.iter().map(|c| c.clone() * factor.clone());
        for number in products.chain(reciprocals) {
            // Rounding to the nearest errs by up to 1.1e-16, 3e-17 in the mean.
            assert!(rounding(&number) < 1.2e-17, "{}", rounding(&number));
        }
    }

    #[test]
    fn lengths_have_a_common_measure() {
        let decimals = ["0.3", "0", "-0.21"];
        let lengths = decimals.map(|text| Rational::parse_decimal(text).expect("a decimal"));
        assert_eq!(common_measure(&lengths), Rational::from_ratio(3, 100));
        assert_eq!(common_measure(&[Rational::zero()]), None);
    }

    #[test]
    fn numbers_stay() {
        let numbers = [Rational::from(3), Rational::from(40)];
        assert_eq!(
            factor(&numbers, &[Rational::from(2)]),
            Some(Rational::one())
        );
    }
}
