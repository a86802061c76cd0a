//! The trait of candidates, with their names and the range of their settings.

use std::error::Error;
use std::fmt;

use branched_pendulum::system::State;

/// Receives states of the scene: index of the start, index of the time, values.
pub type Visit<'v> = dyn FnMut(usize, usize, &[f64]) + 'v;

/// A model with a method: computes the states of a scene at given times from its initial states.
///
/// [`Candidates`](super::Candidates) creates candidates from models and the methods of this crate;
/// others are implemented by hand.
///
/// # Examples
///
/// Small oscillations, written down:
///
/// ```
/// use branched_pendulum_advice::{Candidate, CandidateName, SettingRange, Visit};
/// use branched_pendulum::prelude::*;
/// use std::error::Error;
///
/// struct SmallOscillation;
///
/// impl Candidate for SmallOscillation {
///     fn name(&self) -> CandidateName {
///         CandidateName::new("linear", "exact", "f64")
///     }
///     fn settings(&self) -> SettingRange {
///         SettingRange::Fixed
///     }
///     fn run(&self, _: f64, starts: &[State<f64>], times: &[f64], visit: &mut Visit<'_>)
///         -> Result<u64, Box<dyn Error + Send + Sync>> {
///         for (index, start) in starts.iter().enumerate() {
///             for (number, time) in times.iter().enumerate() {
///                 let (sin, cos) = (time - start.time).sin_cos();
///                 let (angle, rate) = (start.values[0], start.values[1]);
///                 visit(index, number, &[angle * cos + rate * sin, rate * cos - angle * sin]);
///             }
///         }
///         Ok((starts.len() * times.len()) as u64)
///     }
/// }
/// ```
pub trait Candidate {
    /// Returns model, method and scalar of the candidate.
    fn name(&self) -> CandidateName;

    /// Returns the range of settings (tolerances or steps) of the candidate.
    fn settings(&self) -> SettingRange;

    /// Integrates from every start through all times, in any order of the starts, and passes the
    /// states of the *scene* to `visit`. Returns the number of steps.
    ///
    /// # Errors
    ///
    /// The reason why the last time is not reached.
    fn run(
        &self,
        setting: f64,
        starts: &[State<f64>],
        times: &[f64],
        visit: &mut Visit<'_>,
    ) -> Result<u64, Box<dyn Error + Send + Sync>>;

    /// Returns the lines of code that a user writes for this candidate: the entries of the
    /// attribute and the Rust expressions.
    fn to_write(&self, setting: f64) -> Vec<String> {
        let _ = setting;
        Vec::new()
    }
}

/// Name of a candidate, in the parts that tables show in separate columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CandidateName {
    /// Name of the model: `written out`, `in phase`, ….
    pub model: String,
    /// Name of the method.
    pub method: String,
    /// Name of the scalar type.
    pub scalar: &'static str,
    /// True if several starts are computed together, in the lanes of vector registers.
    pub in_lanes: bool,
}

impl CandidateName {
    /// Creates the name of a candidate that integrates one start after the other.
    pub fn new(model: impl Into<String>, method: impl Into<String>, scalar: &'static str) -> Self {
        Self {
            model: model.into(),
            method: method.into(),
            scalar,
            in_lanes: false,
        }
    }
}

impl fmt::Display for CandidateName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            model,
            method,
            scalar,
            in_lanes,
        } = self;
        let lanes = if *in_lanes { " in lanes" } else { "" };
        write!(f, "{model}, {method}, {scalar}{lanes}")
    }
}

/// The setting that determines accuracy and cost, with its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingRange {
    /// Tolerance of one step.
    Tolerance {
        /// Largest useful tolerance.
        coarsest: f64,
        /// Smallest useful tolerance.
        finest: f64,
    },
    /// Length of a step, in s.
    Step {
        /// Longest useful step.
        coarsest: f64,
        /// Shortest useful step.
        finest: f64,
    },
    /// The candidate has no setting.
    Fixed,
}

impl SettingRange {
    /// Returns the decimal logarithms of the coarsest and the finest setting.
    pub(crate) fn ends(self) -> (f64, f64) {
        match self {
            Self::Tolerance { coarsest, finest } | Self::Step { coarsest, finest } => {
                (coarsest.log10(), finest.log10())
            }
            Self::Fixed => (0.0, 0.0),
        }
    }

    /// Returns the difference of the logarithms of two settings whose costs differ by a few per
    /// cent.
    pub(crate) fn resolution(self) -> f64 {
        match self {
            Self::Tolerance { .. } => 0.1,
            Self::Step { .. } | Self::Fixed => 0.02,
        }
    }

    /// Returns the logarithm of the first setting to try for an error of at most `tolerance`, and
    /// the expected power of the setting in the error.
    pub(crate) fn guess(self, tolerance: f64) -> (f64, f64) {
        let (coarsest, finest) = self.ends();
        match self {
            // Along a motion, errors grow to some hundred times the tolerance of a step.
            Self::Tolerance { .. } => ((tolerance.log10() - 1.0).clamp(finest, coarsest), 1.0),
            Self::Step { .. } | Self::Fixed => (0.7 * coarsest + 0.3 * finest, 4.0),
        }
    }

    /// Returns the setting with this logarithm, rounded to the digits that are written.
    pub(crate) fn setting(self, logarithm: f64) -> f64 {
        let digits = match self {
            Self::Tolerance { .. } => 1,
            Self::Step { .. } => 2,
            Self::Fixed => return 1.0,
        };
        let text = format!("{:.digits$e}", 10.0_f64.powf(logarithm));
        text.parse().unwrap_or(f64::NAN)
    }

    /// Returns the setting as text.
    pub(crate) fn describe(self, setting: f64) -> String {
        match self {
            Self::Tolerance { .. } => format!("tolerance {setting:e}"),
            Self::Step { .. } => format!("steps of {setting} s"),
            Self::Fixed => String::from("as it is"),
        }
    }
}
