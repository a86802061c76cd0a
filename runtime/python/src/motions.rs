//! Motions of pendulums of any kind, as Rust data.

use std::ops::ControlFlow;

use branched_pendulum::analysis::variational::{
    Copies, Lyapunov, LyapunovError, LyapunovSpectrum, linearised,
};
use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::{
    AnyIntegrator, Dop853, Event, Horizon, IntegrationError, Integrator, Method, Occurrence,
    Options, RunError, Solution,
};
use branched_pendulum::interruption;
use branched_pendulum::system::{AbsoluteAngles, Ode, State};
use branched_pendulum_measure::SmoothingError;
use branched_pendulum_trees::{DifferenceGrowth, TreeError};

use crate::estimates::{Coordinates, Estimate};
use crate::kept::{End, KeepError, Kept, OutputTimes};
use crate::measured_model::{MeasuredModel, Releases};
use crate::model_smoothing::smoothed_by_equations;

/// Kind of deviations whose Lyapunov exponents are computed.
pub(crate) enum Deviations {
    All,
    /// Equal in all copies.
    Within(Copies),
    /// Differences between copies.
    Transverse(Copies),
}

/// Interface to the motions of a model of any type.
pub(crate) trait Motions: Send + Sync {
    fn names(&self) -> Vec<String>;

    fn dimension(&self) -> usize;

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]);

    fn energy(&self, state: &[f64]) -> f64;

    /// Integrates a motion and keeps the requested states.
    fn follow(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        wanted: OutputTimes<'_>,
        kept: &mut Kept,
    ) -> End;

    /// Compares the motion of a method with that of a finer one, at the given times and at the ends
    /// of all steps to the last of them, and returns the first time at which angles differ by more
    /// than `precision` (rad).
    fn differs_from(
        &self,
        methods: [&AnyIntegrator<f64>; 2],
        start: &State<f64>,
        times: &[f64],
        precision: f64,
    ) -> Result<Option<f64>, IntegrationError<f64>>;

    /// Returns the method that is usually the fastest for one motion at a tolerance.
    fn fastest_method(&self, tolerance: f64) -> Method;

    /// Returns the method that is usually the fastest for an ensemble at a tolerance.
    fn fastest_in_lanes(&self, tolerance: f64) -> Method;

    fn events(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
        events: &[Event<'_, f64>],
        visit: &mut dyn FnMut(Occurrence<'_, f64>) -> ControlFlow<()>,
    ) -> Result<Solution<f64>, IntegrationError<f64>>;

    /// Samples many motions, several at a time in the lanes of a vector register on each thread;
    /// `None` for methods that cannot run in lanes.
    fn ensemble(
        &self,
        method: &AnyIntegrator<f64>,
        ensemble: &Ensemble<'_>,
        starts: &[State<f64>],
        times: &[f64],
    ) -> Option<Vec<Samples<f64>>>;

    /// Samples motions in lanes, for models that differ in their parameters; these are given by
    /// name, with one value per start.
    ///
    /// # Errors
    /// The reason why the values are invalid.
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

    /// Returns the given sets of links, with the links below them, as copies; `None` if they are
    /// not copies that are in phase at all starts.
    fn copies(&self, alike: &[&[usize]], starts: &[State<f64>]) -> Option<Copies>;

    /// Prepares the computation of the growth of a difference between copies, up to the given
    /// horizons (s), with a tolerance.
    ///
    /// # Errors
    /// An error if the links are not copies of each other.
    fn differences(
        &self,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<DifferenceGrowth, TreeError>;

    fn smoothed_coordinates(&self) -> Coordinates;

    /// Smooths measured angles by the equations of motion, and on request estimates friction that
    /// is missing in the equations. `guess` contains states near the true ones.
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
        if let (OutputTimes::At { times, .. }, None) = (wanted, &kept.trajectory) {
            let run = method.try_sample(system, start, times, |time, state| kept.push(time, state));
            return Ok(run.map_err(Box::new)?.report);
        }
        let end = match wanted {
            OutputTimes::At { end, .. } | OutputTimes::AllSteps(end) => end,
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
        if let OutputTimes::At { times, .. } = wanted {
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

    fn differs_from(
        &self,
        methods: [&AnyIntegrator<f64>; 2],
        start: &State<f64>,
        times: &[f64],
        precision: f64,
    ) -> Result<Option<f64>, IntegrationError<f64>> {
        let links = start.values.len() / 2;
        let system = &M::series(self);
        let found = Horizon::find(methods, system, start, times, links, &[precision])?;
        Ok(found.exceeded.first().copied().flatten())
    }

    fn fastest_method(&self, tolerance: f64) -> Method {
        Method::for_model(&M::series(self), tolerance)
    }

    fn fastest_in_lanes(&self, tolerance: f64) -> Method {
        Method::for_lanes(&M::series(self), tolerance)
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
        sampled(method, Releases::OfOne(self, starts), ensemble, times)
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
        Ok(sampled(method, Releases::OfEach(&cases), ensemble, times))
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

/// Samples an ensemble; `None` if it cannot be integrated by this method.
fn sampled<M: MeasuredModel>(
    method: &AnyIntegrator<f64>,
    releases: Releases<'_, M>,
    ensemble: &Ensemble<'_>,
    times: &[f64],
) -> Option<Vec<Samples<f64>>> {
    Some(match method {
        AnyIntegrator::Dop853(method) => releases.sample(method, ensemble, times),
        AnyIntegrator::Dopri5(method) => releases.sample(method, ensemble, times),
        AnyIntegrator::Verner98(method) => releases.sample(method, ensemble, times),
        AnyIntegrator::Taylor(method) => {
            return M::series_ensemble(method, releases, ensemble, times);
        }
        AnyIntegrator::Rk4(_) | AnyIntegrator::Gauss(_) => return None,
    })
}
