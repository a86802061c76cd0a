//! Names for constants that nothing but their formation explains.

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
    let half = numerator == "1" && denominator == "2" && below.is_empty();
    if half {
        above.insert(0, "half".into());
    } else {
        match numerator.as_str() {
            "1" => {}
            "2" if !above.is_empty() => above.insert(0, "twice".into()),
            other => above.insert(0, word(other)),
        }
        match denominator.as_str() {
            "1" => {}
            "2" if !below.is_empty() => below.insert(0, "twice".into()),
            other => below.insert(0, word(other)),
        }
    }
    let (above, below) = (above.join("_"), below.join("_"));
    match (above.is_empty(), below.is_empty()) {
        (false, true) => format!("{sign}{above}"),
        (true, false) => format!("{sign}inverse_{below}"),
        _ => format!("{sign}{above}_over_{below}"),
    }
}

fn number_name(number: &Rational) -> String {
    let sign = if number.is_negative() { "minus_" } else { "" };
    let numerator = number.numerator_text();
    let numerator = word(numerator.trim_start_matches('-'));
    match number.denominator_text().as_str() {
        "1" => format!("{sign}{numerator}"),
        "2" if numerator == "one" => format!("{sign}half"),
        other => format!("{sign}{numerator}_over_{}", word(other)),
    }
}

fn word(digits: &str) -> String {
    match digits {
        "0" => "zero",
        "1" => "one",
        "2" => "two",
        "3" => "three",
        "4" => "four",
        "6" => "six",
        "8" => "eight",
        other => return format!("number_{other}"),
    }
    .into()
}
