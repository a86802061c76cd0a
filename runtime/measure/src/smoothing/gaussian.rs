//! Normal distributions of a state that go forth with it and back.
//!
//! A state has `D` numbers: three by a constant, or as many as a model has.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

/// A normal distribution of a state, variances in units of those of the data.
#[derive(Clone, Debug)]
pub(super) struct Gaussian<D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    pub(super) mean: OVector<f64, D>,
    pub(super) variance: OMatrix<f64, D, D>,
}

/// Difference of a datum from the expected one, its variance, and what it moves the state by.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Innovation<D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// The component that was measured.
    pub(super) component: usize,
    pub(super) value: f64,
    pub(super) variance: f64,
    /// Change of the state for an innovation of one.
    pub(super) gain: OVector<f64, D>,
}

impl<D: Dim> Gaussian<D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// The distribution after a step to `mean` whose derivative is `transition`, `noise`
    /// being the variance that comes from outside.
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

    /// Takes a datum of one component into account.
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
    /// Derivative of the step from the time before.
    pub(super) transition: OMatrix<f64, D, D>,
    /// Variance that comes from outside on that step.
    pub(super) noise: OMatrix<f64, D, D>,
    /// The state before the data of this time.
    pub(super) predicted: Gaussian<D>,
    /// The state after them.
    pub(super) updated: Gaussian<D>,
}

/// Gains by which what is learnt of each state comes back to the one before, one less than steps.
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

/// Means given all data, by the gains.
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

/// Variances given all data, by the gains; a root of the variance of each state given the next one
/// (the last by itself).
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

/// The variance A P Aᵀ of A x, P that of x.
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

/// Puts the mean of a matrix and its transpose in its place.
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

/// A lower triangular root of a variance; directions in which rounding has left none have
/// none.
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
    /// Innovations in their standard deviations, for data of a standard deviation of 1.
    pub(super) standard: Vec<f64>,
    /// Number of those that the start takes up and that say nothing.
    pub(super) free: usize,
    /// Σ ln of the variances of the others.
    pub(super) logs: f64,
    /// Number of constants that were fitted to them.
    pub(super) constants: usize,
}

impl Innovations {
    /// Sums of which the first `free` say nothing.
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
        self.standard
            .push(innovation.value / innovation.variance.sqrt());
    }

    fn used(&self) -> &[f64] {
        self.standard.get(self.free..).unwrap_or_default()
    }

    /// The standard deviation of the data of largest likelihood.
    pub(super) fn noise(&self) -> f64 {
        let used = self.used();
        (used.iter().map(|x| x * x).sum::<f64>() / used.len() as f64).sqrt()
    }

    /// The logarithm of the likelihood but for a constant, for a given standard deviation of
    /// the data or for the likeliest, less what fitted constants have to gain (G. Schwarz,
    /// *Estimating the dimension of a model*, Annals of Statistics 6 (1978)).
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
