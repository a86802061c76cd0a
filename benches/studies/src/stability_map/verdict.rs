//! The fates of runs.

use branched_pendulum::integrate::Solver;
use branched_pendulum::prelude::*;

use crate::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};
use crate::solvers::configured;
use branched_pendulum_frame::Failure;

/// The fate of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The energy is right within 0.1 % of the first; with friction, within
    /// 0.1 % of that of the reference.
    Accurate,
    /// Wrong, and no worse late than early; with friction, never above the
    /// first energy.
    Bounded,
    /// The error of the energy grows; with friction, energy appears.
    Drifting,
    /// More than ten times the first energy, or infinite.
    Diverged,
    /// Ended with an error: the step could not be solved, or too many steps.
    Refused,
}

impl Verdict {
    /// All of them.
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

/// Length of a run without friction, s.
pub const IDEAL_DURATION: f64 = 100.0;

/// Length of a run with friction, s.
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

/// The verdict on a run without friction, released from `angle_deg`.
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

/// Angle from which the runs with friction are released, degrees.
pub const DAMPED_ANGLE: f64 = 40.0;

/// The pendulum with the friction `friction` (N m s) in every pivot.
///
/// # Errors
/// [`Failure::Parameter`].
pub fn damped_model(friction: f64) -> Result<DampedBranchedDouble, Failure> {
    Ok(DampedBranchedDouble::new(DampedBranchedDoubleParameters {
        friction_root: friction,
        friction_children: friction,
    })?)
}

/// Energy at the end with friction by a method and setting that are known to be
/// right: Gauss 8 by Newton's method with short steps.
///
/// # Errors
/// As the method's.
pub fn damped_reference(model: &DampedBranchedDouble) -> Result<f64, IntegrationError<f64>> {
    let method = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Eight, 2e-4)
    };
    let ode = AbsoluteAngles(model);
    let end = method.run(&ode, &start(DAMPED_ANGLE), DAMPED_DURATION)?;
    Ok(energy_of(&BranchedDouble::new(), &end.state.values))
}

/// The verdict on a run with friction whose energy at the end should be
/// `expected`.
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
