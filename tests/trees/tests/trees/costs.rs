//! Cost of one state, by number of links and form of the equations.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum_trees::PendulumTree;

fn binary(generations: usize, more: &str) -> String {
    format!(
        "gravity = 9.81, code = unrolled, tree: generations(count = {generations}, branching = 2,
            shape = rod, mass = 0.2, length = 0.3, mass_ratio = 0.5, length_ratio = 0.8{more})"
    )
}

/// `cargo test --release -p branched-pendulum-trees-tests -- --ignored --nocapture costs`
#[test]
#[ignore = "prints times"]
fn costs_of_one_state() {
    for more in ["", ", friction = 1e-3"] {
        for generations in 1..=6 {
            let tree = PendulumTree::parse(&binary(generations, more)).unwrap();
            let n = tree.links();
            let theta: Vec<f64> = (0..n).map(|i| 0.3 + 0.1 * i as f64).collect();
            let mut alpha = vec![0.0; n];
            let mut workspace = Workspace::new();
            let calls = 40_000 / n;
            let least = (0..100).map(|_| {
                let start = Instant::now();
                for _ in 0..calls {
                    let theta = black_box(&theta);
                    tree.accelerations_with(&mut workspace, 0.0, theta, theta, &mut alpha);
                    black_box(&mut alpha);
                }
                start.elapsed().as_nanos() as f64 / calls as f64
            });
            let least = least.fold(f64::INFINITY, f64::min);
            println!(
                "{n} links{more}: {least:.0} ns, {:.1} a link",
                least / n as f64
            );
        }
    }
}
