//! Families of trees that a text describes.

use branched_pendulum::scalar::Scalar;
use branched_pendulum_trees::{EquationsOfMotion, TreeDescription, TreeError};

use super::family::{Family, ImpossibleValue};

/// All trees of a description: a [`Family`] whose parameters are the names in a text.
#[derive(Clone, Debug)]
pub struct TreeFamily(TreeDescription);

impl TreeFamily {
    /// Returns the trees of this description.
    #[must_use]
    pub fn new(description: TreeDescription) -> Self {
        Self(description)
    }
}

impl Family for TreeFamily {
    type Equations<T: Scalar> = EquationsOfMotion<T>;

    fn parameters(&self) -> Vec<String> {
        self.0.parameters().map(str::to_owned).collect()
    }

    fn links(&self) -> Vec<String> {
        self.0.links()
    }

    fn equations<T: Scalar>(&self, values: &[T]) -> EquationsOfMotion<T> {
        self.0.equations(values)
    }

    fn check(&self, values: &[f64]) -> Result<(), ImpossibleValue> {
        let values: Vec<_> = self.0.parameters().zip(values.iter().copied()).collect();
        match self.0.tree::<f64>(&values) {
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
