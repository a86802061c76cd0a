//! How a search ended, and whether its result is one.

use core::fmt;

/// Residual, in deviations of the noise, up to which it is the noise's.
const NOISE: f64 = 1.5;
/// Residuals of two starts that ended alike differ by no more than this share.
const ALIKE: f64 = 0.01;
/// Part of the motion that a residual may be at most while segments are made longer, and in
/// the end. A turn is seen as a radian is, so that a motion counts no more than that.
const FOLLOWED: f64 = 0.25;
const GOOD: f64 = 0.05;
/// Growth of the residual, where a segment becomes twice as long, beyond which the motion is
/// lost: a torque that the model lacks takes a regular one four times as far.
const GROWTH: f64 = 6.0;
/// Distance from the minimum, in deviations, at which a search is at its end.
const SETTLED: f64 = 0.5;
/// Residual, of the motion, that integration leaves.
pub(super) const ROUNDING: f64 = 1e-7;

/// How a search has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Root mean square of angles less data, rad.
    pub rms: f64,
    /// Root mean square of the data's errors, rad: of what is not smooth in the record, or in
    /// what is left over of it.
    pub noise: f64,
    /// Root mean square of the motion about its mean, rad; 1 at most.
    pub swing: f64,
    /// Distance from the minimum by one step more, in naive deviations.
    pub distance: f64,
    /// Number of starts that were tried.
    pub starts: usize,
    /// Number of starts that ended in the same minimum.
    pub agreed: usize,
}

impl Convergence {
    /// The convergence of a search that has not begun.
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

    /// Returns how many times the noise the residual is.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.rms / self.noise
    }

    /// Returns whether the residual is the noise's.
    #[must_use]
    pub fn is_noise(&self) -> bool {
        self.rms <= f64::max(NOISE * self.noise, ROUNDING * self.swing)
    }

    /// Returns whether one step more would change little beside the deviations.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.distance <= SETTLED
    }

    /// The convergence with this residual, of which so much changes from one time to the next.
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

    /// Whether segments with this residual may become longer.
    pub(super) fn is_followed(&self) -> bool {
        self.is_noise() || self.rms <= FOLLOWED * self.swing
    }

    /// Whether segments twice as long still have the motion of those with this residual.
    pub(super) fn is_kept(&self, longer: &Self) -> bool {
        let before = self.rms.max(NOISE * self.noise);
        longer.is_noise() || (longer.is_followed() && longer.rms <= GROWTH * before)
    }

    /// Whether a start with this residual ended where the best one did.
    pub(super) fn is_alike(&self, rms: f64) -> bool {
        rms <= (self.rms * (1.0 + ALIKE)).max(ROUNDING * self.swing)
    }

    /// Why what was found is no result, if it is none.
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

/// Why a search found nothing that stands.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SearchFailure {
    /// The motion that was found is another one than that of the record.
    Astray,
    /// Segments of one length have the motion of the record, longer ones have lost it.
    Lost {
        /// Length of segments that have it, s.
        followed: f64,
    },
    /// The search ended before it was at a minimum.
    Unsettled,
    /// Every start ended elsewhere.
    Alone,
}

/// A number with three digits, as sentences have it.
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
