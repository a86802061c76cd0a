//! Motions of pendulums of any kind, without Python.

use std::ops::ControlFlow;

use branched_pendulum::analysis::variational::{
    Copies, Lyapunov, LyapunovError, LyapunovSpectrum, linearised,
};
use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::{
    AnyIntegrator, Dop853, Event, IntegrationError, Integrator, Occurrence, Options, RunError,
    Solution,
};
use branched_pendulum::interruption;
use branched_pendulum::system::{AbsoluteAngles, Ode, State};
use branched_pendulum_measure::SmoothingError;
use branched_pendulum_trees::{DifferenceGrowth, TreeError};

use crate::estimates::{Coordinates, Estimate};
use crate::kept::{End, KeepError, Kept, OutputTimes};
use crate::measured_model::MeasuredModel;
use crate::model_smoothing::smoothed_by_equations;

/// Deviations whose exponents are asked for.
pub(crate) enum Deviations {
    All,
    /// Equal in all copies.
    Within(Copies),
    /// Differences between copies.
    Transverse(Copies),
}

/// The motions of a model, whatever its type.
pub(crate) trait Motions: Send + Sync {
    fn names(&self) -> Vec<String>;

    fn dimension(&self) -> usize;

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]);

    fn energy(&self, state: &[f64]) -> f64;

    /// Follows a motion and keeps what is wanted of it.
    fn follow(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        wanted: OutputTimes<'_>,
        kept: &mut Kept,
    ) -> End;

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
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>>;

    /// Samples of motions of models that differ in their parameters, given by name for each
    /// start, likewise.
    ///
    /// # Errors
    /// Why there is no such model.
    fn ensemble_of_models(
        &self,
        method: &AnyIntegrator<f64>,
        ensemble: &Ensemble<'_>,
        parameters: &[(String, Vec<f64>)],
        starts: &[State<f64>],
        times: &[f64],
    ) -> Result<Option<Vec<Samples<f64>>>, String>;

    fn lyapunov(
        &self,
        exponents: &Lyapunov,
        deviations: &Deviations,
        options: Options<f64>,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError>;

    /// Links of each set with all that hangs from them; none where they are no copies that are
    /// in phase at all starts.
    fn copies(&self, alike: &[&[usize]], starts: &[State<f64>]) -> Option<Copies>;

    /// Growth of a difference between copies up to some horizons, at a tolerance.
    ///
    /// # Errors
    /// Links that are no copies.
    fn differences(
        &self,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<DifferenceGrowth, TreeError>;

    fn smoothed_coordinates(&self) -> Coordinates;

    /// Smooths measured angles by the equations of motion, and by friction that they lack
    /// where this is looked for, beginning from states near the true ones.
    fn smooth(
        &self,
        noise: Option<f64>,
        friction: bool,
        times: &[f64],
        angles: &[Vec<Option<f64>>],
        guess: &[f64],
    ) -> Result<Estimate, SmoothingError>;
}

impl<M: MeasuredModel> Motions for AbsoluteAngles<M> {
    fn names(&self) -> Vec<String> {
        self.0.link_names()
    }

    fn dimension(&self) -> usize {
        Ode::<f64>::dimension(self)
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        Ode::<f64>::rates(self, time, state, rates);
    }

    fn energy(&self, state: &[f64]) -> f64 {
        match state.split_at_checked(self.0.links()) {
            Some((theta, omega)) => self.0.energy_of(theta, omega),
            None => f64::NAN,
        }
    }

    fn follow(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        wanted: OutputTimes<'_>,
        kept: &mut Kept,
    ) -> End {
        let system = &M::series(self);
        if let (OutputTimes::At(times), None) = (wanted, &kept.trajectory) {
            let run = method.try_sample(system, start, times, |time, state| kept.push(time, state));
            return Ok(run.map_err(Box::new)?.report);
        }
        let end = match wanted {
            OutputTimes::At(times) => times.last().copied().unwrap_or(start.time),
            OutputTimes::AllSteps(end) => end,
        };
        if let OutputTimes::AllSteps(_) = wanted {
            // Of one number there is room.
            drop(kept.push(start.time, &start.values));
        }
        let run = method.try_integrate(system, start, end, |step| {
            if let Some(trajectory) = &mut kept.trajectory {
                trajectory.push(step).map_err(KeepError::Dense)?;
            }
            if let OutputTimes::AllSteps(_) = wanted {
                kept.push(step.end_time(), step.end())?;
            }
            Ok(ControlFlow::Continue(()))
        });
        if let OutputTimes::At(times) = wanted {
            let sampled = kept.sample(times, run.is_ok());
            let report = run.map_err(Box::new)?.report;
            sampled.map_err(|error| RunError::Observer {
                error,
                last: start.clone(),
                report,
            })?;
            return Ok(report);
        }
        Ok(run.map_err(Box::new)?.report)
    }

    fn events(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
        events: &[Event<'_, f64>],
        visit: &mut dyn FnMut(Occurrence<'_, f64>) -> ControlFlow<()>,
    ) -> Result<Solution<f64>, IntegrationError<f64>> {
        method.integrate_with_events(&M::series(self), start, end, events, visit)
    }

    fn ensemble(
        &self,
        method: &AnyIntegrator<f64>,
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>> {
        Some(match method {
            AnyIntegrator::Dop853(method) => ensemble.sample_in_lanes(method, self, starts, times),
            AnyIntegrator::Dopri5(method) => ensemble.sample_in_lanes(method, self, starts, times),
            AnyIntegrator::Verner98(method) => {
                ensemble.sample_in_lanes(method, self, starts, times)
            }
            AnyIntegrator::Taylor(method) => {
                return M::series_ensemble(method, self, ensemble, starts, times);
            }
            _ => return None,
        })
    }

    fn ensemble_of_models(
        &self,
        method: &AnyIntegrator<f64>,
        ensemble: &Ensemble<'_>,
        parameters: &[(String, Vec<f64>)],
        starts: &[State<f64>],
        times: &[f64],
    ) -> Result<Option<Vec<Samples<f64>>>, String> {
        let case = |(index, start): (usize, &State<f64>)| {
            interruption::look();
            let own = parameters.iter();
            let own = own.filter_map(|(name, all)| Some((name.as_str(), *all.get(index)?)));
            let model = self.0.with_values(&own.collect::<Vec<_>>())?;
            Ok((AbsoluteAngles(model), start.clone()))
        };
        let cases = starts.iter().enumerate().map(case);
        let cases: Vec<(Self, State<f64>)> = cases.collect::<Result<_, String>>()?;
        Ok(Some(match method {
            AnyIntegrator::Dop853(own) => ensemble.sample_models_in_lanes(own, &cases, times),
            AnyIntegrator::Dopri5(own) => ensemble.sample_models_in_lanes(own, &cases, times),
            AnyIntegrator::Verner98(own) => ensemble.sample_models_in_lanes(own, &cases, times),
            _ => return Ok(None),
        }))
    }

    fn lyapunov(
        &self,
        exponents: &Lyapunov,
        deviations: &Deviations,
        options: Options<f64>,
        start: &State<f64>,
    ) -> Result<LyapunovSpectrum, LyapunovError> {
        let (method, system) = (&Dop853::new(options), &linearised(self.clone()));
        match deviations {
            Deviations::All => exponents.spectrum(method, system, start),
            Deviations::Within(copies) => exponents.within(copies, method, system, start),
            Deviations::Transverse(copies) => exponents.transverse(copies, method, system, start),
        }
    }

    fn copies(&self, alike: &[&[usize]], starts: &[State<f64>]) -> Option<Copies> {
        let copies = Copies::of_links(&self.0.link_parents(), alike)?;
        let are_in_phase = starts.iter().all(|start| copies.are_in_phase(self, start));
        are_in_phase.then_some(copies)
    }

    fn differences(
        &self,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<DifferenceGrowth, TreeError> {
        DifferenceGrowth::new(&*self.0.as_tree()?, copies, horizons, tolerance)
    }

    fn smoothed_coordinates(&self) -> Coordinates {
        self.0.smoothed_coordinates()
    }

    fn smooth(
        &self,
        noise: Option<f64>,
        friction: bool,
        times: &[f64],
        angles: &[Vec<Option<f64>>],
        guess: &[f64],
    ) -> Result<Estimate, SmoothingError> {
        smoothed_by_equations(&self.0, noise, friction, times, angles, guess)
    }
}
