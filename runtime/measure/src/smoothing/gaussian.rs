//! Normal distributions of a state in a Kalman filter and smoother.
//!
//! A state has `D` numbers: a constant three, or as many as a model has.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

/// Normal distribution of a state; variances are in units of the variance of the data.
#[derive(Clone, Debug)]
pub(super) struct Gaussian<D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    pub(super) mean: OVector<f64, D>,
    pub(super) variance: OMatrix<f64, D, D>,
}

/// Innovation: the difference between a datum and its prediction, its variance, and the change of
/// the state that it causes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Innovation<D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// The component that was measured.
    pub(super) component: usize,
    pub(super) value: f64,
    pub(super) variance: f64,
    /// Change of the state for an innovation of 1.
    pub(super) gain: OVector<f64, D>,
}

impl<D: Dim> Gaussian<D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Returns the distribution after a step. `mean` is the mean after it, `transition` its
    /// derivative, and `noise` the variance added by disturbances.
    pub(super) fn step(
        &self,
        mean: OVector<f64, D>,
        transition: &OMatrix<f64, D, D>,
        noise: &OMatrix<f64, D, D>,
    ) -> Self {
        let mut variance = carried(transition, &self.variance);
        variance += noise;
        symmetrise(&mut variance);
        Self { mean, variance }
    }

    /// Updates the distribution by a measured value of one component; returns the innovation.
    pub(super) fn update(&mut self, component: usize, datum: f64) -> Innovation<D> {
        let variance = self.variance[(component, component)] + 1.0;
        let gain = self.variance.column(component) / variance;
        let value = datum - self.mean[component];
        self.mean.axpy(value, &gain, 1.0);
        // Joseph's form K P Kᵀ + g gᵀ, K = 1 − g eᵀ, which stays positive: K from the left, and
        // once more after a transposition.
        for _ in 0..2 {
            for mut column in self.variance.column_iter_mut() {
                let own = column[component];
                column.axpy(-own, &gain, 1.0);
                column[component] = own / variance;
            }
            self.variance.transpose_mut();
        }
        self.variance.ger(1.0, &gain, &gain, 1.0);
        symmetrise(&mut self.variance);
        Innovation {
            component,
            value,
            variance,
            gain,
        }
    }
}

/// A filter at one time.
#[derive(Clone, Debug)]
pub(super) struct Step<D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Derivative of the step from the previous time to this one.
    pub(super) transition: OMatrix<f64, D, D>,
    /// Variance that disturbances add in this step.
    pub(super) noise: OMatrix<f64, D, D>,
    /// Distribution of the state before the data of this time are used.
    pub(super) predicted: Gaussian<D>,
    /// The state after them.
    pub(super) updated: Gaussian<D>,
}

/// Returns the smoother's gains, by which the knowledge of each state corrects the previous state;
/// one less than steps.
pub(super) fn gains<D: Dim>(steps: &[Step<D>]) -> Vec<OMatrix<f64, D, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let gain = |(step, next): (&Step<D>, &Step<D>)| {
        let mut gain = &next.transition * &step.updated.variance;
        match next.predicted.variance.clone().cholesky() {
            Some(factor) => factor.solve_mut(&mut gain),
            // A variance that rounding has made singular leaves nothing to be learnt.
            None => gain.fill(0.0),
        }
        gain.transpose_mut();
        gain
    };
    steps.iter().zip(steps.iter().skip(1)).map(gain).collect()
}

/// Returns the means of all states given all data.
pub(super) fn smoothed_means<D: Dim>(
    steps: &[Step<D>],
    gains: &[OMatrix<f64, D, D>],
) -> Vec<OVector<f64, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut means: Vec<_> = steps.iter().map(|step| step.updated.mean.clone()).collect();
    for (index, gain) in gains.iter().enumerate().rev() {
        let learnt = &means[index + 1] - &steps[index + 1].predicted.mean;
        means[index].gemv(1.0, gain, &learnt, 1.0);
    }
    means
}

/// Returns the variances of all states given all data, and a square root of the variance of each
/// state given the next one (for the last state, of the variance itself).
pub(super) fn smoothed_variances<D: Dim>(
    steps: &[Step<D>],
    gains: &[OMatrix<f64, D, D>],
) -> [Vec<OMatrix<f64, D, D>>; 2]
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut variances: Vec<_> = steps
        .iter()
        .map(|step| step.updated.variance.clone())
        .collect();
    let mut roots: Vec<_> = variances.last().cloned().map(root).into_iter().collect();
    for (index, gain) in gains.iter().enumerate().rev() {
        let next = &steps[index + 1];
        let (size, _) = gain.shape_generic();
        // Joseph's form here too: the variance of a start that nothing is known of is so large
        // that a difference would be rounding.
        let mut kept = OMatrix::identity_generic(size, size);
        kept.gemm(-1.0, gain, &next.transition, 1.0);
        let given = root(carried(&kept, &variances[index]) + carried(gain, &next.noise));
        // A sum of squares: a difference of variances may round to less than none.
        let mut variance = carried(gain, &variances[index + 1]);
        variance.gemm(1.0, &given, &given.transpose(), 1.0);
        symmetrise(&mut variance);
        variances[index] = variance;
        roots.push(given);
    }
    roots.reverse();
    [variances, roots]
}

/// Returns A P Aᵀ: the variance of A x, where P is the variance of x.
pub(super) fn carried<D: Dim>(
    matrix: &OMatrix<f64, D, D>,
    variance: &OMatrix<f64, D, D>,
) -> OMatrix<f64, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    // P is symmetric.
    let mut half = matrix * variance;
    half.transpose_mut();
    matrix * half
}

/// Replaces a matrix by the mean of itself and its transpose.
fn symmetrise<D: Dim>(matrix: &mut OMatrix<f64, D, D>)
where
    DefaultAllocator: Allocator<D, D>,
{
    for column in 0..matrix.ncols() {
        for row in 0..column {
            let mean = 0.5 * (matrix[(row, column)] + matrix[(column, row)]);
            matrix[(row, column)] = mean;
            matrix[(column, row)] = mean;
        }
    }
}

/// Returns a lower triangular square root of a variance; directions whose variance rounding has
/// removed get zeros.
fn root<D: Dim>(mut variance: OMatrix<f64, D, D>) -> OMatrix<f64, D, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    symmetrise(&mut variance);
    let (size, _) = variance.shape_generic();
    let largest = variance.diagonal().amax();
    let mut root = OMatrix::zeros_generic(size, size);
    for column in 0..size.value() {
        let pivot = variance[(column, column)];
        if pivot <= f64::EPSILON * largest {
            continue;
        }
        let direction = variance.column(column) / pivot.sqrt();
        variance.ger(-1.0, &direction, &direction, 1.0);
        for row in column..size.value() {
            root[(row, column)] = direction[row];
        }
    }
    root
}

/// Sums over innovations.
#[derive(Clone, Debug, Default)]
pub(super) struct Innovations {
    /// Innovations divided by their standard deviations, for data of standard deviation 1.
    pub(super) standard: Vec<f64>,
    /// Index of the component to which each innovation belongs.
    pub(super) components: Vec<usize>,
    /// Number of first innovations, which determine the initial state and carry no information.
    pub(super) free: usize,
    /// Sum of the logarithms of the variances of the other innovations.
    pub(super) logs: f64,
    /// Number of constants that were fitted to the innovations.
    pub(super) constants: usize,
}

impl Innovations {
    /// Creates the sums; the first `free` innovations are ignored.
    pub(super) fn new(free: usize) -> Self {
        Self {
            free,
            ..Self::default()
        }
    }

    pub(super) fn push<D: Dim>(&mut self, innovation: &Innovation<D>)
    where
        DefaultAllocator: Allocator<D>,
    {
        if self.standard.len() >= self.free {
            self.logs += innovation.variance.ln();
        }
        self.components.push(innovation.component);
        self.standard
            .push(innovation.value / innovation.variance.sqrt());
    }

    fn used(&self) -> &[f64] {
        self.standard.get(self.free..).unwrap_or_default()
    }

    /// Returns the standard deviation of the data with the largest likelihood.
    pub(super) fn noise(&self) -> f64 {
        let used = self.used();
        (used.iter().map(|x| x * x).sum::<f64>() / used.len() as f64).sqrt()
    }

    /// Returns the log-likelihood up to a constant, for the given or the most likely standard
    /// deviation of the data, minus the penalty for fitted constants (G. Schwarz, *Estimating the
    /// dimension of a model*, Annals of Statistics 6 (1978)).
    pub(super) fn log_likelihood(&self, noise: Option<f64>) -> f64 {
        let count = self.used().len() as f64;
        let own = self.noise();
        let fit = match noise {
            None => count * own.ln(),
            Some(noise) => count * (noise.ln() + 0.5 * (own / noise).powi(2)),
        };
        -0.5 * self.logs - fit - 0.5 * self.constants as f64 * count.ln()
    }
}
