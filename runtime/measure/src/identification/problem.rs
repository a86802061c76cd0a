//! Known and unknown parameters, and how the unknown ones are looked for.

use std::ops::Range;

use super::family::Family;
use super::frequencies::Frequency;
use super::least_squares::{DAMPING, FitStage};
use super::start::SmoothedRecord;
use super::task::FitTask;

/// Parameters to be found, of a family of models.
#[derive(Clone, Debug)]
pub struct Identification<F> {
    pub(super) family: F,
    pub(super) known: Vec<(String, f64)>,
    pub(super) unknown: Vec<StartValue>,
    /// Least values of unknowns.
    pub(super) least: Vec<(String, f64)>,
    pub(super) offsets: bool,
    pub(super) frequencies: Vec<Frequency>,
    pub(super) shooting: Shooting,
}

/// Where an unknown starts.
#[derive(Clone, Debug)]
pub(super) struct StartValue {
    pub(super) name: String,
    pub(super) value: f64,
    pub(super) scale: f64,
}

/// How a record is cut into segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shooting {
    /// Length of the first segments, s: a period or so.
    pub first: f64,
    /// Length that segments are not doubled beyond, s. Without a bound one motion covers the
    /// record in the end.
    pub longest: f64,
    /// Jump of an angle from a segment to the next that is worth one deviation, in mean
    /// deviations of the data; of velocities that of angles times the motion's own frequency.
    pub jump: f64,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Length of the blocks by which deviations are told, s: longer than what is left over
    /// stays alike. Without it a thirtieth of the record.
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
    /// The models of a family, of whose parameters nothing is said as yet.
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

    /// Gives the value of a parameter.
    #[must_use]
    pub fn known(mut self, name: &str, value: f64) -> Self {
        self.known.push((name.to_owned(), value));
        self
    }

    /// Gives the value from which a parameter is searched for: 30 % off is near enough.
    /// From 0 it needs a scale: [`unknown_from_zero`](Self::unknown_from_zero).
    #[must_use]
    pub fn unknown(self, name: &str, value: f64) -> Self {
        self.start(name, value, value.abs())
    }

    /// Searches for a parameter from 0; `scale` is the size that it may have.
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

    /// Searches for an unknown among values that are no less than this one: friction that does
    /// not drive, say. Where the data would have it smaller it ends there
    /// ([`Standing::AtBound`](super::Standing::AtBound)).
    #[must_use]
    pub fn at_least(mut self, name: &str, value: f64) -> Self {
        self.least.push((name.to_owned(), value));
        self
    }

    /// Searches for the zero of each measured link's angles, too: an angle of the record is
    /// that of the model and its `offset of LINK`, which is half a turn at most.
    #[must_use]
    pub fn with_offsets(mut self) -> Self {
        self.offsets = true;
        self
    }

    /// Adds a measured frequency of a small motion about the place where the tree rests. Beside a
    /// record it weighs by its standard error, and the angles by what is left over of them.
    #[must_use]
    pub fn with_frequency(mut self, frequency: Frequency) -> Self {
        self.frequencies.push(frequency);
        self
    }

    /// Cuts the record in another way.
    #[must_use]
    pub fn with_shooting(mut self, shooting: Shooting) -> Self {
        self.shooting = shooting;
        self
    }

    /// Segments with these states at their starts.
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

    /// Weights of jumps: angles by the deviation of the data, velocities by that times the
    /// motion's own frequency.
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
