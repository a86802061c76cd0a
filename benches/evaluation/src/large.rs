//! Large trees, whose code is loops over generations.

// One attribute a tree; their docs are in the attribute's output.
#![allow(missing_docs)]

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::system::Workspace;
use branched_pendulum_timing::{Table, least};

use super::articulated::Articulated;
use super::states::{SEEDS, random};
use super::table;

/// Approximate number of values in one pass, if a single state has fewer; they fit into the
/// second-level cache.
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

/// Irregular trees: a rod from which several full trees of rods hang.
macro_rules! bush {
    ($name:ident, $trees:ident: $($tree:ident $generations:literal $branching:literal),*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            code = loops,
            trunk: rod(mass = 0.12, length = 0.3) [
                $($tree: generations(count = $generations, branching = $branching, shape = rod,
                    mass = 0.12, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7)),*
            ]
        )]
        pub struct $name;

        /// Number of generations and of children per link of each tree.
        pub const $trees: &[[usize; 2]] = &[$([$generations, $branching]),*];
    };
}

bush!(Bush127, BUSH_127: a 6 2, b 4 3, c 2 1, d 3 4);
bush!(Bush500, BUSH_500: a 8 2, b 5 3, c 4 4, d 38 1);

/// Function that writes the accelerations for angles and velocities.
type Evaluate<'a> = dyn FnMut(&[f64], &[f64], &mut [f64]) + 'a;

/// Shortest times for one link, in ns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Number of links.
    pub links: usize,
    /// Time of the standard library's sine and cosine of the link's angle.
    pub sines: f64,
    /// Loops on one thread.
    pub one: f64,
    /// Loops on two threads; `None` if these are not measured.
    pub two: Option<f64>,
    /// The recursion over a table.
    pub articulated: f64,
}

/// Measures full trees.
#[must_use]
pub fn full() -> Vec<Row> {
    macro_rules! rows {
        ($($name:ident $generations:literal),*) => {
            vec![$({
                let mut model = $name::<f64>::new();
                model.set_threads(NonZeroUsize::MIN);
                let mut row = row(&model, &table::tree($generations));
                model.set_threads(NonZeroUsize::MIN.saturating_add(1));
                row.two = Some(States::new(row.links).loops(&model));
                row
            }),*]
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

/// Measures irregular trees.
#[must_use]
pub fn irregular() -> Vec<Row> {
    vec![
        row(&Bush127::<f64>::new(), &table::bush(BUSH_127)),
        row(&Bush500::<f64>::new(), &table::bush(BUSH_500)),
    ]
}

fn row<P: Pendulum<f64>>(model: &P, links: &[table::Link]) -> Row {
    let mut states = States::new(model.links());
    let mut recursion = Articulated::new(links);
    Row {
        links: model.links(),
        sines: states.sines(),
        one: states.loops(model),
        two: None,
        articulated: states
            .best(&mut |theta, omega, alpha| recursion.accelerations(theta, omega, alpha)),
    }
}

/// The states of a tree at which its accelerations are timed.
struct States {
    theta: Vec<Vec<f64>>,
    omega: Vec<Vec<f64>>,
    alpha: Vec<Vec<f64>>,
}

impl States {
    fn new(links: usize) -> Self {
        let states = (NUMBERS / links).max(1);
        Self {
            theta: random(SEEDS[0], links, states, std::f64::consts::PI).by_state,
            omega: random(SEEDS[1], links, states, 9.0).by_state,
            alpha: vec![vec![0.0; links]; states],
        }
    }

    fn best(&mut self, evaluate: &mut Evaluate) -> f64 {
        let Self {
            theta,
            omega,
            alpha,
        } = self;
        let numbers: usize = alpha.iter().map(Vec::len).sum();
        let passes = (3_000_000 / numbers).clamp(15, 400);
        let seconds = least(passes, || {
            for ((theta, omega), alpha) in theta.iter().zip(&*omega).zip(&mut *alpha) {
                evaluate(black_box(theta), black_box(omega), black_box(alpha));
            }
        });
        seconds * 1e9 / numbers as f64
    }

    fn sines(&mut self) -> f64 {
        self.best(&mut |theta, _, alpha| {
            for (alpha, theta) in alpha.iter_mut().zip(theta) {
                let (sine, cosine) = f64::sin_cos(*theta);
                *alpha = sine + cosine;
            }
        })
    }

    fn loops(&mut self, model: &impl Pendulum<f64>) -> f64 {
        let mut workspace = Workspace::new();
        self.best(&mut |theta, omega, alpha| {
            model.accelerations_with(&mut workspace, 0.0, theta, omega, alpha);
        })
    }
}

/// Returns the table that the program prints.
#[must_use]
pub fn table(title: &str, rows: &[Row]) -> String {
    let table = Table::new([
        "links",
        "sines of std",
        "one thread",
        "two threads",
        "articulated",
    ]);
    let table = rows.iter().fold(table, |table, row| {
        let times = [
            Some(row.sines),
            Some(row.one),
            row.two,
            Some(row.articulated),
        ];
        let cell = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{time:.2}"));
        table.row([row.links.to_string()].into_iter().chain(times.map(cell)))
    });
    format!("{title}\n\n{table}\n")
}
