//! Smoother whose motion obeys equations of motion.

use nalgebra::{DMatrix, DVector};

use super::disturbances::Disturbances;
use super::error::{SmoothingError, check_length, check_option, check_times, usual_interval};
use super::gaussian::{carried, gains};
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
///     disturbances: vec![
///         vec![1.0, 0.0, 0.0],
///         vec![0.0, 1.0, 1.0],
///         vec![0.0, 1.0, -1.0],
///     ],
///     frictions: vec![
///         vec![vec![1.0, 0.0, 0.0]],
///         vec![vec![-1.0, 1.0, 0.0], vec![-1.0, 0.0, 1.0]],
///     ],
///     ..ModelSmoother::default()
/// };
/// # assert_eq!(smoother.disturbances.len(), 3);
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ModelSmoother {
    /// Standard deviation σ of measured angles, rad; without it the one of largest
    /// likelihood.
    pub noise: Option<f64>,
    /// Spectral density q of the generalized forces, (N m)² s; without it the one of
    /// largest likelihood.
    pub density: Option<f64>,
    /// Patterns of the generalized forces, each a number for each angle and with the likeliest
    /// density of its own; without any all angles are disturbed independently with one density.
    pub disturbances: Vec<Vec<f64>>,
    /// Viscous friction that the equations may lack: of each kind the relative angles p·θ on
    /// which it acts, one for each joint, with torques −c Σ p (p·ω); p is a number for each angle.
    /// Each coefficient c (N m s) is found where the likelihood gains more by it than one more
    /// number does by itself (Schwarz's criterion), and zero otherwise.
    pub frictions: Vec<Vec<Vec<f64>>>,
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

impl ModelSmoother {
    /// Longest step (s) from time to time of a method of fourth order: its error is far
    /// below that of any camera.
    pub const LONGEST_STEP: f64 = 2e-3;

    /// Estimates angles and angular velocities at all times, where data are missing too.
    ///
    /// | argument | meaning |
    /// |---|---|
    /// | `method` | integrates from time to time |
    /// | `system` | rates of a state of 2n numbers: n angles, followed by their rates |
    /// | `mass_matrix` | n rows of n numbers (kg m²) at n angles, by which forces accelerate; where it is the unit matrix, disturbances and friction are accelerations |
    /// | `data` | for each time a row of the n angles (rad), none where one is missing |
    /// | `guess` | for each time a state near the true one, as a [`KinematicSmoother`](super::KinematicSmoother) finds it |
    ///
    /// The cost is that of 2n deviations over the record for each iteration, of which there are
    /// some 5 for each of some 15 values of q.
    ///
    /// # Errors
    ///
    /// [`SmoothingError`]; [`SmoothingError::Diverged`] where the motion of the model does
    /// not stay near the data.
    pub fn smooth<L, M>(
        &self,
        method: &M,
        system: &L,
        mass_matrix: impl Fn(&[f64]) -> Vec<Vec<f64>>,
        times: &[f64],
        data: &[Vec<Option<f64>>],
        guess: &[Vec<f64>],
    ) -> Result<SmoothedMotion<Vec<f64>>, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
    {
        self.check(system.dimension(), times, data, guess)?;
        let unit = usual_interval(times);
        let links = system.dimension() / 2;
        let states: Vec<_> = guess.iter().map(|state| column(state)).collect();
        let mut kinds = self.kinds(links);
        let size = size_of_accelerations(&kinds, &mass_matrix, &states)?;
        for kind in &mut kinds {
            *kind /= size;
        }
        let problem = ModelFilter {
            method,
            system,
            mass_matrix,
            times,
            data,
            links,
            unit,
            noise: self.noise,
            density: self.density.map(|density| density * size),
            kinds,
            frictions: self.torques_of_friction(links),
        };
        let cube = unit.powi(3);
        let ratio = match (problem.noise, problem.density) {
            (Some(noise), Some(q)) => Some(q * cube / (noise * noise)),
            _ => None,
        };
        let start = BrakedMotion {
            states,
            frictions: DVector::zeros(self.frictions.len()),
        };
        let solution = match ratio {
            Some(ratio) => problem.solve(&[ratio.ln()], start, CONVERGED)?,
            None => self.likeliest(&problem, start)?,
        };
        Ok(smoothed(&problem, solution, size))
    }

    fn check(
        &self,
        dimension: usize,
        times: &[f64],
        data: &[Vec<Option<f64>>],
        guess: &[Vec<f64>],
    ) -> Result<(), SmoothingError> {
        let links = dimension / 2;
        if dimension != 2 * links {
            return Err(SmoothingError::Dimension { dimension });
        }
        check_length(times, "data", data.len())?;
        check_length(times, "guess", guess.len())?;
        let frictions = self.frictions.iter().enumerate();
        let frictions = frictions.flat_map(|(kind, all)| all.iter().map(move |row| (kind, row)));
        check_rows("data", links, data.iter().map(Vec::len).enumerate())?;
        check_rows("guess", dimension, guess.iter().map(Vec::len).enumerate())?;
        let disturbances = self.disturbances.iter().map(Vec::len).enumerate();
        check_rows("disturbances", links, disturbances)?;
        let frictions = frictions.map(|(kind, row)| (kind, row.len()));
        check_rows("frictions", links, frictions)?;
        let found = data.iter().flatten().flatten().count();
        let needed = dimension + 1;
        if found < needed || times.len() < 2 {
            return Err(SmoothingError::TooFew { found, needed });
        }
        check_times(times)?;
        for (index, (data, guess)) in data.iter().zip(guess).enumerate() {
            let mut all = data.iter().flatten().chain(guess);
            if let Some(&value) = all.find(|value| !value.is_finite()) {
                return Err(SmoothingError::Datum { index, value });
            }
        }
        check_option("noise", self.noise)?;
        check_option("density", self.density)
    }

    /// Covariances of the forces that have a density of their own.
    fn kinds(&self, links: usize) -> Vec<DMatrix<f64>> {
        if self.disturbances.is_empty() {
            return vec![DMatrix::identity(links, links)];
        }
        self.disturbances.iter().map(|own| square(own)).collect()
    }

    /// Torques of each kind of friction by angular velocities, for a coefficient of one, with
    /// the sign of the friction.
    fn torques_of_friction(&self, links: usize) -> Vec<DMatrix<f64>> {
        let none = DMatrix::zeros(links, links);
        let sum = |joints: &Vec<Vec<f64>>| {
            let joints = joints.iter().map(|joint| square(joint));
            joints.fold(none.clone(), |sum, joint| sum + joint)
        };
        self.frictions.iter().map(sum).collect()
    }

    fn likeliest<L, M, A>(
        &self,
        problem: &ModelFilter<'_, L, M, A>,
        start: BrakedMotion,
    ) -> Result<SmoothingSolution, SmoothingError>
    where
        L: Linearised<f64>,
        M: for<'a> Integrator<f64, Variational<'a, L>>,
        A: Fn(&[f64]) -> Vec<Vec<f64>>,
    {
        let of = |solution: &SmoothingSolution| {
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
                problem.likelihood(
                    logs,
                    &problem.innovations(logs, &best.motion.states, &linear),
                )
            };
            let logs = climb(near, best.logs.clone(), low, STEPS);
            let enough = if search < SEARCHES { NEAR } else { CONVERGED };
            best = problem.solve(&logs, best.motion, enough)?;
        }
        Ok(best)
    }
}

/// Refuses rows, by their indices and lengths, that do not have a number for each of `needed`.
fn check_rows(
    rows: &'static str,
    needed: usize,
    mut lengths: impl Iterator<Item = (usize, usize)>,
) -> Result<(), SmoothingError> {
    match lengths.find(|(_, found)| *found != needed) {
        None => Ok(()),
        Some((index, found)) => Err(SmoothingError::Row {
            rows,
            index,
            found,
            needed,
        }),
    }
}

fn column(row: &[f64]) -> DVector<f64> {
    DVector::from_column_slice(row)
}

/// The matrix p pᵀ of a row p.
fn square(row: &[f64]) -> DMatrix<f64> {
    let column = column(row);
    &column * column.transpose()
}

/// Density of the accelerations by forces of these covariances, a mean over the links and the
/// motion: by which densities of forces are told as such of accelerations. One where there are
/// no forces.
fn size_of_accelerations(
    kinds: &[DMatrix<f64>],
    mass_matrix: impl Fn(&[f64]) -> Vec<Vec<f64>>,
    motion: &[DVector<f64>],
) -> Result<f64, SmoothingError> {
    let (mut sum, mut count) = (0.0, 0);
    for (index, state) in motion.iter().enumerate() {
        let (angles, _) = state.as_slice().split_at(state.len() / 2);
        let inverse = inverse_mass(&mass_matrix, angles, index)?;
        let traces = kinds.iter().map(|kind| carried(&inverse, kind).trace());
        sum += traces.sum::<f64>();
        count += kinds.len() * inverse.nrows();
    }
    let mean = sum / count as f64;
    Ok(if mean > 0.0 { mean } else { 1.0 })
}

/// The motion of a solution with its errors, `size` being that of [`size_of_accelerations`].
fn smoothed<L, M, A>(
    problem: &ModelFilter<'_, L, M, A>,
    solution: SmoothingSolution,
    size: f64,
) -> SmoothedMotion<Vec<f64>>
where
    L: Linearised<f64>,
    M: for<'a> Integrator<f64, Variational<'a, L>>,
    A: Fn(&[f64]) -> Vec<Vec<f64>>,
{
    let cube = problem.unit.powi(3);
    let SmoothingSolution { logs, filtered, .. } = solution;
    let Filtered {
        innovations,
        steps,
        data,
        constants,
        rows,
        effects,
    } = filtered;
    let noise = problem.noise_of(&logs, &innovations);
    let scale = Scale {
        noise,
        densities: logs
            .iter()
            .map(|log| log.exp() * noise * noise / (cube * size))
            .collect(),
        factors: DVector::repeat(2 * problem.links, 1.0),
    };
    let gains = gains(&steps);
    let row = |state: DVector<f64>| state.data.into();
    let motion = SmoothedMotion::new(problem.times, &steps, &gains, innovations, scale, row);
    let frictions = constants.values.iter().copied().collect();
    let motion = motion.with_frictions(frictions, constants.errors(&gains, &effects));
    let explained = constants.explained(&rows);
    motion.with_disturbances(Disturbances::new(steps, data, explained))
}
