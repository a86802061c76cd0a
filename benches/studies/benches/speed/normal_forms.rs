//! Cost of normal forms of the paper's pendulum, and of predictions over a plane of releases on one
//! core.

use std::hint::black_box;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_timing::{Contender, compared};
use branched_pendulum_trees::{PendulumTree, TreeNormalForm};

const PAPER: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ]";

const ROUNDS: usize = 7;

/// Largest angles of the parent and of the children, in steps of 0.5°: those of the map in
/// `docs/growth.md`, with the parent from 0 on.
const LARGEST: [i32; 2] = [180, 270];

fn derived(tree: &PendulumTree, degree: u32) -> TreeNormalForm {
    let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).expect("copies");
    let options = NormalFormOptions {
        degree,
        ..NormalFormOptions::default()
    };
    tree.normal_form(&children, options).expect("a normal form")
}

pub(crate) fn run() {
    let tree = &PendulumTree::parse(PAPER).expect("a tree");
    let degree = |degree: u32| {
        Contender::new(format!("degree {degree}"), 1.0, move || {
            black_box(derived(tree, degree));
        })
    };
    let degrees = [4, 6, 8, 10].map(degree).into();
    println!("A normal form\n{}", compared(ROUNDS, degrees));
    let form = derived(tree, 8);
    let angle = |k: i32| (0.5 * f64::from(k)).to_radians();
    let parents = 0..=LARGEST[0];
    let releases = parents.flat_map(|i| {
        let children = -LARGEST[1]..=LARGEST[1];
        children.map(move |j| State::at_rest(0.0, &[angle(i), angle(j), angle(j)]))
    });
    let releases: Vec<State<f64>> = releases.collect();
    let predictions = Contender::new("degree 8", releases.len() as f64, || {
        for release in &releases {
            let _ = black_box(form.predict(release));
        }
    });
    println!(
        "A prediction, of {}\n{}",
        releases.len(),
        compared(ROUNDS, vec![predictions])
    );
}
