//! Smoother whose motion obeys equations of motion.

use nalgebra::{SMatrix, SVector};

use super::error::{SmoothingError, check_option, check_times, usual_interval};
use super::likelihood::climb;
use super::model_filter::{BrakedMotion, Filtered, ModelFilter, SmoothingSolution, inverse_mass};
use super::series::{Scale, SmoothedMotion};
use branched_pendulum::analysis::variational::{Linearised, Variational};
use branched_pendulum::integrate::Integrator;

/// A smoother that knows the equations of motion: between times the state follows them but
/// for white generalized forces of a spectral density q, which stand for all that the
/// model lacks. Gauss–Newton iteration of a Kalman smoother about the motion's own
/// linearisation (physics §16; B. M. Bell, *The iterated Kalman smoother as a Gauss–Newton
/// method*, SIAM J. Optim. 4 (1994)).
///
/// With the likeliest q, errors are as small as the model is good: with the right model
/// those of the best single trajectory, with a wrong one no worse than without any. What a
/// model lacks seldom acts on all links alike: friction on the motion in phase is far larger
/// than on a small difference of identical branches. [`disturbances`](Self::disturbances)
/// tell such patterns apart, and each has a density of its own.
///
/// White forces stand for anything, and know nothing of friction: that it is
/// opposite to the velocity all the time. [`frictions`](Self::frictions) finds what the
/// equations lack of it, or have too much, as a coefficient for each joint.
///
/// Whether the equations hold is asked of the motion's
/// [`disturbances`](SmoothedMotion::disturbances): noise alone does not bring much more energy
/// than [`spurious_disturbances`](SmoothedMotion::spurious_disturbances).
///
/// # Examples
///
/// A parent with two identical children, and friction in all pivots, equal in the children's:
///
/// ```
/// use branched_pendulum_measure::ModelSmoother;
///
/// let smoother = ModelSmoother {
///     disturbances: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, -1.0]],
///     frictions: vec![
///         vec![[1.0, 0.0, 0.0]],
///         vec![[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
///     ],
///     ..ModelSmoother::default()
/// };
/// # assert_eq!(smoother.disturbances.len(), 3);
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ModelSmoother<const N: usize> {
    /// Standard deviation σ of measured angles, rad; without it the one of largest
    /// likelihood.
    pub noise: Option<f64>,
    /// Spectral density q of the generalized forces, (N m)² s; without it the one of
    /// largest likelihood.
    pub density: Option<f64>,
    /// Patterns of the generalized forces on the links, each with the likeliest density of
    /// its own; without any all links are disturbed independently with one density.
    pub disturbances: Vec<[f64; N]>,
    /// Viscous friction that the equations may lack, at most `N` kinds: of each kind the
    /// relative angles p·θ on which it acts, one for each joint, with torques −c Σ p (p·ω).
    /// Each coefficient c (N m s) is found where the likelihood gains more by it than one more
    /// number does by itself (Schwarz's criterion), and zero otherwise.
    pub frictions: Vec<Vec<[f64; N]>>,
}

/// Change of the angles, in deviations of the data, below which they end.
const CONVERGED: f64 = 1e-3;
/// Change of the angles where the likelihood alone is asked for.
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
    /// the first `N = D/2` are measured; `mass_matrix` gives the rows of the mass matrix
    /// (kg m²) at angles, by which forces accelerate: where it is the unit matrix, disturbances
    /// and friction are accelerations; `method` integrates from time to time; `guess` is
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
        mass_matrix: impl Fn(&[f64; N]) -> [[f64; N]; N],
        times: &[f64],
        data: &[[Option<f64>; N]],
        guess: &[[f64; D]],
    ) -> Result<SmoothedMotion<D>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.check(system.dimension(), times, data, guess)?;
        let unit = usual_interval(times);
        let mut kinds = self.kinds();
        let size = self.size_of_accelerations(&kinds, &mass_matrix, guess)?;
        for kind in &mut kinds {
            *kind /= size;
        }
        let problem = ModelFilter {
            method,
            system,
            mass_matrix,
            times,
            data,
            unit,
            noise: self.noise,
            density: self.density.map(|density| density * size),
            kinds,
            frictions: self.torques_of_friction(),
        };
        let cube = unit.powi(3);
        let ratio = match (problem.noise, problem.density) {
            (Some(noise), Some(q)) => Some(q * cube / (noise * noise)),
            _ => None,
        };
        let start = BrakedMotion {
            states: guess.to_vec(),
            frictions: SVector::zeros(),
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
            disturbances,
        } = filtered;
        let noise = problem.noise_of(&logs, &innovations);
        let scale = Scale {
            noise,
            densities: logs
                .iter()
                .map(|log| log.exp() * noise * noise / (cube * size))
                .collect(),
            factors: SVector::repeat(1.0),
        };
        let frictions = constants.values.iter().take(problem.frictions.len());
        let motion = SmoothedMotion::new(times, &steps, innovations, scale);
        let motion = motion.with_disturbances(disturbances);
        Ok(motion.with_frictions(frictions.copied().collect(), |back| {
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
        if self.frictions.len() > N {
            return Err(SmoothingError::Frictions {
                frictions: self.frictions.len(),
                angles: N,
            });
        }
        check_option("noise", self.noise)?;
        check_option("density", self.density)
    }

    /// Covariances of the forces that have a density of their own.
    fn kinds(&self) -> Vec<SMatrix<f64, N, N>> {
        if self.disturbances.is_empty() {
            return vec![SMatrix::identity()];
        }
        let patterns = self.disturbances.iter().map(|p| SVector::from(*p));
        patterns
            .map(|pattern| pattern * pattern.transpose())
            .collect()
    }

    /// Density of the accelerations by forces of these covariances, a mean over the links and
    /// the motion: by which densities of forces are told as such of accelerations. One where
    /// there are no forces.
    fn size_of_accelerations<const D: usize>(
        &self,
        kinds: &[SMatrix<f64, N, N>],
        mass_matrix: impl Fn(&[f64; N]) -> [[f64; N]; N],
        motion: &[[f64; D]],
    ) -> Result<f64, SmoothingError> {
        let mut sum = 0.0;
        for (index, state) in motion.iter().enumerate() {
            let angles = SVector::from_fn(|row, _| state[row]);
            let inverse = inverse_mass(&mass_matrix, &angles, index)?;
            let traces = kinds
                .iter()
                .map(|kind| (inverse * kind * inverse.transpose()).trace());
            sum += traces.sum::<f64>();
        }
        let mean = sum / (motion.len() * kinds.len() * N) as f64;
        Ok(if mean > 0.0 { mean } else { 1.0 })
    }

    /// Torques of each kind of friction by angular velocities, for a coefficient of one, with
    /// the sign of the friction.
    fn torques_of_friction(&self) -> Vec<SMatrix<f64, N, N>> {
        let kinds = self.frictions.iter();
        kinds
            .map(|joints| {
                let joints = joints.iter().map(|joint| SVector::from(*joint));
                joints.map(|joint| joint * joint.transpose()).sum()
            })
            .collect()
    }

    fn likeliest<const D: usize, L, M, A>(
        &self,
        problem: &ModelFilter<'_, N, L, M, A>,
        start: BrakedMotion<D, N>,
    ) -> Result<SmoothingSolution<D, N>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
        A: Fn(&[f64; N]) -> [[f64; N]; N],
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
        if self.density.is_none() {
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
