//! Errors for invalid arguments of an integration.

use core::fmt;

use crate::scalar::Real;

/// Error: an argument of an integration is invalid. Nothing was computed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum InputError<T> {
    /// A tolerance is negative, infinite or NaN, or zero although it must be positive.
    Tolerance {
        /// Name of the tolerance: `"relative"`, `"absolute"` or `"projection"`.
        name: &'static str,
        /// Index of the component; 0 for a uniform tolerance.
        component: usize,
        /// The tolerance given.
        value: T,
    },
    /// The number of tolerances differs from the number of components of the state.
    ToleranceCount {
        /// Name of the tolerance: `"relative"` or `"absolute"`.
        name: &'static str,
        /// Number of components of the state.
        expected: usize,
        /// Number of tolerances given.
        found: usize,
    },
    /// The relative and the absolute tolerance of a component are both zero.
    NoTolerance {
        /// Index of the component.
        component: usize,
    },
    /// The tolerances of a component are so small that the error estimate would be rounding error.
    ToleranceBelowRounding {
        /// Index of the component.
        component: usize,
        /// Relative tolerance of the component.
        relative: T,
        /// Absolute tolerance of the component.
        absolute: T,
        /// Smallest relative tolerance that the method can use.
        smallest: T,
    },
    /// A step size of the options is negative, infinite or NaN, or zero although it must be
    /// positive.
    Step {
        /// Name of the option: `"initial"`, `"longest"`, `"shortest"` or `"fixed"`.
        name: &'static str,
        /// The step given.
        value: T,
    },
    /// The length of a single step is infinite or NaN.
    FixedStep {
        /// The step given.
        value: T,
    },
    /// The shortest step is longer than the longest step.
    StepRange {
        /// Shortest step given.
        shortest: T,
        /// Longest step given.
        longest: T,
    },
    /// Beta, the proportional gain of the step-size control, is outside 0 to 0.2.
    Beta {
        /// Value of beta.
        value: T,
    },
    /// Beta was given to a method that does not control the step size.
    BetaUnused {
        /// Value of beta.
        value: T,
    },
    /// The order of the Taylor series is outside the supported range.
    Order {
        /// Requested order.
        order: usize,
        /// Lowest supported order.
        smallest: usize,
        /// Highest supported order.
        largest: usize,
    },
    /// The method needs Taylor coefficients, which these equations do not provide.
    NoSeries,
    /// The state has no components.
    EmptyState,
    /// The number of components of the state differs from the dimension of the equations.
    Dimension {
        /// Dimension of the equations.
        expected: usize,
        /// Number of components given.
        found: usize,
    },
    /// The checkpoint belongs to another method or to other equations.
    Checkpoint {
        /// Number of values that this method stores in a checkpoint.
        expected: usize,
        /// Number of values in the checkpoint.
        found: usize,
    },
    /// A system of an ensemble in lanes has another number of constants than the first system. All
    /// systems must convert the same number of constants; see
    /// [`Model::cast`](crate::system::Model::cast).
    Constants {
        /// Number of constants of the first system.
        expected: usize,
        /// Number of constants of this system.
        found: usize,
    },
    /// A system of an ensemble in lanes differs from the first one in more than its constants; see
    /// [`CastOde::shape`](crate::system::CastOde::shape).
    Shape,
    /// The equations have another number of parameters than the one given, by which derivatives are
    /// requested.
    Parameters {
        /// Number given.
        found: usize,
    },
    /// The starting time is infinite or NaN.
    StartTime {
        /// The time given.
        value: T,
    },
    /// A component of the starting state is infinite or NaN.
    StartValue {
        /// Index of the component.
        component: usize,
        /// The value given.
        value: T,
    },
    /// The end time is infinite or NaN.
    EndTime {
        /// The time given.
        value: T,
    },
    /// A sample time is infinite or NaN.
    Time {
        /// Index of the sample time.
        index: usize,
        /// The time given.
        value: T,
    },
    /// The sample times change direction: they must all increase, or all decrease, from the start.
    TimeOrder {
        /// Index of the first time out of order.
        index: usize,
        /// Time of the previous sample; for the first sample, the start time.
        previous: T,
        /// The time that is out of order.
        value: T,
    },
}

impl<T: Real> fmt::Display for InputError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Tolerance {
                name,
                component,
                value,
            } => match name {
                "projection" => out_of_range(f, "tolerance of the projection", value, POSITIVE),
                _ => {
                    let what = format_args!("{name} tolerance of component {component}");
                    out_of_range(f, what, value, NOT_NEGATIVE)
                }
            },
            Self::ToleranceCount {
                name,
                expected,
                found,
            } => write!(
                f,
                "{found} {name} tolerances given for a state of {expected} components: \
                 it must be one for all, or one for each"
            ),
            Self::NoTolerance { component } => write!(
                f,
                "relative and absolute tolerance of component {component} are both zero: \
                 at least one must be positive"
            ),
            Self::ToleranceBelowRounding {
                component,
                relative,
                absolute,
                smallest,
            } => write!(
                f,
                "relative tolerance {relative:?} and absolute tolerance {absolute:?} of component \
                 {component} are below the rounding of its numbers: the smallest relative \
                 tolerance of use is {smallest:?}"
            ),
            Self::Step { name, value } => {
                let range = match name {
                    "shortest" => NOT_NEGATIVE,
                    _ => POSITIVE,
                };
                out_of_range(f, format_args!("{name} step"), value, range)
            }
            Self::FixedStep { value } => out_of_range(f, "step length", value, FINITE),
            Self::StepRange { shortest, longest } => write!(
                f,
                "shortest step {shortest} is longer than the longest step {longest}"
            ),
            Self::Beta { value } => out_of_range(f, "beta", value, "between 0 and 0.2"),
            Self::BetaUnused { value } => write!(
                f,
                "beta is {value}: this method has no use for it, leave it zero"
            ),
            Self::Order {
                order,
                smallest,
                largest,
            } => write!(
                f,
                "the order is {order}: it must be between {smallest} and {largest}"
            ),
            Self::NoSeries => f.write_str(NO_SERIES),
            Self::EmptyState => f.write_str(NO_COMPONENTS),
            Self::Dimension { expected, found } => write!(
                f,
                "the state has {found} components, the equations have {expected}"
            ),
            Self::Checkpoint { expected, found } => write!(
                f,
                "the checkpoint has {found} numbers of a method, this one remembers {expected}"
            ),
            Self::Constants { expected, found } => write!(
                f,
                "the system converts {found} constants, the first of the ensemble {expected}: \
                 in lanes all must have the same"
            ),
            Self::Shape => f.write_str(OTHER_SHAPE),
            Self::Parameters { found } => write!(
                f,
                "derivatives by {found} parameters are requested, but the equations do not have {found}: \
                 give the number of the description's parameters, `Parametric::PARAMETERS.len()`, or 0 \
                 for a model without any"
            ),
            Self::StartTime { value } => out_of_range(f, "the starting time", value, FINITE),
            Self::StartValue { component, value } => {
                let what = format_args!("component {component} of the starting state");
                out_of_range(f, what, value, FINITE)
            }
            Self::EndTime { value } => out_of_range(f, "the end time", value, FINITE),
            Self::Time { index, value } => {
                out_of_range(f, format_args!("requested time {index}"), value, FINITE)
            }
            Self::TimeOrder {
                index,
                previous,
                value,
            } => write!(
                f,
                "requested time {index} is {value}, after {previous}: \
                 times must run one way from the start"
            ),
        }
    }
}

const NO_SERIES: &str = "these equations give no Taylor coefficients: a model does so where its \
                         description says `emit(taylor)`, and so does a tree that is read at run \
                         time; all other methods need rates alone";
const NO_COMPONENTS: &str = "the state has no components: it must have at least one";
const OTHER_SHAPE: &str = "the system differs from the first of the ensemble in more than \
                           constants: in lanes it cannot";
const FINITE: &str = "finite";
const POSITIVE: &str = "finite and positive";
const NOT_NEGATIVE: &str = "finite and not negative";

/// Writes the message that a number is out of its range.
fn out_of_range(
    f: &mut fmt::Formatter<'_>,
    what: impl fmt::Display,
    value: impl fmt::Display,
    range: &str,
) -> fmt::Result {
    write!(f, "{what} is {value}: it must be {range}")
}

impl<T: Real> core::error::Error for InputError<T> {}
