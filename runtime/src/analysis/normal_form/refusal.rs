//! Reasons why a normal form makes no prediction.

use crate::errors::errors;

errors! {
    /// Reason why the normal form makes no prediction for a motion.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum Refusal {
        /// The results of the two degrees differ by too much.
        NotConverged {
            /// The lower degree.
            lower: u32,
            /// The higher degree.
            degree: u32,
            /// Name of the frequency.
            mode: String,
            /// Difference between the degrees, Hz.
            difference_hz: f64,
        } => "the series does not converge at this amplitude: {mode} differs by \
            {difference_hz:.2e} Hz between degrees {lower} and {degree}",
        /// The resonances have no common rotating frame in which all of them are slow.
        Resonances {
            /// Names of the resonances.
            names: String,
        } => "several resonances act at once: {names}; help: use a smaller bound of kept \
            resonances",
        /// The averaged motion has no period, or a long one.
        NoReturn {
            /// Names of the resonances.
            names: String,
            /// Longest period accepted, s.
            time: f64,
        } => "the motion in phase under {names} does not return within {time} s",
        /// A resonance that is not kept becomes a near one at this amplitude.
        Approached {
            /// Name of the resonance.
            name: String,
            /// Mismatch of the resonance at this amplitude, Hz.
            mismatch_hz: f64,
        } => "at this amplitude the mismatch of {name}, which is not kept, is only \
            {mismatch_hz:.2e} Hz; help: use a larger bound of kept resonances",
        /// Differences grow by one of the two degrees alone, on a whole interval of releases.
        OneDegree => "differences grow here by one of the two highest degrees alone",
        /// A computation on the way failed.
        Failed {
            /// The reason.
            reason: String,
        } => "the normal form makes no prediction: {reason}",
        /// The state contains an infinite or NaN number.
        NotFinite => "the state contains an infinite number or NaN",
    }
}

impl std::error::Error for Refusal {}
