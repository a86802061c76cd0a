//! Result of a fit.

use core::fmt;

use super::convergence::{Convergence, SearchFailure};
use super::error::IdentificationError;
use super::family::ImpossibleValue;
use super::identifiability::Identifiability;
use super::record::AngleRecord;
use branched_pendulum::system::State;

/// Result of an identification: parameters with their errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The unknowns, in the order in which they were given, followed by the offsets of angles.
    pub estimates: Vec<ParameterEstimate>,
    /// Products of powers of parameters that the data determine although they do not determine the
    /// parameters individually.
    pub ratios: Vec<ParameterEstimate>,
    /// How the search ended: if it converged, and if the residuals are noise.
    pub convergence: Convergence,
    /// Combinations of the unknowns that the data determine, and changes that they leave open.
    pub identifiability: Identifiability,
    /// The measured frequencies, together with those of the model.
    pub frequencies: Vec<FittedFrequency>,
    /// Other sets of values that fit the frequencies equally well, if only frequencies were fitted
    /// and such sets were found; in the order of [`estimates`](Self::estimates).
    pub alternatives: Vec<Vec<f64>>,
    /// The initial states of the segments in the last stage.
    pub starts: Vec<State<f64>>,
    /// Last time of the fitted record, in s.
    pub(super) until: Option<f64>,
    /// The stages of the fit, from short segments to long ones.
    pub stages: Vec<StageReport>,
    /// Number of blocks of time from which the standard deviations by blocks are computed.
    pub blocks: usize,
    /// The first value found that is not physical. Negative friction means that the real friction
    /// law is different; a negative inertia means that a parameter is fixed at a wrong value.
    pub impossible: Option<ImpossibleValue>,
    /// Values of all parameters of the model, in order.
    pub(super) values: Vec<f64>,
    /// Offset of each measured link's angles, in rad.
    pub(super) offsets: Vec<(String, f64)>,
}

/// An unknown that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterEstimate {
    /// Name of the parameter; `offset of LINK`; or factors and divisors of a ratio.
    pub name: String,
    /// The value.
    pub value: f64,
    /// Evidence for the value.
    pub standing: Standing,
    /// Naive standard deviation, which assumes that errors of the angles are independent. `None`
    /// for fixed unknowns, infinite if the data do not limit the value.
    pub naive: Option<f64>,
    /// Standard deviation computed from the change of the estimate when blocks of the record are
    /// left out; it is the reliable one if residuals are not white. With few blocks, use Student's
    /// distribution with one degree of freedom less than blocks. `None` if only frequencies were
    /// fitted, whose standard errors are known.
    pub by_blocks: Option<f64>,
}

impl ParameterEstimate {
    /// Returns the standard deviation to use, which is the larger of the two: blocks account for
    /// errors that are not independent, but with few blocks the result may be too small.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        let naive = self.naive?;
        Some(
            self.by_blocks
                .map_or(naive, |by_blocks| naive.max(by_blocks)),
        )
    }
}

/// How the value of an unknown was determined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The data alone.
    Determined,
    /// By the data, together with the values at which these other unknowns are fixed; errors of
    /// those values affect this one.
    GoesWith(Vec<String>),
    /// Fixed by the search, because the data do not determine it; usually at its start value.
    Held,
    /// At a bound, because the data favour values beyond it.
    AtBound,
}

/// A stage of a fit, in which all segments have one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageReport {
    /// Number of segments.
    pub segments: usize,
    /// Length of a segment, s.
    pub length: f64,
    /// Root mean square of the residuals (angles of the model minus data), in rad.
    pub rms: f64,
    /// Number of steps.
    pub steps: usize,
}

impl Fit {
    /// Returns the value of an unknown by its name; `None` if there is none.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<f64> {
        self.estimate(name).map(|estimate| estimate.value)
    }

    /// Returns an unknown that the data determine individually.
    ///
    /// # Errors
    ///
    /// [`IdentificationError::NotDetermined`] if it can change together with others without effect
    /// on the data, and [`IdentificationError::UnknownParameter`].
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

    /// Returns the values of all parameters of the model, in order.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.values
    }

    /// Returns the root mean square of the residuals in the last stage, in rad; NaN if only
    /// frequencies were fitted.
    #[must_use]
    pub fn rms(&self) -> f64 {
        self.stages.last().map_or(0.0, |stage| stage.rms)
    }

    /// Returns the offset of a link's angles in rad; 0 if no offset was fitted.
    #[must_use]
    pub fn offset(&self, link: &str) -> f64 {
        let offset = self.offsets.iter().find(|(name, _)| name == link);
        offset.map_or(0.0, |(_, offset)| *offset)
    }

    /// Returns the friction coefficient that is negative by more than its error bar, if there is
    /// one. Such a fit has no standard deviations, because the real friction law is different.
    #[must_use]
    pub fn driving_friction(&self) -> Option<&ImpossibleValue> {
        let has_deviations = self.estimates.iter().any(|own| own.naive.is_some());
        self.impossible.as_ref().filter(|_| !has_deviations)
    }

    /// Removes the standard deviations, which are meaningful only for a valid result.
    pub(super) fn without_deviations(mut self) -> Self {
        for estimate in self.estimates.iter_mut().chain(&mut self.ratios) {
            (estimate.naive, estimate.by_blocks) = (None, None);
        }
        self
    }

    /// Returns the initial states of the segments.
    pub(super) fn start_states(&self) -> Vec<Vec<f64>> {
        let states = self.starts.iter().map(|start| start.values.clone());
        states.collect()
    }

    fn estimate(&self, name: &str) -> Option<&ParameterEstimate> {
        self.estimates.iter().find(|estimate| estimate.name == name)
    }
}

/// Errors of a model: its angles minus the data at every time, link by link.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AngleErrors {
    /// Times, s.
    pub times: Vec<f64>,
    /// Names of the links.
    pub links: Vec<String>,
    /// Model minus data (rad), one row per time; `None` where data are missing.
    pub rows: Vec<Vec<Option<f64>>>,
}

impl AngleErrors {
    /// Creates the error estimates of a record whose errors are unknown.
    #[must_use]
    pub fn missing(record: &AngleRecord) -> Self {
        let times = record.times().to_vec();
        Self {
            rows: vec![vec![None; record.links.len()]; times.len()],
            links: record.links.iter().map(|link| link.name.clone()).collect(),
            times,
        }
    }

    /// Returns the root mean square of all errors, in rad.
    #[must_use]
    pub fn rms(&self) -> f64 {
        self.rms_between(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// Returns the root mean square of the errors from one time up to another (exclusive), in rad.
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

/// A measured frequency, and the corresponding frequency of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedFrequency {
    /// Number of the mode; 1 is the slowest of the oscillating modes.
    pub mode: usize,
    /// The measured frequency, Hz.
    pub hertz: f64,
    /// Standard error of the measured frequency, Hz.
    pub deviation: f64,
    /// Frequency of the model, in Hz.
    pub fitted: f64,
}

impl FittedFrequency {
    /// Returns the model's frequency minus the measured one, in standard errors.
    #[must_use]
    pub fn residual(&self) -> f64 {
        (self.fitted - self.hertz) / self.deviation
    }
}

/// Result of a search that found no valid fit: the reason, and the best values (without standard
/// deviations).
#[derive(Clone, Debug, PartialEq)]
pub struct Unfound {
    /// Why it is none.
    pub failure: SearchFailure,
    /// Time at which the links are released, if the record begins before, in s.
    pub release: Option<f64>,
    /// The best values that were found, without standard deviations.
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
            SearchFailure::Exhausted => write!(
                f,
                "the search has made as many evaluations as a record of this size allows, which \
                 happens if the tree is another one, the unit of the angles is wrong, or the motion is \
                 chaotic; check these with a shorter part of the record, or give more of the parameters"
            ),
            SearchFailure::Interrupted => write!(f, "the search was interrupted"),
            SearchFailure::Unphysical => {
                match &self.best.impossible {
                    Some(impossible) => write!(f, "{impossible}")?,
                    None => write!(f, "the constants are not physical")?,
                }
                write!(
                    f,
                    "; give more of the parameters, since one that is known may be wrong, or try a \
                     tree that is nearer to the real one"
                )
            }
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
