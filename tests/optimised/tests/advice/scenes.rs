//! The trees that advice is asked for, and where they are: by Taylor series in numbers
//! of twice the digits, which no advisor uses.

use branched_pendulum::branched_pendulum;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorOde;

/// The paper's apparatus.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, symmetric, taylor, positions, transfer(exact)),
)]
pub(crate) struct Paper;

/// The apparatus with children in phase, but for small differences.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(small),
)]
pub(crate) struct PaperSmall;

/// Seven rods.
#[branched_pendulum(
    gravity = 9.80665,
    rod: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    emit(energies, taylor),
)]
pub(crate) struct Rods;

/// Seven rods in phase.
#[branched_pendulum(
    gravity = 9.80665,
    rod: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    in_phase(all),
)]
pub(crate) struct InPhase;

/// States at all times.
pub(crate) fn states(
    ode: &impl TaylorOde<Double>,
    start: &State<f64>,
    times: &[f64],
) -> Vec<Vec<f64>> {
    let precise = |values: &[f64]| {
        values
            .iter()
            .map(|&v| Double::from_f64(v))
            .collect::<Vec<_>>()
    };
    let from = State::new(Double::from_f64(start.time), precise(&start.values));
    let method = Taylor::new(Options::with_tolerance(Double::from_f64(1e-25)));
    let states = method.sample_to_vec(ode, &from, &precise(times)).unwrap();
    let rounded = |state: State<Double>| state.values.iter().map(|value| value.high()).collect();
    states.into_iter().map(rounded).collect()
}
