//! `cargo bench -p branched-pendulum-trees --bench normal_form`: cost of normal forms of the paper's
//! pendulum, and of predictions over a plane of releases on one core. The shortest of several runs
//! counts.

use std::hint::black_box;
use std::time::{Duration, Instant};

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::{PendulumTree, TreeNormalForm};

const PAPER: &str = "gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ]";

/// Runs of each measurement.
const RUNS: usize = 7;

/// Largest angles of the parent and of the children, in steps of 0.5°: those of the map in
/// `docs/growth.md`, with the parent from 0 on.
const LARGEST: [i32; 2] = [180, 270];

fn shortest<T>(mut run: impl FnMut() -> T) -> (Duration, T) {
    let timed = || {
        let clock = Instant::now();
        let result = black_box(run());
        (clock.elapsed(), result)
    };
    let all = std::iter::repeat_with(timed).take(RUNS);
    all.min_by_key(|(time, _)| *time).expect("there are runs")
}

fn derived(tree: &PendulumTree, degree: u32) -> TreeNormalForm {
    let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).expect("copies");
    let options = NormalFormOptions {
        degree,
        ..NormalFormOptions::default()
    };
    tree.normal_form(&children, options).expect("a normal form")
}

fn main() {
    let tree = PendulumTree::parse(PAPER).expect("a tree");
    for degree in [4, 6, 8, 10] {
        let (time, _) = shortest(|| derived(&tree, degree));
        println!("degree {degree}: {:.2} ms", 1e3 * time.as_secs_f64());
    }
    let form = derived(&tree, 8);
    let angle = |k: i32| (0.5 * f64::from(k)).to_radians();
    let [parents, children] = [0..=LARGEST[0], -LARGEST[1]..=LARGEST[1]];
    let (time, [growing, refused]) = shortest(|| {
        let mut counts = [0; 2];
        for (i, j) in parents
            .clone()
            .flat_map(|i| children.clone().map(move |j| (i, j)))
        {
            let start = State::at_rest(0.0, &[angle(i), angle(j), angle(j)]);
            match form.predict(&start) {
                Ok(own) => counts[0] += usize::from(own.growth_rate.value > 0.0),
                Err(_) => counts[1] += 1,
            }
        }
        counts
    });
    let count = (parents.count() * children.count()) as f64;
    println!(
        "{count} releases: {:.3} s, {:.2} µs each; {growing} grow, {refused} are refused",
        time.as_secs_f64(),
        1e6 * time.as_secs_f64() / count
    );
}
