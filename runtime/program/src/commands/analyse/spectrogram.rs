//! Spectral lines of a motion that friction shifts, in successive time intervals.

use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series};
use branched_pendulum_data::{Column, Timing};
use branched_pendulum_measure::{
    LineSearch, Lines, Passage, Passages, Spectrum, SpectrumError, SpectrumOptions,
};

use super::estimate::Estimate;
use super::source::Source;
use super::subject::Names;
use crate::Failure;
use crate::frame::Job;
use crate::smoothed::Motion;

/// Length of a time interval, in s: longer than ten oscillations of typical pendulums.
const SPAN: f64 = 10.0;
/// Time between the starts of two successive intervals, in s.
const STEP: f64 = 1.0;
/// Samples a second.
const RATE: f64 = 50.0;
/// Highest frequency in the chart, in Hz.
const TOP: f64 = 4.0;
/// Frequencies from zero to that.
const GRID: u32 = 160;
/// Amplitudes (rad) at which colours change.
const LEVELS: [f64; 5] = [1e-3, 3e-3, 0.01, 0.03, 0.1];
/// Largest number of lines of an interval, and smallest amplitude relative to the largest.
const MOST: usize = 4;
const SMALLEST: f64 = 0.02;

/// Amplitudes and lines of a coordinate's angle in each time interval.
pub struct Spectrogram {
    symbol: String,
    spectra: Vec<Passage<Spectrum>>,
    lines: Vec<Passage<Lines>>,
}

impl Spectrogram {
    /// Computes the spectrogram of an estimate; `None` if the record is shorter than two intervals.
    ///
    /// It uses the sine of the coordinate, which stays bounded if links turn over.
    ///
    /// # Errors
    /// [`Failure::Spectrum`].
    pub fn of(
        names: &Names,
        source: &Source,
        estimate: &Estimate,
    ) -> Result<Option<Self>, Failure> {
        let (mut spectra, mut lines) = (Vec::new(), Vec::new());
        for rows in Timing::stretches(&source.times) {
            let times = &source.times[rows.clone()];
            let motion = &estimate.motion[rows];
            let (Some(start), Some(end)) = (times.first(), times.last()) else {
                continue;
            };
            if end - start < 2.0 * SPAN {
                continue;
            }
            let count = ((end - start) * RATE) as u32;
            let grid = (0..=count).map(|index| start + f64::from(index) / RATE);
            let samples = grid.map(|time| angle(times, motion, names.heard, time).sin());
            let samples: Vec<f64> = samples.collect();
            spectra.extend(of_stretch(*start, &samples, |part| {
                Spectrum::at_frequencies(
                    part,
                    RATE,
                    &grid_of_frequencies(),
                    SpectrumOptions::default(),
                )
            })?);
            lines.extend(of_stretch(*start, &samples, |part| {
                LineSearch {
                    most: MOST,
                    smallest: SMALLEST,
                    ..LineSearch::default()
                }
                .find(part, RATE)
            })?);
        }
        if spectra.is_empty() {
            return Ok(None);
        }
        let symbol = names.symbols[names.heard].clone();
        Ok(Some(Self {
            symbol,
            spectra,
            lines,
        }))
    }

    /// Writes the lines as a table and draws the chart.
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
        let which = match lines.is_empty() {
            true => "without lines",
            false => "and its lines",
        };
        let title = format!("Amplitudes of sin {symbol} in stretches of {SPAN} s, {which}");
        let mut panel = Panel::new(Axis::linear("frequency (Hz)").range(0.0, TOP))
            .heatmap(&x, &y, &values, &LEVELS);
        if !lines.is_empty() {
            let lines = Series::points("lines", &at, &lines);
            panel = panel.series(lines.color(Color::rgb(225, 60, 150)));
        }
        Chart::new(title, Axis::linear("t (s)"))
            .size(900.0, 520.0)
            .panel(panel)
    }
}

/// Frequencies that are drawn, Hz.
fn grid_of_frequencies() -> Vec<f64> {
    let all = (0..=GRID).map(|index| TOP * f64::from(index) / f64::from(GRID));
    all.collect()
}

/// Applies `look` to the successive time intervals of a part of the record that begins at `start`
/// (s).
fn of_stretch<T>(
    start: f64,
    samples: &[f64],
    look: impl FnMut(&[f64]) -> Result<T, SpectrumError>,
) -> Result<Vec<Passage<T>>, Failure> {
    let passages = Passages {
        span: SPAN,
        step: STEP,
    };
    let mut found = passages.each(samples, RATE, look)?;
    for passage in &mut found {
        passage.middle += start;
    }
    Ok(found)
}

/// Returns a coordinate at a time, from the cubic polynomial through the angles and rates at the
/// two neighbouring times.
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
