//! Differences between two copies, as deviations from their motion in phase.

use crate::analysis::variational::Linearised;
use crate::system::{Ode, Workspace};

/// A system whose deviations are differences between two copies that move in phase: for each
/// pair of components those of the copies are opposite, all others zero. Rounding would else
/// let deviations in phase grow beside them, which a chaotic motion makes large.
///
/// [`Growth::along`](super::Growth::along) takes it for models without transverse equations;
/// the motion itself has to be in phase, and the deviation opposite from the start.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::{BetweenCopies, Growth, GrowthError};
/// use branched_pendulum::analysis::variational::linearised;
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::<f64>::new();
/// // Angles of the children, and their rates.
/// let pairs = vec![[1, 2], [4, 5]];
/// let system = BetweenCopies::new(linearised(AbsoluteAngles(&model)), pairs);
/// let growth = Growth {
///     frequency_hz: system.frequency_at_rest().unwrap(),
///     horizons: vec![10.0],
///     tolerance: 1e-9,
/// };
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// let start = State::at_rest(0.0, &[44_f64.to_radians(), 0.0, 0.0]);
/// let grown = growth.along(&system, &start, &system.opposite(), [1..2, 4..5])?;
/// assert!(grown.factors[0].value > 16.0);
/// # Ok::<(), GrowthError>(())
/// ```
#[derive(Clone, Debug)]
pub struct BetweenCopies<L> {
    system: L,
    pairs: Vec<[usize; 2]>,
}

impl<L: Linearised<f64>> BetweenCopies<L> {
    /// The system of angles followed by their rates, with the pairs of components, the first
    /// of which is that of the angles by which the copies differ at the start.
    pub fn new(system: L, pairs: Vec<[usize; 2]>) -> Self {
        Self { system, pairs }
    }

    /// Returns the deviation of the first pair: opposite angles of 1.
    pub fn opposite(&self) -> Vec<f64> {
        let mut deviation = vec![0.0; self.system.dimension()];
        if let Some(&[one, other]) = self.pairs.first() {
            for (component, value) in [(one, 1.0), (other, -1.0)] {
                if let Some(place) = deviation.get_mut(component) {
                    *place = value;
                }
            }
        }
        deviation
    }

    /// Returns the frequency in hertz of a small difference of the first pair, beside all
    /// angles zero and at rest; none where it does not oscillate.
    pub fn frequency_at_rest(&self) -> Option<f64> {
        let dimension = self.system.dimension();
        let (zeros, mut rates) = (vec![0.0; dimension], vec![0.0; dimension]);
        let mut changes = vec![0.0; dimension];
        let workspace = &mut Workspace::new();
        let deviation = self.opposite();
        self.linearised_rates(workspace, 0.0, &zeros, &deviation, &mut rates, &mut changes);
        let &[angle, _] = self.pairs.first()?;
        let frequency = (-changes.get(dimension / 2 + angle)?).sqrt() / std::f64::consts::TAU;
        (frequency > 0.0).then_some(frequency)
    }
}

impl<L: Ode<f64>> Ode<f64> for BetweenCopies<L> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.system.rates(time, state, rates);
    }
}

impl<L: Linearised<f64>> Linearised<f64> for BetweenCopies<L> {
    fn linearised_rates(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        deviation: &[f64],
        rates: &mut [f64],
        deviation_rates: &mut [f64],
    ) {
        let (differences, inner) = workspace.with_inner(deviation_rates.len());
        let system = &self.system;
        system.linearised_rates(inner, time, state, deviation, rates, deviation_rates);
        differences.fill(0.0);
        for &[one, other] in &self.pairs {
            let both = deviation_rates.get(one).zip(deviation_rates.get(other));
            let half = both.map_or(f64::NAN, |(one, other)| 0.5 * (one - other));
            for (component, value) in [(one, half), (other, -half)] {
                if let Some(place) = differences.get_mut(component) {
                    *place = value;
                }
            }
        }
        deviation_rates.copy_from_slice(differences);
    }
}
