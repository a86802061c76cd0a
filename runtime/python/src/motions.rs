//! Motions of pendulums of any kind, without Python.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use branched_pendulum::analysis::variational::{
    Lyapunov, LyapunovError, LyapunovSpectrum, linearised,
};
use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::{
    AnyIntegrator, DenseError, Dop853, Event, IntegrationError, Integrator, Occurrence, Options,
    Report, RunError, Solution, Trajectory,
};
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{CastOde, LaneOde, Ode, RatesOnly, State};

/// Equations of motion with the pendulum behind them.
pub(crate) trait Model:
    LaneOde<f64> + CastOde<f64, Dual<f64, 1>> + Clone + Send + Sync + 'static
{
    /// Names of the links, in the order of the angles.
    fn link_names(&self) -> Vec<String>;

    /// The energy (J) of a state: angles, angular velocities.
    fn state_energy(&self, state: &[f64]) -> f64;
}

/// Error of a run whose steps are kept.
pub(crate) type KeepError = RunError<f64, DenseError<f64>>;

/// The motions of a [`Model`], whatever its type.
pub(crate) trait Motions: Send + Sync {
    fn names(&self) -> Vec<String>;

    fn dimension(&self) -> usize;

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]);

    fn energy(&self, state: &[f64]) -> f64;

    /// States at the given times, one after the other.
    fn sample(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        times: &[f64],
    ) -> Result<(Vec<f64>, Report<f64>), IntegrationError<f64>>;

    fn trajectory(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
    ) -> Result<(Trajectory<f64>, Report<f64>), KeepError>;

    fn events(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
        events: &[Event<'_, f64>],
        visit: &mut dyn FnMut(Occurrence<'_, f64>) -> ControlFlow<()>,
    ) -> Result<Solution<f64>, IntegrationError<f64>>;

    /// Samples of many motions, several in the lanes of a register on each thread; `None` for
    /// methods that do not go in lanes.
    fn ensemble(
        &self,
        method: &AnyIntegrator<f64>,
        threads: Option<NonZeroUsize>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>>;

    fn lyapunov(
        &self,
        exponents: &Lyapunov,
        options: Options<f64>,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>;
}

impl<M: Model> Motions for M {
    fn names(&self) -> Vec<String> {
        self.link_names()
    }

    fn dimension(&self) -> usize {
        Ode::<f64>::dimension(self)
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        Ode::<f64>::rates(self, time, state, rates);
    }

    fn energy(&self, state: &[f64]) -> f64 {
        self.state_energy(state)
    }

    fn sample(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        times: &[f64],
    ) -> Result<(Vec<f64>, Report<f64>), IntegrationError<f64>> {
        let mut values = Vec::with_capacity(times.len() * start.values.len());
        let visit = |_: f64, state: &[f64]| values.extend_from_slice(state);
        let solution = method.sample(&RatesOnly(self), start, times, visit)?;
        Ok((values, solution.report))
    }

    fn trajectory(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
    ) -> Result<(Trajectory<f64>, Report<f64>), KeepError> {
        let mut trajectory = Trajectory::new(start.clone());
        let solution = method.try_integrate(&RatesOnly(self), start, end, |step| {
            trajectory.push(step)?;
            Ok::<_, DenseError<f64>>(ControlFlow::Continue(()))
        })?;
        Ok((trajectory, solution.report))
    }

    fn events(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
        events: &[Event<'_, f64>],
        visit: &mut dyn FnMut(Occurrence<'_, f64>) -> ControlFlow<()>,
    ) -> Result<Solution<f64>, IntegrationError<f64>> {
        method.integrate_with_events(&RatesOnly(self), start, end, events, visit)
    }

    fn ensemble(
        &self,
        method: &AnyIntegrator<f64>,
        threads: Option<NonZeroUsize>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>> {
        let ensemble = match threads {
            Some(threads) => Ensemble::new().threads(threads),
            None => Ensemble::new(),
        };
        Some(match method {
            AnyIntegrator::Dop853(method) => ensemble.sample_in_lanes(method, self, starts, times),
            AnyIntegrator::Dopri5(method) => ensemble.sample_in_lanes(method, self, starts, times),
            AnyIntegrator::Verner98(method) => {
                ensemble.sample_in_lanes(method, self, starts, times)
            }
            _ => return None,
        })
    }

    fn lyapunov(
        &self,
        exponents: &Lyapunov,
        options: Options<f64>,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError> {
        exponents.spectrum(&Dop853::new(options), &linearised(self.clone()), start)
    }
}
