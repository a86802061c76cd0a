//! The names that a description may give.

use proc_macro2::{Ident, Span};

use crate::description::TIME;
use crate::report::{Faults, Lookalike, Message, TreeMessage, ValueMessage};

/// Keywords of Rust 2024, reserved ones included.
#[rustfmt::skip]
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Names that the emitted code gives to things of its own.
#[rustfmt::skip]
const EMITTED: &[&str] = &[
    "accelerations", "angles", "drive", "emit", "model", "momenta", "observe", "out", "scalar",
    "state", "time", "velocities", TIME,
];

/// Constants that look like parameters, with digits to write instead.
const CONSTANTS: &[(&str, &str)] = &[
    ("pi", "3.14159265358979324"),
    ("tau", "6.28318530717958648"),
];

/// Names that mean no finite number, in small letters.
const NOT_FINITE: &[&str] = &["inf", "infinity", "nan"];

/// Types of joints that other tools have.
#[rustfmt::skip]
const JOINTS: &[&str] = &[
    "cylindrical", "fixed", "hinge", "prismatic", "revolute", "slider", "spherical", "universal",
    "weld",
];

/// Functions that other tools have, and ours.
#[rustfmt::skip]
const FUNCTIONS: &[&str] = &[
    "abs", "acos", "asin", "atan", "atan2", "cos", "cosh", "exp", "ln", "log", "sign", "sin",
    "sinh", "sqrt", "tan", "tanh",
];

/// Names of quantities that move, those of observables and words.
const MOTION: &[&str] = &[
    "acceleration",
    "angle",
    "angular_velocity",
    "omega",
    "theta",
    "velocity",
];

/// Message about a name in a property that reads like an angle or a velocity.
pub(super) fn motion(name: &str) -> Option<ValueMessage> {
    let known = MOTION.contains(&name) || name.starts_with("theta_") || name.starts_with("omega_");
    known.then(|| ValueMessage::Lookalike {
        name: name.to_owned(),
        kind: Lookalike::Motion,
    })
}

/// Message about a name that reads like no value at all.
fn lookalike(name: &str) -> Option<ValueMessage> {
    let name = name.to_owned();
    let kind = match name.as_str() {
        small if JOINTS.contains(&small) => Lookalike::Joint,
        small if FUNCTIONS.contains(&small) => Lookalike::Function,
        other if NOT_FINITE.contains(&other.to_ascii_lowercase().as_str()) => {
            return Some(ValueMessage::NotFinite { name });
        }
        _ => return None,
    };
    Some(ValueMessage::Lookalike { name, kind })
}

/// Checks the name of a link; a fault goes to `report`.
pub(super) fn check_link(name: &Ident, report: &mut Faults) {
    if let Some(message) = fault(&name.to_string()) {
        report.error(name.span(), message);
    }
}

/// Checks the name of an observable; a fault goes to `report`.
pub(super) fn check_observable(name: &Ident, report: &mut Faults) -> Option<()> {
    match fault(&name.to_string()) {
        Some(message) => {
            report.error(name.span(), message);
            None
        }
        None => Some(()),
    }
}

/// The message about a constant without exact value, if `name` is one.
pub(super) fn irrational(name: &str) -> Option<ValueMessage> {
    let small = name.to_ascii_lowercase();
    let &(_, digits) = CONSTANTS.iter().find(|(constant, _)| *constant == small)?;
    Some(ValueMessage::NotExact {
        name: name.to_owned(),
        digits,
    })
}

/// Checks the name of a parameter; a fault goes to `report`.
pub(super) fn check_parameter(name: &str, span: Span, report: &mut Faults) -> Option<()> {
    if name == TIME {
        report.error(span, ValueMessage::TimeOutsideDrive);
        return None;
    }
    let message = irrational(name).or_else(|| lookalike(name));
    let message = message.map(Message::from);
    match message.or_else(|| fault(name).map(Message::from)) {
        Some(message) => {
            report.error(span, message);
            None
        }
        None => Some(()),
    }
}

/// Returns true if a name is a keyword of Rust 2024.
pub fn is_keyword(name: &str) -> bool {
    KEYWORDS.contains(&name)
}

/// The message about a name that may not be used.
fn fault(name: &str) -> Option<TreeMessage> {
    let name = name.to_owned();
    if is_keyword(&name) || EMITTED.contains(&name.as_str()) {
        Some(TreeMessage::ReservedName { name })
    } else if is_snake_case(&name) {
        None
    } else {
        let suggestion = snake_case(&name);
        Some(TreeMessage::NotSnakeCase { name, suggestion })
    }
}

/// Returns true if `name` is letters a to z, digits and single underscores, a
/// letter first and no underscore last.
fn is_snake_case(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(plain)
        && !name.ends_with('_')
        && !name.contains("__")
}

/// `name` with its capitals written as words of their own, if that is a name
/// which may be used.
fn snake_case(name: &str) -> Option<String> {
    let mut words = String::new();
    let mut after_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && after_small {
            words.push('_');
        }
        after_small = c.is_ascii_lowercase() || c.is_ascii_digit();
        words.push(c.to_ascii_lowercase());
    }
    let pieces: Vec<&str> = words.split('_').filter(|piece| !piece.is_empty()).collect();
    let suggestion = pieces.join("_");
    fault_free(&suggestion).then_some(suggestion)
}

/// Returns true if a name may be used.
fn fault_free(name: &str) -> bool {
    is_snake_case(name) && !is_keyword(name) && !EMITTED.contains(&name)
}
