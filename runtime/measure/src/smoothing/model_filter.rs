//! Kalman filter and smoother, linearised about a motion that satisfies given equations.

use nalgebra::{DMatrix, DVector, Dyn};

use super::constants::{FittedConstants, StepEffects};
use super::error::SmoothingError;
use super::gaussian::{Gaussian, Innovation, Innovations, Step, carried, gains, smoothed_means};
use super::kinematic::DIFFUSE;
use branched_pendulum::system::State;

/// Largest number of Gauss–Newton iterations for one value of the density q.
const ITERATIONS: usize = 12;

/// Function that returns the state at a given time of the motion from a given state, and the columns
/// of its derivative by that state.
pub(super) type FlowFn<'a> =
    dyn Fn(&State<f64>, f64) -> Result<(State<f64>, Vec<f64>), SmoothingError> + 'a;

/// Function that returns the rows of the mass matrix at given angles.
pub(super) type MassFn<'a> = dyn Fn(&[f64]) -> Vec<Vec<f64>> + 'a;

/// Measured data, and the equations of motion of the measured system. They are behind `dyn`, so that
/// the filter is compiled only once for all systems and methods.
pub(super) struct ModelFilter<'a> {
    pub(super) flow: &'a FlowFn<'a>,
    pub(super) mass_matrix: &'a MassFn<'a>,
    pub(super) times: &'a [f64],
    pub(super) data: &'a [Vec<Option<f64>>],
    /// Number of angles.
    pub(super) links: usize,
    /// The usual interval, s.
    pub(super) unit: f64,
    /// Standard deviation of the data; `None` if it is to be estimated.
    pub(super) noise: Option<f64>,
    /// Spectral density of the disturbances; `None` if it is to be estimated.
    pub(super) density: Option<f64>,
    /// Covariances of the disturbances, scaled so that the density of the accelerations is about 1.
    pub(super) kinds: Vec<DMatrix<f64>>,
    /// For each kind of friction, the matrix that converts angular velocities to friction torques
    /// (with their sign) for a coefficient of 1.
    pub(super) frictions: Vec<DMatrix<f64>>,
}

/// Motion from one time to the next, linearised about a given motion.
pub(super) struct LinearFlow {
    /// State at the end of the step, without the additional friction.
    end: DVector<f64>,
    /// Derivative of the end by the start, including the additional friction.
    transition: DMatrix<f64>,
    /// Changes of the end caused by each friction coefficient with the value 1, one column per
    /// coefficient.
    effects: DMatrix<f64>,
    /// Inverse of the mass matrix, which converts generalized forces to accelerations.
    inverse_mass: DMatrix<f64>,
}

/// Results of a run of the filter.
pub(super) struct Filtered {
    pub(super) innovations: Innovations,
    pub(super) steps: Vec<Step<Dyn>>,
    /// Innovations (prediction errors) of the data at each time, in the order in which they were
    /// used.
    pub(super) data: Vec<Vec<Innovation<Dyn>>>,
    /// The fitted friction coefficients.
    pub(super) constants: FittedConstants,
    /// Changes of each innovation caused by friction coefficients of 1, in units of the
    /// innovation's standard deviation.
    pub(super) rows: Vec<DVector<f64>>,
    /// Changes of the states caused by friction coefficients of 1.
    pub(super) effects: Vec<StepEffects>,
}

/// A motion, with the fitted friction that acts in addition to that in the equations.
#[derive(Clone)]
pub(super) struct BrakedMotion {
    pub(super) states: Vec<DVector<f64>>,
    /// Friction coefficients.
    pub(super) frictions: DVector<f64>,
}

/// The most likely motion for given ratios q τ³/σ² of disturbance and noise.
pub(super) struct SmoothingSolution {
    /// Logarithms of the ratios q τ³/σ²: one for each kind of disturbance, or one for all.
    pub(super) logs: Vec<f64>,
    pub(super) motion: BrakedMotion,
    /// Results of the filter run for this motion.
    pub(super) filtered: Filtered,
}

impl ModelFilter<'_> {
    /// Returns the standard deviation of the data for these logarithms of the ratios, if it or the
    /// density is given.
    fn given_noise(&self, logs: &[f64]) -> Option<f64> {
        let ratio = || logs.first().map_or(1.0, |log| log.exp());
        let of = |q: f64| (q * self.unit.powi(3) / ratio()).sqrt();
        self.noise.or_else(|| self.density.map(of))
    }

    /// Returns the standard deviation of the data: the given or, if none is given, the most likely
    /// one.
    pub(super) fn noise_of(&self, logs: &[f64], innovations: &Innovations) -> f64 {
        self.given_noise(logs)
            .unwrap_or_else(|| innovations.noise())
    }

    pub(super) fn likelihood(&self, logs: &[f64], innovations: &Innovations) -> f64 {
        innovations.log_likelihood(Some(self.noise_of(logs, innovations)))
    }

    /// Iterates from a motion to the most likely motion, until a change is smaller than `converged`
    /// standard deviations of the data.
    pub(super) fn solve(
        &self,
        logs: &[f64],
        mut motion: BrakedMotion,
        converged: f64,
    ) -> Result<SmoothingSolution, SmoothingError> {
        for iteration in 1.. {
            let flow = self.linearise(&motion)?;
            let filtered = self.filter(logs, &motion.states, &flow);
            motion.frictions.copy_from(&filtered.constants.values);
            let smoothed = smoothed_means(&filtered.steps, &gains(&filtered.steps));
            let mut change = 0.0_f64;
            for (old, new) in motion.states.iter().zip(&smoothed) {
                for (old, new) in old.iter().zip(new).take(self.links) {
                    // Written so that NaN does not count as small.
                    change = if (new - old).abs() <= change {
                        change
                    } else {
                        (new - old).abs()
                    };
                }
            }
            motion.states = smoothed;
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

    pub(super) fn linearise(
        &self,
        about: &BrakedMotion,
    ) -> Result<Vec<LinearFlow>, SmoothingError> {
        let ends = self.times.iter().zip(&about.states).skip(1);
        let pairs = self.times.iter().zip(&about.states).zip(ends).enumerate();
        let size = 2 * self.links;
        pairs
            .map(|(index, ((&time, state), (&end, next)))| {
                let start = State::new(time, state.as_slice().to_vec());
                let (reached, columns) = (self.flow)(&start, end)?;
                let ends = [state, next].map(AnglesAndRates::of);
                let angles = ends[0].angles.as_slice();
                let inverse_mass = inverse_mass(self.mass_matrix, angles, index)?;
                let mut flow = LinearFlow {
                    end: DVector::from_vec(reached.values),
                    transition: DMatrix::from_vec(size, size, columns),
                    effects: DMatrix::zeros(size, self.frictions.len()),
                    inverse_mass,
                };
                if !self.frictions.is_empty() {
                    self.brake(&mut flow, &about.frictions, end - time, &ends, index)?;
                }
                Ok(flow)
            })
            .collect()
    }

    /// Adds friction to the linearised motion over a step of length h: the changes of its end by
    /// coefficients of 1, and the change of its derivative by the fitted coefficients.
    fn brake(
        &self,
        flow: &mut LinearFlow,
        coefficients: &DVector<f64>,
        h: f64,
        [first, last]: &[AnglesAndRates; 2],
        index: usize,
    ) -> Result<(), SmoothingError> {
        let links = self.links;
        let middle = first.halfway(last, h);
        let at_middle = inverse_mass(self.mass_matrix, middle.angles.as_slice(), index)?;
        let at_last = inverse_mass(self.mass_matrix, last.angles.as_slice(), index)?;
        // The second half of the flow: the square root of the whole, by its series.
        let unit = DMatrix::identity(2 * links, 2 * links);
        let change = &flow.transition - &unit;
        let half = unit + 0.5 * &change - 0.125 * &change * &change;
        // Changes of the end by changes of the rates at the start and in the middle.
        let [whole, half] = [&flow.transition, &half].map(|flow| flow.columns(links, links));
        let mut found = DMatrix::zeros(links, links);
        let kinds = self.frictions.iter().zip(coefficients).enumerate();
        for (column, (friction, coefficient)) in kinds {
            let braking = |inverse_mass: &DMatrix<f64>, at: &AnglesAndRates| {
                inverse_mass * (friction * &at.rates)
            };
            // Simpson's rule for the effects at the end of pushes at all times.
            let mut pushes = whole * braking(&flow.inverse_mass, first);
            pushes += half * braking(&at_middle, &middle) * 4.0;
            let mut rates = pushes.rows_mut(links, links);
            rates += braking(&at_last, last);
            flow.effects.set_column(column, &(-h / 6.0 * pushes));
            found += friction * *coefficient;
        }
        let lost = h * at_middle * found;
        let mut by_rates = flow.transition.columns_mut(links, links);
        let mut angles = by_rates.rows_mut(0, links);
        angles -= 0.5 * h * &lost;
        let mut rates = by_rates.rows_mut(links, links);
        rates -= lost;
        Ok(())
    }

    /// Runs the filter and returns its steps.
    pub(super) fn filter(
        &self,
        logs: &[f64],
        motion: &[DVector<f64>],
        flow: &[LinearFlow],
    ) -> Filtered {
        self.run(logs, motion, flow, true)
    }

    /// Runs the filter and returns only its innovations (prediction errors).
    pub(super) fn innovations(
        &self,
        logs: &[f64],
        motion: &[DVector<f64>],
        flow: &[LinearFlow],
    ) -> Innovations {
        self.run(logs, motion, flow, false).innovations
    }

    fn run(
        &self,
        logs: &[f64],
        motion: &[DVector<f64>],
        flow: &[LinearFlow],
        is_kept: bool,
    ) -> Filtered {
        let ratios = logs.iter().cycle().map(|log| log.exp());
        let mut forces = DMatrix::zeros(self.links, self.links);
        for (kind, ratio) in self.kinds.iter().zip(ratios) {
            forces += kind * ratio;
        }
        let size = 2 * self.links;
        let mut innovations = Innovations::new(size);
        let (mut steps, mut all_data) = (Vec::new(), Vec::new());
        let (mut rows, mut effects) = (Vec::new(), Vec::new());
        let is_braked = !self.frictions.is_empty();
        let mut state = self.start(motion);
        let mut moved = DMatrix::zeros(size, self.frictions.len());
        for (index, row) in self.data.iter().enumerate() {
            let last = index.checked_sub(1);
            let step = last.and_then(|last| Some((last, flow.get(last)?)));
            let noise = match step {
                Some((last, flow)) => {
                    let h = (self.times[index] - self.times[last]) / self.unit;
                    let accelerations = carried(&flow.inverse_mass, &forces);
                    let noise = self.noise(&accelerations, h);
                    let mut mean = flow.end.clone();
                    let from = &state.mean - &motion[last];
                    mean.gemv(1.0, &flow.transition, &from, 1.0);
                    state = state.step(mean, &flow.transition, &noise);
                    if is_braked {
                        moved = &flow.transition * moved + &flow.effects;
                    }
                    noise
                }
                None => DMatrix::zeros(size, size),
            };
            let before = is_kept.then(|| (state.clone(), moved.clone()));
            let mut data = Vec::with_capacity(self.links);
            for (component, datum) in row.iter().enumerate() {
                let Some(datum) = *datum else { continue };
                let innovation = state.update(component, datum);
                innovations.push(&innovation);
                if is_braked {
                    let moves = moved.row(component).transpose();
                    moved.ger(-1.0, &innovation.gain, &moves, 1.0);
                    rows.push(moves / innovation.variance.sqrt());
                }
                data.push(innovation);
            }
            if let Some((predicted, changes)) = before {
                let identity = || DMatrix::identity(size, size);
                let transition = step.map_or_else(identity, |(_, flow)| flow.transition.clone());
                steps.push(Step {
                    transition,
                    noise,
                    predicted,
                    updated: state.clone(),
                });
                effects.push(StepEffects {
                    predicted: changes,
                    updated: moved.clone(),
                });
                all_data.push(data);
            }
        }
        let constants = FittedConstants::fit(&mut innovations, &rows, self.given_noise(logs));
        constants.move_steps(&mut steps, &effects);
        Filtered {
            innovations,
            steps,
            data: all_data,
            constants,
            rows,
            effects,
        }
    }

    /// Returns the distribution of the state before the first data: practically no information.
    fn start(&self, motion: &[DVector<f64>]) -> Gaussian<Dyn> {
        let rates = DIFFUSE / (self.unit * self.unit);
        let variances = DVector::from_fn(2 * self.links, |row, _| {
            if row < self.links { DIFFUSE } else { rates }
        });
        Gaussian {
            mean: motion.first().cloned().unwrap_or_default(),
            variance: DMatrix::from_diagonal(&variances),
        }
    }

    /// Returns the covariance that white-noise accelerations add over `h` usual intervals.
    fn noise(&self, accelerations: &DMatrix<f64>, h: f64) -> DMatrix<f64> {
        let (unit, links) = (self.unit, self.links);
        DMatrix::from_fn(2 * links, 2 * links, |row, column| {
            let part = match (row < links, column < links) {
                (true, true) => h.powi(3) / 3.0,
                (false, false) => h / (unit * unit),
                _ => 0.5 * h * h / unit,
            };
            part * accelerations[(row % links, column % links)]
        })
    }
}

/// Angles and angular velocities of all links at one time.
struct AnglesAndRates {
    angles: DVector<f64>,
    rates: DVector<f64>,
}

impl AnglesAndRates {
    fn of(state: &DVector<f64>) -> Self {
        let links = state.len() / 2;
        Self {
            angles: state.rows(0, links).into_owned(),
            rates: state.rows(links, links).into_owned(),
        }
    }

    /// Returns the angles and velocities in the middle between this time and the next one, `h`
    /// later, by Hermite's cubic polynomial.
    fn halfway(&self, next: &Self, h: f64) -> Self {
        let step = &next.angles - &self.angles;
        Self {
            angles: &self.angles + 0.5 * &step + 0.125 * h * (&self.rates - &next.rates),
            rates: 1.5 / h * step - 0.25 * (&self.rates + &next.rates),
        }
    }
}

/// Returns the inverse of the mass matrix at the given angles; `index` is the index of the time,
/// for messages.
pub(super) fn inverse_mass(
    mass_matrix: &MassFn<'_>,
    angles: &[f64],
    index: usize,
) -> Result<DMatrix<f64>, SmoothingError> {
    let (rows, links) = (mass_matrix(angles), angles.len());
    let is_square = rows.len() == links && rows.iter().all(|row| row.len() == links);
    let mass = || DMatrix::from_fn(links, links, |row, column| rows[row][column]);
    let factor = is_square.then(mass).and_then(DMatrix::cholesky);
    let angles = links;
    let factor = factor.ok_or(SmoothingError::Mass { index, angles })?;
    Ok(factor.inverse())
}
