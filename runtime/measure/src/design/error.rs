//! Reasons why a design was not searched for.

/// Reason why parameters were not searched for, or why no value of the quantities was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// There are no variables or no targets.
    #[error("a design needs at least one parameter that varies and one target")]
    Nothing,
    /// There are too many variables.
    #[error("{variables} parameters cannot vary at once: at most {most}")]
    TooMany {
        /// Number of variables.
        variables: usize,
        /// Largest number.
        most: usize,
    },
    /// A parameter was given twice.
    #[error("`{name}` is given twice: give it once")]
    Twice {
        /// Name of the parameter.
        name: String,
    },
    /// The bounds of a parameter do not ascend, or are not finite.
    #[error("`{name}` cannot vary from {from} to {to}: the bounds must be finite and ascending")]
    Range {
        /// Name of the parameter.
        name: String,
        /// Lower bound.
        from: f64,
        /// Upper bound.
        to: f64,
    },
    /// A goal is infinite or NaN.
    #[error("the goal of `{name}` must be a finite number, not {value}")]
    Goal {
        /// Name of the quantity.
        name: String,
        /// The goal.
        value: f64,
    },
    /// Parameters that do not vary have no value.
    #[error("no value for `{}`: give one, or let it vary", .names.join("`, `"))]
    MissingValues {
        /// Names of the parameters.
        names: Vec<String>,
    },
    /// The model has no parameter with this name.
    #[error("no parameter is called `{name}`; {}", there_are(.parameters))]
    UnknownParameter {
        /// The name given.
        name: String,
        /// Names that there are.
        parameters: Vec<String>,
    },
    /// The model has no quantity with this name.
    #[error("no quantity is called `{name}`; {}", there_are(.quantities))]
    UnknownQuantity {
        /// The name given.
        name: String,
        /// Names that there are.
        quantities: Vec<String>,
    },
    /// No parameters within the bounds reach the targets.
    #[error("no parameters within the bounds reach the targets: {cause}")]
    NotReached {
        /// The cause, with what to change.
        cause: String,
    },
    /// The quantities have no values at any start of the search.
    #[error(
        "the targets have no values at any of {starts} points within the bounds; help: choose other \
         bounds. At the first point: {reason}"
    )]
    Undefined {
        /// Number of points.
        starts: usize,
        /// Reason at the first point.
        reason: String,
    },
}

fn there_are(names: &[String]) -> String {
    match names {
        [] => "there are none: write a name in place of a number of the description".to_owned(),
        names => format!("there are: {}", names.join(", ")),
    }
}
