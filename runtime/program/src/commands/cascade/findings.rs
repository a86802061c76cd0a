//! Averages over all starts, with their errors.

use branched_pendulum::analysis::statistics::{
    Average, Drift, Estimate, StatisticsError, jackknife, transient,
};

use super::density::{Density, Moments};
use super::motion::{Followed, QUANTITIES};
use super::tree::DrivenTree;

/// A scale sleeps if a degree of freedom of it has less than this part of the energy of
/// one of the means: too much friction, or too short a run to wake it.
const ASLEEP: f64 = 1e-6;

/// Which quantity of a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Energy, J.
    Energy,
    /// Power that the other scales give, W.
    Received,
    /// Power of the friction, W.
    Friction,
    /// Power of the motor, W.
    Drive,
}

/// Largest error bar of a balance that says something, in parts of the motor's power.
const LARGEST_BAR: f64 = 0.1;

/// What the powers of motor and friction say of the integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Balance {
    /// The powers are equal within three error bars, of a tenth of the motor's power at most.
    Closed,
    /// The powers differ by more than three error bars: the steps are too long.
    Lost,
    /// The error bars are too wide to say, or there are none.
    Undecided,
}

/// The state of a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScaleState {
    /// Energy of the scale, J, in the steady state.
    Awake(Average),
    /// It hardly moves: its mean energy, J.
    Asleep(f64),
    /// The energy has no average, and why.
    Unsettled(StatisticsError),
}

/// Power that passes into a scale and all younger ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flux {
    /// By the integral of W along the motion, W.
    pub transferred: Average,
    /// Power of friction there less that of the motor, W.
    pub dissipated: Average,
    /// The first less the second: the rate of the energy there, which has no mean.
    pub gap: Average,
    /// Skewness of the density of W.
    pub skewness: Option<Estimate>,
    /// Flatness of the density of W.
    pub flatness: Option<Estimate>,
}

/// A line through logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Slope of ln(energy per degree of freedom) against ln(length of the links).
    pub exponent: Estimate,
    /// Sum of the squares of the deviations from the line in units of their errors, over
    /// the number of points less two. Far above 1 there is no power law.
    pub misfit: f64,
}

/// Averages over all starts.
#[derive(Clone, Debug)]
pub struct Findings {
    /// Windows that were left out of all averages, by MSER-5 of the mean energy.
    pub transient: Result<usize, StatisticsError>,
    /// Mean energy over all starts, window by window, by scale, J.
    pub course: Vec<Vec<f64>>,
    /// Drift of the energy after the transient.
    pub drift: Result<Drift, StatisticsError>,
    /// The scales, from the means on.
    pub scales: Vec<ScaleState>,
    /// Power of the motor, W.
    pub input: Result<Average, StatisticsError>,
    /// Power of all friction, W, positive.
    pub dissipation: Result<Average, StatisticsError>,
    /// The one less the other, W: what the steps of the integrator have lost.
    pub loss: Result<Average, StatisticsError>,
    /// Powers that pass into scale s and all younger ones, s = 1, 2, ….
    pub fluxes: Vec<Result<Flux, StatisticsError>>,
    /// Densities of the fluxes.
    pub densities: Vec<Density>,
    /// Energy per degree of freedom of the differences, against length.
    pub law: Option<PowerLaw>,
}

impl Findings {
    /// Evaluates the windows of all starts.
    pub fn new(driven: &DrivenTree, starts: &[Followed]) -> Self {
        let series = LaterWindows {
            scales: driven.generations(),
            starts,
            first: 0,
        };
        let course: Vec<Vec<f64>> = (0..series.scales)
            .map(|scale| series.course(scale))
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
        Self {
            drift: Drift::of(&energy),
            input: Average::of(&of(Quantity::Drive, all.clone(), 1.0)),
            loss: Average::of(&series.sums(|row| {
                let power = |s| at(row, s, Quantity::Friction) + at(row, s, Quantity::Drive);
                all.clone().map(power).sum::<f64>()
            })),
            dissipation: Average::of(&of(Quantity::Friction, all, -1.0)),
            fluxes: fluxes.collect(),
            law: power_law(driven, &scales, &series),
            transient,
            course,
            scales,
            densities,
        }
    }

    /// Mean energy of all scales together behind the transient, J.
    pub fn energy(&self) -> f64 {
        let windows = self.course.first().map_or(0, Vec::len);
        let first = self.transient.unwrap_or(windows / 2).min(windows);
        let sums = self
            .course
            .iter()
            .map(|energies| energies[first..].iter().sum::<f64>());
        sums.sum::<f64>() / (windows - first).max(1) as f64
    }

    /// Returns whether friction takes what the motor gives.
    pub fn balance(&self) -> Balance {
        match (&self.loss, &self.input) {
            (Ok(loss), _) if loss.mean.abs() > 3.0 * loss.error => Balance::Lost,
            (Ok(loss), Ok(input)) if loss.error <= LARGEST_BAR * input.mean.abs() => {
                Balance::Closed
            }
            _ => Balance::Undecided,
        }
    }

    /// True if the transient has ended and the energy does not drift.
    pub fn is_steady(&self) -> bool {
        self.transient.is_ok() && self.drift.is_ok_and(|drift| drift.is_within(2.0))
    }
}

/// A quantity in a row of means.
fn at(row: &[f64], scale: usize, quantity: Quantity) -> f64 {
    row.get(QUANTITIES * scale + quantity as usize)
        .copied()
        .unwrap_or(f64::NAN)
}

/// Windows of the starts from one on.
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

    /// A function of each window, one series a start.
    fn sums(&self, value: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
        let rows = |start: &Followed| {
            let rows = start.windows.chunks_exact(QUANTITIES * self.scales);
            rows.skip(self.first).map(&value).collect()
        };
        self.starts.iter().map(rows).collect()
    }

    /// Energies of a scale, averaged over the starts.
    fn course(&self, scale: usize) -> Vec<f64> {
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
        let course = self.course(scale);
        course.iter().sum::<f64>() / course.len() as f64
    }

    /// The state of a scale, which sleeps where its mean energy is at most `least`.
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

    /// Power that passes into a scale and all younger ones.
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

/// A moment of the density of a flux; none of a single start.
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

/// The law E/n ∝ ℓ^p of the differences that are awake, ℓ the length of the oldest links that take
/// part, if there are three.
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

/// Slope of the line of least squares, and its misfit.
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
