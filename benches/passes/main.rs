//! Time saved by each optimisation pass of the compiler: measures the same scenes with and without
//! the pass, in one run. `run.sh` writes `variants.rs` and builds this program.
//!
//! Each time is divided by that of the program with all passes in the same turn, and the median of
//! these ratios is printed. `again` is a second copy of that
//! program: its distance from 1 is the effect of the placement of code.

mod variants;

use branched_pendulum::batch::Batch;
use branched_pendulum::Pendulum;
use branched_pendulum_timing::{Pass, Table, in_warm_turns};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

/// Approximate number of values in one pass; the values of all variants fit into the second-level
/// cache.
const NUMBERS: usize = 2048;

/// A scene compiled without one of the optimisation passes, or with all of them.
struct Variant {
    name: &'static str,
    /// Timed functions: accelerations of one state after the other, accelerations in a batch, and
    /// all other functions.
    passes: [Pass<'static>; 3],
}

fn count<const N: usize>() -> usize {
    (NUMBERS / N).next_multiple_of(16)
}

/// Returns random numbers between −`bound` and `bound`.
fn random<const N: usize>(seed: u64, bound: f64) -> Vec<[f64; N]> {
    let mut random = SplitMix64::seed_from_u64(seed);
    let mut next = || {
        let unit = (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64;
        bound * (unit - 1.0)
    };
    (0..count::<N>()).map(|_| std::array::from_fn(|_| next())).collect()
}

fn inputs<const N: usize>() -> [Vec<[f64; N]>; 2] {
    [random(1, std::f64::consts::PI), random(2, 9.0)]
}

fn one_by_one<const N: usize>(model: impl Pendulum<f64> + 'static) -> Pass<'static> {
    let [theta, omega] = inputs::<N>();
    let mut alpha = vec![[0.0; N]; theta.len()];
    Box::new(move || {
        let states = black_box(&theta).iter().zip(black_box(&omega));
        for ((theta, omega), alpha) in states.zip(black_box(&mut alpha)) {
            model.accelerations_into(0.0, theta, omega, alpha);
        }
    })
}

fn batch<const N: usize>(model: impl Pendulum<f64> + 'static) -> Pass<'static> {
    let columns = |rows: &[[f64; N]]| -> Vec<Vec<f64>> {
        (0..N).map(|link| rows.iter().map(|row| row[link]).collect()).collect()
    };
    let [theta, omega] = inputs::<N>().map(|rows| columns(&rows));
    let mut alpha = vec![vec![0.0; count::<N>()]; N];
    Box::new(move || {
        let (theta, omega) = (black_box(&theta), black_box(&omega));
        let done = Batch::new(&model).accelerations(0.0, theta, omega, black_box(&mut alpha));
        assert!(done.is_ok(), "columns of one length");
    })
}

fn others<const N: usize>(functions: impl Fn(&[f64; N], &[f64; N]) + 'static) -> Pass<'static> {
    let [first, second] = inputs::<N>();
    Box::new(move || {
        for (first, second) in black_box(&first).iter().zip(black_box(&second)) {
            functions(first, second);
        }
    })
}

/// Returns, for every function and variant, the median of its ratios to the first variant.
fn ratios(variants: &mut [Variant], turns: usize) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|kind| {
        let passes = variants.iter_mut().map(|variant| &mut variant.passes[kind]);
        let times = in_warm_turns(turns, &mut passes.collect::<Vec<_>>());
        times.iter().map(|own| own.ratio_to(&times[0])).collect()
    })
}

fn main() {
    let turns = std::env::args().nth(1).and_then(|turns| turns.parse().ok());
    let turns = turns.unwrap_or(400);
    for (scene, mut variants) in variants::scenes() {
        // Warms up the processor's clock.
        ratios(&mut variants, turns / 10 + 1);
        let found = ratios(&mut variants, turns);
        let table = Table::new(["without", "one state", "batch", "other functions"]);
        let table = variants.iter().enumerate().fold(table, |table, (index, variant)| {
            let cells = found.iter().map(|kind| format!("{:.2}", kind[index]));
            table.row([variant.name.to_owned()].into_iter().chain(cells))
        });
        println!("{scene}\n\n{table}");
    }
}
