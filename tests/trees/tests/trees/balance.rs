//! Energies along motions: springs conserve the energy in every form of the equations, and the work
//! of friction is the integral of its power.

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum::system::CanonicalVariables;
use branched_pendulum_trees::PendulumTree;

use super::plain::Numbers;

/// How long motions are followed (s): some ten swings.
pub(super) const END: f64 = 3.0;

/// Largest difference of two energies that count as equal (J).
const SAME: f64 = 1e-10;

pub(super) fn method() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-14))
}

/// A state with angles up to `angle` (rad) and velocities up to 4 rad/s.
pub(super) fn state(tree: &PendulumTree, seed: u64, angle: f64) -> State<f64> {
    let links = tree.links();
    let mut numbers = Numbers(seed);
    let values = (0..2 * links)
        .map(|place| numbers.between(-1.0, 1.0) * if place < links { angle } else { 4.0 });
    State::new(0.0, values.collect::<Vec<f64>>())
}

fn energy(tree: &PendulumTree, state: &State<f64>) -> f64 {
    tree.energy_of(state.positions(), state.velocities())
}

/// Asserts that two states have the same energy.
pub(super) fn assert_same_energy(tree: &PendulumTree, one: &State<f64>, other: &State<f64>) {
    let change = energy(tree, other) - energy(tree, one);
    assert!(change.abs() < SAME, "{change:e}");
}

/// Asserts that motions keep the energy: by the absolute angles, by the canonical variables, and in
/// lanes.
pub(super) fn assert_energy_is_kept(tree: &PendulumTree, start: &State<f64>) {
    let end = method().run(&AbsoluteAngles(tree), start, END);
    assert_same_energy(tree, start, &end.unwrap().state);

    let links = tree.links();
    let momenta = tree.momenta(start.positions(), start.velocities());
    let canonical = State::new(0.0, [start.positions(), &momenta].concat());
    let end = method().run(&CanonicalVariables(tree), &canonical, END);
    let end = end.unwrap().state;
    let (theta, momenta) = end.values.split_at(links);
    let [mut omega, mut rates] = [(); 2].map(|()| vec![0.0; links]);
    tree.canonical_rates_into(0.0, theta, momenta, &mut omega, &mut rates);
    assert_same_energy(tree, start, &State::new(0.0, [theta, &omega].concat()));

    let lanes = vec![(AbsoluteAngles(tree), start.clone()); 5];
    for end in Ensemble::new().integrate_models_in_lanes(&method(), &lanes, END) {
        assert_same_energy(tree, start, &end.unwrap().state);
    }
}

/// A tree whose state has the work of friction (J) as an additional component.
struct WithLoss<'a>(&'a PendulumTree);

impl Ode<f64> for WithLoss<'_> {
    fn dimension(&self) -> usize {
        2 * self.0.links() + 2
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        let links = self.0.links();
        let (theta, omega) = state[..2 * links].split_at(links);
        rates[..links].copy_from_slice(omega);
        rates[links..2 * links].copy_from_slice(&self.0.accelerations(time, theta, omega));
        rates[2 * links..].copy_from_slice(&[self.0.friction_power(theta, omega), 0.0]);
    }
}

/// Asserts that friction dissipates more than `least` (J) along the motion from `start`, and that the
/// change of the energy is the integral of the power of friction. Returns the state at the end.
pub(super) fn assert_friction_takes(
    tree: &PendulumTree,
    start: &State<f64>,
    least: f64,
) -> State<f64> {
    let with_loss = State::new(0.0, [&start.values[..], &[0.0; 2]].concat());
    let end = method().run(&WithLoss(tree), &with_loss, END);
    let end = end.unwrap().state.values;
    let (moved, work) = end.split_at(start.values.len());
    let moved = State::new(END, moved.to_vec());
    let balance = energy(tree, &moved) - energy(tree, start) - work[0];
    assert!(
        work[0] < -least && balance.abs() < SAME,
        "{} {balance:e}",
        work[0]
    );
    moved
}
