//! Time per link of the motion of sixteen states in lanes, of lineages of 20 generations (210
//! links) and of full trees of eight (255 links).

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum_timing::{Contender, compared};
use branched_pendulum_trees::PendulumTree;

const STATES: usize = 16;
const STEPS: usize = 200;
const ROUNDS: usize = 15;

/// Evaluations of the accelerations in a step of `Rk4`.
const STAGES: usize = 4;

fn contender(name: &str, generations: usize, open: &str) -> Contender<'static> {
    let text = format!(
        "gravity = 9.80665,
        arm: generations(count = {generations}, branching = 2, {open} shape = rod, mass = 0.12,
            length = 0.3, mass_ratio = 0.5, length_ratio = 0.85),
        siblings(arm_{generations}, friction = 1e-9)"
    );
    let tree = PendulumTree::parse(&text).expect("a tree");
    let links = tree.links();
    let release = |state: usize| {
        let angle = |link: usize| ((7 * link + 13 * state) % 64) as f64 / 64.0 - 0.5;
        let angles: Vec<f64> = (0..links).map(angle).collect();
        (AbsoluteAngles(tree.clone()), State::at_rest(0.0, &angles))
    };
    let releases: Vec<_> = (0..STATES).map(release).collect();
    let step = 1e-6;
    let (method, end) = (Rk4::new(step), [step * STEPS as f64]);
    let alone = Ensemble::new().threads(NonZeroUsize::MIN);
    Contender::new(name, (STATES * STEPS * STAGES * links) as f64, move || {
        black_box(alone.sample_models_in_lanes(&method, &releases, &end));
    })
}

pub(crate) fn run() {
    let contenders = vec![
        contender("full tree of 8 generations", 8, ""),
        contender("lineage of 20 generations", 20, "open = 1,"),
    ];
    println!("Accelerations of a link\n{}", compared(ROUNDS, contenders));
}
