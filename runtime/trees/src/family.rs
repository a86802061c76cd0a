//! All trees of a description, one of which is to be identified from measured angles.

use branched_pendulum::scalar::Scalar;
use branched_pendulum_measure::identification::{Family, ImpossibleValue};

use crate::description::TreeDescription;
use crate::error::TreeError;
use crate::parametric::{EquationsOfMotion, ParameterUse};

/// A description as a family of trees; its parameters are the names in the text.
impl Family for TreeDescription {
    type Equations<T: Scalar> = EquationsOfMotion<T>;

    fn parameters(&self) -> Vec<String> {
        self.parameters().map(str::to_owned).collect()
    }

    fn links(&self) -> Vec<String> {
        self.links()
    }

    fn equations<T: Scalar>(&self, values: &[T]) -> EquationsOfMotion<T> {
        self.equations(values)
    }

    fn is_friction(&self, parameter: usize) -> bool {
        let name = self.parameters().nth(parameter);
        let uses = name.map(|name| self.uses_of(name)).unwrap_or_default();
        !uses.is_empty() && uses.iter().all(ParameterUse::is_friction)
    }

    fn check(&self, values: &[f64]) -> Result<(), ImpossibleValue> {
        let values: Vec<_> = self.parameters().zip(values.iter().copied()).collect();
        match self.tree::<f64>(&values) {
            Err(TreeError::Value {
                what,
                value,
                requirement,
            }) => Err(ImpossibleValue {
                what,
                value,
                requirement,
            }),
            // Names and their number are those of the description.
            _ => Ok(()),
        }
    }
}
