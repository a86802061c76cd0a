//! Kalman filter and smoother about a motion of given equations.

use nalgebra::{SMatrix, SVector};

use super::constants::{Effects, FittedConstants, StepEffects};
use super::disturbances::{Disturbances, DisturbedStep};
use super::error::SmoothingError;
use super::gaussian::{Gaussian, Innovations, Step, smooth};
use super::kinematic::DIFFUSE;
use branched_pendulum::analysis::variational::{Linearised, Variational, flow_jacobian};
use branched_pendulum::integrate::Integrator;
use branched_pendulum::system::State;

/// Steps of Gauss and Newton for one q at most.
const ITERATIONS: usize = 12;

/// Data and the equations of what they were measured on.
pub(super) struct ModelFilter<'a, const N: usize, L, M, A> {
    pub(super) method: &'a M,
    pub(super) system: &'a L,
    /// The mass matrix at angles.
    pub(super) mass_matrix: A,
    pub(super) times: &'a [f64],
    pub(super) data: &'a [[Option<f64>; N]],
    /// The usual interval, s.
    pub(super) unit: f64,
    /// Standard deviation of the data, where it is given.
    pub(super) noise: Option<f64>,
    /// Density of the disturbances, where it is given.
    pub(super) density: Option<f64>,
    /// Covariances of the disturbances, each of such a density that the accelerations have one
    /// of about 1.
    pub(super) kinds: Vec<SMatrix<f64, N, N>>,
    /// Torques of friction with a coefficient of one, by angular velocities, with the sign
    /// of the friction.
    pub(super) frictions: Vec<SMatrix<f64, N, N>>,
}

/// The flow from one time to the next about a motion.
pub(super) struct LinearFlow<const D: usize, const N: usize> {
    /// Where it leads without the friction that the equations lack.
    end: SVector<f64, D>,
    /// Derivative of the end, with that friction as it is.
    transition: SMatrix<f64, D, D>,
    /// Changes of the end by coefficients of friction of one.
    effects: Effects<D, N>,
    /// Accelerations by generalized forces.
    inverse_mass: SMatrix<f64, N, N>,
}

/// Findings of a filter.
pub(super) struct Filtered<const D: usize, const N: usize> {
    pub(super) innovations: Innovations,
    pub(super) steps: Vec<Step<D>>,
    /// The coefficients of friction.
    pub(super) constants: FittedConstants<N>,
    pub(super) effects: Vec<StepEffects<D, N>>,
    pub(super) disturbances: Disturbances<D>,
}

/// A motion, with the friction that acts on it beside the equations.
#[derive(Clone)]
pub(super) struct BrakedMotion<const D: usize, const N: usize> {
    pub(super) states: Vec<[f64; D]>,
    /// Coefficients of the friction.
    pub(super) frictions: SVector<f64, N>,
}

/// The motion for given ratios q τ³/σ².
pub(super) struct SmoothingSolution<const D: usize, const N: usize> {
    /// Their logarithms: one for each kind of disturbance, or one for all.
    pub(super) logs: Vec<f64>,
    pub(super) motion: BrakedMotion<D, N>,
    /// Findings of the filter that led to it.
    pub(super) filtered: Filtered<D, N>,
}

impl<const N: usize, L, M, A> ModelFilter<'_, N, L, M, A>
where
    L: Linearised<f64>,
    M: for<'a> Integrator<f64, Variational<'a, L>>,
    A: Fn(&[f64; N]) -> [[f64; N]; N],
{
    /// The deviation of the data that goes with logarithms of ratios, where one is given.
    fn given_noise(&self, logs: &[f64]) -> Option<f64> {
        let ratio = || logs.first().map_or(1.0, |log| log.exp());
        let of = |q: f64| (q * self.unit.powi(3) / ratio()).sqrt();
        self.noise.or_else(|| self.density.map(of))
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
        mut motion: BrakedMotion<D, N>,
        converged: f64,
    ) -> Result<SmoothingSolution<D, N>, SmoothingError> {
        for iteration in 1.. {
            let flow = self.linearise(&motion)?;
            let filtered = self.filter(logs, &motion.states, &flow);
            motion.frictions = filtered.constants.values;
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
        about: &BrakedMotion<D, N>,
    ) -> Result<Vec<LinearFlow<D, N>>, SmoothingError> {
        let ends = self.times.iter().zip(&about.states).skip(1);
        let pairs = self.times.iter().zip(&about.states).zip(ends).enumerate();
        pairs
            .map(|(index, ((&time, state), (&end, next)))| {
                let start = State::new(time, state.to_vec());
                let flow = flow_jacobian(self.method, self.system, &start, end);
                let (reached, columns) = flow.map_err(|_| SmoothingError::Diverged)?;
                let ends = [AnglesAndRates::of(state), AnglesAndRates::of(next)];
                let mut flow = LinearFlow {
                    end: SVector::from_column_slice(&reached.values),
                    transition: SMatrix::from_column_slice(&columns),
                    effects: SMatrix::zeros(),
                    inverse_mass: inverse_mass(&self.mass_matrix, &ends[0].angles, index)?,
                };
                if !self.frictions.is_empty() {
                    self.brake(&mut flow, &about.frictions, end - time, &ends, index)?;
                }
                Ok(flow)
            })
            .collect()
    }

    /// Adds friction to a flow over h: changes of its end by coefficients of one, and of its
    /// derivative by those that were found.
    fn brake<const D: usize>(
        &self,
        flow: &mut LinearFlow<D, N>,
        coefficients: &SVector<f64, N>,
        h: f64,
        [first, last]: &[AnglesAndRates<N>; 2],
        index: usize,
    ) -> Result<(), SmoothingError> {
        let middle = first.halfway(last, h);
        let at_middle = inverse_mass(&self.mass_matrix, &middle.angles, index)?;
        let at_last = inverse_mass(&self.mass_matrix, &last.angles, index)?;
        // The second half of the flow: a root of the whole, by its series.
        let unit = SMatrix::<f64, D, D>::identity();
        let change = flow.transition - unit;
        let half = unit + 0.5 * change - 0.125 * change * change;
        let mut found = SMatrix::<f64, N, N>::zeros();
        let kinds = self.frictions.iter().zip(coefficients).enumerate();
        for (column, (friction, coefficient)) in kinds {
            let push = |inverse_mass: &SMatrix<f64, N, N>, at: &AnglesAndRates<N>| {
                let braking = inverse_mass * friction * at.rates;
                SVector::<f64, D>::from_fn(|row, _| row.checked_sub(N).map_or(0.0, |i| -braking[i]))
            };
            // Simpson's rule for what a push at each time has become at the end.
            let pushes = flow.transition * push(&flow.inverse_mass, first)
                + 4.0 * half * push(&at_middle, &middle)
                + push(&at_last, last);
            flow.effects.set_column(column, &(h / 6.0 * pushes));
            found += friction * *coefficient;
        }
        let lost = h * at_middle * found;
        for (row, column) in (0..N).flat_map(|row| (0..N).map(move |column| (row, column))) {
            flow.transition[(row, N + column)] -= 0.5 * h * lost[(row, column)];
            flow.transition[(N + row, N + column)] -= lost[(row, column)];
        }
        Ok(())
    }

    pub(super) fn filter<const D: usize>(
        &self,
        logs: &[f64],
        motion: &[[f64; D]],
        flow: &[LinearFlow<D, N>],
    ) -> Filtered<D, N> {
        let ratios = logs.iter().cycle().map(|log| log.exp());
        let kinds = self.kinds.iter().zip(ratios);
        let forces: SMatrix<f64, N, N> = kinds.map(|(kind, ratio)| kind * ratio).sum();
        let mut innovations = Innovations::new(D);
        let mut steps: Vec<Step<D>> = Vec::with_capacity(self.times.len());
        let mut effects: Vec<StepEffects<D, N>> = Vec::new();
        let mut rows = Vec::new();
        let mut disturbed = Vec::with_capacity(self.times.len());
        let is_braked = !self.frictions.is_empty();
        for (index, row) in self.data.iter().enumerate() {
            let (transition, variance, predicted) = match (steps.last(), index.checked_sub(1)) {
                (Some(last), Some(before)) => {
                    let flow = &flow[before];
                    let h = (self.times[index] - self.times[before]) / self.unit;
                    let about = SVector::from(motion[before]);
                    let mean = flow.end + flow.transition * (last.updated.mean - about);
                    let accelerations = flow.inverse_mass * forces * flow.inverse_mass.transpose();
                    let noise = self.noise(&accelerations, h);
                    let transition = flow.transition;
                    let predicted = last.updated.step(mean, &transition, &noise);
                    (transition, noise, predicted)
                }
                _ => (SMatrix::identity(), SMatrix::zeros(), self.start(motion)),
            };
            let moved = effects.last().map_or_else(SMatrix::zeros, |last| {
                transition * last.updated + flow[index - 1].effects
            });
            let mut own = StepEffects {
                predicted: moved,
                updated: moved,
            };
            let mut updated = predicted;
            let mut data = Vec::with_capacity(N);
            for (component, datum) in row.iter().enumerate() {
                let Some(datum) = *datum else { continue };
                let innovation = updated.update(component, datum);
                innovations.push(innovation);
                if is_braked {
                    let moves = own.updated.row(component).into_owned();
                    own.updated -= innovation.gain * moves;
                    rows.push(moves.transpose() / innovation.variance.sqrt());
                }
                data.push(innovation);
            }
            disturbed.push(DisturbedStep {
                transition,
                variance,
                data,
            });
            if is_braked {
                effects.push(own);
            }
            steps.push(Step {
                transition,
                noise: variance,
                predicted,
                updated,
            });
        }
        let constants = FittedConstants::fit(&mut innovations, &rows, self.given_noise(logs));
        constants.move_steps(&mut steps, &effects);
        let disturbances = Disturbances {
            steps: disturbed,
            explained: constants.explained(&rows),
        };
        Filtered {
            innovations,
            steps,
            constants,
            effects,
            disturbances,
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

/// Angles and angular velocities at one time.
struct AnglesAndRates<const N: usize> {
    angles: SVector<f64, N>,
    rates: SVector<f64, N>,
}

impl<const N: usize> AnglesAndRates<N> {
    fn of(state: &[f64]) -> Self {
        let part = |first: usize| SVector::from_fn(|row, _| state[first + row]);
        Self {
            angles: part(0),
            rates: part(N),
        }
    }

    /// Angles and rates in the middle of h until others, by Hermite's cubic.
    fn halfway(&self, next: &Self, h: f64) -> Self {
        let step = next.angles - self.angles;
        Self {
            angles: self.angles + 0.5 * step + 0.125 * h * (self.rates - next.rates),
            rates: 1.5 / h * step - 0.25 * (self.rates + next.rates),
        }
    }
}

/// Returns the inverse of the mass matrix at the angles of the time with this index.
pub(super) fn inverse_mass<const N: usize>(
    mass_matrix: impl Fn(&[f64; N]) -> [[f64; N]; N],
    angles: &SVector<f64, N>,
    index: usize,
) -> Result<SMatrix<f64, N, N>, SmoothingError> {
    let rows = mass_matrix(&(*angles).into());
    let mass = SMatrix::<f64, N, N>::from_fn(|row, column| rows[row][column]);
    let factor = mass.cholesky().ok_or(SmoothingError::Mass { index })?;
    Ok(factor.inverse())
}
