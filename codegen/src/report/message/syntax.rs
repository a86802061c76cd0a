//! Messages about a description: its tokens, the struct and the settings.

use super::{Problem, suggest};
use crate::report::nearest::nearest;

messages! {
    /// A mistake in a description: its tokens, the struct and the settings.
    SyntaxMessage as Syntax:

    /// Text that has no tokens of Rust.
    NoTokens => (
        "unreadable text",
        "no token starts here, or brackets do not match",
        "write a description as in `gravity = 9.80665, rod: rod(mass = 1, length = 1)`",
    ),
    /// Another token should stand here.
    Expected { what: &'static str } => (
        format!("expected {what}"),
        "something else stands here",
        OUTLINE,
    ),
    /// `:` where a value follows.
    Colon { name: String } => (
        format!("`:` behind `{name}`"),
        "a value follows `=`",
        format!("write `{name} = ...`; `:` stands between a link and its shape only"),
    ),
    /// Brackets of the wrong kind.
    Brackets { what: &'static str, wanted: &'static str } => (
        format!("{what} in the wrong brackets"),
        format!("{what} stand in `{wanted}`"),
        "write `parent(mass = 0.1, ...) [ child(...), ... ]`",
    ),
    /// Two members of a list without a comma between them.
    MissingComma { before: String } => (
        format!("no comma before `{before}`"),
        "the next member of the list",
        format!("write `, {before}`"),
    ),
    /// A unit behind a number.
    Unit { unit: String } => (
        format!("the unit `{unit}` behind a number"),
        "units are not written",
        "write the number alone, in SI units: kg, m, s and what is formed of them",
    ),
    /// The list ends too early.
    Ended { what: &'static str } => (
        format!("expected {what}"),
        "missing before this",
        OUTLINE,
    ),
    /// Brackets or parentheses nested too deeply.
    Nesting { limit: usize } => (
        format!("more than {limit} levels of brackets"),
        "too deep",
        "write long chains by rule: `chain: generations(count = 100, ...)`",
    ),
    /// The attribute stands on something else than a struct.
    NotAStruct => (
        "the attribute stands on something else than a struct",
        "not a struct",
        "put it on a struct without fields: `pub struct Pendulum;`",
    ),
    /// The struct has fields.
    StructFields { name: String } => (
        format!("struct `{name}` has fields"),
        "must be without fields",
        format!("write `struct {name};`, the fields follow from the description"),
    ),
    /// The struct has generic parameters.
    StructGenerics { name: String } => (
        format!("struct `{name}` is generic"),
        "must be without parameters",
        format!("write `struct {name};`, its functions are generic over the scalar"),
    ),
    /// An unknown setting of the scene.
    UnknownEntry { name: String, nearest: Option<&'static str> } => (
        format!("unknown setting `{name}`"),
        "not a setting of the scene",
        suggest(
            nearest,
            "settings are `gravity = ...`, `crate = ...`, `solve = ...`, `code = ...`, \
             `parameters(...)`, `drive(...)`, `emit(...)`, `observe(...)`, `in_phase(...)`, \
             `locked(...)`, `prescribed(...)`",
        ),
    ),
    /// No gravity.
    MissingGravity => (
        "gravity is missing",
        "described without `gravity`",
        "write `gravity = 9.80665`, in m/s²",
    ),
    /// A property or setting given twice.
    DuplicateProperty { name: String } => (
        format!("`{name}` is given twice"),
        "given before",
        "keep one of them",
    ),
    /// A way to write code that is none.
    NotACode => (
        "`code` is neither `loops` nor `unrolled`",
        "not a way to write code",
        "write `code = loops`, `code = unrolled`, or nothing: large trees get loops",
    ),
    /// A way to solve that does not exist.
    UnknownSolve { name: String, nearest: Option<&'static str> } => (
        format!("unknown way to solve `{name}`"),
        "no way to solve for the accelerations",
        suggest(
            nearest,
            "`factorization` or `recursion`; without `solve` the one of fewer operations",
        ),
    ),
}

impl SyntaxMessage {
    /// A property or setting given twice.
    pub fn duplicate_property(name: &impl ToString) -> Self {
        Self::DuplicateProperty {
            name: name.to_string(),
        }
    }

    /// An unknown setting of the scene.
    pub fn unknown_entry(name: String) -> Self {
        let nearest = nearest(
            &name,
            &[
                "gravity",
                "crate",
                "solve",
                "code",
                "parameters",
                "drive",
                "emit",
                "observe",
                "in_phase",
                "locked",
                "prescribed",
            ],
        );
        Self::UnknownEntry { name, nearest }
    }
}

/// Outline of an attribute, for tokens out of place.
const OUTLINE: &str = "an attribute looks like `gravity = 9.80665, parent(mass = 0.1, com = 0.1, \
     inertia = 0, joint = 0.3) [child: rod(mass = 0.1, length = 0.2) * 2], emit(energies)`";
