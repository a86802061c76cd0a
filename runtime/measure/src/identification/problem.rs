//! Known and unknown parameters, and the settings of the search for the unknown ones.

use std::ops::Range;

use super::family::Family;
use super::frequencies::Frequency;
use super::least_squares::{DAMPING, FitStage};
use super::start::SmoothedRecord;
use super::task::FitTask;

/// Identification of the parameters of a family of models.
#[derive(Clone, Debug)]
pub struct Identification<F> {
    pub(super) family: F,
    pub(super) known: Vec<(String, f64)>,
    pub(super) unknown: Vec<StartValue>,
    /// Lower bounds of unknown parameters, by name.
    pub(super) least: Vec<(String, f64)>,
    pub(super) offsets: bool,
    pub(super) frequencies: Vec<Frequency>,
    pub(super) shooting: Shooting,
}

/// Value at which the search for an unknown starts.
#[derive(Clone, Debug)]
pub(super) struct StartValue {
    pub(super) name: String,
    pub(super) value: f64,
    pub(super) scale: f64,
}

/// Division of a record into segments for multiple shooting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shooting {
    /// Length of the first segments, s: about one period.
    pub first: f64,
    /// Length up to which segments are doubled, s. If it is infinite, one motion finally covers the
    /// whole record.
    pub longest: f64,
    /// Jump of an angle between two segments that counts as one standard deviation, relative to the
    /// mean standard deviation of the data; jumps of velocities are divided by the frequency of the
    /// motion first.
    pub jump: f64,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Length of the blocks of time from which standard deviations are computed, s: it must exceed
    /// the correlation time of the residuals. `None` is a thirtieth of the record.
    pub block: Option<f64>,
}

impl Default for Shooting {
    fn default() -> Self {
        Self {
            first: 1.0,
            longest: f64::INFINITY,
            jump: 10.0,
            tolerance: 1e-10,
            block: None,
        }
    }
}

impl<F: Family> Identification<F> {
    /// Creates an identification in a family of models, with neither known nor unknown parameters.
    pub fn new(family: F) -> Self {
        Self {
            family,
            known: Vec::new(),
            unknown: Vec::new(),
            least: Vec::new(),
            offsets: false,
            frequencies: Vec::new(),
            shooting: Shooting::default(),
        }
    }

    /// Sets the value of a known parameter.
    #[must_use]
    pub fn known(mut self, name: &str, value: f64) -> Self {
        self.known.push((name.to_owned(), value));
        self
    }

    /// Sets the value at which the search for an unknown parameter starts; an error of 30 % is
    /// acceptable. A search from 0 needs a scale: [`unknown_from_zero`](Self::unknown_from_zero).
    #[must_use]
    pub fn unknown(self, name: &str, value: f64) -> Self {
        self.start(name, value, value.abs())
    }

    /// Adds an unknown parameter whose search starts at 0; `scale` is its expected size.
    #[must_use]
    pub fn unknown_from_zero(self, name: &str, scale: f64) -> Self {
        self.start(name, 0.0, scale)
    }

    fn start(mut self, name: &str, value: f64, scale: f64) -> Self {
        self.unknown.push(StartValue {
            name: name.to_owned(),
            value,
            scale,
        });
        self
    }

    /// Restricts an unknown to values of at least `value`: friction that must not drive, for
    /// example. If the data favour smaller values, the search ends at the bound
    /// ([`Standing::AtBound`](super::Standing::AtBound)).
    #[must_use]
    pub fn at_least(mut self, name: &str, value: f64) -> Self {
        self.least.push((name.to_owned(), value));
        self
    }

    /// Also fits an offset for each measured link: an angle of the record is the model's angle plus
    /// `offset of LINK`, which is at most half a turn.
    #[must_use]
    pub fn with_offsets(mut self) -> Self {
        self.offsets = true;
        self
    }

    /// Adds a measured frequency of a small motion about the equilibrium. Together with a record,
    /// the frequency is weighted by its standard error, and the angles by their residuals.
    #[must_use]
    pub fn with_frequency(mut self, frequency: Frequency) -> Self {
        self.frequencies.push(frequency);
        self
    }

    /// Sets the division of the record into segments.
    #[must_use]
    pub fn with_shooting(mut self, shooting: Shooting) -> Self {
        self.shooting = shooting;
        self
    }

    /// Creates a stage of a search from segments with these initial states.
    pub(super) fn stage(
        &self,
        task: &FitTask<'_>,
        smoothed: &SmoothedRecord,
        segments: Vec<Range<usize>>,
        starts: Vec<Vec<f64>>,
        globals: Vec<f64>,
    ) -> FitStage {
        FitStage {
            junction: self.junction(task, &starts),
            spread: task.spread(smoothed),
            segments,
            starts,
            globals,
            free: (0..task.names.len()).collect(),
            damping: DAMPING,
        }
    }

    /// Returns the weights of jumps between segments: for angles from the standard deviation of the
    /// data, for velocities from that times the frequency of the motion.
    fn junction(&self, task: &FitTask<'_>, starts: &[Vec<f64>]) -> Vec<f64> {
        let links = task.dimension / 2;
        let weights: f64 = task.links.iter().map(|link| link.weight).sum();
        let weight = weights / task.links.len().max(1) as f64 / self.shooting.jump;
        let square = |of: fn(&[f64], usize) -> &[f64]| {
            let values = starts.iter().flat_map(|start| of(start, links));
            values.map(|value| value * value).sum::<f64>()
        };
        let (angles, velocities) = (square(|s, n| &s[..n]), square(|s, n| &s[n..]));
        let frequency = match angles > 0.0 && velocities > 0.0 {
            true => (velocities / angles).sqrt(),
            false => 1.0,
        };
        let weight = |component| {
            if component < links {
                weight
            } else {
                weight / frequency
            }
        };
        (0..task.dimension).map(weight).collect()
    }
}
