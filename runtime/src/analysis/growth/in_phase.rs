//! The motion of copies that are all in phase, in fewer coordinates.

use crate::analysis::variational::Linearised;
use crate::sectors::{Sector, SectorCoordinate};
use crate::system::{Ode, Workspace};

/// A tree whose copies all move in phase, as a system in the coordinates of that sector,
/// followed by their rates: nonlinear normal modes ([`Continuation`](super::Continuation)) of a
/// tree with copies are those of this system.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::InPhaseOde;
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
/// let system = InPhaseOde::new(AbsoluteAngles(&model), &BranchedDouble::<f64>::SECTORS[0]);
/// assert_eq!(system.dimension(), 4);
/// assert_eq!(system.angles(&[0.8, 0.3]), [0.8, 0.3, 0.3]);
///
/// // A state of another length has no rates.
/// let mut rates = [0.0; 3];
/// system.rates(0.0, &[0.8, 0.3, 0.0], &mut rates);
/// assert!(rates.iter().all(|rate| rate.is_nan()));
/// ```
#[derive(Clone, Debug)]
pub struct InPhaseOde<L> {
    system: L,
    coordinates: Vec<SectorCoordinate>,
}

impl<L: Ode<f64>> InPhaseOde<L> {
    /// Returns the system of angles followed by their rates, in the coordinates of the sector of
    /// the means. With states of another length, and a sector of another tree, all rates are NaN.
    pub fn new(system: L, in_phase: &Sector) -> Self {
        Self {
            system,
            coordinates: in_phase.coordinates().to_vec(),
        }
    }

    /// Returns the angles of all links at coordinates, or their rates likewise.
    pub fn angles(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut angles = vec![0.0; self.system.dimension() / 2];
        self.write_links(coordinates, &mut angles);
        angles
    }

    fn write_links(&self, coordinates: &[f64], links: &mut [f64]) {
        for (own, value) in self.coordinates.iter().zip(coordinates) {
            own.write(*value, links);
        }
    }

    /// Returns true if slices of these lengths are states, and the sector is one of the system's.
    fn fits(&self, lengths: [usize; 2]) -> bool {
        let links = self.system.dimension() / 2;
        let mut weights = self.coordinates.iter().flat_map(|own| own.weights());
        lengths == [2 * self.coordinates.len(); 2] && weights.all(|(link, _)| *link < links)
    }

    /// Writes a state, or a deviation, of all links.
    fn write_whole(&self, state: &[f64], whole: &mut [f64]) {
        let (angles, rates) = whole.split_at_mut(whole.len() / 2);
        let (own, own_rates) = state.split_at(self.coordinates.len());
        self.write_links(own, angles);
        self.write_links(own_rates, rates);
    }

    /// Writes what coordinates have of the rates of all links.
    fn write_own(&self, whole: &[f64], rates: &mut [f64]) {
        let (angles, velocities) = whole.split_at(whole.len() / 2);
        let both = self.coordinates.iter().map(|own| own.of(angles));
        let both = both.chain(self.coordinates.iter().map(|own| own.of(velocities)));
        for (rate, value) in rates.iter_mut().zip(both) {
            *rate = value;
        }
    }
}

impl<L: Ode<f64>> Ode<f64> for InPhaseOde<L> {
    fn dimension(&self) -> usize {
        2 * self.coordinates.len()
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
        if !self.fits([state.len(), rates.len()]) {
            rates.fill(f64::NAN);
            return;
        }
        let dimension = self.system.dimension();
        let (numbers, inner) = workspace.with_inner(2 * dimension);
        let (whole, whole_rates) = numbers.split_at_mut(dimension);
        self.write_whole(state, whole);
        self.system.rates_with(inner, time, whole, whole_rates);
        self.write_own(whole_rates, rates);
    }
}

impl<L: Linearised<f64>> Linearised<f64> for InPhaseOde<L> {
    fn linearised_rates(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        deviation: &[f64],
        rates: &mut [f64],
        deviation_rates: &mut [f64],
    ) {
        let lengths = [state, deviation].map(<[f64]>::len);
        if !(self.fits(lengths) && self.fits([rates.len(), deviation_rates.len()])) {
            rates.fill(f64::NAN);
            deviation_rates.fill(f64::NAN);
            return;
        }
        let dimension = self.system.dimension();
        let (numbers, inner) = workspace.with_inner(4 * dimension);
        let (given, found) = numbers.split_at_mut(2 * dimension);
        let (whole, whole_deviation) = given.split_at_mut(dimension);
        let (whole_rates, changes) = found.split_at_mut(dimension);
        self.write_whole(state, whole);
        self.write_whole(deviation, whole_deviation);
        let system = &self.system;
        system.linearised_rates(inner, time, whole, whole_deviation, whole_rates, changes);
        self.write_own(whole_rates, rates);
        self.write_own(changes, deviation_rates);
    }
}
