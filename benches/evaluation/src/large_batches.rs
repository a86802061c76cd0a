//! Many states of large trees: code in loops, with one state in each lane of the vector registers.

use std::hint::black_box;

use branched_pendulum::batch::Batch;
use branched_pendulum::scalar::Lane;
use branched_pendulum::system::Workspace;
use branched_pendulum::{Pendulum, branched_pendulum};
use branched_pendulum_timing::{Pass, Table, in_turns};

use super::large::{Bush127, Bush500, Loops127, Loops1023};
use super::measure::states_of;
use super::states::{SEEDS, random};

/// 127 links in generations.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 7, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, code = loops),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t)),
)]
struct Driven;

/// 127 links given by a table, one of which hangs at another point of its parent.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 0.12, length = 0.3) [
        hook: rod(mass = 0.12, length = 0.3, at = 0.1),
        a: generations(count = 6, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        b: generations(count = 4, branching = 3, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        c: rod(mass = 0.12, length = 0.3),
        d: generations(count = 3, branching = 4, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
    ],
)]
struct Rack;

/// Shortest times for one state of a large tree, in ns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Kind of the tree: generations, a table, generations of a driven tree, or a table with
    /// another attachment point.
    pub scene: &'static str,
    /// Number of links.
    pub links: usize,
    /// One state after the other.
    pub single: f64,
    /// A batch.
    pub batch: f64,
    /// A batch in `f32`.
    pub narrow: f64,
}

/// Measures all trees.
#[must_use]
pub fn all() -> Vec<Row> {
    vec![
        row("generations", &Loops127::new(), &Loops127::default()),
        row("generations", &Loops1023::new(), &Loops1023::default()),
        row("table", &Bush127::new(), &Bush127::default()),
        row("table", &Bush500::new(), &Bush500::default()),
        row("driven", &Driven::new(), &Driven::default()),
        row("places", &Rack::new(), &Rack::default()),
    ]
}

fn row<P: Pendulum<f64>, Q: Pendulum<f32>>(scene: &'static str, model: &P, narrow: &Q) -> Row {
    let links = model.links();
    let states = states_of(links);
    let theta = random(SEEDS[0], links, states, std::f64::consts::PI);
    let omega = random(SEEDS[1], links, states, 9.0);
    let mut alpha = vec![0.0; links];
    let mut workspace = Workspace::new();
    let single = || {
        for (theta, omega) in theta.by_state.iter().zip(&omega.by_state) {
            model.accelerations_with(
                &mut workspace,
                0.0,
                black_box(theta),
                black_box(omega),
                black_box(&mut alpha),
            );
        }
    };
    let wide = pass(model, &theta.by_link, &omega.by_link, |x| x);
    let short = pass(narrow, &theta.by_link, &omega.by_link, |x| x as f32);
    let mut passes: [Pass<'_>; 3] = [Box::new(single), Box::new(wide), Box::new(short)];
    let times = in_turns(500_000 / (links * states).max(1) * 10, &mut passes);
    let [single, batch, narrow] =
        [0, 1, 2].map(|pass: usize| times[pass].least() * 1e9 / states as f64);
    Row {
        scene,
        links,
        single,
        batch,
        narrow,
    }
}

/// A pass over all states.
fn pass<P: Pendulum<T>, T: Lane>(
    model: &P,
    theta: &[Vec<f64>],
    omega: &[Vec<f64>],
    convert: fn(f64) -> T,
) -> impl FnMut() {
    let columns = |columns: &[Vec<f64>]| -> Vec<Vec<T>> {
        let column = |column: &Vec<f64>| column.iter().map(|&x| convert(x)).collect();
        columns.iter().map(column).collect()
    };
    let (theta, omega) = (columns(theta), columns(omega));
    let mut alpha = theta.clone();
    let mut batch = Batch::new(model);
    move || {
        let done = batch.accelerations(
            T::from_f64(0.0),
            black_box(&theta),
            black_box(&omega),
            black_box(&mut alpha),
        );
        debug_assert!(done.is_ok());
    }
}

/// Returns the table that the program prints.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let table = Table::new(["loops over", "links", "one state", "batch", "f32"]);
    let table = rows.iter().fold(table, |table, row| {
        let times = [row.single, row.batch, row.narrow].map(|time| format!("{time:.0}"));
        let head = [row.scene.to_owned(), row.links.to_string()];
        table.row(head.into_iter().chain(times))
    });
    format!(
        "Many states of large trees: least time for one state, ns. The driven one is in\n\
        generations; `places` is a table with children at several places of a link.\n\n{table}"
    )
}
