//! Requests that no method can answer.

use core::fmt;

use crate::scalar::Real;

/// A request that no method can answer; nothing was computed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum InputError<T> {
    /// A tolerance is negative or not finite, or zero where it must not be.
    Tolerance {
        /// `"relative"`, `"absolute"` or `"projection"`.
        name: &'static str,
        /// Index of the component; 0 for a uniform tolerance.
        component: usize,
        /// The tolerance given.
        value: T,
    },
    /// Tolerances per component do not fit the state.
    ToleranceCount {
        /// `"relative"` or `"absolute"`.
        name: &'static str,
        /// Number of components of the state.
        expected: usize,
        /// Number of tolerances given.
        found: usize,
    },
    /// Relative and absolute tolerance of a component are both zero.
    NoTolerance {
        /// Index of the component.
        component: usize,
    },
    /// The tolerances of a component ask for digits that it does not have.
    ToleranceBelowRounding {
        /// Index of the component.
        component: usize,
        /// Relative tolerance of the component.
        relative: T,
        /// Absolute tolerance of the component.
        absolute: T,
        /// The smallest relative tolerance that is of use to the method.
        smallest: T,
    },
    /// A step size in the options is negative or not finite, or zero where it
    /// must not be.
    Step {
        /// `"initial"`, `"longest"`, `"shortest"` or `"fixed"`.
        name: &'static str,
        /// The step given.
        value: T,
    },
    /// The length of a single step is infinite or NaN.
    FixedStep {
        /// The step given.
        value: T,
    },
    /// The shortest step allowed is longer than the longest.
    StepRange {
        /// Shortest step given.
        shortest: T,
        /// Longest step given.
        longest: T,
    },
    /// Beta is outside 0 to 0.2.
    Beta {
        /// The beta given.
        value: T,
    },
    /// Beta is given to a method whose steps it has no part in.
    BetaUnused {
        /// The beta given.
        value: T,
    },
    /// A Taylor method of an order that there is not.
    Order {
        /// The order given.
        order: usize,
        /// The lowest order there is.
        smallest: usize,
        /// The highest.
        largest: usize,
    },
    /// Taylor series are asked for where the equations give no coefficients.
    NoSeries,
    /// The state has no components.
    EmptyState,
    /// The state does not fit the equations.
    Dimension {
        /// Dimension of the equations.
        expected: usize,
        /// Number of components given.
        found: usize,
    },
    /// A checkpoint of another method, or of other equations.
    Checkpoint {
        /// Numbers that this method remembers.
        expected: usize,
        /// Numbers of the checkpoint.
        found: usize,
    },
    /// A system of an ensemble in lanes has not as many constants as the first
    /// one: [`Pendulum`](crate::system::Pendulum) says what it takes.
    Constants {
        /// Constants of the first one.
        expected: usize,
        /// Constants of this one.
        found: usize,
    },
    /// A system of an ensemble in lanes differs from the first one in more than
    /// constants: [`LaneOde::shape`](crate::system::LaneOde::shape).
    Shape,
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
    /// The time to integrate to is infinite or NaN.
    EndTime {
        /// The time given.
        value: T,
    },
    /// A time to sample at is infinite or NaN.
    Time {
        /// Index among the times given.
        index: usize,
        /// The time given.
        value: T,
    },
    /// Times to sample at turn back: they must run one way from the start.
    TimeOrder {
        /// Index of the offending time.
        index: usize,
        /// The time before it, or the starting time.
        previous: T,
        /// The offending time.
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

/// Writes that a number is not in its range.
fn out_of_range(
    f: &mut fmt::Formatter<'_>,
    what: impl fmt::Display,
    value: impl fmt::Display,
    range: &str,
) -> fmt::Result {
    write!(f, "{what} is {value}: it must be {range}")
}

impl<T: Real> core::error::Error for InputError<T> {}
