//! A motion estimated from data, with its errors.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use super::disturbances::Disturbances;
use super::gaussian::{Innovations, Step, smoothed_means, smoothed_variances};

/// An estimated motion at every time, its errors, and random draws of motions that agree with the
/// data. A state is a row of numbers: for a [`KinematicSmoother`](super::KinematicSmoother) and
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
    /// The state that is returned after the last time: all numbers NaN.
    beyond: R,
    errors: Errors<R>,
    innovations: Vec<f64>,
    /// Index of the component to which each innovation belongs.
    components: Vec<usize>,
    disturbances: Disturbances,
    free: usize,
}

/// How the errors of a motion are computed from independent normal numbers.
#[derive(Clone, Debug, PartialEq)]
enum Errors<R> {
    /// Backwards from the error at the next time, plus independent errors.
    Steps {
        /// Matrices that multiply the error at the next time, column by column, one time after the
        /// other.
        gains: Vec<f64>,
        /// Also matrices for own errors.
        roots: Vec<f64>,
        /// For each source of error that is common to all times, the resulting change of the state
        /// at each time.
        shared: Vec<Vec<R>>,
    },
    /// As weighted sums of the errors of the data.
    Sums {
        rows: Vec<DataWeights<R>>,
        /// Number of data.
        data: usize,
        /// Their deviation.
        noise: f64,
    },
}

/// Weights of consecutive data in a state; the first datum has the index `first`.
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

/// Adds a multiple of one row to another.
// Where this is inlined, the length of an array is known: draws take a third of the time.
#[inline(always)]
fn add(sum: &mut [f64], factor: f64, row: &[f64]) {
    for (sum, part) in sum.iter_mut().zip(row) {
        *sum += factor * part;
    }
}

/// Properties of a smoother's state that its steps do not contain.
pub(super) struct Scale<D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Standard deviation of the data.
    pub(super) noise: f64,
    /// Spectral densities of the disturbances of the motion.
    pub(super) densities: Vec<f64>,
    /// Factors that convert the numbers of a state to the user's units.
    pub(super) factors: OVector<f64, D>,
}

impl<R> SmoothedMotion<R> {
    /// Creates the motion from the steps and gains of a filter; `row` converts its states to rows.
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
            components: innovations.components,
            disturbances: Disturbances::default(),
            free: innovations.free,
        }
    }
}

impl SmoothedMotion {
    /// Creates a motion whose states are weighted sums of data with independent errors.
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
            components: Vec::new(),
            disturbances: Disturbances::default(),
            free: 0,
        }
    }
}

/// Methods for the parameters that a [`ModelSmoother`](super::ModelSmoother) estimates together
/// with the motion.
impl SmoothedMotion<Vec<f64>> {
    /// Returns the motion with the estimated disturbances added.
    pub(super) fn with_disturbances(mut self, disturbances: Disturbances) -> Self {
        self.disturbances = disturbances;
        self
    }

    /// Returns the motion with the estimated friction added, whose errors contribute to those of
    /// the states. Each series in `errors` is the change of the states caused by one standard
    /// deviation of an independent error, for data of standard deviation 1.
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

    /// Returns the friction coefficients (N m s) that the equations of motion lack, one for each
    /// kind that the smoother searched for; zero if the data do not require it.
    pub fn frictions(&self) -> &[f64] {
        &self.frictions
    }

    /// Returns the most likely disturbances: changes of the state, from the previous time to each
    /// time, that neither the equations of motion nor the fitted friction explain.
    pub fn disturbances(&self) -> Vec<Vec<f64>> {
        let innovations = self.innovations.iter();
        let innovations: Vec<f64> = innovations.map(|value| self.noise * value).collect();
        self.disturbances.likeliest(&innovations)
    }

    /// Draws random [`disturbances`](Self::disturbances) as another measurement of a motion without
    /// any disturbance would give them, with the estimated densities. Effects of the actual
    /// disturbances that these do not show are not noise; this is a test of the equations. `normal`
    /// returns independent numbers of a standard normal distribution.
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

    /// Returns the spectral densities of the disturbances: the jerk of a
    /// [`KinematicSmoother`](super::KinematicSmoother) in the data's unit squared over s⁵, the
    /// generalized forces of a [`ModelSmoother`](super::ModelSmoother) in (N m)² s, one for each of
    /// its patterns; none for [`LocalPolynomials`](super::LocalPolynomials).
    pub fn densities(&self) -> &[f64] {
        &self.densities
    }

    /// Returns the state at the time with this index; NaN after the last time.
    pub fn mean(&self, index: usize) -> R {
        self.means.get(index).unwrap_or(&self.beyond).clone()
    }

    /// Returns the standard deviations of the state at the time with this index; NaN after the last
    /// time.
    pub fn deviation(&self, index: usize) -> R {
        self.deviations.get(index).unwrap_or(&self.beyond).clone()
    }

    /// Returns the innovations: the difference between each datum and its prediction from the data
    /// before, in units of its standard deviation. They are white and normally distributed if the
    /// assumptions on noise and motion hold. The first ones, as many as a state has numbers, carry
    /// no information. Empty for [`LocalPolynomials`](super::LocalPolynomials).
    pub fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// Returns the correlation of successive innovations of the same angle, in units of the
    /// standard deviation that it has for white innovations. NaN if there are no innovations.
    ///
    /// Innovations of a [`ModelSmoother`](super::ModelSmoother) are white by theory if its
    /// equations hold and the noise is white: above about 3, one of these assumptions is wrong, and
    /// errors are larger than the smoother reports. Innovations of a
    /// [`KinematicSmoother`](super::KinematicSmoother) may exceed this value although its errors
    /// are correct, because the jerk of a real motion is not white.
    pub fn whiteness(&self) -> f64 {
        let used = self
            .innovations
            .iter()
            .zip(&self.components)
            .skip(self.free);
        // Errors of different angles at one time may be correlated, as those of two links with a
        // common dot are.
        let mut before: Vec<Option<f64>> = Vec::new();
        let (mut square, mut product, mut pairs) = (0.0, 0.0, 0_u32);
        for (&own, &component) in used {
            if before.len() <= component {
                before.resize(component + 1, None);
            }
            if let Some(last) = before[component].replace(own) {
                product += last * own;
                square += own * own;
                pairs += 1;
            }
        }
        f64::from(pairs).sqrt() * product / square
    }

    /// Draws a random motion that agrees with the data, in proportion to its probability; returns
    /// the state at every time. `normal` returns independent numbers of a standard normal
    /// distribution.
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
