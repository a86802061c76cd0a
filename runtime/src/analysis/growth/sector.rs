//! Differences of one sector beside a motion in phase, by dual numbers.

use super::{DifferenceRanges, Grown, Growth, GrowthError, GrowthRun, TransverseSystem, places};
use crate::analysis::variational::Linearised;
use crate::sectors::{Sector, SectorCoordinate};
use crate::system::{Ode, State, Workspace};

/// A motion in which all copies are in phase, and small differences of one sector beside it:
/// transverse equations (physics (12.2)) without a compiler, from the linearised equations of
/// the whole tree. Infinitesimal differences of a sector stay in it.
///
/// The state is the angles, the differences in the order of the sector's coordinates, the
/// angular velocities and the rates of the differences, as that of a
/// [`TransverseOde`](crate::system::TransverseOde), but with the angles of all copies.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::{
///     Growth, GrowthError, SectorDifferences, frequency_at_rest,
/// };
/// use branched_pendulum::analysis::variational::linearised;
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     emit(budget(canonical)),
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::<f64>::new();
/// let antiphase = &BranchedDouble::<f64>::SECTORS[1];
/// let system = SectorDifferences::new(linearised(AbsoluteAngles(&model)), antiphase);
/// let growth = Growth {
///     frequency_hz: frequency_at_rest(&system),
///     horizons: vec![10.0],
///     tolerance: 1e-9,
/// };
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// let grown = growth.of_sector(&system, &State::at_rest(0.0, &[44_f64.to_radians(), 0.0, 0.0]))?;
/// assert!(grown.factors[0].value > 16.0);
/// # Ok::<(), GrowthError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SectorDifferences<L> {
    system: L,
    coordinates: Vec<SectorCoordinate>,
}

impl<L: Ode<f64>> SectorDifferences<L> {
    /// The system of angles followed by their rates, with the differences of a sector.
    pub fn new(system: L, sector: &Sector) -> Self {
        Self {
            system,
            coordinates: sector.coordinates().to_vec(),
        }
    }

    fn links(&self) -> usize {
        self.system.dimension() / 2
    }
}

impl<L: Linearised<f64>> SectorDifferences<L> {
    /// Writes Σ weight · difference to the links' angles and to their rates.
    fn write_deviation(&self, state: &[f64], deviation: &mut [f64]) {
        let DifferenceRanges { angles, rates } = places(self);
        deviation.fill(0.0);
        let (to_angles, to_rates) = deviation.split_at_mut(self.links());
        for (range, links) in [(angles, to_angles), (rates, to_rates)] {
            for (coordinate, difference) in self.coordinates.iter().zip(&state[range]) {
                coordinate.write(*difference, links);
            }
        }
    }
}

impl<L: Linearised<f64>> Ode<f64> for SectorDifferences<L> {
    fn dimension(&self) -> usize {
        self.system.dimension() + 2 * self.coordinates.len()
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        rates: &mut [f64],
    ) {
        let (links, own) = (self.links(), self.coordinates.len());
        let is_ours = |coordinate: &SectorCoordinate| {
            let mut weights = coordinate.weights().iter();
            weights.all(|(link, _)| *link < links)
        };
        if [state.len(), rates.len()] != [self.dimension(); 2]
            || !self.coordinates.iter().all(is_ours)
        {
            rates.fill(f64::NAN);
            return;
        }
        let (numbers, inner) = workspace.with_inner(8 * links);
        let (motion, numbers) = numbers.split_at_mut(2 * links);
        let (deviation, numbers) = numbers.split_at_mut(2 * links);
        let (motion_rates, deviation_rates) = numbers.split_at_mut(2 * links);
        motion[..links].copy_from_slice(&state[..links]);
        motion[links..].copy_from_slice(&state[links + own..][..links]);
        self.write_deviation(state, deviation);
        let system = &self.system;
        system.linearised_rates(
            inner,
            time,
            motion,
            deviation,
            motion_rates,
            deviation_rates,
        );
        rates[..links].copy_from_slice(&motion_rates[..links]);
        rates[links + own..][..links].copy_from_slice(&motion_rates[links..]);
        let DifferenceRanges {
            angles,
            rates: place,
        } = places(self);
        rates[angles].copy_from_slice(&state[place.clone()]);
        for (rate, coordinate) in rates[place].iter_mut().zip(&self.coordinates) {
            *rate = coordinate.of(&deviation_rates[links..]);
        }
    }
}

impl<L: Linearised<f64>> TransverseSystem for SectorDifferences<L> {
    fn differences(&self) -> usize {
        self.coordinates.len()
    }
}

impl Growth {
    /// Returns the growth of differences of a sector beside the motion from a start, a state of
    /// angles followed by angular velocities in which all copies are in phase. All differences
    /// are 1 at the start, and at rest.
    ///
    /// # Errors
    ///
    /// [`GrowthError`]; [`GrowthError::Difference`] for a start of another length, and where
    /// copies of the sector differ.
    pub fn of_sector<L: Linearised<f64>>(
        &self,
        system: &SectorDifferences<L>,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError> {
        let (links, own) = (system.links(), system.coordinates.len());
        if start.values.len() != 2 * links {
            return Err(GrowthError::Difference);
        }
        let (theta, omega) = start.values.split_at(links);
        let is_in_phase = |coordinate: &SectorCoordinate| {
            [theta, omega]
                .iter()
                .all(|values| coordinate.of(values) == 0.0)
        };
        if !system.coordinates.iter().all(is_in_phase) {
            return Err(GrowthError::Difference);
        }
        let values = [theta, &vec![1.0; own], omega, &vec![0.0; own]].concat();
        let both = State::new(start.time, values);
        self.one_by_one(system, &both, places(system), GrowthRun::scale)
    }
}
