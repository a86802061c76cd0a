//! Cost of energy budgets by scale, as multiples of the cost of an evaluation of the accelerations
//! of the same tree.
//!
//! Binary trees of rods, one state, one thread. The last column is the cost per link and scale: it
//! is constant if the cost grows as n log n.

use std::hint::black_box;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{ScaleBudget, Scales};
use branched_pendulum::system::Workspace;
use branched_pendulum_timing::{Pass, Table, in_turns};

/// Full binary trees of rods.
macro_rules! trees {
    ($($name:ident $generations:literal),*) => {
        $(#[branched_pendulum(
            gravity = 9.80665,
            tree: generations(count = $generations, branching = 2, shape = rod, mass = 0.12,
                length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
            emit(energies, budget(parseval, scales)),
        )]
        struct $name;)*

        fn rows() -> Vec<[String; 6]> {
            vec![$({
                let mut model = $name::<f64>::new();
                model.set_threads(NonZeroUsize::MIN);
                row(&model)
            }),*]
        }
    };
}

trees!(
    Links31 5,
    Links127 7,
    Links1023 10,
    Links2047 11,
    Links4095 12,
    Links8191 13,
    Links16383 14,
    Links32767 15,
    Links65535 16,
    Links131071 17
);

fn row<M: Pendulum<f64> + Scales<f64>>(model: &M) -> [String; 6] {
    let links = model.links();
    let angle = |link: usize| ((7 * link + 13) % 64) as f64 / 32.0 - 1.0;
    let theta: Vec<f64> = (0..links).map(angle).collect();
    let omega: Vec<f64> = (0..links).map(|link| 3.0 * angle(link + 5)).collect();
    let (theta, omega) = (theta.as_slice(), omega.as_slice());
    let mut alpha = vec![0.0; links];
    let mut workspaces = [Workspace::new(), Workspace::new(), Workspace::new()];
    let [first, second, third] = &mut workspaces;
    let (mut budget, mut energies) = (ScaleBudget::new(), ScaleBudget::new());
    let mut passes: [Pass<'_>; 3] = [
        Box::new(|| {
            model.accelerations_with(first, 0.0, black_box(theta), omega, &mut alpha);
            black_box(&mut alpha);
        }),
        Box::new(|| {
            model.budget_by_scale(second, 0.0, black_box(theta), omega, &mut budget);
            black_box(&mut budget);
        }),
        Box::new(|| {
            model.energies_by_scale(third, black_box(theta), omega, &mut energies);
            black_box(&mut energies);
        }),
    ];
    let times = in_turns((4_000_000 / links).clamp(15, 2_000), &mut passes);
    let [evaluation, all, energies] = [0, 1, 2].map(|pass: usize| times[pass].least());
    let scales = M::COPIES.len() as f64;
    [
        links.to_string(),
        scales.to_string(),
        format!("{:.2}", 1e6 * evaluation),
        format!("{:.1}", energies / evaluation),
        format!("{:.1}", all / evaluation),
        format!("{:.2}", 1e9 * all / (links as f64 * scales)),
    ]
}

pub(crate) fn run() {
    let table = Table::new([
        "links",
        "scales",
        "accelerations (µs)",
        "energies",
        "budget",
        "ns a link and scale",
    ]);
    println!("{}", rows().into_iter().fold(table, Table::row));
}
