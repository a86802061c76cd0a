//! Kalman filter and smoother about a motion of given equations.

use nalgebra::{SMatrix, SVector};

use super::constants::{Effects, FittedConstants, StepEffects};
use super::error::SmoothingError;
use super::gaussian::{Gaussian, Innovations, Step, smooth};
use super::kinematic::DIFFUSE;
use crate::analysis::variational::{Linearised, Variational, flow_jacobian};
use crate::integrate::Integrator;
use crate::system::State;

/// Steps of Gauss and Newton for one q at most.
const ITERATIONS: usize = 12;

/// Data and the equations of what they were measured on.
pub(super) struct ModelFilter<'a, const N: usize, L, M> {
    pub(super) method: &'a M,
    pub(super) system: &'a L,
    pub(super) times: &'a [f64],
    pub(super) data: &'a [[Option<f64>; N]],
    /// The usual interval, s.
    pub(super) unit: f64,
    /// Standard deviation of the data, where it is given.
    pub(super) noise: Option<f64>,
    /// Density of the accelerations, where it is given.
    pub(super) acceleration: Option<f64>,
    /// Covariances of the accelerations, of a density of 1 each.
    pub(super) kinds: Vec<SMatrix<f64, N, N>>,
    /// Projections of angular velocities on those that a damping acts on, for each of them.
    pub(super) dampings: Vec<SMatrix<f64, N, N>>,
}

/// The flow from one time to the next about a motion.
pub(super) struct LinearFlow<const D: usize, const N: usize> {
    /// Where it leads without dampings.
    end: SVector<f64, D>,
    /// Its derivative, with dampings as they are.
    transition: SMatrix<f64, D, D>,
    /// Changes of the end by dampings of one.
    effects: Effects<D, N>,
}

/// Findings of a filter.
pub(super) struct Filtered<const D: usize, const N: usize> {
    pub(super) innovations: Innovations,
    pub(super) steps: Vec<Step<D>>,
    /// The dampings.
    pub(super) constants: FittedConstants<N>,
    pub(super) effects: Vec<StepEffects<D, N>>,
}

/// A motion, with the dampings that act on it beside the equations.
#[derive(Clone)]
pub(super) struct DampedMotion<const D: usize, const N: usize> {
    pub(super) states: Vec<[f64; D]>,
    pub(super) dampings: SVector<f64, N>,
}

/// The motion for given ratios q τ³/σ².
pub(super) struct SmoothingSolution<const D: usize, const N: usize> {
    /// Their logarithms: one for each kind of disturbance, or one for all.
    pub(super) logs: Vec<f64>,
    pub(super) motion: DampedMotion<D, N>,
    /// Findings of the filter that led to it.
    pub(super) filtered: Filtered<D, N>,
}

impl<const N: usize, L, M> ModelFilter<'_, N, L, M>
where
    L: Linearised<f64>,
    M: for<'a> Integrator<f64, Variational<'a, L>>,
{
    /// The deviation of the data that goes with logarithms of ratios, where one is given.
    fn given_noise(&self, logs: &[f64]) -> Option<f64> {
        let ratio = || logs.first().map_or(1.0, |log| log.exp());
        let of = |q: f64| (q * self.unit.powi(3) / ratio()).sqrt();
        self.noise.or_else(|| self.acceleration.map(of))
    }

    /// The deviation of the data, given or the likeliest.
    pub(super) fn noise_of(&self, logs: &[f64], innovations: &Innovations) -> f64 {
        self.given_noise(logs)
            .unwrap_or_else(|| innovations.noise())
    }

    pub(super) fn likelihood(&self, logs: &[f64], innovations: &Innovations) -> f64 {
        innovations.log_likelihood(Some(self.noise_of(logs, innovations)))
    }

    /// Iterates from a motion to the likeliest one, until it changes by `converged`
    /// deviations of the data.
    pub(super) fn solve<const D: usize>(
        &self,
        logs: &[f64],
        mut motion: DampedMotion<D, N>,
        converged: f64,
    ) -> Result<SmoothingSolution<D, N>, SmoothingError> {
        for iteration in 1.. {
            let flow = self.linearise(&motion)?;
            let filtered = self.filter(logs, &motion.states, &flow);
            motion.dampings = filtered.constants.values;
            let (smoothed, _) = smooth(&filtered.steps);
            let mut change = 0.0_f64;
            for (old, new) in motion.states.iter_mut().zip(&smoothed) {
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
            let enough = converged * filtered.innovations.noise();
            if change <= enough || iteration == ITERATIONS {
                return Ok(SmoothingSolution {
                    logs: logs.to_vec(),
                    motion,
                    filtered,
                });
            }
        }
        Err(SmoothingError::Diverged)
    }

    pub(super) fn linearise<const D: usize>(
        &self,
        about: &DampedMotion<D, N>,
    ) -> Result<Vec<LinearFlow<D, N>>, SmoothingError> {
        let ends = self.times.iter().zip(&about.states).skip(1);
        let pairs = self.times.iter().zip(&about.states).zip(ends);
        pairs
            .map(|((&time, state), (&end, next))| {
                let start = State::new(time, state.to_vec());
                let flow = flow_jacobian(self.method, self.system, &start, end);
                let (reached, columns) = flow.map_err(|_| SmoothingError::Diverged)?;
                let mut transition = SMatrix::from_column_slice(&columns);
                let h = end - time;
                for (projection, damping) in self.dampings.iter().zip(&about.dampings) {
                    for (row, column) in (0..N).flat_map(|row| (0..N).map(move |c| (row, c))) {
                        let lost = h * damping * projection[(row, column)];
                        transition[(row, N + column)] -= 0.5 * h * lost;
                        transition[(N + row, N + column)] -= lost;
                    }
                }
                Ok(LinearFlow {
                    end: SVector::from_column_slice(&reached.values),
                    transition,
                    effects: self.damped(h, state, next),
                })
            })
            .collect()
    }

    /// Returns the changes by dampings of one over an interval on which the velocity is a line.
    fn damped<const D: usize>(&self, h: f64, start: &[f64; D], end: &[f64; D]) -> Effects<D, N> {
        let mut effects = SMatrix::zeros();
        for (column, projection) in self.dampings.iter().enumerate() {
            let [start, end] = [start, end].map(|state| {
                let rates = SVector::<f64, N>::from_fn(|row, _| state[N + row]);
                projection * rates
            });
            for row in 0..N {
                effects[(row, column)] = -h * h / 6.0 * (2.0 * start[row] + end[row]);
                effects[(N + row, column)] = -0.5 * h * (start[row] + end[row]);
            }
        }
        effects
    }

    pub(super) fn filter<const D: usize>(
        &self,
        logs: &[f64],
        motion: &[[f64; D]],
        flow: &[LinearFlow<D, N>],
    ) -> Filtered<D, N> {
        let ratios = logs.iter().cycle().map(|log| log.exp());
        let kinds = self.kinds.iter().zip(ratios);
        let accelerations: SMatrix<f64, N, N> = kinds.map(|(kind, ratio)| kind * ratio).sum();
        let mut innovations = Innovations::new(D);
        let mut steps: Vec<Step<D>> = Vec::with_capacity(self.times.len());
        let mut effects: Vec<StepEffects<D, N>> = Vec::new();
        let mut rows = Vec::new();
        let is_damped = !self.dampings.is_empty();
        for (index, row) in self.data.iter().enumerate() {
            let (transition, predicted) = match (steps.last(), index.checked_sub(1)) {
                (Some(last), Some(before)) => {
                    let flow = &flow[before];
                    let h = (self.times[index] - self.times[before]) / self.unit;
                    let about = SVector::from(motion[before]);
                    let mean = flow.end + flow.transition * (last.updated.mean - about);
                    let noise = self.noise(&accelerations, h);
                    let transition = flow.transition;
                    (transition, last.updated.step(mean, &transition, &noise))
                }
                _ => (SMatrix::identity(), self.start(motion)),
            };
            let moved = effects.last().map_or_else(SMatrix::zeros, |last| {
                transition * last.updated + flow[index - 1].effects
            });
            let mut own = StepEffects {
                predicted: moved,
                updated: moved,
            };
            let mut updated = predicted;
            for (component, datum) in row.iter().enumerate() {
                let Some(datum) = *datum else { continue };
                let innovation = updated.update(component, datum);
                innovations.push(innovation);
                if is_damped {
                    let moves = own.updated.row(component).into_owned();
                    own.updated -= innovation.gain * moves;
                    rows.push(moves.transpose() / innovation.variance.sqrt());
                }
            }
            if is_damped {
                effects.push(own);
            }
            steps.push(Step {
                transition,
                predicted,
                updated,
            });
        }
        let constants = FittedConstants::fit(&mut innovations, &rows, self.given_noise(logs));
        constants.move_steps(&mut steps, &effects);
        Filtered {
            innovations,
            steps,
            constants,
            effects,
        }
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
