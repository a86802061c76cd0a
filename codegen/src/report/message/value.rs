//! Messages about a description: its values and the drive.

use super::{Problem, problem, suggest};

/// A mistake in a description: its values and the drive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ValueMessage {
    /// A name of something else as a parameter, as in `joint = prismatic`.
    Lookalike {
        /// The name.
        name: String,
        /// Kind of thing that it names.
        kind: Lookalike,
    },
    /// A value that is infinite or no number.
    NotFinite {
        /// As written.
        name: String,
    },
    /// A name that is no declared parameter.
    UndeclaredParameter {
        /// Text as written.
        name: String,
        /// The declared one that is spelt most alike.
        nearest: Option<String>,
    },
    /// A declared parameter that no value names.
    UnusedParameter {
        /// The parameter.
        name: String,
    },
    /// A value below zero that must not be.
    Negative {
        /// Name of it, as in "mass of `child`".
        what: String,
        /// The value.
        value: String,
    },
    /// A value that must be above zero.
    NotPositive {
        /// Name of it, as in "length of `child`".
        what: String,
        /// The value.
        value: String,
    },
    /// A divisor that is zero.
    DivisionByZero,
    /// A literal that is no plain decimal number.
    NotDecimal {
        /// Text as written.
        text: String,
    },
    /// A number that no `f64` can hold.
    NumberRange,
    /// A number with too many digits to go on exactly.
    NumberLength,
    /// An exponent that is no small whole number.
    Exponent,
    /// A power of a power without parentheses.
    ChainedPower,
    /// A function in a value.
    FunctionCall {
        /// The function.
        name: String,
    },
    /// A function in the drive that does not exist.
    DriveFunction {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// `drive()` without a torque or a motion.
    EmptyDrive,
    /// A part of the drive that does not exist.
    UnknownDrive {
        /// Text as written.
        name: String,
        /// The known one that is spelt most alike.
        nearest: Option<&'static str>,
    },
    /// A divisor in the drive that depends on time.
    TimeDivisor,
    /// `t` where nothing depends on time.
    TimeOutsideDrive,
    /// A mathematical constant without exact value.
    NotExact {
        /// The name.
        name: String,
        /// Its value in digits.
        digits: &'static str,
    },
    /// Too high a power of parameters.
    Degree {
        /// Highest power allowed.
        limit: u32,
    },
    /// A product of masses and lengths that no `f64` can hold.
    ConstantRange {
        /// The constant.
        name: String,
    },
    /// `each(...)` where there are no copies.
    EachWithoutCopies,
    /// `each(...)` in a generation rule.
    EachInRule {
        /// The rule.
        link: String,
    },
    /// `each(...)` with more or fewer values than copies.
    EachCount {
        /// The link.
        link: String,
        /// Number of copies.
        copies: usize,
        /// Number of values.
        values: usize,
    },
}

/// Kind of thing for which a name is taken where it stands as a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lookalike {
    /// A type of joint.
    Joint,
    /// A function.
    Function,
    /// An angle or its rate.
    Motion,
}

impl ValueMessage {
    /// The message in words.
    pub(super) fn problem(&self) -> Problem {
        use ValueMessage as M;
        match self {
            M::Lookalike { name, kind } => {
                let (what, hint) = match kind {
                    Lookalike::Joint => (
                        "a type of joint",
                        "links turn about pivots, and `joint` is a distance in m; for other \
                         joints see `docs/limits.md`",
                    ),
                    Lookalike::Function => (
                        "a function",
                        "give a parameter another name; values have no functions, drives have \
                         `sin(...)` and `cos(...)`",
                    ),
                    Lookalike::Motion => (
                        "an angle or a velocity",
                        "properties do not change with the motion: `friction(...)` and `drag(...)` \
                         have coefficients of laws, and `docs/limits.md` has other forces; give a \
                         parameter another name",
                    ),
                };
                problem(
                    format!("`{name}` as a parameter"),
                    format!("reads like {what}"),
                    hint,
                )
            }
            M::NotFinite { name } => problem(
                format!("`{name}` is not a finite number"),
                "no value of a pendulum",
                "write a number, or the name of a parameter",
            ),
            M::UndeclaredParameter { name, nearest } => problem(
                format!("`{name}` is not declared"),
                "not in `parameters(...)`",
                match nearest {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => format!("add `{name}` to `parameters(...)`, or write a number"),
                },
            ),
            M::UnusedParameter { name } => problem(
                format!("the parameter `{name}` is never used"),
                "no value names it",
                "leave it out of `parameters(...)`, or use it",
            ),
            M::Negative { what, value } => problem(
                format!("{what} is negative"),
                format!("this is {value}"),
                "write a value that is zero or above",
            ),
            M::NotPositive { what, value } => problem(
                format!("{what} is not positive"),
                format!("this is {value}"),
                "write a value above zero",
            ),
            M::DivisionByZero => problem(
                "division by zero",
                "this is zero",
                "write a divisor other than zero",
            ),
            M::NotDecimal { text } => problem(
                format!("`{text}` is not a decimal number"),
                "cannot be read",
                "write digits as in `0.27` or `1.88e-3`, without suffix; units are SI",
            ),
            M::NumberRange => problem(
                "a number is too large or too small",
                "no `f64` can hold it",
                "magnitudes go from 5e-324 to 1.7e308; units are SI",
            ),
            M::NumberLength => problem(
                "too many digits",
                "too long for exact arithmetic",
                "round it: 17 digits are all that an `f64` keeps",
            ),
            M::Exponent => problem(
                "the exponent is not a whole number",
                "not an exponent",
                "write a literal, as in `length^2` or `length^-1`",
            ),
            M::ChainedPower => problem(
                "a power of a power",
                "ambiguous",
                "write parentheses: `(a^2)^3`",
            ),
            M::FunctionCall { name } => problem(
                format!("`{name}(...)`: values have no functions"),
                "values are made of `+ - * / ^`",
                "compute it beforehand and write the digits, or make it a parameter",
            ),
            M::DriveFunction { name, nearest } => problem(
                format!("unknown function `{name}`"),
                "not a function of a drive",
                suggest(
                    nearest,
                    "functions are `sin(...)` and `cos(...)`, of angles in rad",
                ),
            ),
            M::EmptyDrive => problem(
                "the drive is empty",
                "drives nothing",
                "write `drive(torque = ...)`, or the motion of the root's pivot, \
                   `drive(x = ..., y = ...)`",
            ),
            M::UnknownDrive { name, nearest } => problem(
                format!("unknown part `{name}` of the drive"),
                "not a part of the drive",
                suggest(
                    nearest,
                    "parts are `torque`, on the root in N m, and `x` and `y`, of its pivot in m",
                ),
            ),
            M::TimeDivisor => problem(
                "division by a function",
                "may vanish at some time",
                "divide by numbers and parameters only, so that the drive is finite at all times",
            ),
            M::TimeOutsideDrive => problem(
                "`t` is the time",
                "does not depend on time",
                "only `drive(...)` does; give a parameter another name",
            ),
            M::NotExact { name, digits } => problem(
                format!("`{name}` has no exact value"),
                "not a rational number",
                format!("write as many digits as needed: `{digits}`"),
            ),
            M::Degree { limit } => problem(
                "the power of parameters is too high",
                "makes too many factors",
                format!("powers of parameters go up to {limit}"),
            ),
            M::ConstantRange { name } => problem(
                format!("the constant `{name}` of the model is too large or too small"),
                "no `f64` can hold a constant of this scene",
                "masses, lengths and gravity multiply: write values in SI units",
            ),
            M::EachWithoutCopies => problem(
                "`each(...)` where there are no copies",
                "one value is enough here",
                "write the value alone, or copies behind the link: \
                   `child(mass = each(0.105, 0.106), ...) * 2`",
            ),
            M::EachInRule { link } => problem(
                format!("`each(...)` in the generation rule `{link}`"),
                "all links of a generation are equal",
                "write the generations out, each link with its children in `[ ]`",
            ),
            M::EachCount {
                link,
                copies,
                values,
            } => problem(
                format!("`each(...)` needs {copies} values for the {copies} copies of `{link}`"),
                format!("{values} of them here"),
                "write one value for each copy, as in `each(0.105, 0.106)` for two",
            ),
        }
    }
}
