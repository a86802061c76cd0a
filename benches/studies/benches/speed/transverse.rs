//! Growth rates of small differences between closed copies of a lineage of eight generations, in
//! the full tree of 255 links.
//!
//! Each branching below a closed link forms its own sector: to first order its difference moves
//! independently of all others. The lineage moves under a motor without gravity, and next to it the
//! full tree with a small difference in 21 branchings, which is scaled down again and again. The mean
//! of d ln|δ|/dt is printed for each, with the paces u/ℓ of the scales, u = √(2 E/M).

use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

const GENERATIONS: usize = 8;

/// Times of a start, s: until the motion is steady, and while the growth is measured.
const SETTLING: f64 = 60.0;
const DURATION: f64 = 60.0;

/// Length of a step, s, and steps between two reductions of the differences.
const STEP: f64 = 1.0 / 2400.0;
const STRIDE: u32 = 12;

const STARTS: u32 = 6;

/// Typical rate, by which velocities are divided in the size of a difference, 1/s. The mean growth
/// does not depend on it.
const RATE: f64 = 30.0;

/// Size to which differences are scaled down, rad.
const SIZE: f64 = 1e-7;

/// Rods by rule without gravity, under a motor, with dampers between the youngest ones alone.
fn tree(open: &str) -> PendulumTree {
    let text = format!(
        "gravity = 0,
        arm: generations(count = {GENERATIONS}, branching = 2, {open} shape = rod, mass = 0.12,
            length = 0.3, mass_ratio = 0.5, length_ratio = 0.85),
        siblings(arm_{GENERATIONS}, friction = 4e-5),
        drive(torque = 0.5 * cos(3.7699111843 * t))"
    );
    PendulumTree::parse(&text).expect("a tree")
}

/// A branching of generation `generation` below the closed link of generation `closed`, as the links
/// of the full tree below its two children: one list for each generation from the children's on.
struct Branching {
    closed: usize,
    generation: usize,
    links: Vec<[Vec<usize>; 2]>,
}

impl Branching {
    fn all(full: &PendulumTree) -> Vec<Self> {
        let pairs = (1..GENERATIONS).flat_map(|q| (q + 1..GENERATIONS).map(move |g| (q, g)));
        let own = pairs.map(|(closed, generation)| {
            let above = format!(
                "{}_2{}",
                "_1".repeat(closed - 1),
                "_1".repeat(generation - 1 - closed)
            );
            let below = |child: &str, own: usize| -> Vec<usize> {
                let stem = format!("arm_{}{above}_{child}", own + 1);
                let names = full.names().iter().enumerate();
                let names = names.filter(|(_, name)| {
                    name.strip_prefix(&stem)
                        .is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
                });
                names.map(|(link, _)| link).collect()
            };
            Self {
                closed,
                generation,
                links: (generation..GENERATIONS)
                    .map(|own| ["1", "2"].map(|child| below(child, own)))
                    .collect(),
            }
        });
        own.collect()
    }

    /// Returns half the differences between the means below the two children, generation by
    /// generation.
    fn differences(&self, values: &[f64]) -> Vec<f64> {
        let mean = |links: &[usize]| {
            links.iter().map(|&link| values[link]).sum::<f64>() / links.len() as f64
        };
        let pairs = self.links.iter();
        pairs
            .map(|[first, second]| 0.5 * (mean(first) - mean(second)))
            .collect()
    }

    fn add(&self, values: &mut [f64], differences: &[f64]) {
        for ([first, second], own) in self.links.iter().zip(differences) {
            first.iter().for_each(|&link| values[link] += own);
            second.iter().for_each(|&link| values[link] -= own);
        }
    }
}

/// Index in the lineage of each link of the full tree.
fn representatives(full: &PendulumTree, lineage: &PendulumTree) -> Vec<usize> {
    let names = full.names().iter().map(|name| {
        let closed = name["arm_".len()..]
            .find("_2")
            .map(|first| &name[.."arm_".len() + first + 2]);
        let own = closed.unwrap_or(name);
        lineage
            .names()
            .iter()
            .position(|known| known == own)
            .expect("a copy")
    });
    names.collect()
}

/// Returns the size of a difference of angles (rad) and velocities (rad/s).
fn norm([angles, rates]: &[Vec<f64>; 2]) -> f64 {
    let rates = rates.iter().map(|own| (own / RATE).powi(2));
    (angles.iter().map(|own| own * own).sum::<f64>() + rates.sum::<f64>()).sqrt()
}

/// Follows one start. Returns the growth rate of each branching, and the mean energy of each scale.
fn follow(seed: u32, [full, lineage]: [&PendulumTree; 2]) -> [Vec<f64>; 2] {
    let (links, own) = (full.links(), lineage.links());
    let copies = representatives(full, lineage);
    let whole = |values: &[f64]| -> Vec<f64> { copies.iter().map(|&link| values[link]).collect() };
    let method = Rk4::new(STEP);
    let angle = |link: usize| 0.5 * (f64::from(seed) * 1.7 * (link + 1) as f64).sin();
    let start = State::at_rest(0.0, &(0..own).map(angle).collect::<Vec<f64>>());
    let moved = |tree: &PendulumTree, start: &State<f64>, time: f64| {
        let run = method.run(&AbsoluteAngles(tree), start, time);
        run.expect("the motion is regular").state
    };
    let mut state = moved(lineage, &start, SETTLING);
    let branchings = Branching::all(full);
    let first = branchings.iter().map(|own| {
        let generations = own.links.len();
        [vec![SIZE; generations], vec![0.0; generations]]
    });
    let mut differences: Vec<[Vec<f64>; 2]> = first.collect();
    let mut rates = vec![0.0; branchings.len()];
    let mut energies = vec![0.0; GENERATIONS];
    let interval = STEP * f64::from(STRIDE);
    let windows = (DURATION / interval) as usize;
    // A tenth of the time turns the differences into their direction of growth.
    let counted = windows - windows / 10;
    for window in 0..windows {
        let (theta, omega) = state.values.split_at(own);
        let (mut angles, mut velocities) = (whole(theta), whole(omega));
        for (own, [angle, rate]) in branchings.iter().zip(&differences) {
            own.add(&mut angles, angle);
            own.add(&mut velocities, rate);
        }
        let budget = lineage.budget_by_scale(state.time, [theta, omega, &[]]);
        let budget = budget.expect("a lineage has scales");
        for (scale, energy) in energies.iter_mut().enumerate() {
            *energy += budget.energy(scale) / windows as f64;
        }
        let start = State::new(state.time, [angles, velocities].concat());
        let end = state.time + interval;
        let all = moved(full, &start, end).values;
        state = moved(lineage, &state, end);
        let pairs = branchings.iter().zip(&mut differences);
        for ((own, difference), rate) in pairs.zip(&mut rates) {
            let found = [&all[..links], &all[links..]].map(|values| own.differences(values));
            let size = norm(&found);
            if window >= windows - counted {
                *rate += (size / norm(difference)).ln() / (counted as f64 * interval);
            }
            *difference = found.map(|own| own.iter().map(|own| SIZE / size * own).collect());
        }
    }
    [rates, energies]
}

pub(crate) fn run() {
    let [full, lineage] = ["", "open = 1,"].map(tree);
    let starts: Vec<[Vec<f64>; 2]> = (1..=STARTS)
        .map(|seed| follow(seed, [&full, &lineage]))
        .collect();
    let count = f64::from(STARTS);
    println!("| closed at | opens at | growth rate (1/s) | error bar |\n|---:|---:|---:|---:|");
    for (index, own) in Branching::all(&full).iter().enumerate() {
        let rates = || starts.iter().map(|[rates, _]| rates[index]);
        let mean = rates().sum::<f64>() / count;
        let square = rates().map(|rate| (rate - mean).powi(2)).sum::<f64>();
        let error = (square / (count * (count - 1.0))).sqrt();
        println!(
            "| {} | {} | {mean:.2} | {error:.2} |",
            own.closed, own.generation
        );
    }
    println!("\n| scale | energy (J) | u/ℓ (1/s) |\n|---:|---:|---:|");
    for scale in 1..GENERATIONS {
        let energy = starts.iter().map(|[_, all]| all[scale]).sum::<f64>() / count;
        let mass = 0.24 * 0.5_f64.powi(scale as i32) * (GENERATIONS - scale) as f64;
        let length = 0.3 * 0.85_f64.powi(scale as i32);
        let pace = (2.0 * energy / mass).sqrt() / length;
        println!("| {scale} | {energy:.4e} | {pace:.2} |");
    }
}
