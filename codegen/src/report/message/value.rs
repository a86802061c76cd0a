//! Messages about the values of a description and the drive.

use super::{Problem, suggest};

messages! {
    /// A mistake in the values of a description or in the drive.
    ValueMessage as Value:

    /// A parameter has the name of something that is not a parameter, as in `joint = prismatic`.
    Lookalike { name: String, kind: Lookalike } => (
        format!("`{name}` is used as a parameter"),
        format!("looks like {}", kind.words()),
        kind.hint(),
    ),
    /// A value names a constant of the surrounding Rust code, by a path or in capital letters.
    RustConstant { name: String } => (
        format!("`{name}` cannot be read as a value"),
        match name.contains("::") {
            true => "constants of Rust are not seen here",
            false => "parameters have small letters, and constants of Rust are not seen here",
        },
        "write the number itself, as in `gravity = 9.80665`, or a parameter in small letters, as in \
         `gravity = g`, which gets its value when the program runs",
    ),
    /// The value is infinite or NaN.
    NotFinite { name: String } => (
        format!("`{name}` is not a finite number"),
        "expected a finite number",
        "write a number, or the name of a parameter",
    ),
    /// A name is not among the declared parameters.
    UndeclaredParameter { name: String, nearest: Option<String> } => (
        format!("the parameter `{name}` is not declared"),
        "not in `parameters(...)`",
        suggest(nearest, format!("add `{name}` to `parameters(...)`, or write a number")),
    ),
    /// A declared parameter is not used in any value.
    UnusedParameter { name: String } => (
        format!("the parameter `{name}` is never used"),
        "no value uses it",
        "remove it from `parameters(...)`, or use it",
    ),
    /// The value is negative but must be at least zero.
    Negative { what: String, value: String } => (
        format!("{what} is negative"),
        format!("this is {value}"),
        "write a value that is zero or above",
    ),
    /// The value must be positive.
    NotPositive { what: String, value: String } => (
        format!("{what} is not positive"),
        format!("this is {value}"),
        "write a value above zero",
    ),
    /// The magnitude of the value is outside the accepted range.
    Magnitude { what: String, value: String, range: &'static str } => (
        format!("{what} is too large or too small"),
        format!("this is {value}"),
        format!("write a value that is {range}; units are SI"),
    ),
    /// A divisor is zero.
    DivisionByZero => (
        "division by zero",
        "this is zero",
        "write a divisor other than zero",
    ),
    /// A literal is not a plain decimal number.
    NotDecimal { text: String } => (
        format!("`{text}` is not a decimal number"),
        "cannot be read",
        "write digits as in `0.27` or `1.88e-3`, without suffix; units are SI",
    ),
    /// A number exceeds the range of `f64`.
    NumberRange => (
        "a number is too large or too small",
        "does not fit an `f64`",
        "write a magnitude from 5e-324 to 1.7e308; units are SI",
    ),
    /// A number has too many digits for exact arithmetic.
    NumberLength => (
        "a number has too many digits",
        "too long for exact arithmetic",
        "round it: an `f64` keeps only 17 digits",
    ),
    /// An exponent is not a small whole number.
    Exponent => (
        "the exponent is not a whole number",
        "expected a whole number",
        "write a number, as in `length^2` or `length^-1`",
    ),
    /// A power is raised to a power without parentheses.
    ChainedPower => (
        "a power is raised to a power without parentheses",
        "ambiguous",
        "write parentheses: `(a^2)^3`",
    ),
    /// A value contains a function.
    FunctionCall { name: String } => (
        format!("a value contains the function `{name}(...)`"),
        "values can use `+ - * / ^` only",
        "compute the number and write its digits, or make it a parameter",
    ),
    /// The drive contains an unknown function.
    DriveFunction { name: String, nearest: Option<&'static str> } => (
        format!("unknown function `{name}`"),
        "not a function of a drive",
        suggest(
            nearest,
            "functions are `sin(...)` and `cos(...)`, of angles in rad",
        ),
    ),
    /// `drive()` contains neither a torque nor a motion.
    EmptyDrive => (
        "the drive is empty",
        "drives nothing",
        "write `drive(torque = ...)`, or the motion of the root's pivot, \
           `drive(x = ..., y = ...)`",
    ),
    /// The drive has an unknown property.
    UnknownDrive { name: String, nearest: Option<&'static str> } => (
        format!("unknown part `{name}` of the drive"),
        "not a part of the drive",
        suggest(
            nearest,
            "parts are `torque`, on the root in N m, and `x` and `y`, its pivot's position in m",
        ),
    ),
    /// A divisor in the drive depends on time.
    TimeDivisor => (
        "division by a function of time",
        "may be zero at some time",
        "divide by numbers and parameters only, so that the drive is finite at all times",
    ),
    /// A value outside the drive contains the time `t`.
    TimeOutsideDrive => (
        "`t` is the time, which only `drive(...)` can use",
        "cannot depend on time",
        "give a parameter another name",
    ),
    /// The value is a mathematical constant that has no exact decimal value.
    NotExact { name: String, digits: &'static str } => (
        format!("`{name}` has no exact value"),
        "not a rational number",
        format!("write as many digits as needed: `{digits}`"),
    ),
    /// The power of parameters is too high.
    Degree { limit: u32 } => (
        "the power of parameters is too high",
        "too many factors",
        format!("powers of parameters go up to {limit}"),
    ),
    /// A constant of the model, a product of masses and lengths, exceeds the range of `f64`.
    ConstantRange { name: String } => (
        format!("the constant `{name}` of the model is too large or too small"),
        "a constant of this scene does not fit an `f64`",
        "it is a product of masses, lengths and gravity: write these in SI units",
    ),
    /// `each(...)` is given for a link without copies.
    EachWithoutCopies => (
        "`each(...)` is used where there are no copies",
        "expected a single value",
        "write the value alone, or add copies to the link: \
           `child(mass = each(0.105, 0.106), ...) * 2`",
    ),
    /// `each(...)` is given in a generation rule.
    EachInRule { link: String } => (
        format!("`each(...)` is used in the generation rule `{link}`"),
        "all links of a generation are equal",
        "write the generations out, each link with its children in `[ ]`",
    ),
    /// The number of values in `each(...)` differs from the number of copies.
    EachCount { link: String, copies: usize, values: usize } => (
        format!("`each(...)` needs {copies} values for the {copies} copies of `{link}`"),
        format!("{values} given here"),
        "write one value for each copy, as in `each(0.105, 0.106)` for two",
    ),
}

/// Meaning that a reader would expect from a name that is used as a parameter.
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
