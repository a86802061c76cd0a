//! Systems of an in-phase motion with small differences between copies.

use super::run::DifferenceRanges;
use crate::system::{Ode, State, Transverse, TransverseOde};

/// A system of equations for copies in phase and small differences between them: the state is the
/// angles (rad), the differences, the angular velocities (rad/s) and the rates of the differences.
pub trait TransverseSystem: Ode<f64> {
    /// Returns the number of differences.
    fn differences(&self) -> usize;
}

impl<P: Transverse<f64>> TransverseSystem for TransverseOde<P> {
    fn differences(&self) -> usize {
        TransverseOde::differences(self)
    }
}

impl<O: TransverseSystem> TransverseSystem for &O {
    fn differences(&self) -> usize {
        (**self).differences()
    }
}

/// Returns the frequency (Hz) of small differences about the equilibrium with all angles zero, exact
/// for one link. For several links it is a typical frequency: its square is the mean restoring
/// acceleration per angle if all differences are displaced equally. Where that mean does not restore
/// them, as with light links far from the branching, it is the mean square of all frequencies.
///
/// NaN if the mean square is negative, so that differences do not oscillate. Costs one evaluation of
/// the rates, or one for each difference in the second case.
pub fn frequency_at_rest(system: &impl TransverseSystem) -> f64 {
    let own = system.differences();
    let equally = -restoring(system, &vec![1.0; own]).iter().sum::<f64>();
    let sum = match equally > 0.0 {
        true => equally,
        // The trace of the matrix of accelerations, which is the sum of all squares.
        false => (0..own)
            .map(|link| {
                let mut alone = vec![0.0; own];
                alone[link] = 1.0;
                -restoring(system, &alone)[link]
            })
            .sum(),
    };
    (sum / own as f64).sqrt() / std::f64::consts::TAU
}

/// Returns the accelerations (rad/s²) of the differences at rest, displaced by `differences` (rad)
/// from the equilibrium with all angles zero.
fn restoring(system: &impl TransverseSystem, differences: &[f64]) -> Vec<f64> {
    let all = system.dimension() / 2;
    let mut angles = vec![0.0; all - differences.len()];
    angles.extend_from_slice(differences);
    let state = State::at_rest(0.0, &angles);
    let mut rates = vec![0.0; state.values.len()];
    system.rates(0.0, &state.values, &mut rates);
    rates[difference_ranges(system).rates].to_vec()
}

/// Returns the index ranges of the differences and their rates in a state.
pub(super) fn difference_ranges(system: &impl TransverseSystem) -> DifferenceRanges {
    let all = system.dimension() / 2;
    let motion = all - system.differences();
    DifferenceRanges {
        angles: motion..all,
        rates: all + motion..2 * all,
    }
}
