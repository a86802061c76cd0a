//! Exact numbers and their one rounding.

use branched_pendulum_codegen::exact::{ExactError, Rational};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// A random whole number below a limit.
fn below(random: &mut SplitMix64, limit: usize) -> usize {
    (random.next_u64() % limit as u64) as usize
}

fn decimal(text: &str) -> Rational {
    Rational::parse_decimal(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The exact value of a finite `f64`.
fn exactly(value: f64) -> Rational {
    let bits = value.abs().to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, exponent - 1075),
    };
    let magnitude = Rational::from(mantissa) * power_of_two(exponent);
    if value.is_sign_negative() {
        -magnitude
    } else {
        magnitude
    }
}

fn power_of_two(exponent: i32) -> Rational {
    Rational::from(2)
        .checked_pow(exponent)
        .expect("short enough")
}

fn divided(a: &Rational, b: &Rational) -> Rational {
    a.checked_div(b).expect("divisor is not zero")
}

#[test]
fn literals_are_read_exactly() {
    for (text, numerator, denominator) in [
        ("0", "0", "1"),
        ("1_000", "1000", "1"),
        ("0.1", "1", "10"),
        ("1.88e-3", "47", "25000"),
        ("5e-1", "1", "2"),
        ("12.50E+1", "125", "1"),
        ("-0.25", "-1", "4"),
        ("2.", "2", "1"),
        ("1_0.0_1", "1001", "100"),
    ] {
        let value = decimal(text);
        assert_eq!(value.numerator_text(), numerator, "{text}");
        assert_eq!(value.denominator_text(), denominator, "{text}");
    }
}

#[test]
fn what_is_no_decimal_is_refused() {
    for text in [
        "", ".", "-", "e5", "1e", "1e+", "0x10", "1.0f64", "1f32", "1.2.3", "--1", "1e1.5", "NaN",
        "inf", "١",
    ] {
        assert_eq!(
            Rational::parse_decimal(text),
            Err(ExactError::Malformed),
            "{text}"
        );
    }
    for text in ["1e401", "1e-401", "1e999999999", "1e99999999999999999999"] {
        assert_eq!(
            Rational::parse_decimal(text),
            Err(ExactError::Exponent),
            "{text}"
        );
    }
    assert!(Rational::parse_decimal("1e400").is_ok());
    let long = "1".repeat(1_000_000);
    assert_eq!(Rational::parse_decimal(&long), Err(ExactError::TooLong));
}

#[test]
fn arithmetic_is_exact() {
    let (tenth, fifth) = (decimal("0.1"), decimal("0.2"));
    assert_eq!(&tenth + &fifth, decimal("0.3"));
    assert_eq!(&tenth - &fifth, decimal("-0.1"));
    assert_eq!(&tenth * &fifth, decimal("0.02"));
    assert_eq!(divided(&tenth, &fifth), decimal("0.5"));
    assert_eq!(tenth.checked_div(&Rational::zero()), None);
    assert_eq!(tenth.checked_pow(-3), Ok(Rational::from(1000)));
    assert_eq!(decimal("-1.5").checked_pow(3), Ok(decimal("-3.375")));
    assert_eq!(decimal("7").checked_pow(0), Ok(Rational::one()));
    assert_eq!(Rational::zero().checked_pow(0), Ok(Rational::one()));
    assert_eq!(Rational::zero().checked_pow(5), Ok(Rational::zero()));
    assert_eq!(
        Rational::zero().checked_pow(-1),
        Err(ExactError::DivisionByZero)
    );
    assert_eq!(
        Rational::from(-1).checked_pow(i32::MAX),
        Ok(Rational::from(-1))
    );
    assert_eq!(
        Rational::from(-1).checked_pow(i32::MIN),
        Ok(Rational::one())
    );
    assert_eq!(
        Rational::from(2).checked_pow(i32::MAX),
        Err(ExactError::TooLong)
    );
    assert_eq!(
        Rational::from_ratio(i64::MIN, -1),
        Some(-Rational::from(i64::MIN))
    );
    assert_eq!(Rational::from_ratio(6, -4), Some(decimal("-1.5")));
    assert_eq!(Rational::from_ratio(1, 0), None);
}

#[test]
fn large_numbers_come_back_to_small_ones() {
    use std::hash::{BuildHasher as _, RandomState};
    let hashed = RandomState::new();
    let large = decimal("1e60");
    let small = divided(&(&large * &decimal("3")), &large);
    assert_eq!(small, Rational::from(3));
    assert_eq!(hashed.hash_one(&small), hashed.hash_one(Rational::from(3)));
    assert_eq!(&large - &large, Rational::zero());
}

#[test]
fn order_is_that_of_the_numbers() {
    let mut random = SplitMix64::seed_from_u64(3);
    for _ in 0..1000 {
        let mut part = || below(&mut random, 41) as i64 - 20;
        let (a, b, c, d) = (part(), part(), part(), part());
        let (b, d) = (b.abs() + 1, d.abs() + 1);
        let left = Rational::from_ratio(a, b).expect("b > 0");
        let right = Rational::from_ratio(c, d).expect("d > 0");
        assert_eq!(left.cmp(&right), (a * d).cmp(&(c * b)), "{left} {right}");
    }
}

#[test]
fn text_is_decimal_where_that_is_exact_and_short() {
    for (value, text) in [
        (decimal("1.88e-3"), "0.00188"),
        (decimal("-9.80665"), "-9.80665"),
        (decimal("1e3"), "1000"),
        (decimal("-0.5"), "-0.5"),
        (decimal("1e-25"), "0.0000000000000000000000001"),
        (decimal("1e24"), "1000000000000000000000000"),
        (divided(&Rational::one(), &Rational::from(3)), "1/3"),
        (divided(&Rational::from(-7), &Rational::from(12)), "-7/12"),
    ] {
        assert_eq!(value.to_string(), text);
    }
    assert_eq!(
        decimal("1e-26").to_string(),
        format!("1/1{}", "0".repeat(26))
    );
}

#[test]
fn rounding_agrees_with_the_standard_library_on_decimals() {
    let mut random = SplitMix64::seed_from_u64(1);
    for _ in 0..20_000 {
        let digits: String = (0..1 + below(&mut random, 40))
            .map(|_| char::from(b'0' + below(&mut random, 10) as u8))
            .collect();
        let point = below(&mut random, digits.len() + 1);
        let exponent = below(&mut random, 720) as i32 - 370;
        let sign = ["", "-"][below(&mut random, 2)];
        let text = format!(
            "{sign}0{}.{}e{exponent}",
            &digits[..point],
            &digits[point..]
        );
        let expected: f64 = text.parse().expect("a float");
        let found = decimal(&text).to_f64();
        // An exact number has no negative zero.
        let same = found.to_bits() == expected.to_bits() || (expected == 0.0 && found == 0.0);
        assert!(same, "{text}: {found:e}, not {expected:e}");
    }
}

#[test]
fn rounding_gives_the_nearest_of_all() {
    let mut random = SplitMix64::seed_from_u64(2);
    for _ in 0..5_000 {
        let mut part = || {
            let small = Rational::from((random.next_u64() >> below(&mut random, 60)) as i64 | 1);
            &small * &power_of_two(below(&mut random, 1000) as i32 - 500)
        };
        let value = divided(&part(), &part());
        let found = value.to_f64();
        if found.is_infinite() || found == 0.0 {
            continue;
        }
        let distance = |candidate: f64| {
            let difference = &exactly(candidate) - &value;
            if difference.is_negative() {
                -difference
            } else {
                difference
            }
        };
        assert!(distance(found) <= distance(found.next_up()), "{value}");
        assert!(distance(found) <= distance(found.next_down()), "{value}");
    }
}

#[test]
fn halves_go_to_the_even_neighbour() {
    let mut random = SplitMix64::seed_from_u64(4);
    let least = f64::from_bits(1);
    let edges = [
        0.0,
        least,
        2.0 * least,
        3.0 * least,
        f64::MIN_POSITIVE,
        f64::MIN_POSITIVE.next_down(),
        1.0,
        1.0_f64.next_down(),
        2.0_f64.powi(53),
    ];
    let drawn = (0..2_000)
        .map(|_| f64::from_bits(random.next_u64() >> 1))
        .filter(|x| *x < f64::MAX);
    for lower in edges.into_iter().chain(drawn.collect::<Vec<_>>()) {
        let upper = lower.next_up();
        let half = divided(&(exactly(lower) + exactly(upper)), &Rational::from(2));
        let even = if lower.to_bits() % 2 == 0 {
            lower
        } else {
            upper
        };
        let hair = power_of_two(-1200);
        assert_eq!(half.to_f64(), even, "{lower:e}");
        assert_eq!((&half + &hair).to_f64(), upper, "{lower:e}");
        assert_eq!((&half - &hair).to_f64(), lower, "{lower:e}");
        assert_eq!((-&half).to_f64(), -even, "{lower:e}");
        assert_eq!(exactly(lower).to_f64(), lower);
    }
}

#[test]
fn the_ends_of_the_range() {
    let largest = exactly(f64::MAX);
    let beyond = power_of_two(1024);
    let half = divided(&(&largest + &beyond), &Rational::from(2));
    let hair = power_of_two(-1200);
    assert_eq!(largest.to_f64(), f64::MAX);
    assert_eq!((&half - &hair).to_f64(), f64::MAX);
    assert_eq!(half.to_f64(), f64::INFINITY);
    assert_eq!((-&beyond).to_f64(), f64::NEG_INFINITY);
    assert_eq!(power_of_two(-1075).to_f64(), 0.0);
    assert_eq!((power_of_two(-1075) + hair).to_f64(), f64::from_bits(1));
    assert_eq!(power_of_two(-4000).to_f64(), 0.0);
    assert_eq!(power_of_two(4000).to_f64(), f64::INFINITY);
}

/// In machine words: 0.1 = 3602879701896397 / 2^55 - 1 / (5 * 2^56), by hand.
#[test]
fn two_parts() {
    let number = decimal;
    assert_eq!(number("0.1").to_parts(), (0.1, -5.551115123125783e-18));
    assert_eq!(number("-0.1").to_parts(), (-0.1, 5.551115123125783e-18));
    for exact in ["0", "0.5", "-3", "1e22", "9007199254740992"] {
        assert_eq!(number(exact).to_parts(), (exact.parse().unwrap(), 0.0));
    }
    // 2^53 + 1: a tie that goes to the even one.
    assert_eq!(
        number("9007199254740993").to_parts(),
        (9007199254740992.0, 1.0)
    );
    assert_eq!(number("1e400").to_parts(), (f64::INFINITY, 0.0));
    assert_eq!(number("1e-400").to_parts(), (0.0, 0.0));
    // The last bit of a subnormal number is the last there is.
    assert_eq!(number("1e-310").to_parts(), (1e-310, 0.0));
}
