//! Messages about a description: its values and the drive.

use super::{Problem, suggest};

messages! {
    /// A mistake in a description: its values and the drive.
    ValueMessage as Value:

    /// A name of something else as a parameter, as in `joint = prismatic`.
    Lookalike { name: String, kind: Lookalike } => (
        format!("`{name}` as a parameter"),
        format!("reads like {}", kind.words()),
        kind.hint(),
    ),
    /// A value that is infinite or no number.
    NotFinite { name: String } => (
        format!("`{name}` is not a finite number"),
        "no value of a pendulum",
        "write a number, or the name of a parameter",
    ),
    /// A name that is no declared parameter.
    UndeclaredParameter { name: String, nearest: Option<String> } => (
        format!("`{name}` is not declared"),
        "not in `parameters(...)`",
        suggest(nearest, format!("add `{name}` to `parameters(...)`, or write a number")),
    ),
    /// A declared parameter that no value names.
    UnusedParameter { name: String } => (
        format!("the parameter `{name}` is never used"),
        "no value names it",
        "leave it out of `parameters(...)`, or use it",
    ),
    /// A value below zero that must not be.
    Negative { what: String, value: String } => (
        format!("{what} is negative"),
        format!("this is {value}"),
        "write a value that is zero or above",
    ),
    /// A value that must be above zero.
    NotPositive { what: String, value: String } => (
        format!("{what} is not positive"),
        format!("this is {value}"),
        "write a value above zero",
    ),
    /// A value of a magnitude that no pendulum has.
    Magnitude { what: String, value: String, range: &'static str } => (
        format!("{what} is too large or too small"),
        format!("this is {value}"),
        format!("write a value that is {range}; units are SI"),
    ),
    /// A divisor that is zero.
    DivisionByZero => (
        "division by zero",
        "this is zero",
        "write a divisor other than zero",
    ),
    /// A literal that is no plain decimal number.
    NotDecimal { text: String } => (
        format!("`{text}` is not a decimal number"),
        "cannot be read",
        "write digits as in `0.27` or `1.88e-3`, without suffix; units are SI",
    ),
    /// A number that no `f64` can hold.
    NumberRange => (
        "a number is too large or too small",
        "no `f64` can hold it",
        "magnitudes go from 5e-324 to 1.7e308; units are SI",
    ),
    /// A number with too many digits to go on exactly.
    NumberLength => (
        "too many digits",
        "too long for exact arithmetic",
        "round it: 17 digits are all that an `f64` keeps",
    ),
    /// An exponent that is no small whole number.
    Exponent => (
        "the exponent is not a whole number",
        "not an exponent",
        "write a literal, as in `length^2` or `length^-1`",
    ),
    /// A power of a power without parentheses.
    ChainedPower => (
        "a power of a power",
        "ambiguous",
        "write parentheses: `(a^2)^3`",
    ),
    /// A function in a value.
    FunctionCall { name: String } => (
        format!("`{name}(...)`: values have no functions"),
        "values are made of `+ - * / ^`",
        "compute it beforehand and write the digits, or make it a parameter",
    ),
    /// A function in the drive that does not exist.
    DriveFunction { name: String, nearest: Option<&'static str> } => (
        format!("unknown function `{name}`"),
        "not a function of a drive",
        suggest(
            nearest,
            "functions are `sin(...)` and `cos(...)`, of angles in rad",
        ),
    ),
    /// `drive()` without a torque or a motion.
    EmptyDrive => (
        "the drive is empty",
        "drives nothing",
        "write `drive(torque = ...)`, or the motion of the root's pivot, \
           `drive(x = ..., y = ...)`",
    ),
    /// A part of the drive that does not exist.
    UnknownDrive { name: String, nearest: Option<&'static str> } => (
        format!("unknown part `{name}` of the drive"),
        "not a part of the drive",
        suggest(
            nearest,
            "parts are `torque`, on the root in N m, and `x` and `y`, of its pivot in m",
        ),
    ),
    /// A divisor in the drive that depends on time.
    TimeDivisor => (
        "division by a function",
        "may vanish at some time",
        "divide by numbers and parameters only, so that the drive is finite at all times",
    ),
    /// `t` where nothing depends on time.
    TimeOutsideDrive => (
        "`t` is the time",
        "does not depend on time",
        "only `drive(...)` does; give a parameter another name",
    ),
    /// A mathematical constant without exact value.
    NotExact { name: String, digits: &'static str } => (
        format!("`{name}` has no exact value"),
        "not a rational number",
        format!("write as many digits as needed: `{digits}`"),
    ),
    /// Too high a power of parameters.
    Degree { limit: u32 } => (
        "the power of parameters is too high",
        "makes too many factors",
        format!("powers of parameters go up to {limit}"),
    ),
    /// A product of masses and lengths that no `f64` can hold.
    ConstantRange { name: String } => (
        format!("the constant `{name}` of the model is too large or too small"),
        "no `f64` can hold a constant of this scene",
        "masses, lengths and gravity multiply: write values in SI units",
    ),
    /// `each(...)` where there are no copies.
    EachWithoutCopies => (
        "`each(...)` where there are no copies",
        "one value is enough here",
        "write the value alone, or copies behind the link: \
           `child(mass = each(0.105, 0.106), ...) * 2`",
    ),
    /// `each(...)` in a generation rule.
    EachInRule { link: String } => (
        format!("`each(...)` in the generation rule `{link}`"),
        "all links of a generation are equal",
        "write the generations out, each link with its children in `[ ]`",
    ),
    /// `each(...)` with more or fewer values than copies.
    EachCount { link: String, copies: usize, values: usize } => (
        format!("`each(...)` needs {copies} values for the {copies} copies of `{link}`"),
        format!("{values} of them here"),
        "write one value for each copy, as in `each(0.105, 0.106)` for two",
    ),
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

impl Lookalike {
    fn words(self) -> &'static str {
        match self {
            Self::Joint => "a type of joint",
            Self::Function => "a function",
            Self::Motion => "an angle or a velocity",
        }
    }

    fn hint(self) -> &'static str {
        match self {
            Self::Joint => {
                "links turn about pivots, and `joint` is a distance in m; for other joints see \
                 `docs/limits.md`"
            }
            Self::Function => {
                "give a parameter another name; values have no functions, drives have `sin(...)` \
                 and `cos(...)`"
            }
            Self::Motion => {
                "properties do not change with the motion: `friction(...)` and `drag(...)` have \
                 coefficients of laws, and `docs/limits.md` has other forces; give a parameter \
                 another name"
            }
        }
    }
}
