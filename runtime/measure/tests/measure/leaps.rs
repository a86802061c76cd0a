//! Leaps of records by the equations of motion.

use std::ops::Range;

use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Rk4};
use branched_pendulum::prelude::*;
use branched_pendulum_measure::LeapSearch;

use crate::identification::chain::real;
use crate::normal::Normal;

const RATE: f64 = 100.0;
const ROWS: usize = 300;

/// Angles of both links, a row for each time.
type Rows = Vec<[f64; 2]>;

/// Fault of a record, the rows at which it begins or ends, and what it does.
type Fault = (&'static str, &'static [usize], fn(&mut Rows));

const FAULTS: [Fault; 7] = [
    ("step", &[130], |rows| {
        rows[130..].iter_mut().for_each(|row| row[1] += 0.3);
    }),
    ("lost rows", &[160], |rows| {
        rows.drain(160..163);
    }),
    ("sign", &[100, 108], |rows| {
        rows[100..108].iter_mut().for_each(|row| row[0] = -row[0]);
    }),
    ("zeros", &[200, 205], |rows| {
        rows[200..205].iter_mut().for_each(|row| row[1] = 0.0);
    }),
    ("exchange", &[90, 110], |rows| {
        rows[90..110].iter_mut().for_each(|row| row.swap(0, 1));
    }),
    ("frozen", &[150, 158], |rows| {
        let before = rows[149];
        rows[150..158].fill(before);
    }),
    ("lag", &[120], |rows| {
        for row in (120..rows.len()).rev() {
            rows[row][1] = rows[row - 1][1];
        }
    }),
];

/// Starts of three motions (rad), with the noise of their angles.
const STARTS: [([f64; 2], f64); 3] = [([0.5, -0.3], 1e-3), ([1.2, 0.4], 2e-3), ([2.0, 2.4], 1e-3)];

fn record((start, noise): ([f64; 2], f64), seed: u64) -> Rows {
    let times: Vec<f64> = (0..ROWS).map(|row| row as f64 / RATE).collect();
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let start = State::at_rest(0.0, &start);
    let motion = method.sample_to_vec(&AbsoluteAngles(real()), &start, &times);
    let mut normal = Normal(seed);
    let mut seen = |angle: f64| angle + noise * normal.next();
    let states = motion.unwrap().into_iter();
    states
        .map(|state| [seen(state.values[0]), seen(state.values[1])])
        .collect()
}

fn leaps(rows: &Rows) -> Vec<Range<usize>> {
    let times: Vec<f64> = (0..rows.len()).map(|row| row as f64 / RATE).collect();
    let data: Vec<Vec<Option<f64>>> = rows.iter().map(|row| row.map(Some).to_vec()).collect();
    let method = Rk4::new(LeapSearch::LONGEST_STEP);
    let system = linearised(AbsoluteAngles(real()));
    let found = LeapSearch::default().find(&method, &system, &times, &data);
    found.unwrap()
}

#[test]
fn faults_are_found_in_their_rows() {
    for (name, edges, spoil) in FAULTS {
        for (start, seed) in STARTS.into_iter().zip(1..) {
            let mut rows = record(start, seed);
            spoil(&mut rows);
            let found = leaps(&rows);
            let is_near = |rows: &Range<usize>| {
                let mut edges = edges.iter();
                edges.any(|edge| (rows.start.saturating_sub(6)..rows.end + 6).contains(edge))
            };
            assert!(found.iter().any(is_near), "{name} {start:?}: {found:?}");
        }
    }
}

#[test]
fn right_records_have_no_leaps() {
    for (start, seed) in STARTS.into_iter().zip(1..) {
        assert_eq!(leaps(&record(start, seed)), [], "{start:?}");
    }
}
