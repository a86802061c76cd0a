//! Charts of the onset: energies by scale, and the energy that flowed between scales.

use branched_pendulum_charts::{Axis, Chart, Panel, verbatim};

use super::report::{by_scale, matrix_by_scale};
use super::run::{Budgets, Onset, PARSEVAL};
use crate::commands::cascade::report::name;
use crate::commands::cascade::tree::scales_of_sectors;
use crate::subject::Subject;

/// Energy (J) below which values are not shown on the logarithmic axis.
const LEAST_ENERGY: f64 = 1e-12;

/// Draws energies and energy flows against time.
pub fn chart(driven: &Subject, run: &Onset) -> Chart {
    let scales = scales_of_sectors(driven);
    let count = 1 + scales.iter().max().unwrap_or(&0);
    let times: Vec<f64> = run.samples.iter().map(|sample| sample.time).collect();
    let energies = |sample: &Budgets| by_scale(&scales, &sample.energies[PARSEVAL]);
    let energies: Vec<Vec<f64>> = run.samples.iter().map(energies).collect();
    let largest = energies.iter().flatten().copied().fold(0.0, f64::max);
    let axis = Axis::log("energy (J)").range(LEAST_ENERGY, 2.0 * largest.max(LEAST_ENERGY));
    let mut levels = Panel::new(axis);
    for scale in 0..count {
        let energy: Vec<f64> = energies.iter().map(|energies| energies[scale]).collect();
        // A scale that stays empty has nothing to show.
        if energy.iter().any(|energy| *energy > 0.0) {
            levels = levels.line(format!("scale {}", name(scale)), &times, &energy);
        }
    }
    let matrix = |sample: &Budgets| matrix_by_scale(&scales, &sample.flowed.transfers);
    let matrices: Vec<Vec<f64>> = run.samples.iter().map(matrix).collect();
    let mut flows = Panel::new(Axis::linear("given so far (J)")).zero_line();
    for to in 1..count {
        for from in 0..to {
            let given = matrices.iter().map(|matrix| matrix[to * count + from]);
            let given: Vec<f64> = given.collect();
            flows = flows.line(format!("{from} to {to}"), &times, &given);
        }
    }
    let title = format!(
        "{}: energy of the sectors by the scale at which they branch",
        verbatim(&driven.name)
    );
    Chart::new(title, Axis::linear("t (s)"))
        .size(1000.0, 820.0)
        .panel(levels)
        .panel(flows)
}
