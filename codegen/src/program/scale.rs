//! Choice of a common factor for the constants of an equation.
//!
//! A rounded constant has the same error in every step of a long motion. Such errors add up,
//! whereas those of single steps average out. A common factor of all constants changes only their
//! rounding.

use crate::exact::Rational;

/// Number of factors that are tried. With n constants, the best of N factors reduces the errors by
/// a factor of about N^(1/n).
const FACTORS: i64 = 1 << 18;

/// Returns the factor, a fraction with few digits, for which these constants, and the reciprocals
/// of those used as divisors, are closest to `f64` numbers. No constant may be zero.
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
        // Most factors are rejected after a constant or two.
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

/// Returns the largest number of which all nonzero `lengths` are integer multiples; `None` if `f64`
/// cannot represent the multiples exactly.
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

/// Returns the greatest common divisor of two positive numbers.
fn divisor(mut a: i64, mut b: i64) -> i64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// Multiplies a constant in two parts by a whole number of few digits.
fn scaled((high, low): (f64, f64), factor: f64) -> (f64, f64) {
    let product = high * factor;
    let rest = high.mul_add(factor, -product) + low * factor;
    (product, rest)
}

/// Returns the relative rounding error of a number in two parts.
fn relative((high, low): (f64, f64)) -> f64 {
    low / high
}

/// Returns the relative rounding error of the reciprocal of a number in two parts.
fn reciprocal((high, low): (f64, f64)) -> f64 {
    let reciprocal = 1.0 / high;
    high.mul_add(reciprocal, -1.0) + low * reciprocal
}

#[cfg(test)]
mod tests {
    use super::{common_measure, factor};
    use crate::exact::Rational;

    /// Returns the relative rounding error of a number, by exact arithmetic.
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
            // Rounding to the nearest has an error of up to 1.1e-16, and 3e-17 on average.
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
