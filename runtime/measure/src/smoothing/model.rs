//! Smoothing of measured angles by equations of motion.

use nalgebra::{DMatrix, DVector};

use super::disturbances::Disturbances;
use super::error::{SmoothingError, check_length, check_option, check_times, usual_interval};
use super::gaussian::{carried, gains};
use super::likelihood::climb;
use super::model_filter::{
    BrakedMotion, Filtered, MassFn, ModelFilter, SmoothingSolution, inverse_mass,
};
use super::series::{Scale, SmoothedMotion};
use branched_pendulum::analysis::variational::{Linearised, Variational, flow_jacobian};
use branched_pendulum::integrate::Integrator;
use branched_pendulum::system::State;

/// A smoother that uses the equations of motion: between two times the state obeys the equations,
/// disturbed by white-noise generalized forces of spectral density q, which represent everything
/// that the model lacks. It is a Gauss–Newton iteration of a Kalman smoother, linearised about the
/// motion (physics §16; B. M. Bell, *The iterated Kalman smoother as a Gauss–Newton method*, SIAM
/// J. Optim. 4 (1994)).
///
/// With the most likely q, errors depend on the quality of the model: with the right model they are
/// those of the best single trajectory, with a wrong one no larger than without any model. Forces
/// that a model lacks seldom act equally on all links: friction on the motion in phase is far larger
/// than on a small difference of identical branches. [`disturbances`](Self::disturbances) separates
/// such patterns, each with its own density.
///
/// White forces do not represent friction well, since it is always opposite to the velocity.
/// [`frictions`](Self::frictions) fits the friction that the equations lack, or have in excess, as
/// a coefficient for each kind.
///
/// To test the equations, compare the motion's [`disturbances`](SmoothedMotion::disturbances) with
/// [`spurious_disturbances`](SmoothedMotion::spurious_disturbances), which noise alone causes: they
/// have much more energy only if the equations are wrong.
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
    /// Standard deviation σ of measured angles, rad; `None` for the most likely value.
    pub noise: Option<f64>,
    /// Spectral density q of the generalized forces, (N m)² s; `None` for the most likely value.
    pub density: Option<f64>,
    /// Patterns of the generalized forces, each with one number for each angle. Each pattern has
    /// its own density, the most likely one. If empty, all angles are disturbed independently with
    /// one density.
    pub disturbances: Vec<Vec<f64>>,
    /// Kinds of viscous friction that the equations may lack. A kind is a list of relative angles
    /// p·θ on which it acts, one for each joint, with torques −c Σ p (p·ω); p has one number for
    /// each angle. The coefficient c (N m s) of a kind is fitted if it increases the likelihood by
    /// more than an additional number does by chance (Schwarz's criterion), and is zero otherwise.
    pub frictions: Vec<Vec<Vec<f64>>>,
}

/// Change of the angles, in standard deviations of the data, below which the iteration ends.
const CONVERGED: f64 = 1e-3;
/// Change of the angles, in standard deviations of the data, below which the iteration ends if only
/// the likelihood is needed.
const NEAR: f64 = 0.1;
/// Range of ln(q τ³/σ²) that is searched, from the largest value down: each motion starts from the
/// previous one, and with a large density q any motion is fitted easily. τ is the interval between
/// data, σ their standard deviation.
const LOG_RATIOS: [f64; 2] = [-35.0, 2.0];
/// Distance between two values of ln(q τ³/σ²) in the first search.
const LOG_STEP: f64 = 2.5;
/// Decrease of the log-likelihood from its maximum after which smaller values are not tried.
const HOPELESS: f64 = 20.0;
/// First and last step of the refined search for the most likely values, in logarithms.
const STEPS: [f64; 2] = [LOG_STEP, 0.3];
/// Number of refined searches, each linearised about the motion of the one before.
const SEARCHES: usize = 2;

impl ModelSmoother {
    /// Longest step (s) of a fourth-order method between two times; its error is far below that of
    /// any camera.
    pub const LONGEST_STEP: f64 = 2e-3;

    /// Estimates angles and angular velocities at all times, also where data are missing.
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
        let flow = |start: &State<f64>, end: f64| {
            let flow = flow_jacobian(method, system, start, end);
            flow.map_err(|_| SmoothingError::Diverged)
        };
        let problem = ModelFilter {
            flow: &flow,
            mass_matrix: &mass_matrix,
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

    /// Returns the covariances of the generalized forces, one for each separate density.
    fn kinds(&self, links: usize) -> Vec<DMatrix<f64>> {
        if self.disturbances.is_empty() {
            return vec![DMatrix::identity(links, links)];
        }
        self.disturbances.iter().map(|own| square(own)).collect()
    }

    /// Returns, for each kind of friction, the matrix that converts angular velocities to friction
    /// torques (with their sign) for a coefficient of 1.
    fn torques_of_friction(&self, links: usize) -> Vec<DMatrix<f64>> {
        let none = DMatrix::zeros(links, links);
        let sum = |joints: &Vec<Vec<f64>>| {
            let joints = joints.iter().map(|joint| square(joint));
            joints.fold(none.clone(), |sum, joint| sum + joint)
        };
        self.frictions.iter().map(sum).collect()
    }

    fn likeliest(
        &self,
        problem: &ModelFilter<'_>,
        start: BrakedMotion,
    ) -> Result<SmoothingSolution, SmoothingError> {
        let of = |solution: &SmoothingSolution| {
            problem.likelihood(&solution.logs, &solution.filtered.innovations)
        };
        let [low, high] = LOG_RATIOS;
        let mut log = high;
        let mut best = problem.solve(&[log], start, NEAR)?;
        let mut last = best.motion.clone();
        while log > low {
            log -= LOG_STEP;
            // With an even smaller density the model cannot follow the data: the search ends.
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
        // A given density is that of all patterns.
        if self.density.is_none() {
            best.logs = vec![best.logs[0]; problem.kinds.len()];
        }
        for search in 1..=SEARCHES {
            // Uses the linearisation about the best motion for nearby values.
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

/// Checks that each row has `needed` entries; `lengths` yields the index and length of each row.
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

/// Returns the matrix p pᵀ of a row p.
fn square(row: &[f64]) -> DMatrix<f64> {
    let column = column(row);
    &column * column.transpose()
}

/// Returns the spectral density of the accelerations that forces with these covariances cause, as a
/// mean over the links and the motion. It converts densities of forces to densities of
/// accelerations; 1 if there are no forces.
fn size_of_accelerations(
    kinds: &[DMatrix<f64>],
    mass_matrix: &MassFn<'_>,
    motion: &[DVector<f64>],
) -> Result<f64, SmoothingError> {
    let (mut sum, mut count) = (0.0, 0);
    for (index, state) in motion.iter().enumerate() {
        let (angles, _) = state.as_slice().split_at(state.len() / 2);
        let inverse = inverse_mass(mass_matrix, angles, index)?;
        let traces = kinds.iter().map(|kind| carried(&inverse, kind).trace());
        sum += traces.sum::<f64>();
        count += kinds.len() * inverse.nrows();
    }
    let mean = sum / count as f64;
    Ok(if mean > 0.0 { mean } else { 1.0 })
}

/// Returns the motion of a solution with its errors; `size` comes from [`size_of_accelerations`].
fn smoothed(
    problem: &ModelFilter<'_>,
    solution: SmoothingSolution,
    size: f64,
) -> SmoothedMotion<Vec<f64>> {
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
