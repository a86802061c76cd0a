//! Result of a fit.

use core::fmt;

use super::convergence::{Convergence, SearchFailure};
use super::error::IdentificationError;
use super::family::ImpossibleValue;
use super::identifiability::Identifiability;
use branched_pendulum::system::State;

/// Parameters that a record determines, with their errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The unknowns, in the order in which they were given; offsets of angles come last.
    pub estimates: Vec<ParameterEstimate>,
    /// Products of powers of parameters that the data determine, of those that they do not
    /// determine one by one.
    pub ratios: Vec<ParameterEstimate>,
    /// How the search ended: whether it converged, whether what is left over is the noise.
    pub convergence: Convergence,
    /// Combinations of them that the data determine, and changes that they leave open.
    pub identifiability: Identifiability,
    /// The frequencies that were measured, beside those of the model.
    pub frequencies: Vec<FittedFrequency>,
    /// Unknowns with other values by which frequencies alone are met as well, if some were found:
    /// parameters in the order of [`estimates`](Self::estimates).
    pub alternatives: Vec<Vec<f64>>,
    /// The states at the starts of the last stage's segments.
    pub starts: Vec<State<f64>>,
    /// The last time of the record that was fitted, s.
    pub(super) until: Option<f64>,
    /// The stages, from short segments to long ones.
    pub stages: Vec<StageReport>,
    /// Number of blocks of time from which the second kind of deviations is.
    pub blocks: usize,
    /// The first value found that no pendulum can have: a friction below zero says that the law of
    /// friction is another one, an inertia below zero that something is held where it is not.
    pub impossible: Option<ImpossibleValue>,
    /// Values of all parameters of the model.
    pub(super) values: Vec<f64>,
    /// Offset of each measured link, rad.
    pub(super) offsets: Vec<(String, f64)>,
}

/// An unknown that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterEstimate {
    /// Name of the parameter, or `offset of LINK`, or factors and divisors of a ratio.
    pub name: String,
    /// The value.
    pub value: f64,
    /// What the value stands on.
    pub standing: Standing,
    /// Standard deviation, as if errors of the angles were independent of each other. None
    /// for what is held, and infinite where nothing can be said.
    pub naive: Option<f64>,
    /// Standard deviation by how the estimate changes when blocks of the record are left
    /// out: the one to trust where what is left over is not white. With few blocks it
    /// belongs to Student's distribution of as many degrees of freedom, less one. None of
    /// frequencies alone, whose standard errors are known.
    pub by_blocks: Option<f64>,
}

impl ParameterEstimate {
    /// Returns the standard deviation to go by, the larger of the two: blocks see errors that
    /// are not independent, and are so few that they may find too little.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        let naive = self.naive?;
        Some(
            self.by_blocks
                .map_or(naive, |by_blocks| naive.max(by_blocks)),
        )
    }
}

/// What the value of an unknown stands on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The data alone.
    Determined,
    /// The data, and the values at which these others are held: as wrong as they are.
    GoesWith(Vec<String>),
    /// The value that the search had when the data turned out to leave it open, mostly the start.
    Held,
    /// A bound, beyond which the data would have it.
    AtBound,
}

/// A stage of a fit: segments of one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageReport {
    /// Number of segments.
    pub segments: usize,
    /// Length of a segment, s.
    pub length: f64,
    /// Root mean square of angles less data, rad.
    pub rms: f64,
    /// Number of steps.
    pub steps: usize,
}

impl Fit {
    /// Returns the value of an unknown.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<f64> {
        self.estimate(name).map(|estimate| estimate.value)
    }

    /// Returns an unknown that has a value of its own.
    ///
    /// # Errors
    ///
    /// [`IdentificationError::NotDetermined`] where others can change together with it of
    /// which the data show nothing, [`IdentificationError::UnknownParameter`].
    pub fn determined(&self, name: &str) -> Result<&ParameterEstimate, IdentificationError> {
        let names = || self.estimates.iter().map(|estimate| estimate.name.clone());
        let unknown = || IdentificationError::UnknownParameter {
            name: name.to_owned(),
            parameters: names().collect(),
        };
        let estimate = self.estimate(name).ok_or_else(unknown)?;
        let mut with = self.identifiability.together_with(name);
        match &estimate.standing {
            Standing::Determined | Standing::AtBound => return Ok(estimate),
            Standing::GoesWith(held) if with.is_empty() => with.clone_from(held),
            Standing::GoesWith(_) | Standing::Held => {}
        }
        Err(IdentificationError::NotDetermined {
            name: name.to_owned(),
            with,
        })
    }

    /// Values of all parameters of the model, in their order.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.values
    }

    /// Root mean square of angles less data in the last stage, rad; NaN of frequencies alone.
    #[must_use]
    pub fn rms(&self) -> f64 {
        self.stages.last().map_or(0.0, |stage| stage.rms)
    }

    /// Returns the offset of a link's angles, 0 where none was asked for.
    #[must_use]
    pub fn offset(&self, link: &str) -> f64 {
        let offset = self.offsets.iter().find(|(name, _)| name == link);
        offset.map_or(0.0, |(_, offset)| *offset)
    }

    /// Takes away what may be said of a result alone.
    pub(super) fn without_deviations(mut self) -> Self {
        for estimate in self.estimates.iter_mut().chain(&mut self.ratios) {
            (estimate.naive, estimate.by_blocks) = (None, None);
        }
        self
    }

    /// The states at the starts of the segments.
    pub(super) fn start_states(&self) -> Vec<Vec<f64>> {
        let states = self.starts.iter().map(|start| start.values.clone());
        states.collect()
    }

    fn estimate(&self, name: &str) -> Option<&ParameterEstimate> {
        self.estimates.iter().find(|estimate| estimate.name == name)
    }
}

/// Angles less data at every time, and link by link.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AngleErrors {
    /// Times, s.
    pub times: Vec<f64>,
    /// Names of the links.
    pub links: Vec<String>,
    /// Model less data (rad), a row a time; none where there are no data.
    pub rows: Vec<Vec<Option<f64>>>,
}

impl AngleErrors {
    /// Root mean square of all, rad.
    #[must_use]
    pub fn rms(&self) -> f64 {
        self.rms_between(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// Root mean square from a time on and before another, rad.
    #[must_use]
    pub fn rms_between(&self, from: f64, until: f64) -> f64 {
        let rows = self.times.iter().zip(&self.rows);
        let within = rows.filter(|(time, _)| (from..until).contains(*time));
        let errors = within.flat_map(|(_, row)| row.iter().flatten());
        let (sum, count) = errors.fold((0.0, 0_usize), |(sum, count), error| {
            (sum + error * error, count + 1)
        });
        (sum / count as f64).sqrt()
    }
}

/// A measured frequency beside that of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedFrequency {
    /// Number of its mode, 1 for the slowest of those that oscillate.
    pub mode: usize,
    /// The measured frequency, Hz.
    pub hertz: f64,
    /// Standard error of the measured frequency, Hz.
    pub deviation: f64,
    /// The frequency of the model, Hz.
    pub fitted: f64,
}

impl FittedFrequency {
    /// Returns by how many standard errors the model is above the datum.
    #[must_use]
    pub fn residual(&self) -> f64 {
        (self.fitted - self.hertz) / self.deviation
    }
}

/// What a search found that is no result: the best of it, without deviations.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfound {
    /// Why it is none.
    pub failure: SearchFailure,
    /// The time at which the links are released, where the record begins before, s.
    pub release: Option<f64>,
    /// The best that was found, without deviations.
    pub best: Fit,
}

impl fmt::Display for Unfound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no fit was found ({}): ", self.best.convergence)?;
        match self.failure {
            SearchFailure::Astray => write!(
                f,
                "the motion is another one than the record's; try other starts, shorter first \
                 segments, or a tree and a law of friction that are nearer to the real ones"
            ),
            SearchFailure::Lost { followed } => write!(
                f,
                "segments of {followed} s have the motion of the record, longer ones lose it, as \
                 they do where it is chaotic: keep to segments that are no longer"
            ),
            SearchFailure::Unsettled => write!(
                f,
                "the search has not come to its end; give more of the parameters, or go on from \
                 the best found"
            ),
            SearchFailure::Alone => write!(
                f,
                "every start ended elsewhere; try starts nearer to the truth, or give more of \
                 the parameters"
            ),
        }?;
        match self.release {
            Some(time) => write!(
                f,
                "; the links are held until {time} s, where the fit has to begin"
            ),
            None => Ok(()),
        }
    }
}
