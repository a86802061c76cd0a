//! Motions in phase with small differences beside them, as systems.

use super::run::DifferenceRanges;
use crate::system::{Ode, State, Transverse, TransverseOde};

/// A motion of copies in phase and small differences beside it, as one system: the state is the
/// angles, the differences, the angular velocities and the rates of the differences.
pub trait TransverseSystem: Ode<f64> {
    /// Returns the number of differences.
    fn differences(&self) -> usize;
}

impl<P: Transverse<f64>> TransverseSystem for TransverseOde<P> {
    fn differences(&self) -> usize {
        self.sector().links
    }
}

impl<O: TransverseSystem> TransverseSystem for &O {
    fn differences(&self) -> usize {
        (**self).differences()
    }
}

/// Returns the frequency of small differences beside the tree at rest with all angles zero, in
/// hertz: of all of them turned as one, by Rayleigh's quotient, so that it is exact for one link.
/// NaN where they do not oscillate.
pub fn frequency_at_rest(system: &impl TransverseSystem) -> f64 {
    let all = system.dimension() / 2;
    let own = system.differences();
    let mut angles = vec![0.0; all - own];
    angles.resize(all, 1.0);
    let state = State::at_rest(0.0, &angles);
    let mut rates = vec![0.0; state.values.len()];
    system.rates(0.0, &state.values, &mut rates);
    let sum: f64 = rates[places(system).rates].iter().sum();
    (-sum / own as f64).sqrt() / std::f64::consts::TAU
}

/// Returns where differences stand in a state.
pub(super) fn places(system: &impl TransverseSystem) -> DifferenceRanges {
    let all = system.dimension() / 2;
    let motion = all - system.differences();
    DifferenceRanges {
        angles: motion..all,
        rates: all + motion..2 * all,
    }
}
