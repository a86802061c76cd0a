//! Growth of small differences between copies of a tree that move in phase.

use branched_pendulum::analysis::growth::{Grown, Growth, GrowthError, frequency_at_rest};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::system::{CastOde, Ode, State};

use super::InPhaseTree;
use crate::error::TreeError;
use crate::tree::PendulumTree;

/// Computes the growth of a small difference between two copies in a tree whose motion is otherwise
/// in phase.
///
/// Starts are states of the whole tree. The size of the difference is √(Σ δ²) over all links that
/// differ; at the start all these differences are equal.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::variational::Copies;
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};
///
/// let tree = PendulumTree::parse(
///     "gravity = 9.80665,
///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///      ]",
/// )?;
/// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
/// let differences = DifferenceGrowth::new(&tree, &children, vec![10.0], 1e-9)?;
/// assert!((differences.growth().frequency_hz - 1.2581).abs() < 1e-4);
/// let starts = [42.0_f64, 44.0].map(|degrees| {
///     State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0])
/// });
/// let grown = differences.in_lanes(&Ensemble::new(), &starts)?;
/// let [Ok(below), Ok(above)] = grown.as_slice() else { panic!("{grown:?}") };
/// assert!(below.factors[0].value < 10.0 && above.factors[0].value > 16.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct DifferenceGrowth {
    system: InPhaseTree,
    growth: Growth,
}

impl DifferenceGrowth {
    /// Prepares the computation of the growth of a difference between the first two `copies`, up to
    /// each of the `horizons` (times in s after the start), with the given tolerance. The frequency
    /// of [`Growth`] is set to the frequency of the difference in small motions about all angles
    /// zero; it is NaN if the difference does not oscillate.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] if the links do not stay in phase.
    pub fn new(
        tree: &PendulumTree,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<Self, TreeError> {
        let system = tree.in_phase(copies)?.with_differences(copies)?;
        let growth = Growth {
            frequency_hz: frequency_at_rest(&system),
            horizons,
            tolerance,
        };
        Ok(Self { system, growth })
    }

    /// Sets the frequency (Hz) at which the size of differences is sampled, and by which their
    /// rates are scaled.
    #[must_use]
    pub fn looked_at(mut self, frequency_hz: f64) -> Self {
        self.growth.frequency_hz = frequency_hz;
        self
    }

    /// Returns the settings of the computation.
    pub fn growth(&self) -> &Growth {
        &self.growth
    }

    /// Returns the equations of the copies in phase together with their differences.
    pub fn system(&self) -> &InPhaseTree {
        &self.system
    }

    /// Returns the rate (1/s) at which friction damps the velocity of a small difference in small
    /// motions, as a mean over the links that differ.
    pub fn decay(&self) -> f64 {
        let own = self.system.differing();
        let all = self.system.dimension() / 2;
        let is_difference = |place: usize| place >= 2 * all - own;
        let state: Vec<f64> = (0..2 * all)
            .map(|place| f64::from(u8::from(is_difference(place))))
            .collect();
        let mut rates = state.clone();
        self.system.rates(0.0, &state, &mut rates);
        -rates.iter().skip(2 * all - own).sum::<f64>() / own as f64
    }

    /// Returns the growth of the difference after each start, computed on all cores and in lanes of
    /// vector registers.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] if the copies are not in phase at a start; otherwise each start
    /// has its own result, which may be a [`GrowthError`].
    pub fn in_lanes(
        &self,
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
    ) -> Result<Vec<Result<Grown, GrowthError>>, TreeError> {
        let releases = starts
            .iter()
            .map(|start| Ok((&self.system, self.start(start)?)));
        let releases: Vec<_> = releases.collect::<Result<_, TreeError>>()?;
        Ok(self.growth.in_lanes(ensemble, &releases))
    }

    /// Returns the growth of the difference in several trees, each after its own start, computed on
    /// all cores and in lanes of vector registers. Trees of the same shape with equal horizons are
    /// computed together.
    ///
    /// # Errors
    /// As [`in_lanes`](Self::in_lanes).
    pub fn of_trees_in_lanes(
        ensemble: &Ensemble<'_>,
        cases: &[(&Self, State<f64>)],
    ) -> Result<Vec<Result<Grown, GrowthError>>, TreeError> {
        // Sorts the starts by trees, so that the constants of a tree stay in their lanes.
        let mut ordered: Vec<(&(&Self, State<f64>), usize)> = cases.iter().zip(0..).collect();
        ordered.sort_by_key(|((own, _), _)| (own.system.shape(), std::ptr::from_ref(*own)));
        let share = |one: &Self, other: &Self| {
            let is_asked_alike = one.growth.horizons == other.growth.horizons
                && one.growth.tolerance == other.growth.tolerance;
            one.system.shape() == other.system.shape() && is_asked_alike
        };
        let mut all: Vec<(usize, Result<Grown, GrowthError>)> = Vec::new();
        for cases in ordered.chunk_by(|((one, _), _), ((other, _), _)| share(one, other)) {
            let Some(((first, _), _)) = cases.first() else {
                continue;
            };
            let own = || cases.iter().map(|(case, _)| *case);
            let releases = own().map(|(own, start)| Ok((&own.system, own.start(start)?)));
            let releases: Vec<_> = releases.collect::<Result<_, TreeError>>()?;
            let frequencies: Vec<f64> = own().map(|(own, _)| own.growth.frequency_hz).collect();
            let grown = first
                .growth
                .in_lanes_by_frequency(ensemble, &releases, &frequencies);
            all.extend(cases.iter().map(|(_, place)| *place).zip(grown));
        }
        all.sort_unstable_by_key(|(place, _)| *place);
        Ok(all.into_iter().map(|(_, grown)| grown).collect())
    }

    /// Returns the growth of the difference after one start, computed on this thread.
    ///
    /// # Errors
    /// As [`in_lanes`](Self::in_lanes).
    pub fn of_release(&self, start: &State<f64>) -> Result<Result<Grown, GrowthError>, TreeError> {
        let start = self.start(start)?;
        Ok(self.growth.of_release(&self.system, &start))
    }

    fn start(&self, whole: &State<f64>) -> Result<State<f64>, TreeError> {
        self.system.start(whole).ok_or(TreeError::NotInPhase)
    }
}
