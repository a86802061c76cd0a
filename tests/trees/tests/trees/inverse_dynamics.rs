//! Torques of a given motion of a described tree.

use branched_pendulum::prelude::*;
use branched_pendulum::system::{At, TotalEnergy, functions};
use branched_pendulum_trees::PendulumTree;

use super::mechanics::{BENT, OMEGA, THETA, bent, near};

const ALPHA: [f64; 5] = [7.0, -40.0, 3.0, 20.0, -11.0];
const TIME: f64 = 0.7;

fn torques(tree: &PendulumTree) -> [f64; 5] {
    let mut torques = [0.0; 5];
    tree.inverse_dynamics_into(TIME, &THETA, &OMEGA, &ALPHA, &mut torques);
    torques
}

#[test]
fn accelerations_under_the_torques_are_the_given_ones() {
    let (tree, mut back) = (bent(), [0.0; 5]);
    tree.accelerations_under_into(TIME, &THETA, &OMEGA, &torques(&tree), &mut back);
    for (back, alpha) in back.into_iter().zip(ALPHA) {
        near(back, alpha, 1e-12);
    }
}

/// Q = M (α − α₀) with the accelerations α₀ of free motion.
#[test]
fn torques_are_the_mass_matrix_times_what_is_not_free() {
    let tree = bent();
    let free = tree.accelerations(TIME, &THETA, &OMEGA);
    let torques = torques(&tree);
    let size = torques
        .iter()
        .fold(0.0_f64, |size, torque| size.max(torque.abs()));
    for (row, torque) in tree.mass_matrix(&THETA).iter().zip(torques) {
        let terms = row.iter().zip(ALPHA.iter().zip(&free));
        let expected: f64 = terms
            .map(|(mass, (alpha, free))| mass * (alpha - free))
            .sum();
        assert!(
            (torque - expected).abs() < 1e-13 * size,
            "{torque} {expected}"
        );
    }
}

/// dE/dt is the power of the torques, of friction and of the drive.
#[test]
fn the_balance_of_energy_holds() {
    let tree = bent();
    let mut slopes = [0.0; 10];
    let state: Vec<f64> = THETA.into_iter().chain(OMEGA).collect();
    let _: f64 = TotalEnergy::new(&tree).evaluate(&state, &mut slopes);
    let rates = OMEGA.iter().chain(&ALPHA);
    let rate: f64 = slopes
        .iter()
        .zip(rates)
        .map(|(slope, rate)| slope * rate)
        .sum();
    let power = tree.outside_power(&OMEGA, &torques(&tree))
        + tree.friction_power(&THETA, &OMEGA)
        + tree.drive_power(TIME, &THETA, &OMEGA);
    near(rate, power, 1e-12);
}

/// The request may be written or not; links that are held change nothing.
#[test]
fn the_request_is_known() {
    for more in ["emit(inverse_dynamics)", "prescribed(bough)"] {
        let description =
            branched_pendulum_trees::TreeDescription::parse(&format!("{BENT}, {more}"));
        let tree = description.unwrap().tree(&[("m", 0.07)]).unwrap();
        assert_eq!(torques(&tree), torques(&bent()));
    }
}

/// A tree of one link that a torque drives: Q = m L²/3 α + m g L/2 sin θ − τ.
#[test]
fn a_single_link_moves_against_its_drive() {
    let text = "gravity = 9.81, rod: rod(mass = 0.3, length = 0.4), drive(torque = 0.1)";
    let tree = PendulumTree::parse(text).unwrap();
    let mut torque = [0.0];
    tree.inverse_dynamics_into(0.0, &[0.5], &[1.0], &[2.0], &mut torque);
    let (inertia, weight) = (0.3 * 0.16 / 3.0, 0.3 * 9.81 * 0.2);
    near(
        torque[0],
        inertia * 2.0 + weight * 0.5_f64.sin() - 0.1,
        1e-14,
    );
}

/// States in a batch have the bits of single states.
#[test]
fn a_batch_has_the_bits_of_single_states() {
    const STATES: usize = 13;
    let tree = bent();
    let columns = |values: [f64; 5]| -> Vec<Vec<f64>> {
        let column = |value: f64| {
            (0..STATES)
                .map(|i| value * (1.0 + 0.1 * i as f64))
                .collect()
        };
        values.into_iter().map(column).collect()
    };
    let given = [THETA, OMEGA, ALPHA].map(columns);
    let slices: [&[Vec<f64>]; 3] = given.each_ref().map(Vec::as_slice);
    let mut torques = vec![vec![0.0; STATES]; 5];
    Batch::new(&tree)
        .compute(
            functions::InverseDynamics,
            At::time(TIME),
            slices,
            [&mut torques[..]],
        )
        .unwrap();
    for state in 0..STATES {
        let [theta, omega, alpha]: [Vec<f64>; 3] = given
            .each_ref()
            .map(|argument| argument.iter().map(|slice| slice[state]).collect());
        let mut alone = [0.0; 5];
        tree.inverse_dynamics_into(TIME, &theta, &omega, &alpha, &mut alone);
        let in_batch: Vec<f64> = torques.iter().map(|slice| slice[state]).collect();
        assert_eq!(in_batch, alone);
    }
}
