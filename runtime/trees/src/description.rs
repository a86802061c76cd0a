//! Descriptions of trees, whose parameters have no values yet.

use std::sync::Arc;

use branched_pendulum::scalar::Scalar;
use branched_pendulum_codegen::scene::Scene;

use crate::error::{DescriptionError, TreeError};
use crate::text;
use crate::tree::PendulumTree;

/// A parsed and checked description of a tree, whose parameters have no values yet.
///
/// # Examples
///
/// ```
/// use branched_pendulum_trees::TreeDescription;
///
/// let rod = TreeDescription::parse("gravity = g, rod: rod(mass = 0.2, length = l)")?;
/// assert_eq!(rod.parameters().collect::<Vec<_>>(), ["g", "l"]);
/// assert_eq!(rod.parameter_use("g"), Some("gravity, m/s²"));
/// let rod = rod.tree::<f64>(&[("g", 9.81), ("l", 1.0)])?;
/// let alpha = rod.accelerations(0.0, &[0.1], &[0.0]);
/// assert!((alpha[0] + 1.5 * 9.81 * 0.1_f64.sin()).abs() < 1e-14);
/// # Ok::<(), branched_pendulum_trees::TreeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreeDescription {
    pub(crate) scene: Arc<Scene>,
}

impl TreeDescription {
    /// Parses a description: the text between the parentheses of the attribute `branched_pendulum`.
    ///
    /// # Errors
    /// [`DescriptionError`] with all mistakes and their positions in the text. `emit(taylor)` and
    /// transverse equations are mistakes too, because these are derived for compiled trees only.
    pub fn parse(text: &str) -> Result<Self, DescriptionError> {
        let scene = Arc::new(text::scene(text)?);
        Ok(Self { scene })
    }

    /// Returns the names of the parameters, in the order of the description.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        let parameters = self.scene.parameters.iter();
        parameters.map(|parameter| parameter.name.as_str())
    }

    /// Returns what a parameter is used for, with its unit, as in "gravity, m/s²"; `None` if there
    /// is no such parameter.
    pub fn parameter_use(&self, name: &str) -> Option<&str> {
        let mut parameters = self.scene.parameters.iter();
        let found = parameters.find(|parameter| parameter.name == name)?;
        Some(&found.doc)
    }

    /// Returns the tree for the given values of its parameters, in SI units.
    ///
    /// # Errors
    /// [`TreeError`] for an unknown parameter, for a parameter without a value, and for values that
    /// are not physical.
    pub fn tree<T: Scalar>(&self, values: &[(&str, f64)]) -> Result<PendulumTree<T>, TreeError> {
        PendulumTree::of(self.clone(), self.values(values)?)
    }

    /// Returns the values of all parameters, in the order of the description.
    pub(crate) fn values(&self, values: &[(&str, f64)]) -> Result<Vec<f64>, TreeError> {
        let mut own = vec![None; self.scene.parameters.len()];
        for &(name, value) in values {
            let place = self.place(name)?;
            if let Some(own) = own.get_mut(place) {
                *own = Some(value);
            }
        }
        let known: Vec<f64> = own.iter().copied().flatten().collect();
        if known.len() < own.len() {
            let names = self.parameters().zip(&own);
            let names = names.filter(|(_, value)| value.is_none());
            let names = names.map(|(name, _)| name.to_owned()).collect();
            return Err(TreeError::MissingValues { names });
        }
        Ok(known)
    }

    /// Returns the index of the parameter with this name, or an error if it does not exist.
    pub(crate) fn place(&self, name: &str) -> Result<usize, TreeError> {
        let found = self.parameters().position(|parameter| parameter == name);
        found.ok_or_else(|| TreeError::UnknownParameter {
            name: name.to_owned(),
            parameters: self.parameters().map(str::to_owned).collect(),
        })
    }
}
