//! `cargo bench -p branched-pendulum-trees --bench lineage`: time per link of the motion of sixteen
//! states in lanes, of lineages of 20 generations (210 links) and of full trees of eight (255
//! links). Both are timed alternately, and the shortest time of each counts.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

const STATES: usize = 16;
const STEPS: usize = 200;
const PASSES: usize = 15;

/// Evaluations of the accelerations in a step of `Rk4`.
const STAGES: usize = 4;

struct Case {
    name: &'static str,
    tree: PendulumTree,
    least: Duration,
}

impl Case {
    fn new(name: &'static str, rule: &str) -> Self {
        let youngest = rule.split([' ', ',']).next().expect("a number");
        let text = format!(
            "gravity = 9.80665,
            arm: generations(count = {rule}, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                mass_ratio = 0.5, length_ratio = 0.85),
            siblings(arm_{youngest}, friction = 1e-9)"
        );
        let tree = PendulumTree::parse(&text).expect("a tree");
        let least = Duration::MAX;
        Self { name, tree, least }
    }

    fn pass(&mut self) {
        let links = self.tree.links();
        let releases = (0..STATES).map(|state| {
            let angle = |link: usize| ((7 * link + 13 * state) % 64) as f64 / 64.0 - 0.5;
            let angles: Vec<f64> = (0..links).map(angle).collect();
            (AbsoluteAngles(&self.tree), State::at_rest(0.0, &angles))
        });
        let releases: Vec<_> = releases.collect();
        let step = 1e-6;
        let method = Rk4::new(step);
        let alone = Ensemble::new().threads(NonZeroUsize::MIN);
        let end = [step * STEPS as f64];
        let clock = Instant::now();
        black_box(alone.sample_models_in_lanes(&method, &releases, &end));
        self.least = self.least.min(clock.elapsed());
    }

    /// Time of an evaluation of one state, ns a link.
    fn nanoseconds(&self) -> f64 {
        let evaluations = (STATES * STEPS * STAGES * self.tree.links()) as f64;
        1e9 * self.least.as_secs_f64() / evaluations
    }
}

fn main() {
    let mut cases = [
        Case::new("lineage of 20 generations", "20, open = 1"),
        Case::new("full tree of 8 generations", "8"),
    ];
    for _ in 0..PASSES {
        cases.iter_mut().for_each(Case::pass);
    }
    for own in &cases {
        let links = own.tree.links();
        println!(
            "{}: {links} links, {:.2} ns a link",
            own.name,
            own.nanoseconds()
        );
    }
    let [lineage, full] = cases.each_ref().map(Case::nanoseconds);
    println!("lineage over full tree: {:.2}", lineage / full);
}
