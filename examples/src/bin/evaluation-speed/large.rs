//! Large trees: code in loops over generations.

// One attribute a tree; their docs are in the attribute's output.
#![allow(missing_docs)]

use std::fmt::Write;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use branched_pendulum::prelude::*;

use super::articulated::Articulated;
use super::states::random;
use super::table;

/// Numbers in one pass, about, where a state has fewer: they fit into the second
/// cache.
const NUMBERS: usize = 6144;

/// Full binary trees of rods.
macro_rules! tree {
    ($name:ident, $generations:literal) => {
        #[branched_pendulum(
                    gravity = 9.80665,
                    tree: generations(count = $generations, branching = 2, shape = rod, mass = 0.12,
                        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, code = loops),
                )]
        pub struct $name;
    };
}

tree!(Loops15, 4);
tree!(Loops31, 5);
tree!(Loops127, 7);
tree!(Loops1023, 10);
tree!(Loops16383, 14);
tree!(Loops131071, 17);
tree!(Loops1048575, 20);

/// Writes accelerations of angles and velocities.
type Evaluate<'a> = dyn FnMut(&[f64], &[f64], &mut [f64]) + 'a;

/// Least times for one link, ns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Number of links.
    pub links: usize,
    /// The system's sine and cosine of its angle.
    pub sines: f64,
    /// Loops on one thread.
    pub one: f64,
    /// Loops on two threads.
    pub two: f64,
    /// The recursion over a table.
    pub articulated: f64,
}

/// Measures all trees.
#[must_use]
pub fn all() -> Vec<Row> {
    macro_rules! rows {
        ($($name:ident $generations:literal),*) => {
            vec![$(row($name::<f64>::new(), $name::set_threads, $generations)),*]
        };
    }
    rows!(
        Loops15 4,
        Loops31 5,
        Loops127 7,
        Loops1023 10,
        Loops16383 14,
        Loops131071 17,
        Loops1048575 20
    )
}

fn row<P: Pendulum<f64>>(
    mut model: P,
    set_threads: impl Fn(&mut P, NonZeroUsize),
    generations: usize,
) -> Row {
    let links = P::LINKS;
    let states = (NUMBERS / links).max(1);
    let theta = random(1, links, states, std::f64::consts::PI).by_state;
    let omega = random(2, links, states, 9.0).by_state;
    let mut alpha = vec![vec![0.0; links]; states];
    let mut best = |evaluate: &mut Evaluate| {
        let passes = (3_000_000 / (links * states)).clamp(15, 400);
        let mut least = f64::INFINITY;
        for _ in 0..passes {
            let start = Instant::now();
            for ((theta, omega), alpha) in theta.iter().zip(&omega).zip(&mut alpha) {
                evaluate(black_box(theta), black_box(omega), black_box(alpha));
            }
            least = least.min(start.elapsed().as_secs_f64());
        }
        least * 1e9 / (links * states) as f64
    };
    let sines = best(&mut |theta, _, alpha| {
        for (alpha, theta) in alpha.iter_mut().zip(theta) {
            let (sine, cosine) = f64::sin_cos(*theta);
            *alpha = sine + cosine;
        }
    });
    let mut threads = |count: NonZeroUsize| {
        set_threads(&mut model, count);
        best(&mut |theta, omega, alpha| model.accelerations_into(0.0, theta, omega, alpha))
    };
    let one = threads(NonZeroUsize::MIN);
    let two = threads(NonZeroUsize::MIN.saturating_add(1));
    let mut recursion = Articulated::new(&table::tree(generations));
    let articulated = best(&mut |theta, omega, alpha| recursion.accelerations(theta, omega, alpha));
    Row {
        links,
        sines,
        one,
        two,
        articulated,
    }
}

/// The table that the program prints.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let mut text = "Large trees in loops: least time for one link, ns.\n\n".to_owned();
    let _ = writeln!(
        text,
        "{:>9} {:>14} {:>14} {:>14} {:>14}",
        "links", "sines of std", "one thread", "two threads", "articulated"
    );
    for row in rows {
        let &Row {
            links,
            sines,
            one,
            two,
            articulated,
        } = row;
        let _ = writeln!(
            text,
            "{links:>9} {sines:>14.2} {one:>14.2} {two:>14.2} {articulated:>14.2}"
        );
    }
    text
}
