//! Lyapunov exponents of random trees with copies, in phase and out of it, against the whole
//! spectrum, against those by name, and against the determinant of the mass matrix.

use std::f64::consts::PI;

use branched_pendulum::analysis::variational::{Copies, Lyapunov, LyapunovSpectrum, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::PendulumTree;

/// A tree with copies, and links that are copies of each other.
struct Copied {
    text: String,
    tree: PendulumTree,
    copies: Copies,
    /// A letter for each link, the same in all copies.
    letters: Vec<char>,
}

impl Copied {
    /// A root that carries two or three copies, with or without links that hang from these.
    fn random(random: &mut Random) -> Self {
        let mut rod = || {
            let (mass, length) = (random.between(0.05, 0.5), random.between(0.1, 0.5));
            format!("rod(mass = {mass:.4}, length = {length:.4})")
        };
        let [a, b, c, d] = [rod(), rod(), rod(), rod()];
        let shapes = [
            format!("a: {a} [b: {b} * 2]"),
            format!("a: {a} [b: {b} * 3]"),
            format!("a: {a} [b: {b} * 2, c: {c}]"),
            format!("a: {a} [b: {b} [c: {c}] * 2]"),
            format!("a: {a} [b: {b} [c: {c} * 2]]"),
            format!("a: {a} [b: {b} * 2, c: {c} [d: {d}]]"),
        ];
        let text = format!("gravity = 9.81, {}", random.pick(&shapes));
        let tree = PendulumTree::parse(&text).expect(&text);
        let parents: Vec<Option<usize>> = (0..tree.links())
            .map(|link| tree.properties_of(link).expect("it is there").parent)
            .collect();
        let letters: Vec<char> = tree
            .names()
            .iter()
            .filter_map(|name| name.chars().next())
            .collect();
        let mut alike: Vec<Vec<usize>> = Vec::new();
        for link in 0..tree.links() {
            let same = |own: &&mut Vec<usize>| {
                parents[own[0]] == parents[link] && letters[own[0]] == letters[link]
            };
            match alike.iter_mut().find(same) {
                Some(own) => own.push(link),
                None => alike.push(vec![link]),
            }
        }
        alike.retain(|own| own.len() > 1);
        let alike: Vec<&[usize]> = alike.iter().map(Vec::as_slice).collect();
        let copies = Copies::of_links(&parents, &alike).expect(&text);
        Self {
            text,
            tree,
            copies,
            letters,
        }
    }

    /// At rest, copies at the same angle.
    fn in_phase(&self, random: &mut Random) -> State<f64> {
        let angles = random.around_zero(4, 0.7 * PI);
        let angle = |letter: &char| angles[(*letter as usize - 'a' as usize) % 4];
        State::at_rest(0.0, &self.letters.iter().map(angle).collect::<Vec<_>>())
    }

    fn anywhere(&self, random: &mut Random) -> State<f64> {
        State::at_rest(0.0, &random.around_zero(self.tree.links(), 0.7 * PI))
    }
}

fn method() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-9))
}

/// Whether two largest exponents are one within their error bars, and within what deviations
/// leave in the mean that grow in proportion to the time, as those of regular motions do.
fn agree(lyapunov: &Lyapunov, one: &LyapunovSpectrum, other: &LyapunovSpectrum) -> bool {
    let bars = one.standard_errors[0].hypot(other.standard_errors[0]);
    let intervals = f64::from(lyapunov.intervals);
    let linear = intervals.ln() / (intervals * lyapunov.interval);
    (one.exponents[0] - other.exponents[0]).abs() <= 3.0 * bars + linear
}

/// Looks at so many trees over so many intervals.
fn largest_of(trees: u64, intervals: u32) {
    let lyapunov = |count| Lyapunov {
        count,
        interval: 0.25,
        settling: intervals / 4,
        intervals,
    };
    let (mut parting, mut chaotic) = (0, 0);
    for seed in 0..trees {
        let mut random = Random::new(seed);
        let copied = Copied::random(&mut random);
        let (text, copies) = (&copied.text, &copied.copies);
        let system = linearised(AbsoluteAngles(copied.tree.clone()));
        let dimension = 2 * copied.tree.links();
        if seed % 10 == 9 {
            println!("{seed} trees: {chaotic} chaotic motions, {parting} of copies that part");
        }
        let starts = [copied.in_phase(&mut random), copied.anywhere(&mut random)];
        for (start, is_in_phase) in starts.iter().zip([true, false]) {
            let [one, all] = [1, dimension].map(|count| {
                let found = lyapunov(count).spectrum(&method(), &system, start);
                found.unwrap_or_else(|error| panic!("{text}: {error}"))
            });
            assert_eq!(one.end, all.end, "{text}");
            assert!(
                agree(&lyapunov(1), &one, &all),
                "{seed} {text} {start:?}: {one:?} {all:?}"
            );
            chaotic += u32::from(one.exponents[0] > 0.5);
            if !is_in_phase {
                continue;
            }
            let within = lyapunov(1).within(copies, &method(), &system, start);
            let transverse = lyapunov(1).transverse(copies, &method(), &system, start);
            let [within, transverse] = [within, transverse]
                .map(|found| found.unwrap_or_else(|error| panic!("{text}: {error}")));
            let larger = match within.exponents[0] > transverse.exponents[0] {
                true => &within,
                false => &transverse,
            };
            assert!(
                agree(&lyapunov(1), larger, &all),
                "{seed} {text} {start:?}: {within:?} {transverse:?} {all:?}"
            );
            parting += u32::from(transverse.exponents[0] > 0.5);
        }
    }
    println!(
        "{trees} trees: {chaotic} of {} motions are chaotic, in {parting} copies part",
        2 * trees
    );
    assert!(chaotic > 0 && parting > 0, "{chaotic} {parting}");
}

#[test]
fn one_exponent_is_the_largest_of_all() {
    largest_of(3, 300);
}

/// Half an hour: `cargo test -p branched-pendulum-optimised-tests --test run_time -- --ignored
/// --nocapture`.
#[test]
#[ignore = "half an hour"]
fn one_exponent_is_the_largest_of_all_in_two_hundred_trees() {
    largest_of(200, 400);
}

/// Volumes of coordinates and momenta stay, so that those of angles and velocities go with
/// 1 / det M: the sum of all exponents, whatever the motion.
fn exponents_add_up(tree: &PendulumTree, start: &State<f64>, intervals: u32) {
    let links = tree.links();
    let lyapunov = Lyapunov {
        count: 2 * links,
        interval: 0.25,
        settling: 0,
        intervals,
    };
    let system = linearised(AbsoluteAngles(tree.clone()));
    let found = lyapunov.spectrum(&method(), &system, start).unwrap();
    let logarithm = |state: &State<f64>| {
        let rows = tree.mass_matrix(&state.values[..links]);
        logarithm_of_determinant(rows)
    };
    let sum: f64 = found.exponents.iter().sum();
    let duration = 0.25 * f64::from(intervals);
    let change = (logarithm(start) - logarithm(&found.end)) / duration;
    assert!((sum - change).abs() < 1e-6, "{sum} {change}");
}

#[test]
fn exponents_add_up_to_the_change_of_the_mass_matrix() {
    for seed in 0..12 {
        let mut random = Random::new(1000 + seed);
        let copied = Copied::random(&mut random);
        let start = copied.anywhere(&mut random);
        exponents_add_up(&copied.tree, &start, 12);
    }
}

/// A light link whirls at 110 rad/s: deviations grow ten decades between two orthonormalisations,
/// and the rounding of the large parts would pass the tolerance of the small ones.
#[test]
fn deviations_that_grow_ten_decades_in_an_interval_are_followed() {
    let text = "gravity = 9.81, a: rod(mass = 0.3634, length = 0.4808) [
        b: rod(mass = 0.0624, length = 0.4031) [c: rod(mass = 0.4397, length = 0.1219) * 2]]";
    let tree = PendulumTree::parse(text).expect("it is right");
    let angles = [
        -1.7764498465346197,
        -2.069165736091177,
        -1.47113351202627,
        -1.47113351202627,
    ];
    exponents_add_up(&tree, &State::at_rest(0.0, &angles), 56);
}

/// ln det of a positive definite matrix, by elimination.
fn logarithm_of_determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut sum = 0.0;
    for pivot in 0..rows.len() {
        let own = rows[pivot].clone();
        sum += own[pivot].ln();
        for row in &mut rows[pivot + 1..] {
            let factor = row[pivot] / own[pivot];
            for (entry, own) in row.iter_mut().zip(&own) {
                *entry -= factor * own;
            }
        }
    }
    sum
}
