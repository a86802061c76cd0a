//! Spectrum of θ_m as a chart, and its lines as a table.

use std::fmt::Write;

use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_frame::Failure;
use branched_pendulum_measure::{LineSearch, Spectrum, SpectrumError, SpectrumOptions};

use super::charts::compared;
use super::findings::Frequencies;
use super::release::Run;
use super::{Arguments, RATE};

/// Length of the record from which the paper's spectrum was computed, in s.
const SPAN: f64 = 32.0;

/// Number of lines that are searched for, and number of those that are reported: the last ones
/// found are distorted by still weaker ones.
const SOUGHT: usize = 18;
const REPORTED: usize = 12;

/// Highest order of a combination that names a line, and the largest distance of the line from the
/// combination's frequency, in cycles per record.
const ORDER: u32 = 11;
const NEAR: f64 = 0.01;

/// Largest frequency of the spectrum, Hz.
const TOP: f64 = 3.0;

/// Returns θ_m of a run, up to the time [`SPAN`].
fn mean_angle(run: &Run) -> Vec<f64> {
    let samples = run.samples.iter();
    let samples = samples.take_while(|sample| sample.time < SPAN);
    samples.map(|sample| sample.mean).collect()
}

/// Returns the spectral lines of θ_m of a run as a table, with the names of those that are
/// combinations of the two strongest.
///
/// # Errors
/// [`SpectrumError`].
pub fn lines(run: &Run) -> Result<String, SpectrumError> {
    let search = LineSearch {
        most: SOUGHT,
        ..LineSearch::default()
    };
    let found = search.find(&mean_angle(run), RATE)?;
    let strongest = found.lines.iter().take(2);
    let mut strongest: Vec<f64> = strongest.map(|line| line.frequency_hz).collect();
    strongest.sort_by(f64::total_cmp);
    let names = found.named(&strongest, ORDER, NEAR * found.resolution_hz);
    let mut text = format!(
        "Lines of θ_m from {:?}°; those nearer than {:.3} Hz are one in a record this long\n  \
         frequency (Hz)         amplitude (rad)  name\n",
        run.angle_deg, found.resolution_hz
    );
    for (line, name) in found.lines.iter().zip(names).take(REPORTED) {
        let name = name.map_or(String::new(), |name| name.named(&["f_+", "f_−"]));
        let row = format!(
            "  {:<9.7} ± {:<8.1e} {:>16.6}  {name}",
            line.frequency_hz, line.deviation_hz, line.amplitude
        );
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", row.trim_end());
    }
    Ok(text + "\n")
}

/// Draws the amplitude spectrum of θ_m, computed with a Hann window, for the run with the smallest
/// angle of release and for the two runs compared.
pub fn chart(
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
) -> Result<Chart, Failure> {
    let span = arguments.duration.min(SPAN);
    // Eight points for each resolved frequency: smooth peaks.
    let count = (8.0 * span * TOP).round() as usize;
    let grid = (0..=count).map(|index| TOP * index as f64 / count as f64);
    let grid: Vec<f64> = grid.collect();
    let mut drawn = compared(runs);
    let lowest = runs.first();
    let lowest = lowest.filter(|run| drawn.iter().all(|own| own.angle_deg != run.angle_deg));
    drawn.splice(..0, lowest);
    let (mut lines, mut all_move) = (Vec::new(), true);
    for run in drawn {
        let samples = mean_angle(run);
        let options = SpectrumOptions::default();
        let amplitudes = Spectrum::at_frequencies(&samples, RATE, &grid, options)?.amplitudes;
        all_move &= amplitudes.iter().any(|amplitude| *amplitude > 0.0);
        lines.push(Series::line(run.release(), &grid, &amplitudes));
    }
    let label = "amplitude of θ_m (rad)";
    // A pendulum at rest cannot be drawn on a logarithmic axis.
    let axis = match all_move {
        true => Axis::log(label),
        false => Axis::linear(label),
    };
    let panel = Panel::new(axis)
        .vertical(frequencies.plus, "f_+")
        .vertical(frequencies.antiphase, "f_d")
        .vertical(frequencies.minus, "f_−")
        .vertical(2.0 * frequencies.antiphase, "2f_d");
    let title = format!("Spectrum of θ_m, 0 to {span} s; {}", arguments.conditions());
    let chart = Chart::new(title, Axis::linear("frequency (Hz)").range(0.0, TOP));
    let panel = lines.into_iter().fold(panel, Panel::series);
    Ok(chart.size(900.0, 520.0).panel(panel))
}
