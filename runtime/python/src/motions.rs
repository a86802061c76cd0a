//! Motions of pendulums of any kind, without Python.

use std::ops::ControlFlow;

use branched_pendulum::analysis::growth::{BetweenCopies, Grown, Growth, GrowthError};
use branched_pendulum::analysis::variational::{
    Copies, Lyapunov, LyapunovError, LyapunovSpectrum, linearised,
};
use branched_pendulum_measure::{ModelSmoother, SmoothingError};
use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::{
    AnyIntegrator, DenseError, Dop853, Event, IntegrationError, Integrator, Occurrence, Options,
    Report, Rk4, RunError, Solution, Trajectory,
};
use branched_pendulum::system::{AbsoluteAngles, Energy, Ode, State, TaylorOde};

use crate::growth::GrowthTask;
use crate::smoothing::{Coordinates, Estimate};

/// A model with what its measured motions are smoothed by.
pub(crate) trait MeasuredModel: Energy<f64> + Clone + Send + Sync + 'static {
    /// The equations, with Taylor coefficients where the model has them.
    type Series<'a>: TaylorOde<f64>;

    /// Returns the equations for methods that may ask for Taylor coefficients.
    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_>;

    /// The mass matrix (kg m²) at angles, a row for each link.
    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>>;

    /// The link that each hangs from; of the root none.
    fn link_parents(&self) -> Vec<Option<usize>>;

    /// Coordinates in which measured angles are smoothed.
    fn smoothed_coordinates(&self) -> Coordinates {
        Coordinates::links(self.links())
    }
}

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

    /// States at the given times, one after the other.
    fn sample(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        times: &[f64],
    ) -> Result<(Vec<f64>, Report<f64>), IntegrationError<f64>>;

    /// All steps.
    fn trajectory(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
    ) -> Result<(Trajectory<f64>, Report<f64>), RunError<f64, DenseError<f64>>>;

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

    /// Growth of a difference between copies along a motion; without a frequency looked at by
    /// that of the difference beside all links at rest.
    fn growth(
        &self,
        task: &GrowthTask,
        copies: &Copies,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError>;

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

/// A smoothing by equations of motion that is asked for.
struct ModelSmoothing<'a, M> {
    model: &'a M,
    noise: Option<f64>,
    friction: bool,
    times: &'a [f64],
    angles: &'a [Vec<Option<f64>>],
    guess: &'a [f64],
}

/// Most links of a pendulum whose equations smooth angles.
const MOST_SMOOTHED: usize = 4;

impl<M: MeasuredModel> ModelSmoothing<'_, M> {
    fn estimate<const N: usize, const D: usize>(&self) -> Result<Estimate, SmoothingError> {
        let array = |row: &Vec<Option<f64>>| std::array::from_fn(|link| row[link]);
        let angles: Vec<[Option<f64>; N]> = self.angles.iter().map(array).collect();
        let (guess, _) = self.guess.as_chunks::<D>();
        // Forces on a single coordinate, and in the pivot of a single link.
        let coordinates = self.model.smoothed_coordinates().of_links;
        let pattern = |row: &Vec<f64>| std::array::from_fn(|link| row[link]);
        let parents = self.model.link_parents();
        let joint = |(own, parent): (usize, &Option<usize>)| {
            let weight = |link: usize| match link {
                link if link == own => 1.0,
                link if Some(link) == *parent => -1.0,
                _ => 0.0,
            };
            vec![std::array::from_fn(weight)]
        };
        let smoother = ModelSmoother {
            noise: self.noise,
            disturbances: coordinates.iter().map(pattern).collect(),
            frictions: match self.friction {
                true => parents.iter().enumerate().map(joint).collect(),
                false => Vec::new(),
            },
            ..ModelSmoother::<N>::default()
        };
        let method = Rk4::new(ModelSmoother::<N>::LONGEST_STEP);
        let system = linearised(AbsoluteAngles(self.model.clone()));
        let mass = |theta: &[f64; N]| {
            let rows = self.model.mass_rows(theta);
            let entry = |row: usize, column: usize| rows.get(row)?.get(column).copied();
            std::array::from_fn(|row| {
                std::array::from_fn(|column| entry(row, column).unwrap_or(f64::NAN))
            })
        };
        let motion = smoother.smooth(&method, &system, mass, self.times, &angles, guess)?;
        let rows = |of: &dyn Fn(usize) -> [f64; D]| (0..self.times.len()).flat_map(of).collect();
        Ok(Estimate {
            states: [
                rows(&|time| motion.mean(time)),
                rows(&|time| motion.deviation(time)),
            ],
            accelerations: None,
            noise: vec![motion.noise(); N],
            whiteness: motion.whiteness(),
            frictions: motion.frictions().to_vec(),
            draw: Box::new(move |normal| motion.draw(normal).into_flattened()),
        })
    }
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

    fn sample(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        times: &[f64],
    ) -> Result<(Vec<f64>, Report<f64>), IntegrationError<f64>> {
        let mut values = Vec::with_capacity(times.len() * start.values.len());
        let visit = |_: f64, state: &[f64]| values.extend_from_slice(state);
        let solution = method.sample(&M::series(self), start, times, visit)?;
        Ok((values, solution.report))
    }

    fn trajectory(
        &self,
        method: &AnyIntegrator<f64>,
        start: &State<f64>,
        end: f64,
    ) -> Result<(Trajectory<f64>, Report<f64>), RunError<f64, DenseError<f64>>> {
        let mut trajectory = Trajectory::new(start.clone());
        let run = method.try_integrate(&M::series(self), start, end, |step| {
            trajectory.push(step)?;
            Ok::<_, DenseError<f64>>(ControlFlow::Continue(()))
        });
        Ok((trajectory, run?.report))
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
            _ => return None,
        })
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

    fn growth(
        &self,
        task: &GrowthTask,
        copies: &Copies,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError> {
        let system = BetweenCopies::new(linearised(self.clone()), copies.clone());
        let frequency = task.frequency_hz.or_else(|| system.frequency_at_rest());
        let growth = Growth {
            frequency_hz: frequency.unwrap_or(f64::NAN),
            horizons: task.horizons.clone(),
            tolerance: task.tolerance,
        };
        growth.between_copies(&system, start)
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
        let task = ModelSmoothing {
            model: &self.0,
            noise,
            friction,
            times,
            angles,
            guess,
        };
        let links = Ode::<f64>::dimension(self) / 2;
        match links {
            1 => task.estimate::<1, 2>(),
            2 => task.estimate::<2, 4>(),
            3 => task.estimate::<3, 6>(),
            MOST_SMOOTHED => task.estimate::<4, 8>(),
            _ => Err(SmoothingError::Dimension {
                dimension: 2 * links,
                state: 2 * MOST_SMOOTHED,
                measured: links,
            }),
        }
    }
}
