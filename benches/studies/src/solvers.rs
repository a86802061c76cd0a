//! The methods of the runtime, for programs that compare them.

use branched_pendulum::integrate::AnyIntegrator;
use branched_pendulum::prelude::*;

/// The method with the tolerance or the step `setting`. A step that cannot be solved
/// in one piece is not halved: it shows as that.
pub fn configured(method: Method, setting: f64) -> AnyIntegrator<f64> {
    let method = method.with(setting).with_step_limit(5_000_000);
    method.with_halvings(0)
}
