//! How long a motion is determined by its start.

use branched_pendulum::system::State;

use super::Arguments;
use crate::Failure;
use crate::motion::{SampledMotion, horizon};
use crate::subject::Subject;

/// Difference (degrees) between two runs from which on an angle counts as lost.
const LOST: f64 = 10.0;

/// Comparison of a motion with a run at a tighter tolerance.
pub(super) struct Determined {
    /// First time (s), of the rows and of the ends of steps, at which angles differ by more than the
    /// precision.
    pub(super) until: Option<f64>,
    /// First time (s) at which angles differ by more than [`LOST`].
    lost: Option<f64>,
    /// Differences at the end, in degrees; `None` if angles are lost before.
    at_end: Option<Vec<f64>>,
}

impl Determined {
    pub(super) fn of(
        arguments: &Arguments,
        subject: &Subject,
        start: &State<f64>,
        samples: &SampledMotion,
    ) -> Result<Self, Failure> {
        let precisions = [arguments.precision, LOST].map(f64::to_radians);
        let found = horizon(subject, &arguments.method, start, samples, &precisions)?;
        let in_degrees = |all: Vec<f64>| all.into_iter().map(f64::to_degrees).collect();
        // Ends of steps have many digits, of which few matter.
        let exceeded = |index: usize| found.exceeded.get(index).copied().flatten();
        let rounded = |time: f64| (1e4 * time).floor() / 1e4;
        Ok(Self {
            until: exceeded(0).map(rounded),
            lost: exceeded(1).map(rounded),
            at_end: found
                .at_end
                .filter(|_| found.exceeded.get(1) == Some(&None))
                .map(in_degrees),
        })
    }

    /// Returns the error of a link's angle at the end in degrees, but at least 1e-7; `None` if the
    /// angle is lost.
    pub(super) fn error_at_end(&self, link: usize) -> Option<f64> {
        let error = self.at_end.as_ref()?.get(link)?;
        Some(error.max(1e-7))
    }

    pub(super) fn in_words(&self, arguments: &Arguments, subject: &Subject) -> String {
        let method = arguments.method.method(&subject.tree);
        let setting = arguments.method.setting(method);
        let finer = match method.is_adaptive() {
            true => format!("a tolerance of {:e}", method.finer(setting)),
            false => format!("steps of {} s", method.finer(setting)),
        };
        let precision = arguments.precision;
        match (self.until, self.lost) {
            (None, _) => {
                format!("a second run with {finer} agrees to {precision}° at all times\n")
            }
            (Some(until), None) => {
                let most = self
                    .at_end
                    .iter()
                    .flatten()
                    .fold(0.0, |most, x| f64::max(most, *x));
                format!(
                    "a second run with {finer} differs by more than {precision}° from {until} s \
                     on, and by {most:.1e}° at the end; help: lower `--tolerance`, or state by \
                     `--precision` which error does not matter\n"
                )
            }
            (Some(until), Some(lost)) => format!(
                "NOT DETERMINED from {until} s on: a second run, with {finer} and from a start that \
                 differs by rounding, then differs by more than {precision}°, and from {lost} s on \
                 by more than {LOST}°. If a lower `--tolerance` does not move these times, rounding \
                 decides from there on, by chaos or at an unstable place: what follows is one possible \
                 motion, not that of this start\n"
            ),
        }
    }
}
