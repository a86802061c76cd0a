//! The lines of a motion that friction moves, one stretch of time after the other.

use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series};
use branched_pendulum_data::Column;
use branched_pendulum_measure::{LineSearch, Lines, Passage, Passages, Spectrum, SpectrumOptions};

use super::estimate::Estimate;
use super::source::Source;
use super::subject::Names;
use crate::Failure;
use crate::frame::Job;
use crate::smoothed::Motion;

/// Length of a stretch, s: longer than ten swings of the pendulums here.
const SPAN: f64 = 10.0;
/// From the start of one to that of the next, s.
const STEP: f64 = 1.0;
/// Samples a second.
const RATE: f64 = 50.0;
/// Highest frequency that is drawn, Hz.
const TOP: f64 = 4.0;
/// Frequencies from zero to that.
const GRID: u32 = 160;
/// Amplitudes, rad, at which colours change.
const LEVELS: [f64; 5] = [1e-3, 3e-3, 0.01, 0.03, 0.1];
/// Lines of a stretch, and the smallest beside the largest.
const MOST: usize = 4;
const SMALLEST: f64 = 0.02;

/// Amplitudes and lines of a coordinate's angle in each stretch.
pub struct Spectrogram {
    symbol: String,
    spectra: Vec<Passage<Spectrum>>,
    lines: Vec<Passage<Lines>>,
}

impl Spectrogram {
    /// Analyses an estimate; none of one that is not two stretches long.
    ///
    /// The sine of the coordinate is taken, which is bounded where links turn over.
    ///
    /// # Errors
    /// [`Failure::Spectrum`].
    pub fn of(
        names: &Names,
        source: &Source,
        estimate: &Estimate,
    ) -> Result<Option<Self>, Failure> {
        let (Some(start), Some(end)) = (source.times.first(), source.times.last()) else {
            return Ok(None);
        };
        if end - start < 2.0 * SPAN {
            return Ok(None);
        }
        let count = ((end - start) * RATE) as u32;
        let times = (0..=count).map(|index| start + f64::from(index) / RATE);
        let samples: Vec<f64> = times
            .map(|time| angle(&source.times, &estimate.motion, names.heard, time).sin())
            .collect();
        let passages = Passages {
            span: SPAN,
            step: STEP,
        };
        let grid: Vec<f64> = (0..=GRID)
            .map(|index| TOP * f64::from(index) / f64::from(GRID))
            .collect();
        let search = LineSearch {
            most: MOST,
            smallest: SMALLEST,
            ..LineSearch::default()
        };
        let mut spectra = passages.each(&samples, RATE, |part| {
            Spectrum::at_frequencies(part, RATE, &grid, SpectrumOptions::default())
        })?;
        let mut lines = passages.each(&samples, RATE, |part| search.find(part, RATE))?;
        for passage in &mut spectra {
            passage.middle += start;
        }
        for passage in &mut lines {
            passage.middle += start;
        }
        let symbol = names.symbols[names.heard].clone();
        Ok(Some(Self {
            symbol,
            spectra,
            lines,
        }))
    }

    /// Writes the lines and draws the chart.
    ///
    /// # Errors
    /// [`Failure::Csv`], [`Failure::File`] or [`Failure::Chart`].
    pub fn write(&self, job: &Job) -> Result<(), Failure> {
        let columns = [
            Column::new("time", "s"),
            Column::new("frequency", "Hz"),
            Column::new("frequency_error", "Hz"),
            Column::new("amplitude", ""),
            Column::new("amplitude_error", ""),
        ];
        job.csv("lines.csv", &columns, |file| {
            for passage in &self.lines {
                for line in &passage.found.lines {
                    file.row([
                        passage.middle,
                        line.frequency_hz,
                        line.deviation_hz,
                        line.amplitude,
                        line.amplitude_deviation,
                    ])?;
                }
            }
            Ok(())
        })?;
        job.chart("spectrogram", &self.chart())
    }

    fn chart(&self) -> Chart {
        let (mut x, mut y, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for passage in &self.spectra {
            let Spectrum {
                frequencies_hz,
                amplitudes,
            } = &passage.found;
            for (frequency, amplitude) in frequencies_hz.iter().zip(amplitudes) {
                x.push(passage.middle);
                y.push(*frequency);
                values.push(*amplitude);
            }
        }
        let (mut at, mut lines) = (Vec::new(), Vec::new());
        for passage in &self.lines {
            let drawn = passage.found.lines.iter();
            for line in drawn.filter(|line| line.frequency_hz <= TOP) {
                at.push(passage.middle);
                lines.push(line.frequency_hz);
            }
        }
        let symbol = &self.symbol;
        let title = format!("Amplitudes of sin {symbol} in stretches of {SPAN} s, and its lines");
        let panel = Panel::new(Axis::linear("frequency (Hz)").range(0.0, TOP))
            .heatmap(&x, &y, &values, &LEVELS)
            .series(Series::points("lines", &at, &lines).color(Color::rgb(225, 60, 150)));
        Chart::new(title, Axis::linear("t (s)"))
            .size(900.0, 520.0)
            .panel(panel)
    }
}

/// A coordinate at a time: the cubic through angles and rates at the two times about it.
fn angle(times: &[f64], motion: &[Motion], of: usize, time: f64) -> f64 {
    let after = times.partition_point(|other| *other < time);
    let after = after.clamp(1, times.len() - 1);
    let before = after - 1;
    let step = times[after] - times[before];
    let part = (time - times[before]) / step;
    let [[one, other], [rate, later]] =
        [0, 1].map(|order| [motion[before][order][of], motion[after][order][of]]);
    let rest = 1.0 - part;
    let along = rest * rest * (1.0 + 2.0 * part) * one + part * part * (3.0 - 2.0 * part) * other;
    along + step * part * rest * (rest * rate - part * later)
}
