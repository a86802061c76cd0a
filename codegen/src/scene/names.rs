//! Checks of the names in a description.

use proc_macro2::{Ident, Span};

use crate::description::TIME;
use crate::report::{Faults, Lookalike, Message, NameRule, TreeMessage, ValueMessage};

/// Keywords of Rust 2024, including reserved ones.
#[rustfmt::skip]
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Names that the emitted code uses itself, for items and variables.
#[rustfmt::skip]
const EMITTED: &[&str] = &[
    "accelerations", "angles", "drive", "emit", "model", "momenta", "observe", "out", "scalar",
    "state", "time", "velocities", TIME,
];

/// Mathematical constants that look like parameters, with the digits to write instead.
const CONSTANTS: &[(&str, &str)] = &[
    ("pi", "3.14159265358979324"),
    ("tau", "6.28318530717958648"),
];

/// Names of values that are not finite, in lower case.
const NOT_FINITE: &[&str] = &["inf", "infinity", "nan"];

/// Joint types of other simulation tools.
#[rustfmt::skip]
const JOINTS: &[&str] = &[
    "cylindrical", "fixed", "hinge", "prismatic", "revolute", "slider", "spherical", "universal",
    "weld",
];

/// Names of functions, of this tool and of others.
#[rustfmt::skip]
const FUNCTIONS: &[&str] = &[
    "abs", "acos", "asin", "atan", "atan2", "cos", "cosh", "exp", "ln", "log", "sign", "sin",
    "sinh", "sqrt", "tan", "tanh",
];

/// Names of quantities that depend on the motion: those of observables, and common words.
const MOTION: &[&str] = &[
    "acceleration",
    "angle",
    "angular_velocity",
    "omega",
    "theta",
    "velocity",
];

/// Returns the message for a name in a property that looks like an angle or a velocity; `None` for
/// other names.
pub(super) fn motion(name: &str) -> Option<ValueMessage> {
    let known = MOTION.contains(&name) || name.starts_with("theta_") || name.starts_with("omega_");
    known.then(|| ValueMessage::Lookalike {
        name: name.to_owned(),
        kind: Lookalike::Motion,
    })
}

/// Returns the message for a name that looks like a joint type or a function; `None` for other
/// names.
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

/// Checks the name of a link. Adds a mistake to `report`.
pub(super) fn check_link(name: &Ident, report: &mut Faults) {
    if let Some(message) = fault(&name.to_string(), report.names()) {
        report.error(name.span(), message);
    }
}

/// Checks the name of an observable. Adds a mistake to `report`.
pub(super) fn check_observable(name: &Ident, report: &mut Faults) -> Option<()> {
    match fault(&name.to_string(), report.names()) {
        Some(message) => {
            report.error(name.span(), message);
            None
        }
        None => Some(()),
    }
}

/// Returns the message for a mathematical constant without an exact value; `None` for other names.
pub(super) fn irrational(name: &str) -> Option<ValueMessage> {
    let small = name.to_ascii_lowercase();
    let &(_, digits) = CONSTANTS.iter().find(|(constant, _)| *constant == small)?;
    Some(ValueMessage::NotExact {
        name: name.to_owned(),
        digits,
    })
}

/// Checks the name of a parameter. Adds a mistake to `report`.
pub(super) fn check_parameter(name: &str, span: Span, report: &mut Faults) -> Option<()> {
    if name == TIME {
        report.error(span, ValueMessage::TimeOutsideDrive);
        return None;
    }
    let message = irrational(name)
        .or_else(|| lookalike(name))
        .or_else(|| match report.names() {
            NameRule::SnakeCase => rust_constant(name),
            NameRule::Free => None,
        });
    let message = message.map(Message::from);
    match message.or_else(|| fault(name, report.names()).map(Message::from)) {
        Some(message) => {
            report.error(span, message);
            None
        }
        None => Some(()),
    }
}

/// Returns the message for a name in capital letters, like a constant of Rust; `None` for other
/// names.
fn rust_constant(name: &str) -> Option<ValueMessage> {
    let is_upper = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_';
    let is_constant =
        name.starts_with(|c: char| c.is_ascii_uppercase()) && name.chars().all(is_upper);
    is_constant.then(|| ValueMessage::RustConstant {
        name: name.to_owned(),
    })
}

/// Returns true if a name is a keyword of Rust 2024.
pub fn is_keyword(name: &str) -> bool {
    KEYWORDS.contains(&name)
}

/// Returns the message for a name that violates the rule; `None` for a valid name.
fn fault(name: &str, rule: NameRule) -> Option<TreeMessage> {
    let name = name.to_owned();
    let is_allowed = match rule {
        NameRule::SnakeCase => is_snake_case(&name),
        NameRule::Free => is_free(&name),
    };
    if is_keyword(&name) || EMITTED.contains(&name.as_str()) {
        Some(TreeMessage::ReservedName { name })
    } else if is_allowed {
        None
    } else {
        let suggestion = snake_case(&name);
        Some(TreeMessage::NotSnakeCase { name, suggestion })
    }
}

/// Returns true if `name` consists of letters a to z, digits and single underscores, starts with a
/// letter and does not end with an underscore.
fn is_snake_case(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(plain)
        && !name.ends_with('_')
        && !name.contains("__")
}

/// Returns true if `name` consists of letters of any script, digits and underscores, and contains a
/// letter.
fn is_free(name: &str) -> bool {
    let is_plain = |c: char| c.is_alphanumeric() || c == '_';
    name.chars().all(is_plain) && name.chars().any(char::is_alphabetic)
}

/// Converts a name with capitals to snake case; `None` if the result is not a valid name.
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

/// Returns true if the name may be used.
fn fault_free(name: &str) -> bool {
    is_snake_case(name) && !is_keyword(name) && !EMITTED.contains(&name)
}
