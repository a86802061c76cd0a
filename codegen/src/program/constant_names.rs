//! Names for constants that nothing but their formation explains, and for numbers.

use super::constants::{ConstantId, ConstantOp, Setup};
use crate::exact::Rational;

/// `twice_gravity_child`, `coupling_child_parent_over_inertia_child`.
pub(super) fn constant(setup: &Setup, op: &ConstantOp) -> String {
    let name = |id: ConstantId| setup.get(id).name.clone();
    match op {
        ConstantOp::Number(number) => number_name(number),
        ConstantOp::Parameter(index) => format!("parameter_{index}"),
        ConstantOp::Named(_, a) | ConstantOp::Called(a) => name(*a),
        ConstantOp::Add(a, b) => format!("{}_plus_{}", name(*a), name(*b)),
        ConstantOp::Sub(a, b) => format!("{}_minus_{}", name(*a), name(*b)),
        ConstantOp::Product(number, powers) => product(setup, number, powers),
    }
}

fn product(setup: &Setup, number: &Rational, powers: &[(ConstantId, i32)]) -> String {
    let side = |above: bool| -> Vec<String> {
        powers
            .iter()
            .filter(|(_, power)| (*power > 0) == above)
            .map(|(id, power)| {
                let name = &setup.get(*id).name;
                match power.unsigned_abs() {
                    1 => name.clone(),
                    2 => format!("{name}_squared"),
                    other => format!("{name}_to_{other}"),
                }
            })
            .collect()
    };
    let (mut above, mut below) = (side(true), side(false));
    let numerator = number.numerator_text();
    let (sign, numerator) = match numerator.strip_prefix('-') {
        Some(size) => ("minus_", size.to_owned()),
        None => ("", numerator),
    };
    let denominator = number.denominator_text();
    let long = is_long(&numerator) || is_long(&denominator);
    if numerator == "1" && denominator == "2" && below.is_empty() {
        above.insert(0, "half".into());
    } else if !long {
        for (side, digits) in [(&mut above, &numerator), (&mut below, &denominator)] {
            match digits.as_str() {
                "1" => {}
                "2" if !side.is_empty() => side.insert(0, "twice".into()),
                other => side.insert(0, word(other)),
            }
        }
    }
    let (above, below) = (above.join("_"), below.join("_"));
    // Digits would say less than that there is a factor.
    let scaled = if long { "scaled_" } else { "" };
    let name = match (above.is_empty(), below.is_empty()) {
        (false, true) => above,
        (true, false) => format!("inverse_{below}"),
        _ => format!("{above}_over_{below}"),
    };
    started(format!("{sign}{scaled}{name}"))
}

/// `half`, `three_over_five`, `number` where digits say more than a name.
fn number_name(number: &Rational) -> String {
    let sign = if number.is_negative() { "minus_" } else { "" };
    let numerator = number.numerator_text();
    let numerator = numerator.trim_start_matches('-');
    let denominator = number.denominator_text();
    if is_long(numerator) || is_long(&denominator) {
        return format!("{sign}number");
    }
    let name = match (numerator, denominator.as_str()) {
        (_, "1") => word(numerator),
        ("1", "2") => "half".to_owned(),
        ("1", "4") => "quarter".to_owned(),
        ("1", "8") => "eighth".to_owned(),
        (_, denominator) => format!("{}_over_{}", word(numerator), word(denominator)),
    };
    started(format!("{sign}{name}"))
}

/// The name of a number in a function: `quarter`, `number_0_15`.
pub(crate) fn number(number: &Rational) -> String {
    let decimal = number.to_string();
    let short = decimal.len() <= MOST_DIGITS + 2;
    match decimal.strip_prefix("0.") {
        Some(digits) if short && !["5", "25", "125"].contains(&digits) => {
            format!("number_0_{digits}")
        }
        _ => number_name(number),
    }
}

/// A number of more digits than this has no name.
const MOST_DIGITS: usize = 3;

fn is_long(digits: &str) -> bool {
    digits.len() > MOST_DIGITS
}

/// A name begins with a letter.
fn started(name: String) -> String {
    match name.starts_with(|first: char| first.is_ascii_digit()) {
        true => format!("number_{name}"),
        false => name,
    }
}

fn word(digits: &str) -> String {
    match digits {
        "0" => "zero",
        "1" => "one",
        "2" => "two",
        "3" => "three",
        "4" => "four",
        "5" => "five",
        "6" => "six",
        "7" => "seven",
        "8" => "eight",
        "9" => "nine",
        other => other,
    }
    .into()
}
