//! Smoother whose motion obeys equations of motion.

use nalgebra::{SMatrix, SVector};

use super::error::{SmoothingError, check_option, check_times, usual_interval};
use super::likelihood::climb;
use super::model_filter::{DampedMotion, Filtered, ModelFilter, SmoothingSolution};
use super::series::{Scale, SmoothedMotion};
use crate::analysis::variational::{Linearised, Variational};
use crate::integrate::Integrator;

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
/// White accelerations stand for anything, and know nothing of friction: that its force is
/// opposite to the velocity all the time. Where equations lack friction, or have too much,
/// [`damping`](Self::damping) finds what is missing in a number for each pattern.
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
    /// True finds for each of the first `N` patterns a damping γ that the equations lack, an
    /// acceleration −γ times the part of the angular velocities in the pattern, where the
    /// likelihood gains more by it than one more number does by itself (Schwarz's criterion).
    pub damping: bool,
}

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
            noise: self.noise,
            acceleration: self.acceleration,
            kinds: self.kinds(),
            dampings: self.dampings(),
        };
        let cube = problem.unit.powi(3);
        let ratio = match (self.noise, self.acceleration) {
            (Some(noise), Some(q)) => Some(q * cube / (noise * noise)),
            _ => None,
        };
        let start = DampedMotion {
            states: guess.to_vec(),
            dampings: SVector::zeros(),
        };
        let solution = match ratio {
            Some(ratio) => problem.solve(&[ratio.ln()], start, CONVERGED)?,
            None => self.likeliest(&problem, start)?,
        };
        let SmoothingSolution { logs, filtered, .. } = solution;
        let Filtered {
            innovations,
            steps,
            constants,
            effects,
        } = filtered;
        let noise = problem.noise_of(&logs, &innovations);
        let scale = Scale {
            noise,
            densities: logs
                .iter()
                .map(|log| log.exp() * noise * noise / cube)
                .collect(),
            factors: SVector::repeat(1.0),
        };
        let dampings = constants.values.iter().take(problem.dampings.len());
        let motion = SmoothedMotion::new(times, &steps, innovations, scale);
        Ok(motion.with_dampings(dampings.copied().collect(), |back| {
            constants.errors(back, &effects)
        }))
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

    /// Projections of the angular velocities on the patterns that may have a damping.
    fn dampings(&self) -> Vec<SMatrix<f64, N, N>> {
        if !self.damping {
            return Vec::new();
        }
        let patterns: Vec<SVector<f64, N>> = match self.disturbances.is_empty() {
            true => {
                let angles = SMatrix::<f64, N, N>::identity();
                angles
                    .column_iter()
                    .map(|angle| angle.into_owned())
                    .collect()
            }
            false => self.disturbances.iter().map(|p| (*p).into()).collect(),
        };
        let projection = |pattern: &SVector<f64, N>| {
            let square = pattern.norm_squared().max(f64::MIN_POSITIVE);
            pattern * pattern.transpose() / square
        };
        patterns.iter().take(N).map(projection).collect()
    }

    fn likeliest<const D: usize, L, M>(
        &self,
        problem: &ModelFilter<'_, N, L, M>,
        start: DampedMotion<D, N>,
    ) -> Result<SmoothingSolution<D, N>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        let of = |solution: &SmoothingSolution<D, N>| {
            problem.likelihood(&solution.logs, &solution.filtered.innovations)
        };
        let [low, high] = LOG_RATIOS;
        let mut log = high;
        let mut best = problem.solve(&[log], start, NEAR)?;
        let mut last = best.motion.clone();
        while log > low {
            log -= LOG_STEP;
            // A model that cannot follow the data any more has been trusted too far.
            let Ok(next) = problem.solve(&[log], last, NEAR) else {
                break;
            };
            last = next.motion.clone();
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
            let near = |logs: &[f64]| {
                let filtered = problem.filter(logs, &best.motion.states, &linear);
                problem.likelihood(logs, &filtered.innovations)
            };
            let logs = climb(near, best.logs.clone(), low, STEPS);
            let enough = if search < SEARCHES { NEAR } else { CONVERGED };
            best = problem.solve(&logs, best.motion, enough)?;
        }
        Ok(best)
    }
}
