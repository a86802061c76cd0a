//! Messages about a description: its tokens, the struct and the settings.

use super::{Problem, problem, suggest};
use crate::report::nearest::nearest;

/// A mistake in a description: its tokens, the struct and the settings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SyntaxMessage {
    /// Text that has no tokens of Rust.
    NoTokens,
    /// Another token should stand here.
    Expected {
        /// The token that should.
        what: &'static str,
    },
    /// `:` where a value follows.
    Colon {
        /// Name of the value.
        name: String,
    },
    /// Brackets of the wrong kind.
    Brackets {
        /// Contents of the brackets.
        what: &'static str,
        /// The right ones.
        wanted: &'static str,
    },
    /// Two members of a list without a comma between them.
    MissingComma {
        /// The second one.
        before: String,
    },
    /// A unit behind a number.
    Unit {
        /// The unit, as far as its first name.
        unit: String,
    },
    /// The list ends too early.
    Ended {
        /// The missing token.
        what: &'static str,
    },
    /// Brackets or parentheses nested too deeply.
    Nesting {
        /// Deepest nesting allowed.
        limit: usize,
    },
    /// The attribute stands on something else than a struct.
    NotAStruct,
    /// The struct has fields.
    StructFields {
        /// The struct.
        name: String,
    },
    /// The struct has generic parameters.
    StructGenerics {
        /// The struct.
        name: String,
    },
    /// An unknown setting of the scene.
    UnknownEntry {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// No gravity.
    MissingGravity,
    /// A property or setting given twice.
    DuplicateProperty {
        /// The property.
        name: String,
    },
    /// A way to write code that is none.
    NotACode,
    /// A way to solve that does not exist.
    UnknownSolve {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
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

impl SyntaxMessage {
    /// The message in words.
    pub(super) fn problem(&self) -> Problem {
        use SyntaxMessage as M;
        match self {
            M::NoTokens => problem(
                "unreadable text",
                "no token starts here, or brackets do not match",
                "write a description as in `gravity = 9.80665, rod: rod(mass = 1, length = 1)`",
            ),
            M::Expected { what } => problem(
                format!("expected {what}"),
                "something else stands here",
                OUTLINE,
            ),
            M::Colon { name } => problem(
                format!("`:` behind `{name}`"),
                "a value follows `=`",
                format!("write `{name} = ...`; `:` stands between a link and its shape only"),
            ),
            M::Brackets { what, wanted } => problem(
                format!("{what} in the wrong brackets"),
                format!("{what} stand in `{wanted}`"),
                "write `parent(mass = 0.1, ...) [ child(...), ... ]`",
            ),
            M::MissingComma { before } => problem(
                format!("no comma before `{before}`"),
                "the next member of the list",
                format!("write `, {before}`"),
            ),
            M::Unit { unit } => problem(
                format!("the unit `{unit}` behind a number"),
                "units are not written",
                "write the number alone, in SI units: kg, m, s and what is formed of them",
            ),
            M::Ended { what } => {
                problem(format!("expected {what}"), "missing before this", OUTLINE)
            }
            M::Nesting { limit } => problem(
                format!("more than {limit} levels of brackets"),
                "too deep",
                "write long chains by rule: `chain: generations(count = 100, ...)`",
            ),
            M::NotAStruct => problem(
                "the attribute stands on something else than a struct",
                "not a struct",
                "put it on a struct without fields: `pub struct Pendulum;`",
            ),
            M::StructFields { name } => problem(
                format!("struct `{name}` has fields"),
                "must be without fields",
                format!("write `struct {name};`, the fields follow from the description"),
            ),
            M::StructGenerics { name } => problem(
                format!("struct `{name}` is generic"),
                "must be without parameters",
                format!("write `struct {name};`, its functions are generic over the scalar"),
            ),
            M::UnknownEntry { name, nearest } => problem(
                format!("unknown setting `{name}`"),
                "not a setting of the scene",
                suggest(
                    nearest,
                    "settings are `gravity = ...`, `crate = ...`, `solve = ...`, `code = ...`, \
                     `parameters(...)`, `drive(...)`, `emit(...)`, `observe(...)`",
                ),
            ),
            M::MissingGravity => problem(
                "gravity is missing",
                "described without `gravity`",
                "write `gravity = 9.80665`, in m/s²",
            ),
            M::DuplicateProperty { name } => problem(
                format!("`{name}` is given twice"),
                "given before",
                "keep one of them",
            ),
            M::NotACode => problem(
                "`code` is neither `loops` nor `unrolled`",
                "not a way to write code",
                "write `code = loops`, `code = unrolled`, or nothing: large trees get loops",
            ),
            M::UnknownSolve { name, nearest } => problem(
                format!("unknown way to solve `{name}`"),
                "no way to solve for the accelerations",
                suggest(
                    nearest,
                    "`factorization` or `recursion`; without `solve` the one of fewer operations",
                ),
            ),
        }
    }
}

/// Outline of an attribute, for tokens out of place.
const OUTLINE: &str = "an attribute looks like `gravity = 9.80665, parent(mass = 0.1, com = 0.1, \
     inertia = 0, joint = 0.3) [child: rod(mass = 0.1, length = 0.2) * 2], emit(energies)`";
