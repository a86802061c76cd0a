//! The fates of runs.

use branched_pendulum::integrate::Solver;
use branched_pendulum::prelude::*;

use crate::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};
use crate::solvers::configured;
use branched_pendulum_frame::Failure;

/// The fate of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The energy error stays within 0.1 % of the initial energy; with friction, of the energy of
    /// the reference.
    Accurate,
    /// The energy error is larger but does not grow; with friction, the energy never exceeds its
    /// initial value.
    Bounded,
    /// The energy error grows; with friction, the energy exceeds its initial value.
    Drifting,
    /// The energy exceeds ten times its initial value, or is not finite.
    Diverged,
    /// The method ended with an error: a step could not be solved, or too many steps were needed.
    Refused,
}

impl Verdict {
    /// All verdicts.
    pub const ALL: [Self; 5] = [
        Self::Accurate,
        Self::Bounded,
        Self::Drifting,
        Self::Diverged,
        Self::Refused,
    ];

    /// As the charts name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accurate => "accurate",
            Self::Bounded => "bounded but wrong",
            Self::Drifting => "drifting",
            Self::Diverged => "diverged",
            Self::Refused => "refused",
        }
    }
}

/// Duration of a run without friction, in s.
pub const IDEAL_DURATION: f64 = 100.0;

/// Duration of a run with friction, in s.
pub const DAMPED_DURATION: f64 = 3.0;

fn start(angle_deg: f64) -> State<f64> {
    State::at_rest(0.0, &[angle_deg.to_radians(), 1e-3, -1e-3])
}

fn energy_of(model: &BranchedDouble, state: &[f64]) -> f64 {
    let (theta, omega) = state.split_at(3);
    model.kinetic_energy_of(theta, omega) + model.potential_energy_of(theta)
}

fn of_error(error: &IntegrationError<f64>) -> Verdict {
    match error {
        IntegrationError::NonFinite { .. } => Verdict::Diverged,
        _ => Verdict::Refused,
    }
}

/// Returns the verdict on a run without friction, released from `angle_deg`.
pub fn ideal(method: Method, setting: f64, angle_deg: f64) -> Verdict {
    let model = BranchedDouble::new();
    let start = start(angle_deg);
    let initial = energy_of(&model, &start.values);
    let (mut early, mut late) = (0.0_f64, 0.0_f64);
    let observer = |step: &mut DenseStep<'_, f64>| {
        let time = step.end_time();
        let error = (energy_of(&model, step.end()) / initial - 1.0).abs();
        if time < 0.25 * IDEAL_DURATION {
            early = early.max(error);
        } else if time > 0.75 * IDEAL_DURATION {
            late = late.max(error);
        }
        if error < 10.0 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    let ode = AbsoluteAngles(&model);
    match configured(method, setting).integrate(&ode, &start, IDEAL_DURATION, observer) {
        Err(error) => of_error(&error),
        Ok(solution) if solution.report.stop == StopReason::StoppedByObserver => Verdict::Diverged,
        Ok(_) if early.max(late) < 1e-3 => Verdict::Accurate,
        Ok(_) if late > 2.0 * early => Verdict::Drifting,
        Ok(_) => Verdict::Bounded,
    }
}

/// Angle of release of the runs with friction, in degrees.
pub const DAMPED_ANGLE: f64 = 40.0;

/// Creates the pendulum with the friction coefficient `friction` (N m s) in every pivot.
///
/// # Errors
/// [`Failure::Parameter`].
pub fn damped_model(friction: f64) -> Result<DampedBranchedDouble, Failure> {
    Ok(DampedBranchedDouble::new(DampedBranchedDoubleParameters {
        friction_root: friction,
        friction_children: friction,
    })?)
}

/// Returns the energy at the end of a run with friction, computed by a method and setting that are
/// known to be accurate: Gauss 8 with Newton's method and short steps.
///
/// # Errors
/// Errors of the method.
pub fn damped_reference(model: &DampedBranchedDouble) -> Result<f64, IntegrationError<f64>> {
    let method = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Eight, 2e-4)
    };
    let ode = AbsoluteAngles(model);
    let end = method.run(&ode, &start(DAMPED_ANGLE), DAMPED_DURATION)?;
    Ok(energy_of(&BranchedDouble::new(), &end.state.values))
}

/// Returns the verdict on a run with friction, whose energy at the end should be `expected`.
pub fn damped(
    method: Method,
    setting: f64,
    model: &DampedBranchedDouble,
    expected: f64,
) -> Verdict {
    let ideal = BranchedDouble::new();
    let start = start(DAMPED_ANGLE);
    let initial = energy_of(&ideal, &start.values);
    let mut most = initial;
    let observer = |step: &mut DenseStep<'_, f64>| {
        most = most.max(energy_of(&ideal, step.end()));
        if most < 10.0 * initial {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    let ode = AbsoluteAngles(model);
    match configured(method, setting).integrate(&ode, &start, DAMPED_DURATION, observer) {
        Err(error) => of_error(&error),
        Ok(solution) => {
            let error = (energy_of(&ideal, &solution.state.values) - expected).abs();
            if solution.report.stop == StopReason::StoppedByObserver {
                Verdict::Diverged
            } else if most > 1.001 * initial {
                Verdict::Drifting
            } else if error < 1e-3 * initial {
                Verdict::Accurate
            } else {
                Verdict::Bounded
            }
        }
    }
}
