//! Methods of the runtime, for programs that compare them.

use branched_pendulum::integrate::AnyIntegrator;
use branched_pendulum::prelude::*;

/// Creates the method with the tolerance or step length `setting`. A step of a Gauss method whose
/// equations cannot be solved is not halved, so that the failure is visible.
pub fn configured(method: Method, setting: f64) -> AnyIntegrator<f64> {
    let method = method.with(setting).with_step_limit(5_000_000);
    method.with_halvings(0)
}
