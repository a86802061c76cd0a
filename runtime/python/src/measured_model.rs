//! Models whose motions can be integrated, and smoothed from measured angles.

use std::borrow::Cow;

use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::{LaneMethod, Taylor};
use branched_pendulum::system::{AbsoluteAngles, Energy, State, TaylorOde};
use branched_pendulum_trees::{PendulumTree, TreeError};

use crate::estimates::Coordinates;

/// Starts of an ensemble.
pub(crate) enum Releases<'a, M> {
    /// Several starts of one model.
    OfOne(&'a AbsoluteAngles<M>, &'a [State<f64>]),
    /// Starts that each have a model.
    OfEach(&'a [(AbsoluteAngles<M>, State<f64>)]),
}

impl<M: MeasuredModel> Releases<'_, M> {
    /// Returns the states at the given times, computed in the lanes of vector registers.
    pub(crate) fn sample(
        self,
        method: &impl LaneMethod<AbsoluteAngles<M>, f64>,
        ensemble: &Ensemble<'_>,
        times: &[f64],
    ) -> Vec<Samples<f64>> {
        match self {
            Self::OfOne(system, starts) => ensemble.sample_in_lanes(method, system, starts, times),
            Self::OfEach(releases) => ensemble.sample_models_in_lanes(method, releases, times),
        }
    }
}

/// A model with what is needed to smooth measured motions.
pub(crate) trait MeasuredModel: Energy<f64> + Clone + Send + Sync + 'static {
    /// Type of the equations, with Taylor coefficients if the model has them.
    type Series<'a>: TaylorOde<f64>;

    /// Returns the equations for methods that may need Taylor coefficients.
    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_>;

    /// Returns the model as a tree at run time.
    ///
    /// # Errors
    /// None if the description was read before.
    fn as_tree(&self) -> Result<Cow<'_, PendulumTree>, TreeError>;

    /// Returns the same model with other values of some parameters.
    ///
    /// # Errors
    /// The reason why the values are invalid.
    fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, String>;

    /// Samples many motions by the Taylor series method; `None` if the model has no Taylor
    /// coefficients.
    fn series_ensemble(
        method: &Taylor<f64>,
        releases: Releases<'_, Self>,
        ensemble: &Ensemble<'_>,
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>>;

    /// Returns the mass matrix (kg m²) at the given angles, one row per link.
    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>>;

    /// Returns the index of each link's parent; `None` for the root.
    fn link_parents(&self) -> Vec<Option<usize>>;

    /// Returns the coordinates in which measured angles are smoothed.
    fn smoothed_coordinates(&self) -> Coordinates {
        Coordinates::links(self.links())
    }
}
