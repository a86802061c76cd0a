//! Designs of trees: parameters at which frequencies, thresholds and growth rates have given values.

mod quantity;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::system::State;
use branched_pendulum_measure::design::{
    Design, DesignError, DesignSearch, DesignTarget, DesignVariable,
};

use crate::description::TreeDescription;
use crate::error::TreeError;
use crate::tree::PendulumTree;

use self::quantity::{Evaluation, QuantityNames};
pub use self::quantity::{QuantityValue, TreeQuantity};

/// Settings of thresholds and growth rates.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignSettings {
    /// Copies between which a difference grows; without them there are only frequencies of modes.
    pub copies: Option<Copies>,
    /// State of all links at the release, after which growth rates are computed. Copies are in
    /// phase.
    pub release: State<f64>,
    /// Links whose angle of release is varied to find the threshold.
    pub scanned: Vec<usize>,
    /// Angles of these links, in degrees, ascending. The threshold is located between two of them.
    pub angles_deg: Vec<f64>,
    /// Growth rate (1/s) that counts as growth, in addition to the decay by friction.
    pub least: f64,
    /// Settings of the normal form.
    pub form: NormalFormOptions,
}

impl DesignSettings {
    /// Step and largest angle of the default scan, in degrees.
    const SCAN: [f64; 2] = [0.25, 60.0];
    /// Default growth rate that counts as growth, 1/s: tongues narrower than the step grow slower.
    const LEAST: f64 = 0.02;

    /// Creates the default settings: the root is released from each angle up to 60°, and all other
    /// links hang down.
    pub fn new(links: usize, copies: Option<Copies>) -> Self {
        let [step, last] = Self::SCAN;
        Self {
            copies,
            release: State::at_rest(0.0, &vec![0.0; links]),
            scanned: vec![0],
            angles_deg: (1..=(last / step) as u32)
                .map(|number| step * f64::from(number))
                .collect(),
            least: Self::LEAST,
            form: NormalFormOptions::default(),
        }
    }
}

/// A search for the parameters of a tree at which its quantities reach their targets.
///
/// Names of quantities are `mode_1`, `mode_2`, … for the frequencies (Hz) of all modes in ascending
/// order; `f_1`, … for those of the modes in phase, and `d_1`, … for those of the difference between
/// copies; `threshold` or `window` for the smallest angle of release (degrees) from which a
/// difference grows; and `growth` for its growth rate (1/s) after a release. `f_d` is `d_1` if it is
/// the only one; `f_+` and `f_-` are `f_1` and `f_2` if there are two.
///
/// # Examples
///
/// Places of the children's centres of mass and of their pivot for which a small difference has
/// 1.25 Hz, and grows from 22° on if the parent is released with vertical children:
///
/// ```
/// use branched_pendulum::analysis::variational::Copies;
/// use branched_pendulum_measure::design::{DesignTarget, DesignVariable, Goal};
/// use branched_pendulum_trees::{DesignSettings, TreeDescription, TreeDesign};
///
/// let description = TreeDescription::parse(
///     "gravity = 9.80665,
///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = joint) [
///          child(mass = 0.10531, com = com, inertia = 0.516e-3) * 2
///      ]",
/// )?;
/// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]);
/// let design = TreeDesign::new(
///     description,
///     &[("joint", 0.27), ("com", 0.043)],
///     vec![
///         DesignVariable::new("joint", [0.2, 0.35]),
///         DesignVariable::new("com", [0.03, 0.06]),
///     ],
///     vec![
///         DesignTarget::new("f_d", Goal::Equal(1.25)),
///         DesignTarget::new("threshold", Goal::Equal(22.0)),
///     ],
///     DesignSettings::new(3, children),
/// )?;
/// let found = design.run()?;
/// assert!(found.is_reached && found.is_isolated());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreeDesign {
    description: TreeDescription,
    known: Vec<(String, f64)>,
    search: DesignSearch,
    quantities: Vec<TreeQuantity>,
    settings: DesignSettings,
}

impl TreeDesign {
    /// Creates a search. `known` has the values of parameters that do not vary, and present values
    /// of those that do.
    ///
    /// # Errors
    /// [`DesignError`] for unknown names, missing values, and ranges that are not valid.
    pub fn new(
        description: TreeDescription,
        known: &[(&str, f64)],
        variables: Vec<DesignVariable>,
        targets: Vec<DesignTarget>,
        settings: DesignSettings,
    ) -> Result<Self, DesignError> {
        let parameters: Vec<String> = description.parameters().map(str::to_owned).collect();
        let varied = variables.iter().map(|own| own.name.as_str());
        let mut given = varied.chain(known.iter().map(|(name, _)| *name));
        if let Some(name) = given.find(|name| parameters.iter().all(|own| own != name)) {
            return Err(DesignError::UnknownParameter {
                name: name.to_owned(),
                parameters: parameters.clone(),
            });
        }
        let value = |name: &str| known.iter().find(|(own, _)| *own == name).map(|own| own.1);
        let varies = |name: &String| variables.iter().any(|own| own.name == *name);
        let missing = parameters
            .iter()
            .filter(|name| !varies(name) && value(name).is_none());
        let names: Vec<String> = missing.cloned().collect();
        if !names.is_empty() {
            return Err(DesignError::MissingValues { names });
        }
        let known = known
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value));
        let known: Vec<(String, f64)> = known.filter(|(name, _)| !varies(name)).collect();
        let variables = variables.into_iter().map(|own| match value(&own.name) {
            Some(present) => own.with_present(present),
            None => own,
        });
        let search = DesignSearch::new(variables.collect(), targets)?;
        let names = QuantityNames::of(&description, settings.copies.as_ref());
        let quantities = search
            .targets()
            .iter()
            .map(|target| names.quantity(&target.name));
        Ok(Self {
            quantities: quantities.collect::<Result<_, _>>()?,
            description,
            known,
            search,
            settings,
        })
    }

    /// Returns the search, with its variables and targets.
    pub fn search(&self) -> &DesignSearch {
        &self.search
    }

    /// Returns the quantities of the targets.
    pub fn quantities(&self) -> &[TreeQuantity] {
        &self.quantities
    }

    /// Searches for the parameters.
    ///
    /// # Errors
    /// [`DesignError::Undefined`] if the targets have no values anywhere.
    pub fn run(&self) -> Result<Design, DesignError> {
        self.search.run(&|parameters| {
            let values = self.values(parameters)?;
            Ok(values.iter().map(|own| own.value).collect())
        })
    }

    /// Returns the tree with these values of the variables.
    ///
    /// # Errors
    /// [`TreeError`] for values that are not physical.
    pub fn tree(&self, parameters: &[f64]) -> Result<PendulumTree, TreeError> {
        let variables = self.search.variables().iter().zip(parameters);
        let varied = variables.map(|(own, value)| (own.name.as_str(), *value));
        let known = self
            .known
            .iter()
            .map(|(name, value)| (name.as_str(), *value));
        self.description
            .tree(&known.chain(varied).collect::<Vec<_>>())
    }

    /// Returns the values of the quantities of all targets, with their errors.
    ///
    /// # Errors
    /// The reason why a quantity has no value.
    pub fn values(&self, parameters: &[f64]) -> Result<Vec<QuantityValue>, String> {
        let tree = self.tree(parameters).map_err(|error| error.to_string())?;
        let mut evaluation = Evaluation::new(&tree, &self.settings);
        let all = self.quantities.iter();
        all.map(|quantity| evaluation.value(*quantity)).collect()
    }
}
