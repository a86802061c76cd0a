//! Charts: energies by level, and what flowed between the levels.

use branched_pendulum_charts::{Axis, Chart, Panel};

use super::report::level_matrix;
use super::run::{Onset, PARSEVAL};
use super::scene::{Level, by_level};

/// Energies below this are not shown on the logarithmic axis, J.
const LEAST_ENERGY: f64 = 1e-12;

/// Draws energies and flows against time.
pub fn chart(run: &Onset) -> Chart {
    let times: Vec<f64> = run.samples.iter().map(|sample| sample.time).collect();
    let energies: Vec<[f64; 4]> = run
        .samples
        .iter()
        .map(|sample| by_level(&sample.energies[PARSEVAL]))
        .collect();
    let largest = energies.iter().flatten().copied().fold(0.0, f64::max);
    let axis = Axis::log("energy (J)").range(LEAST_ENERGY, 2.0 * largest.max(LEAST_ENERGY));
    let mut levels = Panel::new(axis);
    for level in Level::ALL {
        let energy: Vec<f64> = energies.iter().map(|e| e[level as usize]).collect();
        // A level that stays empty has nothing to show.
        if energy.iter().any(|energy| *energy > 0.0) {
            levels = levels.line(level.name(), &times, &energy);
        }
    }
    let matrices: Vec<[[f64; 4]; 4]> = run
        .samples
        .iter()
        .map(|sample| level_matrix(&sample.transfers))
        .collect();
    let mut flows = Panel::new(Axis::linear("given so far (J)")).zero_line();
    for to in Level::ALL {
        for from in Level::ALL.into_iter().filter(|from| *from < to) {
            let given: Vec<f64> = matrices
                .iter()
                .map(|matrix| matrix[to as usize][from as usize])
                .collect();
            let label = format!("{} to {}", from.name(), to.name());
            flows = flows.line(label, &times, &given);
        }
    }
    Chart::new(
        "Energy of the sectors of a driven binary tree, by where they branch",
        Axis::linear("t (s)"),
    )
    .size(1000.0, 820.0)
    .panel(levels)
    .panel(flows)
}
