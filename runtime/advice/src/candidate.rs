//! Things that go from a state to states at given times, and the number that decides
//! about their accuracy.

use std::error::Error;
use std::fmt;

use branched_pendulum::system::State;

/// Receives states of the scene: index of the start, index of the time, values.
pub type Visit<'v> = dyn FnMut(usize, usize, &[f64]) + 'v;

/// A way to go from states of a scene to its states at given times: a model with a
/// method, whatever both are.
///
/// [`Candidates`](super::Candidates) makes them of models and of the methods of this
/// crate; others are implemented by hand.
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
    /// Returns the parts of the candidate.
    fn name(&self) -> CandidateName;

    /// The numbers that may be chosen for it.
    fn settings(&self) -> SettingRange;

    /// Follows every start through all times, in whatever order, and hands the states of
    /// the *scene* to `visit`. Returns the number of steps.
    ///
    /// # Errors
    ///
    /// Why it does not reach the last time.
    fn run(
        &self,
        setting: f64,
        starts: &[State<f64>],
        times: &[f64],
        visit: &mut Visit<'_>,
    ) -> Result<u64, Box<dyn Error + Send + Sync>>;

    /// Lines to write for it, in the attribute and in Rust.
    fn to_write(&self, setting: f64) -> Vec<String> {
        let _ = setting;
        Vec::new()
    }
}

/// Parts of a candidate, as tables show them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CandidateName {
    /// Model: `written out`, `in phase`, …
    pub model: String,
    /// Method.
    pub method: String,
    /// Scalar.
    pub scalar: &'static str,
    /// True if several starts go at once, in the lanes of vector registers.
    pub in_lanes: bool,
}

impl CandidateName {
    /// A candidate that takes one start after the other.
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

/// The number that decides about accuracy and cost, and where it may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingRange {
    /// Tolerance of one step.
    Tolerance {
        /// Largest that makes sense.
        coarsest: f64,
        /// Smallest that makes sense.
        finest: f64,
    },
    /// Length of a step, s.
    Step {
        /// Longest that makes sense.
        coarsest: f64,
        /// Shortest that makes sense.
        finest: f64,
    },
    /// None: the candidate is as it is.
    Fixed,
}

impl SettingRange {
    /// Decimal logarithms of the coarsest and the finest setting.
    pub(crate) fn ends(self) -> (f64, f64) {
        match self {
            Self::Tolerance { coarsest, finest } | Self::Step { coarsest, finest } => {
                (coarsest.log10(), finest.log10())
            }
            Self::Fixed => (0.0, 0.0),
        }
    }

    /// Distance of two settings, as that of their logarithms, between which costs hardly
    /// differ: by some per cent.
    pub(crate) fn resolution(self) -> f64 {
        match self {
            Self::Tolerance { .. } => 0.1,
            Self::Step { .. } | Self::Fixed => 0.02,
        }
    }

    /// Where to begin for a largest error of `tolerance`, and the power of the setting
    /// that errors are expected to go with.
    pub(crate) fn guess(self, tolerance: f64) -> (f64, f64) {
        let (coarsest, finest) = self.ends();
        match self {
            // Errors grow along the way by some hundred times the tolerance of a step.
            Self::Tolerance { .. } => ((tolerance.log10() - 1.0).clamp(finest, coarsest), 1.0),
            Self::Step { .. } | Self::Fixed => (0.7 * coarsest + 0.3 * finest, 4.0),
        }
    }

    /// The setting with this logarithm, in as many digits as are written.
    pub(crate) fn setting(self, logarithm: f64) -> f64 {
        let digits = match self {
            Self::Tolerance { .. } => 1,
            Self::Step { .. } => 2,
            Self::Fixed => return 1.0,
        };
        let text = format!("{:.digits$e}", 10.0_f64.powf(logarithm));
        text.parse().unwrap_or(f64::NAN)
    }

    /// A setting, as one says it.
    pub(crate) fn describe(self, setting: f64) -> String {
        match self {
            Self::Tolerance { .. } => format!("tolerance {setting:e}"),
            Self::Step { .. } => format!("steps of {setting} s"),
            Self::Fixed => String::from("as it is"),
        }
    }
}
