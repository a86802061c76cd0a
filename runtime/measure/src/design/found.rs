//! Result of a search for parameters.

use super::problem::DesignVariable;

/// A bound of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The lower bound.
    Lower,
    /// The upper bound.
    Upper,
}

/// Parameters that were found, or the nearest ones if the targets cannot be reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Values of the parameters, in the order of the variables.
    pub parameters: Vec<f64>,
    /// Values of the quantities, in the order of the targets.
    pub values: Vec<f64>,
    /// True if all requirements hold to [`Design::TOLERANCE`].
    pub is_reached: bool,
    /// Derivatives of each quantity by each parameter. Not a number if the quantity has no value
    /// next to the solution.
    pub sensitivities: Vec<Vec<f64>>,
    /// Bound at which each parameter is.
    pub bounds: Vec<Option<Side>>,
    /// For each parameter, true if only its bound keeps the quantities from coming nearer to their
    /// targets.
    pub holds: Vec<bool>,
    /// Independent changes of the parameters that leave all quantities as they are, to first order;
    /// the largest change is the width of a parameter's range.
    pub open_directions: Vec<Vec<f64>>,
    /// True if requirements that are not equations leave the parameters some freedom.
    pub has_slack: bool,
    /// Other solutions that were found, if they are isolated.
    pub others: Vec<Vec<f64>>,
    /// Number of points at which the quantities were computed before the search, and the number of
    /// these without values.
    pub starts: [usize; 2],
    /// If the targets are not reached: reason why the quantities have no values in the direction in
    /// which they come nearer to their targets.
    pub ends_at: Option<String>,
}

impl Design {
    /// Largest difference between a quantity and its goal, relative to the goal, that counts as
    /// reached.
    pub const TOLERANCE: f64 = 1e-6;

    /// Returns the reason why the targets are not reached, with what to change; `None` if they are
    /// reached. `variables` are the ones that the search varied.
    pub fn cause(&self, variables: &[DesignVariable]) -> Option<String> {
        if self.is_reached {
            return None;
        }
        let held = variables.iter().zip(&self.parameters).zip(&self.holds);
        let held = held.filter(|(_, holds)| **holds);
        let held = held.map(|((own, value), _)| format!("`{}` is held at {value}", own.name));
        let held: Vec<String> = held.collect();
        Some(match (held.is_empty(), &self.ends_at) {
            (_, Some(reason)) => format!(
                "next to the nearest point the targets have no values ({reason}); help: choose \
                 another target"
            ),
            (false, None) => format!("{}; help: widen this range", held.join(", ")),
            (true, None) => "no bound is the cause: the targets exclude each other, or a quantity \
                             has its largest or smallest value there; help: vary other parameters"
                .to_owned(),
        })
    }

    /// Returns true if no small change of the parameters leaves the targets reached.
    pub fn is_isolated(&self) -> bool {
        self.open_directions.is_empty() && !self.has_slack
    }
}
