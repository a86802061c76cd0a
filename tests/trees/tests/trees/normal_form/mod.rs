//! Normal forms against simulated motions and known expansions.

mod blades;
mod expansions;
mod frequencies;
mod internal;
mod limits;
mod random;

use branched_pendulum::analysis::normal_form::{Agreement, NormalFormOptions, Tongue, Tongues};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeNormalForm};

const PAPER: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ]";

const SIX: &str = "gravity = 9.80665,
    parent(mass = 0.47851, com = 0.0783778, inertia = 7.33498e-3, joint = 0.279147) [
        child(mass = 0.151115, com = 0.0550991, inertia = 1.95611e-4) * 2
    ]";

/// Growth rate from which on a place counts as unstable, 1/s.
const LEAST: f64 = 0.02;

fn children() -> Copies {
    Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap()
}

fn of(text: &str, degree: u32) -> TreeNormalForm {
    let tree = PendulumTree::parse(text).unwrap();
    let options = NormalFormOptions {
        degree,
        ..NormalFormOptions::default()
    };
    tree.normal_form(&children(), options).unwrap()
}

/// Options that refuse no prediction, however far the two degrees are apart.
fn unchecked(degree: u32) -> NormalFormOptions {
    NormalFormOptions {
        degree,
        agreement: Agreement { frequency: 1.0 },
        ..NormalFormOptions::default()
    }
}

fn release(parent: f64, child: f64) -> State<f64> {
    State::at_rest(0.0, &[parent, child, child].map(f64::to_radians))
}

fn grid(from: f64, to: f64) -> Vec<f64> {
    let steps = ((to - from) / 0.5).round() as usize;
    (0..=steps).map(|k| from + 0.5 * k as f64).collect()
}

fn tongues(form: &TreeNormalForm, parent: f64, children: &[f64]) -> Tongues {
    Tongues::along(children, LEAST, |child| {
        form.predict(&release(parent, child))
    })
}

/// First and last point of the grid inside a tongue.
fn snapped(tongue: &Tongue) -> [f64; 2] {
    let [from, to] = tongue.edges.map(|edge| edge.value);
    [(2.0 * from).ceil() / 2.0, (2.0 * to).floor() / 2.0]
}
