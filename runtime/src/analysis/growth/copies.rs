//! Differences between two copies, as deviations from their motion in phase.

use super::{Grown, Growth, GrowthError};
use crate::analysis::variational::Linearised;
use crate::system::{Ode, State, Workspace};

/// Largest part by which rates of copies differ, from rounding.
const ALIKE: f64 = 1e-12;

/// A system whose deviations are differences between two copies that move in phase: for each
/// pair of components those of the copies are opposite, all others zero. Rounding would else
/// let deviations in phase grow beside them, which a chaotic motion makes large.
///
/// [`Growth::between_copies`] takes it for models without transverse equations; the motion
/// itself has to be in phase ([`is_in_phase`](Self::is_in_phase)).
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::{BetweenCopies, Growth, GrowthError, pairs_of_links};
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
/// let pairs = pairs_of_links(&[None, Some(0), Some(0)], [1, 2]).unwrap();
/// assert_eq!(pairs, [[1, 2], [4, 5]]);
/// let system = BetweenCopies::new(linearised(AbsoluteAngles(&model)), pairs);
/// let growth = Growth {
///     frequency_hz: system.frequency_at_rest().unwrap(),
///     horizons: vec![10.0],
///     tolerance: 1e-9,
/// };
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// let start = State::at_rest(0.0, &[44_f64.to_radians(), 0.0, 0.0]);
/// assert!(system.is_in_phase(&start));
/// let grown = growth.between_copies(&system, &start)?;
/// assert!(grown.factors[0].value > 16.0);
/// # Ok::<(), GrowthError>(())
/// ```
#[derive(Clone, Debug)]
pub struct BetweenCopies<L> {
    system: L,
    pairs: Vec<[usize; 2]>,
}

/// Returns the pairs of components of a state, angles and their rates, in which two links with
/// all that hangs from them differ; none where one hangs from the other or does not carry as
/// many links. `parents` are the links that each hangs from, before it in their order.
pub fn pairs_of_links(parents: &[Option<usize>], links: [usize; 2]) -> Option<Vec<[usize; 2]>> {
    let carried = |from: usize| -> Vec<usize> {
        let mut own = vec![from];
        for (link, parent) in parents.iter().enumerate() {
            if parent.is_some_and(|parent| own.contains(&parent)) {
                own.push(link);
            }
        }
        own
    };
    let [one, other] = links.map(carried);
    let are_apart = one.len() == other.len() && !one.iter().any(|link| other.contains(link));
    let angles = one.into_iter().zip(other).map(|(one, other)| [one, other]);
    let angles: Vec<[usize; 2]> = angles.collect();
    let of_rates = |pair: &[usize; 2]| pair.map(|link| link + parents.len());
    let rates = angles.iter().map(of_rates);
    are_apart.then(|| angles.iter().copied().chain(rates).collect())
}

impl<L: Ode<f64>> BetweenCopies<L> {
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

    /// Returns true if the copies are in one state and move on alike, but for rounding. A state
    /// that is no number differs from none.
    pub fn is_in_phase(&self, start: &State<f64>) -> bool {
        let state = &start.values;
        let mut rates = vec![0.0; state.len()];
        self.system.rates(start.time, state, &mut rates);
        let size = rates
            .iter()
            .fold(0.0, |size: f64, rate| size.max(rate.abs()));
        let difference = |values: &[f64], [one, other]: [usize; 2]| -> Option<f64> {
            Some((values.get(one)? - values.get(other)?).abs())
        };
        let differ = |&pair: &[usize; 2]| {
            let both = difference(state, pair).zip(difference(&rates, pair));
            both.is_none_or(|(own, rate)| own > 0.0 || rate > ALIKE * size)
        };
        !self.pairs.iter().any(differ)
    }
}

impl<L: Linearised<f64>> BetweenCopies<L> {
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

impl Growth {
    /// Returns the growth of a difference between copies along their motion in phase, looked
    /// at by the angles of the first pair.
    ///
    /// # Errors
    ///
    /// [`GrowthError`].
    pub fn between_copies<L: Linearised<f64>>(
        &self,
        system: &BetweenCopies<L>,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError> {
        let &[angle, _] = system.pairs.first().ok_or(GrowthError::Difference)?;
        let rate = system.dimension() / 2 + angle;
        let differences = [angle..angle + 1, rate..rate + 1];
        self.along(system, start, &system.opposite(), differences)
    }
}
