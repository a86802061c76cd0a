//! Models whose motions are followed and measured.

use std::borrow::Cow;

use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::Taylor;
use branched_pendulum::system::{AbsoluteAngles, Energy, State, TaylorOde};
use branched_pendulum_trees::{PendulumTree, TreeError};

use crate::estimates::Coordinates;

/// A model with what its measured motions are smoothed by.
pub(crate) trait MeasuredModel: Energy<f64> + Clone + Send + Sync + 'static {
    /// The equations, with Taylor coefficients where the model has them.
    type Series<'a>: TaylorOde<f64>;

    /// Returns the equations for methods that may ask for Taylor coefficients.
    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_>;

    /// Returns the model as a tree at run time.
    ///
    /// # Errors
    /// None of a description that was read before.
    fn as_tree(&self) -> Result<Cow<'_, PendulumTree>, TreeError>;

    /// Returns the model with other values of parameters.
    ///
    /// # Errors
    /// Why there is no such model.
    fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, String>;

    /// Samples of many motions by Taylor series; none of models without.
    fn series_ensemble(
        method: &Taylor<f64>,
        system: &AbsoluteAngles<Self>,
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>>;

    /// The mass matrix (kg m²) at angles, a row for each link.
    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>>;

    /// The link that each hangs from; of the root none.
    fn link_parents(&self) -> Vec<Option<usize>>;

    /// Coordinates in which measured angles are smoothed.
    fn smoothed_coordinates(&self) -> Coordinates {
        Coordinates::links(self.links())
    }
}
