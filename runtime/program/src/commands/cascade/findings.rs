//! Averages over all starts of a cascade, with their errors.

use std::iter;

use branched_pendulum::analysis::statistics::{
    Average, Drift, Estimate, StatisticsError, jackknife, transient,
};

use super::balance::Balance;
use super::budgets::QUANTITIES;
use super::density::{Density, Moments};
use super::motion::Followed;
use super::structure::{Structure, level_range};
use super::tree::DrivenTree;

/// Energy per degree of freedom, relative to that of the means, below which a scale counts as
/// asleep: it has too much friction, or the run is too short to excite it.
const ASLEEP: f64 = 1e-6;

/// Deviation of a flux that counts as constant.
pub const LEVEL: f64 = 0.05;

/// Which quantity of a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Energy, J.
    Energy,
    /// Power received from the other scales, in W.
    Received,
    /// Power of the friction, W.
    Friction,
    /// Power of the motor, W.
    Drive,
}

/// The state of a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScaleState {
    /// The scale has a steady mean energy, in J.
    Awake(Average),
    /// The scale hardly moves; its mean energy, in J.
    Asleep(f64),
    /// The energy has no steady average, for this reason.
    Unsettled(StatisticsError),
}

/// Power that passes into a scale and all younger ones, computed in two ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flux {
    /// From the energy transfers W along the motion, in W.
    pub transferred: Average,
    /// From the powers: friction in these scales minus that of the motor, in W.
    pub dissipated: Average,
    /// Difference of the two, which is the rate of change of the energy of these scales; its mean
    /// is zero in a steady state.
    pub gap: Average,
    /// Skewness of the distribution of W.
    pub skewness: Option<Estimate>,
    /// Flatness of the distribution of W.
    pub flatness: Option<Estimate>,
}

/// A line through logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Slope of ln(energy per degree of freedom) as a function of ln(length of the links).
    pub exponent: Estimate,
    /// Sum of the squared deviations from the line in units of their errors, divided by the number
    /// of points minus two. Values far above 1 mean that there is no power law.
    pub misfit: f64,
}

/// Averages over all starts.
#[derive(Clone, Debug)]
pub struct Findings {
    /// Number of windows at the start that are left out of all averages, determined by MSER-5 from
    /// the mean energy.
    pub transient: Result<usize, StatisticsError>,
    /// Mean energy (J) over all starts, for each window and scale.
    pub course: Vec<Vec<f64>>,
    /// Drift of the energy after the initial transient.
    pub drift: Result<Drift, StatisticsError>,
    /// State of each scale, beginning with the means.
    pub scales: Vec<ScaleState>,
    /// Power of the motor, W.
    pub input: Result<Average, StatisticsError>,
    /// Power removed by all friction, in W; positive.
    pub dissipation: Result<Average, StatisticsError>,
    /// Difference of the two powers, in W: energy that integration errors have added or removed.
    pub loss: Result<Average, StatisticsError>,
    /// Powers that pass into scale s and all younger ones, for s = 1, 2, ….
    pub fluxes: Vec<Result<Flux, StatisticsError>>,
    /// Densities of the fluxes.
    pub densities: Vec<Density>,
    /// Power law of the energy per degree of freedom of the differences, against length.
    pub law: Option<PowerLaw>,
    /// Moments of the amplitudes over the scales of constant flux.
    pub structure: Structure,
}

impl Findings {
    /// Computes all averages from the windows of all starts.
    pub fn new(driven: &DrivenTree, starts: &[Followed]) -> Self {
        let series = LaterWindows {
            scales: driven.generations(),
            starts,
            first: 0,
        };
        let course: Vec<Vec<f64>> = (0..series.scales)
            .map(|scale| series.energy_history(scale))
            .collect();
        let total: Vec<f64> = (0..series.windows())
            .map(|window| course.iter().map(|energies| energies[window]).sum())
            .collect();
        let transient = transient(&total);
        let series = LaterWindows {
            // The second half of what has not settled is shown, and called so.
            first: transient.unwrap_or(series.windows() / 2),
            ..series
        };
        let all = 0..series.scales;
        let of = |quantity, scales: std::ops::Range<usize>, sign: f64| {
            series.sums(|row| sign * scales.clone().map(|s| at(row, s, quantity)).sum::<f64>())
        };
        let energy = of(Quantity::Energy, all.clone(), 1.0);
        let per_mean = series.mean(0) / driven.degrees_of_freedom(0) as f64;
        let states = all.clone().map(|scale| {
            let least = ASLEEP * per_mean * driven.degrees_of_freedom(scale) as f64;
            series.state(scale, least)
        });
        let scales: Vec<ScaleState> = states.collect();
        let mut densities = vec![Density::default(); series.scales - 1];
        for start in starts {
            for (all, own) in densities.iter_mut().zip(&start.densities) {
                all.add(own);
            }
        }
        let fluxes = (1..series.scales).map(|scale| series.flux(scale));
        let fluxes: Vec<Result<Flux, StatisticsError>> = fluxes.collect();
        let dissipation = Average::of(&of(Quantity::Friction, all.clone(), -1.0));
        let lost = |flux: &Result<Flux, _>| flux.map_or(f64::NAN, |own| own.dissipated.mean);
        let whole = dissipation.map_or(f64::NAN, |own| own.mean);
        let powers: Vec<f64> = iter::once(whole).chain(fluxes.iter().map(lost)).collect();
        let range = level_range(&powers, LEVEL);
        let amplitudes: Vec<_> = starts.iter().map(|own| own.amplitudes.as_slice()).collect();
        Self {
            structure: Structure::new(driven, &amplitudes, range, &powers),
            drift: Drift::of(&energy),
            input: Average::of(&of(Quantity::Drive, all.clone(), 1.0)),
            loss: Average::of(&series.sums(|row| {
                let power = |s| at(row, s, Quantity::Friction) + at(row, s, Quantity::Drive);
                all.clone().map(power).sum::<f64>()
            })),
            dissipation,
            fluxes,
            law: power_law(driven, &scales, &series),
            transient,
            course,
            scales,
            densities,
        }
    }

    /// Returns the mean total energy of all scales after the transient, in J.
    pub fn energy(&self) -> f64 {
        let windows = self.course.first().map_or(0, Vec::len);
        let first = self.transient.unwrap_or(windows / 2).min(windows);
        let sums = self
            .course
            .iter()
            .map(|energies| energies[first..].iter().sum::<f64>());
        sums.sum::<f64>() / (windows - first).max(1) as f64
    }

    /// Checks if friction removes the power that the motor supplies.
    pub fn balance(&self) -> Balance {
        Balance::of(&self.loss, &self.input, self.is_steady())
    }

    /// Returns true if the transient has ended and the energy does not drift.
    pub fn is_steady(&self) -> bool {
        self.transient.is_ok() && self.drift.is_ok_and(|drift| drift.is_within(2.0))
    }
}

/// Returns the value of a quantity of one scale, from a row of mean values.
fn at(row: &[f64], scale: usize, quantity: Quantity) -> f64 {
    row.get(QUANTITIES * scale + quantity as usize)
        .copied()
        .unwrap_or(f64::NAN)
}

/// The windows of all starts after the transient.
#[derive(Clone, Copy)]
struct LaterWindows<'a> {
    scales: usize,
    starts: &'a [Followed],
    first: usize,
}

impl LaterWindows<'_> {
    fn windows(&self) -> usize {
        let numbers = self.starts.first().map_or(0, |start| start.windows.len());
        numbers / (QUANTITIES * self.scales)
    }

    /// Computes a quantity of each window; returns one series per start.
    fn sums(&self, value: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
        let rows = |start: &Followed| {
            let rows = start.windows.chunks_exact(QUANTITIES * self.scales);
            rows.skip(self.first).map(&value).collect()
        };
        self.starts.iter().map(rows).collect()
    }

    /// Returns the energy of a scale in each window, averaged over the starts.
    fn energy_history(&self, scale: usize) -> Vec<f64> {
        let all = self.sums(|row| at(row, scale, Quantity::Energy));
        (0..self.windows() - self.first)
            .map(|window| {
                let energies = all.iter().filter_map(|energies| energies.get(window));
                energies.sum::<f64>() / self.starts.len() as f64
            })
            .collect()
    }

    /// Mean energy of a scale.
    fn mean(&self, scale: usize) -> f64 {
        let course = self.energy_history(scale);
        course.iter().sum::<f64>() / course.len() as f64
    }

    /// Returns the state of a scale; it is asleep if its mean energy is at most `least`.
    fn state(&self, scale: usize, least: f64) -> ScaleState {
        let mean = self.mean(scale);
        if mean <= least {
            return ScaleState::Asleep(mean);
        }
        match Average::of(&self.sums(|row| at(row, scale, Quantity::Energy))) {
            Ok(average) => ScaleState::Awake(average),
            Err(error) => ScaleState::Unsettled(error),
        }
    }

    /// Computes the power that passes into a scale and all younger ones.
    fn flux(&self, scale: usize) -> Result<Flux, StatisticsError> {
        let below = scale..self.scales;
        let lost = |row: &[f64]| {
            let power = |s| at(row, s, Quantity::Friction) + at(row, s, Quantity::Drive);
            -below.clone().map(power).sum::<f64>()
        };
        let given = |row: &[f64]| {
            below
                .clone()
                .map(|s| at(row, s, Quantity::Received))
                .sum::<f64>()
        };
        Ok(Flux {
            transferred: Average::of(&self.sums(given))?,
            dissipated: Average::of(&self.sums(lost))?,
            gap: Average::of(&self.sums(|row| given(row) - lost(row)))?,
            skewness: shape(self.starts, scale - 1, |moments| moments.skewness),
            flatness: shape(self.starts, scale - 1, |moments| moments.flatness),
        })
    }
}

/// Returns a moment of the distribution of a flux with its error; `None` for a single start.
fn shape(starts: &[Followed], flux: usize, of: impl Fn(Moments) -> f64) -> Option<Estimate> {
    let estimate = jackknife(starts.len(), |left_out| {
        let mut all = Density::default();
        for (index, start) in starts.iter().enumerate() {
            if let Some(own) = start.densities.get(flux)
                && Some(index) != left_out
            {
                all.add(own);
            }
        }
        of(all.moments())
    });
    estimate.ok()
}

/// Fits the power law E/n ∝ ℓ^p to the differences that are awake, with the energy E per degree of
/// freedom n and the length ℓ of the oldest links involved; `None` for fewer than three scales.
fn power_law(
    driven: &DrivenTree,
    scales: &[ScaleState],
    series: &LaterWindows<'_>,
) -> Option<PowerLaw> {
    let awake: Vec<(usize, Average)> = scales
        .iter()
        .enumerate()
        .skip(1)
        .filter_map(|(scale, state)| match state {
            ScaleState::Awake(average) => Some((scale, *average)),
            _ => None,
        })
        .collect();
    let lengths = awake
        .iter()
        .filter_map(|(scale, _)| driven.lengths.get(*scale));
    let lengths: Vec<f64> = lengths.map(|length| length.ln()).collect();
    let is_alike = lengths.windows(2).all(|pair| pair[0] == pair[1]);
    let is_measured = lengths.len() == awake.len() && lengths.iter().all(|l| l.is_finite());
    if awake.len() < 3 || is_alike || !is_measured {
        return None;
    }
    let weights: Vec<f64> = awake
        .iter()
        .map(|(_, a)| (a.mean / a.error).powi(2))
        .collect();
    let fit = |energies: &[f64]| {
        let logarithms = energies.iter().zip(&awake);
        let logarithms = logarithms
            .map(|(energy, (scale, _))| (energy / driven.degrees_of_freedom(*scale) as f64).ln());
        line(&weights, &lengths, &logarithms.collect::<Vec<_>>())
    };
    let means: Vec<Vec<f64>> = awake
        .iter()
        .map(|(scale, _)| {
            let energies = series.sums(|row| at(row, *scale, Quantity::Energy));
            let mean = |own: &Vec<f64>| own.iter().sum::<f64>() / own.len() as f64;
            energies.iter().map(mean).collect()
        })
        .collect();
    let exponent = jackknife(series.starts.len(), |left_out| {
        let energies = means.iter().map(|means| {
            let kept = means
                .iter()
                .enumerate()
                .filter(|(i, _)| Some(*i) != left_out);
            let (sum, number) = kept.fold((0.0, 0.0), |(sum, n), (_, mean)| (sum + mean, n + 1.0));
            sum / number
        });
        fit(&energies.collect::<Vec<f64>>()).0
    });
    let energies: Vec<f64> = awake.iter().map(|(_, average)| average.mean).collect();
    Some(PowerLaw {
        exponent: exponent.ok()?,
        misfit: fit(&energies).1,
    })
}

/// Returns the slope of the least-squares line, and its misfit.
fn line(weights: &[f64], x: &[f64], y: &[f64]) -> (f64, f64) {
    let sum = |value: &dyn Fn(usize) -> f64| -> f64 {
        weights
            .iter()
            .enumerate()
            .map(|(i, weight)| weight * value(i))
            .sum()
    };
    let total = sum(&|_| 1.0);
    let (x_mean, y_mean) = (sum(&|i| x[i]) / total, sum(&|i| y[i]) / total);
    let slope = sum(&|i| (x[i] - x_mean) * (y[i] - y_mean)) / sum(&|i| (x[i] - x_mean).powi(2));
    let misfit = sum(&|i| (y[i] - y_mean - slope * (x[i] - x_mean)).powi(2));
    (slope, misfit / (weights.len() - 2) as f64)
}
