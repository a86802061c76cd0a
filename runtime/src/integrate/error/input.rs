//! Requests that no method can answer.

use alloc::string::String;

/// A request that no method can answer; nothing was computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError<T> {
    /// A tolerance is negative or not finite, or zero where it must not be.
    #[error("{} is {value}: it must be finite and {}", tolerance(name, *component), range(name))]
    Tolerance {
        /// `"relative"`, `"absolute"` or `"projection"`.
        name: &'static str,
        /// Index of the component; 0 for a uniform tolerance.
        component: usize,
        /// The tolerance given.
        value: T,
    },
    /// Tolerances per component do not fit the state.
    #[error("{found} {name} tolerances given for a state of {expected} components")]
    ToleranceCount {
        /// `"relative"` or `"absolute"`.
        name: &'static str,
        /// Number of components of the state.
        expected: usize,
        /// Number of tolerances given.
        found: usize,
    },
    /// Relative and absolute tolerance of a component are both zero.
    #[error(
        "relative and absolute tolerance of component {component} are both zero: \
         at least one must be positive"
    )]
    NoTolerance {
        /// Index of the component.
        component: usize,
    },
    /// A step size in the options is negative or not finite, or zero where it
    /// must not be.
    #[error("{name} step is {value}: it must be finite and {}", range(name))]
    Step {
        /// `"initial"`, `"longest"`, `"shortest"` or `"fixed"`.
        name: &'static str,
        /// The step given.
        value: T,
    },
    /// The length of a single step is infinite or NaN.
    #[error("the length of a step is {value}")]
    FixedStep {
        /// The step given.
        value: T,
    },
    /// The shortest step allowed is longer than the longest.
    #[error("shortest step {shortest} is longer than the longest step {longest}")]
    StepRange {
        /// Shortest step given.
        shortest: T,
        /// Longest step given.
        longest: T,
    },
    /// Beta is outside 0 to 0.2.
    #[error("beta is {value}: it must be between 0 and 0.2")]
    Beta {
        /// The beta given.
        value: T,
    },
    /// Beta is given to a method whose steps it has no part in.
    #[error("beta is {value}: this method has no use for it, leave it zero")]
    BetaUnused {
        /// The beta given.
        value: T,
    },
    /// A Taylor method of an order that there is not.
    #[error("the order is {order}: it must be between {smallest} and {largest}")]
    Order {
        /// The order given.
        order: usize,
        /// The lowest order there is.
        smallest: usize,
        /// The highest.
        largest: usize,
    },
    /// Taylor series are asked for where the equations give no coefficients.
    #[error(
        "these equations give no Taylor coefficients: a model does so where its description says \
         `emit(taylor)`; all other methods need rates alone"
    )]
    NoSeries,
    /// A splitting is asked for where H is not T(p) + U(q).
    #[error(
        "the {} {coordinate} depends on the {}, by {change} of its size: H is not T(p) + U(q), so \
         that a splitting would not be symplectic and hardly consistent; Gauss methods need no such \
         form",
        rate.words()[0],
        rate.words()[1]
    )]
    NotSeparable {
        /// Index of the coordinate whose rate, or whose momentum's rate, depends
        /// on what it must not.
        coordinate: usize,
        /// The one of the two.
        rate: Inseparable,
        /// By how much it does, relative to its size.
        change: T,
    },
    /// The state has no components.
    #[error("the state has no components")]
    EmptyState,
    /// The state does not fit the equations.
    #[error("the state has {found} components, the equations have {expected}")]
    Dimension {
        /// Dimension of the equations.
        expected: usize,
        /// Number of components given.
        found: usize,
    },
    /// A checkpoint of another method, or of other equations.
    #[error("the checkpoint has {found} numbers of a method, this one remembers {expected}")]
    Checkpoint {
        /// Numbers that this method remembers.
        expected: usize,
        /// Numbers of the checkpoint.
        found: usize,
    },
    /// A system of an ensemble in lanes has not as many constants as the first
    /// one: [`Cast`](crate::system::Cast) says what it takes.
    #[error(
        "the system converts {found} constants, the first of the ensemble {expected}: in lanes all \
         must have the same"
    )]
    Constants {
        /// Constants of the first one.
        expected: usize,
        /// Its own.
        found: usize,
    },
    /// A system of an ensemble in lanes differs from the first one in more than
    /// constants: [`LaneOde::shape`](crate::system::LaneOde::shape).
    #[error(
        "the system differs from the first of the ensemble in more than constants: in lanes it cannot"
    )]
    Shape,
    /// The starting time is infinite or NaN.
    #[error("the starting time is {value}")]
    StartTime {
        /// The time given.
        value: T,
    },
    /// A component of the starting state is infinite or NaN.
    #[error("component {component} of the starting state is {value}")]
    StartValue {
        /// Index of the component.
        component: usize,
        /// The value given.
        value: T,
    },
    /// A time to integrate to, or to sample at, is infinite or NaN.
    #[error("requested time {index} is {value}")]
    Time {
        /// Index among the times given; 0 for an end time.
        index: usize,
        /// The time given.
        value: T,
    },
    /// Times to sample at turn back: they must run one way from the start.
    #[error(
        "requested time {index} is {value}, after {previous}: times must run one way from the start"
    )]
    TimeOrder {
        /// Index of the offending time.
        index: usize,
        /// The time before it, or the starting time.
        previous: T,
        /// The offending time.
        value: T,
    },
}

/// The rates that keep a Hamiltonian from being T(p) + U(q).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inseparable {
    /// Velocities depend on the coordinates, as those of links that hang from
    /// other links do.
    Velocity,
    /// Rates of momenta depend on momenta: by a kinetic energy that depends on
    /// the coordinates, or by friction.
    Force,
}

impl Inseparable {
    /// The rate, and what it depends on.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Velocity => ["velocity of coordinate", "coordinates"],
            Self::Force => ["rate of momentum", "momenta"],
        }
    }
}

/// A tolerance in a message.
fn tolerance(name: &str, component: usize) -> String {
    match name {
        "projection" => String::from("tolerance of the projection"),
        _ => alloc::format!("{name} tolerance of component {component}"),
    }
}

/// Which numbers a tolerance or a step of this name may be.
fn range(name: &str) -> &'static str {
    match name {
        "relative" | "absolute" | "shortest" => "not negative",
        _ => "positive",
    }
}
