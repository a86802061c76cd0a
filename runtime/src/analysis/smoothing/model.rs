//! Smoother whose motion obeys equations of motion.

use nalgebra::{SMatrix, SVector};

use super::error::{SmoothingError, check_option, check_times, usual_interval};
use super::gaussian::{Gaussian, Innovations, Step, smooth};
use super::kinematic::DIFFUSE;
use super::likelihood::climb;
use super::series::{Scale, SmoothedMotion};
use crate::analysis::variational::{Linearised, Variational, flow_jacobian};
use crate::integrate::Integrator;
use crate::system::State;

/// A smoother that knows the equations of motion: between times the state follows them but
/// for white angular accelerations of a spectral density q, which stand for all that the
/// model lacks. Gauss–Newton iteration of a Kalman smoother about the motion's own
/// linearisation (physics §16; B. M. Bell, *The iterated Kalman smoother as a Gauss–Newton
/// method*, SIAM J. Optim. 4 (1994)).
///
/// With the likeliest q, errors are as small as the model is good: with the right model
/// those of the best single trajectory, with a wrong one no worse than without any. What a
/// model lacks seldom acts on all angles alike: friction on the motion in phase is far larger
/// than on a small difference of identical branches. [`disturbances`](Self::disturbances)
/// tell such patterns apart, and each has a density of its own.
///
/// # Examples
///
/// Patterns of a parent with two identical children:
///
/// ```
/// use branched_pendulum::analysis::ModelSmoother;
///
/// let smoother = ModelSmoother {
///     disturbances: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, -1.0]],
///     ..ModelSmoother::default()
/// };
/// # assert_eq!(smoother.disturbances.len(), 3);
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ModelSmoother<const N: usize> {
    /// Standard deviation σ of measured angles, rad; without it the one of largest
    /// likelihood.
    pub noise: Option<f64>,
    /// Spectral density q of the angular accelerations, rad²/s³; without it the one of
    /// largest likelihood.
    pub acceleration: Option<f64>,
    /// Patterns of the angular accelerations, each with the likeliest density of its own;
    /// without any all angles are disturbed independently with one density.
    pub disturbances: Vec<[f64; N]>,
}

/// Steps of Gauss and Newton for one q at most.
const ITERATIONS: usize = 12;
/// Change of the angles, in deviations of the data, below which they end.
const CONVERGED: f64 = 1e-3;
/// That change where the likelihood alone is asked for.
const NEAR: f64 = 0.1;
/// Logarithms of q τ³/σ² that are tried, from the largest down: each motion starts from the
/// one before, and a model that is not trusted is easily met.
const LOG_RATIOS: [f64; 2] = [-35.0, 2.0];
/// Distance of two of them.
const LOG_STEP: f64 = 2.5;
/// Loss of likelihood after which smaller ones are not tried.
const HOPELESS: f64 = 20.0;
/// Steps by which the likeliest ones are approached, the first and the last.
const STEPS: [f64; 2] = [LOG_STEP, 0.3];
/// Times that the likeliest ones are sought, each about the motion of the last ones.
const SEARCHES: usize = 2;

impl<const N: usize> ModelSmoother<N> {
    /// Longest step (s) from time to time of a method of fourth order: its error is far
    /// below that of any camera.
    pub const LONGEST_STEP: f64 = 2e-3;

    /// Estimates angles and angular velocities at all times, where data are missing too.
    ///
    /// `system` is that of the angles followed by their rates, `D` numbers in all, of which
    /// the first `N = D/2` are measured; `method` integrates from time to time; `guess` is
    /// a motion near the true one, as a [`KinematicSmoother`](super::KinematicSmoother)
    /// gives it. The cost is that of D deviations over the record for each iteration, of
    /// which there are some 5 for each of some 15 values of q.
    ///
    /// # Errors
    ///
    /// [`SmoothingError`]; [`SmoothingError::Diverged`] where the motion of the model does
    /// not stay near the data.
    pub fn smooth<const D: usize, L, M>(
        &self,
        method: &M,
        system: &L,
        times: &[f64],
        data: &[[Option<f64>; N]],
        guess: &[[f64; D]],
    ) -> Result<SmoothedMotion<D>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.check(system.dimension(), times, data, guess)?;
        let problem = ModelFilter {
            method,
            system,
            times,
            data,
            unit: usual_interval(times),
            kinds: self.kinds(),
        };
        let cube = problem.unit.powi(3);
        let ratio = match (self.noise, self.acceleration) {
            (Some(noise), Some(q)) => Some(q * cube / (noise * noise)),
            _ => None,
        };
        let solution = match ratio {
            Some(ratio) => problem.solve(&[ratio.ln()], guess.to_vec(), CONVERGED)?,
            None => self.likeliest(&problem, guess)?,
        };
        let Solution {
            logs,
            steps,
            innovations,
            ..
        } = solution;
        let noise = self.noise_of(&logs, cube, &innovations);
        let scale = Scale {
            noise,
            densities: logs
                .iter()
                .map(|log| log.exp() * noise * noise / cube)
                .collect(),
            factors: SVector::repeat(1.0),
        };
        Ok(SmoothedMotion::new(times, &steps, innovations, scale))
    }

    fn check<const D: usize>(
        &self,
        dimension: usize,
        times: &[f64],
        data: &[[Option<f64>; N]],
        guess: &[[f64; D]],
    ) -> Result<(), SmoothingError> {
        if dimension != D || D != 2 * N {
            let state = D;
            return Err(SmoothingError::Dimension {
                dimension,
                state,
                measured: N,
            });
        }
        if times.len() != data.len() || times.len() != guess.len() {
            let (times, data) = (times.len(), data.len().min(guess.len()));
            return Err(SmoothingError::Length { times, data });
        }
        let found = data.iter().flatten().flatten().count();
        if found <= D || times.len() < 2 {
            return Err(SmoothingError::TooFew { found });
        }
        check_times(times)?;
        for (index, (data, guess)) in data.iter().zip(guess).enumerate() {
            let mut all = data.iter().flatten().chain(guess);
            if let Some(&value) = all.find(|value| !value.is_finite()) {
                return Err(SmoothingError::Datum { index, value });
            }
        }
        check_option("noise", self.noise)?;
        check_option("acceleration", self.acceleration)
    }

    /// Covariances of the accelerations that have a density of their own.
    fn kinds(&self) -> Vec<SMatrix<f64, N, N>> {
        if self.disturbances.is_empty() {
            return vec![SMatrix::identity()];
        }
        let patterns = self.disturbances.iter().map(|p| SVector::from(*p));
        patterns
            .map(|pattern| pattern * pattern.transpose())
            .collect()
    }

    /// The deviation of the data that goes with logarithms of ratios.
    fn noise_of(&self, logs: &[f64], cube: f64, innovations: &Innovations) -> f64 {
        match (self.noise, self.acceleration) {
            (Some(noise), _) => noise,
            (None, Some(q)) => (q * cube / logs.first().map_or(1.0, |log| log.exp())).sqrt(),
            (None, None) => innovations.noise(),
        }
    }

    fn likeliest<const D: usize, L, M>(
        &self,
        problem: &ModelFilter<'_, N, L, M>,
        guess: &[[f64; D]],
    ) -> Result<Solution<D>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let cube = problem.unit.powi(3);
        let likelihood = |logs: &[f64], innovations: &Innovations| {
            innovations.log_likelihood(Some(self.noise_of(logs, cube, innovations)))
        };
        let of = |solution: &Solution<D>| likelihood(&solution.logs, &solution.innovations);
        let [low, high] = LOG_RATIOS;
        let mut log = high;
        let mut best = problem.solve(&[log], guess.to_vec(), NEAR)?;
        let mut motion = best.motion.clone();
        while log > low {
            log -= LOG_STEP;
            // A model that cannot follow the data any more has been trusted too far.
            let Ok(next) = problem.solve(&[log], motion, NEAR) else {
                break;
            };
            motion = next.motion.clone();
            if of(&next) < of(&best) - HOPELESS {
                break;
            }
            if of(&next) > of(&best) {
                best = next;
            }
        }
        // A density that is given is that of all patterns.
        if self.acceleration.is_none() {
            best.logs = vec![best.logs[0]; problem.kinds.len()];
        }
        for search in 1..=SEARCHES {
            // The linearisation about the best motion serves its neighbours.
            let linear = problem.linearise(&best.motion)?;
            let near =
                |logs: &[f64]| likelihood(logs, &problem.filter(logs, &best.motion, &linear).0);
            let logs = climb(near, best.logs.clone(), low, STEPS);
            let enough = if search < SEARCHES { NEAR } else { CONVERGED };
            best = problem.solve(&logs, best.motion, enough)?;
        }
        Ok(best)
    }
}

/// Data and the equations of what they were measured on.
struct ModelFilter<'a, const N: usize, L, M> {
    method: &'a M,
    system: &'a L,
    times: &'a [f64],
    data: &'a [[Option<f64>; N]],
    /// The usual interval, s.
    unit: f64,
    /// Covariances of the accelerations, of a density of 1 each.
    kinds: Vec<SMatrix<f64, N, N>>,
}

/// The flow from each time to the next about a motion: where it leads, and its derivative.
type Flow<const D: usize> = Vec<(SVector<f64, D>, SMatrix<f64, D, D>)>;

/// The motion for given ratios q τ³/σ².
struct Solution<const D: usize> {
    /// Their logarithms: one for each kind of disturbance, or one for all.
    logs: Vec<f64>,
    motion: Vec<[f64; D]>,
    steps: Vec<Step<D>>,
    innovations: Innovations,
}

impl<const N: usize, L, M> ModelFilter<'_, N, L, M>
where
    L: Linearised<f64>,
    M: for<'a> Integrator<f64, Variational<'a, L>>,
{
    /// Iterates from a motion to the likeliest one, until it changes by `converged`
    /// deviations of the data.
    fn solve<const D: usize>(
        &self,
        logs: &[f64],
        mut motion: Vec<[f64; D]>,
        converged: f64,
    ) -> Result<Solution<D>, SmoothingError> {
        for iteration in 1.. {
            let flow = self.linearise(&motion)?;
            let (innovations, steps) = self.filter(logs, &motion, &flow);
            let (smoothed, _) = smooth(&steps);
            let noise = innovations.noise();
            let mut change = 0.0_f64;
            for (old, new) in motion.iter_mut().zip(&smoothed) {
                let new: [f64; D] = new.mean.into();
                for (old, new) in old.iter().zip(&new).take(N) {
                    // NaN does not pass as small.
                    change = if (new - old).abs() <= change {
                        change
                    } else {
                        (new - old).abs()
                    };
                }
                *old = new;
            }
            if !change.is_finite() {
                return Err(SmoothingError::Diverged);
            }
            if change <= converged * noise || iteration == ITERATIONS {
                return Ok(Solution {
                    logs: logs.to_vec(),
                    motion,
                    steps,
                    innovations,
                });
            }
        }
        Err(SmoothingError::Diverged)
    }

    fn linearise<const D: usize>(&self, motion: &[[f64; D]]) -> Result<Flow<D>, SmoothingError> {
        let ends = self.times.iter().skip(1);
        let pairs = self.times.iter().zip(motion).zip(ends);
        pairs
            .map(|((&time, state), &end)| {
                let start = State::new(time, state.to_vec());
                let flow = flow_jacobian(self.method, self.system, &start, end);
                let (end, columns) = flow.map_err(|_| SmoothingError::Diverged)?;
                let derivative = SMatrix::from_column_slice(&columns);
                Ok((SVector::from_column_slice(&end.values), derivative))
            })
            .collect()
    }

    fn filter<const D: usize>(
        &self,
        logs: &[f64],
        motion: &[[f64; D]],
        flow: &Flow<D>,
    ) -> (Innovations, Vec<Step<D>>) {
        let ratios = logs.iter().cycle().map(|log| log.exp());
        let kinds = self.kinds.iter().zip(ratios);
        let accelerations: SMatrix<f64, N, N> = kinds.map(|(kind, ratio)| kind * ratio).sum();
        let mut innovations = Innovations::new(D);
        let mut steps: Vec<Step<D>> = Vec::with_capacity(self.times.len());
        for (index, row) in self.data.iter().enumerate() {
            let (transition, predicted) = match (steps.last(), index.checked_sub(1)) {
                (Some(last), Some(before)) => {
                    let (end, transition) = &flow[before];
                    let h = (self.times[index] - self.times[before]) / self.unit;
                    let about = SVector::from(motion[before]);
                    let mean = end + transition * (last.updated.mean - about);
                    let noise = self.noise(&accelerations, h);
                    (*transition, last.updated.step(mean, transition, &noise))
                }
                _ => (SMatrix::identity(), self.start(motion)),
            };
            let mut updated = predicted;
            for (component, datum) in row.iter().enumerate() {
                if let Some(datum) = *datum {
                    innovations.push(updated.update(component, datum));
                }
            }
            steps.push(Step {
                transition,
                predicted,
                updated,
            });
        }
        (innovations, steps)
    }

    /// The state before the first data: not known.
    fn start<const D: usize>(&self, motion: &[[f64; D]]) -> Gaussian<D> {
        let rates = DIFFUSE / (self.unit * self.unit);
        Gaussian {
            mean: motion.first().copied().unwrap_or([0.0; D]).into(),
            variance: SMatrix::from_diagonal(&SVector::from_fn(|row, _| {
                if row < N { DIFFUSE } else { rates }
            })),
        }
    }

    /// Variance that white accelerations add over h usual intervals.
    fn noise<const D: usize>(
        &self,
        accelerations: &SMatrix<f64, N, N>,
        h: f64,
    ) -> SMatrix<f64, D, D> {
        let unit = self.unit;
        SMatrix::from_fn(|row, column| {
            let part = match (row < N, column < N) {
                (true, true) => h.powi(3) / 3.0,
                (false, false) => h / (unit * unit),
                _ => 0.5 * h * h / unit,
            };
            part * accelerations[(row % N, column % N)]
        })
    }
}
