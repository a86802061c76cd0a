//! Spectrum of θ_m, for the run with the smallest angle of release and for the two runs compared.

use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_measure::{Spectrum, SpectrumOptions};

use super::arguments::Arguments;
use super::experiment::Run;
use super::findings::Frequencies;
use super::lines;
use branched_pendulum_frame::Failure;

/// The frequencies shown, Hz.
const SPECTRUM_TOP: f64 = 3.0;

/// Returns the chart of the amplitude spectrum of θ_m, computed with a Hann window.
///
/// # Errors
/// [`Failure::Spectrum`].
pub(super) fn chart(
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
    pair: &[&Run],
) -> Result<Chart, Failure> {
    let span = arguments.duration.min(lines::SPAN);
    let top = SPECTRUM_TOP.min(0.5 * arguments.rate);
    // Eight points for each resolved frequency: smooth peaks.
    let count = (8.0 * span * top).round();
    let grid: Vec<f64> = (0..=count as usize)
        .map(|index| top * index as f64 / count)
        .collect();
    let title = format!("Spectrum of θ_m, 0 to {span} s; {}", arguments.conditions());
    let mut series = Vec::new();
    let mut moves = true;
    let lowest = runs
        .first()
        .filter(|run| pair.iter().all(|other| other.angle_deg != run.angle_deg));
    for run in lowest.into_iter().chain(pair.iter().copied()) {
        let samples = lines::mean_angle(run);
        let spectrum =
            Spectrum::at_frequencies(&samples, arguments.rate, &grid, SpectrumOptions::default())?;
        series.push(Series::line(
            run.release(),
            &spectrum.frequencies_hz,
            &spectrum.amplitudes,
        ));
        moves &= spectrum.amplitudes.iter().any(|amplitude| *amplitude > 0.0);
    }
    // A pendulum at rest has no place on a logarithmic axis.
    let label = "amplitude of θ_m (rad)";
    let panel = Panel::new(if moves {
        Axis::log(label)
    } else {
        Axis::linear(label)
    });
    let panel = series
        .into_iter()
        .fold(panel, Panel::series)
        .vertical(frequencies.plus, "f_+")
        .vertical(frequencies.antiphase, "f_d")
        .vertical(frequencies.minus, "f_−")
        .vertical(2.0 * frequencies.antiphase, "2f_d");
    Ok(
        Chart::new(title, Axis::linear("frequency (Hz)").range(0.0, top))
            .size(900.0, 520.0)
            .panel(panel),
    )
}
