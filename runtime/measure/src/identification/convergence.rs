//! How a search ended, and if its result is valid.

use core::fmt;

/// Largest residual, in standard deviations of the noise, that noise can explain.
const NOISE: f64 = 1.5;
/// Largest relative difference between the residuals of two starts that ended in the same minimum.
const SAME_MINIMUM: f64 = 0.01;
/// Largest residual relative to the size of the motion, while segments are lengthened and in the
/// end. The size of a motion that turns over counts as 1 rad.
const FOLLOWED: f64 = 0.25;
const GOOD: f64 = 0.05;
/// Growth of the residual, when a segment becomes twice as long, above which the motion is lost. A
/// torque that the model lacks makes the residual of a regular motion four times as large.
const GROWTH: f64 = 6.0;
/// Distance from the minimum, in standard deviations, at which a search has converged.
const SETTLED: f64 = 0.5;
/// Residual, relative to the motion, that is caused by the integration.
pub(super) const ROUNDING: f64 = 1e-7;

/// How a search has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Root mean square of the residuals (angles of the model minus data), in rad.
    pub rms: f64,
    /// Root mean square of the data's errors, in rad, estimated from the part of the record, or of
    /// its residuals, that is not smooth.
    pub noise: f64,
    /// Root mean square of the motion about its mean, in rad; at most 1.
    pub swing: f64,
    /// Distance from the minimum, as the length of one more step, in naive standard deviations.
    pub distance: f64,
    /// Number of starts that were tried.
    pub starts: usize,
    /// Number of starts that ended in the same minimum.
    pub agreed: usize,
}

impl Convergence {
    /// Returns the convergence of a search that has not begun.
    pub(super) fn before(noise: f64, swing: f64) -> Self {
        Self {
            rms: f64::NAN,
            noise,
            swing,
            distance: 0.0,
            starts: 1,
            agreed: 1,
        }
    }

    /// Returns the ratio of the residual to the noise.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.rms / self.noise
    }

    /// Returns true if the residual is explained by noise.
    #[must_use]
    pub fn is_noise(&self) -> bool {
        self.rms <= f64::max(NOISE * self.noise, ROUNDING * self.swing)
    }

    /// Returns true if one more step would be small compared with the standard deviations.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.distance <= SETTLED
    }

    /// Returns the convergence with this residual; `rough` is the part of it that changes from one
    /// time to the next.
    pub(super) fn with_residual(&self, rms: f64, rough: f64) -> Self {
        let is_small = rough <= GOOD * self.swing;
        Self {
            rms,
            noise: if is_small {
                self.noise.max(rough)
            } else {
                self.noise
            },
            ..*self
        }
    }

    /// Returns true if the residual is small enough for segments to be lengthened.
    pub(super) fn is_followed(&self) -> bool {
        self.is_noise() || self.rms <= FOLLOWED * self.swing
    }

    /// Returns true if segments of twice the length still fit the same motion.
    pub(super) fn is_kept(&self, longer: &Self) -> bool {
        let before = self.rms.max(NOISE * self.noise);
        longer.is_noise() || (longer.is_followed() && longer.rms <= GROWTH * before)
    }

    /// Returns true if a start with this residual ended in the same minimum as the best one.
    pub(super) fn is_same_minimum(&self, rms: f64) -> bool {
        rms <= (self.rms * (1.0 + SAME_MINIMUM)).max(ROUNDING * self.swing)
    }

    /// Returns the reason why the result is not valid; `None` if it is.
    pub(super) fn failure(&self) -> Option<SearchFailure> {
        if self.is_noise() && self.is_settled() {
            return None;
        }
        if !self.is_noise() && self.rms > GOOD * self.swing {
            return Some(SearchFailure::Astray);
        }
        if !self.is_settled() {
            return Some(SearchFailure::Unsettled);
        }
        (self.starts > 1 && self.agreed < 2).then_some(SearchFailure::Alone)
    }
}

impl fmt::Display for Convergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ended = match self.is_settled() {
            true => "converged",
            false => "not converged",
        };
        let [rms, noise] = [self.rms, self.noise].map(|value| 1e3 * value);
        match (self.noise > 0.0, self.is_noise()) {
            (false, _) => write!(f, "{ended}")?,
            (_, true) => write!(f, "{ended}; residual {rms:.3} mrad is the noise's")?,
            (_, false) => write!(
                f,
                "{ended}; residual {rms:.3} mrad, {} times the noise",
                digits(rms / noise)
            )?,
        }
        let Self { starts, agreed, .. } = self;
        write!(f, "; {agreed} of {starts} starts agree")
    }
}

/// Reason why a search has no valid result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SearchFailure {
    /// The motion that was found differs from that of the record.
    Astray,
    /// Segments of one length fit the motion of the record, but longer ones do not.
    Lost {
        /// Length of the segments that fit, in s.
        followed: f64,
    },
    /// The search ended before it reached a minimum.
    Unsettled,
    /// Every start ended elsewhere.
    Alone,
    /// The search has done as much work as the size of the record allows.
    Exhausted,
    /// The observer of the search has ended it.
    Interrupted,
    /// The constants found are not physical ([`Fit::impossible`](super::Fit::impossible)).
    Unphysical,
}

/// Formats a number with three digits, for sentences.
pub(super) fn digits(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if !value.is_finite() => format!("{value}"),
        _ if size >= 1e4 => format!("{value:.0e}"),
        _ if size >= 100.0 => format!("{value:.0}"),
        _ if size >= 10.0 => format!("{value:.1}"),
        _ if size >= 0.01 || size == 0.0 => format!("{value:.2}"),
        _ => format!("{value:.1e}"),
    }
}
