//! Frequencies against those of motions.

use std::f64::consts::TAU;

use branched_pendulum::analysis::growth::turns_a_second;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeNormalForm};

use super::{PAPER, children, of, release, unchecked};

/// Frequencies of the two modes in phase of a simulated motion, Hz.
fn simulated(tree: &PendulumTree, form: &TreeNormalForm, start: &State<f64>) -> [f64; 2] {
    let modes = tree.modes(&[0.0; 3]).unwrap();
    let mass = tree.mass_matrix(&[0.0; 3]);
    let linear = form.form().linear_frequencies_hz();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let times: Vec<f64> = (0..=40_000).map(|k| 0.02 * f64::from(k)).collect();
    let states = method
        .sample_to_vec(&AbsoluteAngles(tree), start, &times)
        .unwrap();
    [0, 1].map(|mode| {
        let frequency = linear[mode];
        let place = modes
            .frequencies_hz
            .iter()
            .position(|own| (own - frequency).abs() < 1e-9);
        let shape = &modes.shapes[place.unwrap()];
        let part = |values: &[f64]| -> f64 {
            let rows = mass.iter().zip(shape);
            rows.map(|(row, own)| own * row.iter().zip(values).map(|(a, b)| a * b).sum::<f64>())
                .sum()
        };
        let points = states.iter().map(|state| {
            (
                part(state.positions()),
                part(state.velocities()) / (TAU * frequency),
            )
        });
        turns_a_second(&times, points)
    })
}

/// Half the amplitude leaves an error of at most 2^(1 − degree).
#[test]
fn frequencies_converge_by_their_order() {
    let tree = PendulumTree::parse(PAPER).unwrap();
    let starts = [release(16.0, 0.0), release(8.0, 0.0)];
    let exact = starts
        .each_ref()
        .map(|start| simulated(&tree, &of(PAPER, 4), start));
    for degree in [4, 6, 8] {
        let form = tree.normal_form(&children(), unchecked(degree)).unwrap();
        let errors = [0, 1].map(|place| {
            let predicted = form.predict(&starts[place]).unwrap().frequencies_hz;
            [0, 1].map(|mode| (predicted[mode].value - exact[place][mode]).abs())
        });
        for mode in [0, 1] {
            let ratio = errors[0][mode] / errors[1][mode];
            assert!(
                ratio > 2_f64.powi(degree as i32 - 1),
                "{degree}, {mode}: {ratio} {errors:?}"
            );
        }
    }
}

/// Actions are constant along a motion, up to the first degree left out.
#[test]
fn actions_of_later_states_are_those_of_the_release() {
    let tree = PendulumTree::parse(PAPER).unwrap();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let times = [0.0, 0.13, 0.3, 0.61];
    let form = of(PAPER, 8);
    let change = |start: &State<f64>| {
        let states = method
            .sample_to_vec(&AbsoluteAngles(&tree), start, &times)
            .unwrap();
        let all: Vec<_> = states.iter().map(|state| form.actions(state)).collect();
        let parts = all.iter().flat_map(|own| {
            let both = own.iter().zip(&all[0]);
            both.map(|(one, first)| (one.value / first.value - 1.0).abs())
        });
        parts.fold(0.0, f64::max)
    };
    let [large, small] =
        [(12.0, 9.0), (6.0, 4.5)].map(|(parent, child)| change(&release(parent, child)));
    assert!(
        large < 1e-4 && small < large / 2_f64.powi(7),
        "{large:e} {small:e}"
    );
}
