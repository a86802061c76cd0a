//! A motion estimated from data, with its errors.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use super::disturbances::Disturbances;
use super::gaussian::{Innovations, Step, smoothed_means, smoothed_variances};

/// A motion at every time, its errors, and draws from all motions that the data allow. A state
/// is a row of numbers: for a [`KinematicSmoother`](super::KinematicSmoother) and
/// [`LocalPolynomials`](super::LocalPolynomials) a coordinate, its first and its second time
/// derivative in an array, for a [`ModelSmoother`](super::ModelSmoother) all angles, followed by
/// their angular velocities, in a vector.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothedMotion<R = [f64; 3]> {
    times: Vec<f64>,
    noise: f64,
    densities: Vec<f64>,
    frictions: Vec<f64>,
    means: Vec<R>,
    deviations: Vec<R>,
    /// The row beyond the last time: NaN.
    beyond: R,
    errors: Errors<R>,
    innovations: Vec<f64>,
    disturbances: Disturbances,
    free: usize,
}

/// How the errors of a motion follow from independent ones of a deviation of 1.
#[derive(Clone, Debug, PartialEq)]
enum Errors<R> {
    /// From that at the next time and errors of its own.
    Steps {
        /// Matrices for the next one, column by column, one time after the other.
        gains: Vec<f64>,
        /// Matrices for own errors, likewise.
        roots: Vec<f64>,
        /// Changes at each time by errors that all states share.
        shared: Vec<Vec<R>>,
    },
    /// As sums over errors of data.
    Sums {
        rows: Vec<DataWeights<R>>,
        /// Number of data.
        data: usize,
        /// Their deviation.
        noise: f64,
    },
}

/// Weights of some data, from the one with index `first` on, in a state.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DataWeights<R> {
    pub(super) first: usize,
    pub(super) weights: Vec<R>,
}

impl<R: AsRef<[f64]>> DataWeights<R> {
    fn add_to(&self, state: &mut [f64], data: &[f64]) {
        let terms = self.weights.iter().zip(data.iter().skip(self.first));
        terms.for_each(|(weight, datum)| add(state, *datum, weight.as_ref()));
    }
}

/// Adds a multiple of a row to another.
// Where this is inlined, the length of an array is known: draws take a third of the time.
#[inline(always)]
fn add(sum: &mut [f64], factor: f64, row: &[f64]) {
    for (sum, part) in sum.iter_mut().zip(row) {
        *sum += factor * part;
    }
}

/// Knowledge of a smoother's state beside the steps.
pub(super) struct Scale<D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Standard deviation of the data.
    pub(super) noise: f64,
    /// Spectral densities of what disturbs the motion.
    pub(super) densities: Vec<f64>,
    /// Factors that take the state to the user's units.
    pub(super) factors: OVector<f64, D>,
}

impl<R> SmoothedMotion<R> {
    /// A motion that a filter has gone over, with the gains of its steps, in rows that `row`
    /// makes of states.
    pub(super) fn new<D: Dim>(
        times: &[f64],
        steps: &[Step<D>],
        gains: &[OMatrix<f64, D, D>],
        innovations: Innovations,
        scale: Scale<D>,
        row: impl Fn(OVector<f64, D>) -> R,
    ) -> Self
    where
        DefaultAllocator: Allocator<D> + Allocator<D, D>,
    {
        let Scale {
            noise,
            densities,
            factors,
        } = scale;
        let means = smoothed_means(steps, gains);
        let means = means.iter().map(|mean| row(mean.component_mul(&factors)));
        let [variances, roots] = smoothed_variances(steps, gains);
        let deviations = variances.iter().map(|variance| {
            let deviations = variance.diagonal().map(|own| noise * own.max(0.0).sqrt());
            row(deviations.component_mul(&factors))
        });
        // Columns in the user's units, each times its factor of `from`.
        let scaled = |matrices: &[OMatrix<f64, D, D>], from: OVector<f64, D>| {
            let mut numbers = Vec::new();
            for matrix in matrices {
                for (column, from) in matrix.column_iter().zip(&from) {
                    numbers.extend(&(column.component_mul(&factors) * *from));
                }
            }
            numbers
        };
        let roots = scaled(&roots, factors.map(|_| noise));
        let mut gains = scaled(gains, factors.map(|factor| 1.0 / factor));
        // Behind the last time there is none.
        gains.resize(roots.len(), 0.0);
        Self {
            times: times.to_vec(),
            noise,
            densities,
            frictions: Vec::new(),
            means: means.collect(),
            deviations: deviations.collect(),
            beyond: row(factors.map(|_| f64::NAN)),
            errors: Errors::Steps {
                gains,
                roots,
                shared: Vec::new(),
            },
            innovations: innovations
                .standard
                .iter()
                .map(|value| value / noise)
                .collect(),
            disturbances: Disturbances::default(),
            free: innovations.free,
        }
    }
}

impl SmoothedMotion {
    /// A motion whose states are sums of data with independent errors.
    pub(super) fn by_weights(
        times: &[f64],
        rows: Vec<DataWeights<[f64; 3]>>,
        data: &[f64],
        noise: f64,
    ) -> Self {
        let mean = |row: &DataWeights<[f64; 3]>| {
            let mut state = [0.0; 3];
            row.add_to(&mut state, data);
            state
        };
        let deviation = |row: &DataWeights<[f64; 3]>| {
            [0, 1, 2].map(|part| {
                let squares = row.weights.iter().map(|weight| weight[part] * weight[part]);
                noise * squares.sum::<f64>().sqrt()
            })
        };
        Self {
            times: times.to_vec(),
            noise,
            densities: Vec::new(),
            frictions: Vec::new(),
            means: rows.iter().map(mean).collect(),
            deviations: rows.iter().map(deviation).collect(),
            beyond: [f64::NAN; 3],
            errors: Errors::Sums {
                rows,
                data: data.len(),
                noise,
            },
            innovations: Vec::new(),
            disturbances: Disturbances::default(),
            free: 0,
        }
    }
}

/// What a [`ModelSmoother`](super::ModelSmoother) finds beside the motion.
impl SmoothedMotion<Vec<f64>> {
    /// The motion with what tells its disturbances.
    pub(super) fn with_disturbances(mut self, disturbances: Disturbances) -> Self {
        self.disturbances = disturbances;
        self
    }

    /// The motion with frictions that were found with it. Their errors come to those of the
    /// states: each is independent, and a series tells what one deviation of it does at each
    /// time, for data of a standard deviation of 1.
    pub(super) fn with_frictions(
        mut self,
        frictions: Vec<f64>,
        mut errors: Vec<Vec<Vec<f64>>>,
    ) -> Self {
        self.frictions = frictions;
        for states in &mut errors {
            for (deviations, errors) in self.deviations.iter_mut().zip(states) {
                for (deviation, error) in deviations.iter_mut().zip(errors) {
                    *error *= self.noise;
                    *deviation = deviation.hypot(*error);
                }
            }
        }
        if let Errors::Steps { shared, .. } = &mut self.errors {
            *shared = errors;
        }
        self
    }

    /// Coefficients (N m s) of the friction that the equations of motion lack, one for each
    /// kind that the smoother looks for: zero where the data do not ask for one.
    pub fn frictions(&self) -> &[f64] {
        &self.frictions
    }

    /// Changes of the state from the time before to each that the equations of motion do not
    /// make, nor the frictions that were found: those of the likeliest disturbances.
    pub fn disturbances(&self) -> Vec<Vec<f64>> {
        let innovations = self.innovations.iter();
        let innovations: Vec<f64> = innovations.map(|value| self.noise * value).collect();
        self.disturbances.likeliest(&innovations)
    }

    /// Draws the [`disturbances`](Self::disturbances) that another measurement would feign of a
    /// motion that has none, with its densities as they were found. What the found ones do, and
    /// these do not, is no noise: a test of the equations. `normal` gives independent numbers of
    /// a standard normal distribution.
    pub fn spurious_disturbances(&self, mut normal: impl FnMut() -> f64) -> Vec<Vec<f64>> {
        self.disturbances.spurious(|| self.noise * normal())
    }
}

impl<R: AsRef<[f64]> + AsMut<[f64]> + Clone> SmoothedMotion<R> {
    /// Times, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Standard deviation of the data.
    pub fn noise(&self) -> f64 {
        self.noise
    }

    /// Spectral densities of what disturbs the motion: the jerk of a
    /// [`KinematicSmoother`](super::KinematicSmoother) in the data's unit squared over s⁵,
    /// the generalized forces of a [`ModelSmoother`](super::ModelSmoother) in (N m)² s, one
    /// for each of its patterns; none for [`LocalPolynomials`](super::LocalPolynomials).
    pub fn densities(&self) -> &[f64] {
        &self.densities
    }

    /// Returns the state at a time, NaN beyond the last.
    pub fn mean(&self, index: usize) -> R {
        self.means.get(index).unwrap_or(&self.beyond).clone()
    }

    /// Returns the standard deviations of its numbers, NaN beyond the last time.
    pub fn deviation(&self, index: usize) -> R {
        self.deviations.get(index).unwrap_or(&self.beyond).clone()
    }

    /// Difference of each datum from the one that those before it led to expect, in standard
    /// deviations of that: white and normal if noise and motion are as assumed. The first, as many
    /// as a state has numbers, say nothing. [`LocalPolynomials`](super::LocalPolynomials) expect nothing: none.
    pub fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// Returns the correlation of successive innovations in its standard deviations for
    /// white ones: beyond some 3 the motion is not what the smoother takes it for, and its
    /// errors are larger than it says. NaN without innovations.
    pub fn whiteness(&self) -> f64 {
        let used = self.innovations.get(self.free..).unwrap_or_default();
        let square: f64 = used.iter().map(|x| x * x).sum();
        let product: f64 = used.windows(2).map(|pair| pair[0] * pair[1]).sum();
        (used.len() as f64).sqrt() * product / square
    }

    /// Draws a motion, each as likely as the data make it: the state at every time. `normal`
    /// gives independent numbers of a standard normal distribution.
    pub fn draw(&self, mut normal: impl FnMut() -> f64) -> Vec<R> {
        let mut motion = self.means.clone();
        match &self.errors {
            Errors::Steps {
                gains,
                roots,
                shared,
            } => {
                for changes in shared {
                    let size = normal();
                    for (state, change) in motion.iter_mut().zip(changes) {
                        add(state.as_mut(), size, change.as_ref());
                    }
                }
                let [mut error, mut next] = [self.beyond.clone(), self.beyond.clone()];
                next.as_mut().fill(0.0);
                let size = next.as_ref().len();
                let [gains, roots] = [gains, roots].map(|all| all.chunks_exact(size * size));
                for ((state, gain), root) in motion.iter_mut().zip(gains).zip(roots).rev() {
                    error.as_mut().fill(0.0);
                    for column in root.chunks_exact(size) {
                        add(error.as_mut(), normal(), column);
                    }
                    for (column, next) in gain.chunks_exact(size).zip(next.as_ref()) {
                        add(error.as_mut(), *next, column);
                    }
                    add(state.as_mut(), 1.0, error.as_ref());
                    core::mem::swap(&mut error, &mut next);
                }
            }
            Errors::Sums { rows, data, noise } => {
                let errors: Vec<f64> = (0..*data).map(|_| noise * normal()).collect();
                for (state, row) in motion.iter_mut().zip(rows) {
                    row.add_to(state.as_mut(), &errors);
                }
            }
        }
        motion
    }
}
