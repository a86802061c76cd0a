//! Normal distributions of a state that go forth with it and back.

use nalgebra::{SMatrix, SVector};

/// A normal distribution of a state, variances in units of those of the data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gaussian<const D: usize> {
    pub(super) mean: SVector<f64, D>,
    pub(super) variance: SMatrix<f64, D, D>,
}

/// Difference of a datum from the expected one, its variance, and what it moves the state by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Innovation<const D: usize> {
    /// The component that was measured.
    pub(super) component: usize,
    pub(super) value: f64,
    pub(super) variance: f64,
    /// Change of the state for an innovation of one.
    pub(super) gain: SVector<f64, D>,
}

impl<const D: usize> Gaussian<D> {
    /// The distribution after a step to `mean` whose derivative is `transition`, `noise`
    /// being the variance that comes from outside.
    pub(super) fn step(
        &self,
        mean: SVector<f64, D>,
        transition: &SMatrix<f64, D, D>,
        noise: &SMatrix<f64, D, D>,
    ) -> Self {
        Self {
            mean,
            variance: symmetric(transition * self.variance * transition.transpose() + noise),
        }
    }

    /// Takes a datum of one component into account.
    pub(super) fn update(&mut self, component: usize, datum: f64) -> Innovation<D> {
        let variance = self.variance[(component, component)] + 1.0;
        let gain = self.variance.column(component) / variance;
        let innovation = Innovation {
            component,
            value: datum - self.mean[component],
            variance,
            gain,
        };
        self.mean += gain * innovation.value;
        // Joseph's form, which stays positive.
        let mut kept = SMatrix::<f64, D, D>::identity();
        for row in 0..D {
            kept[(row, component)] -= gain[row];
        }
        self.variance =
            symmetric(kept * self.variance * kept.transpose() + gain * gain.transpose());
        innovation
    }

    /// Standard deviations of the components, for data of a standard deviation of 1.
    pub(super) fn deviations(&self) -> SVector<f64, D> {
        self.variance
            .diagonal()
            .map(|variance| variance.max(0.0).sqrt())
    }
}

/// A filter at one time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step<const D: usize> {
    /// Derivative of the step from the time before.
    pub(super) transition: SMatrix<f64, D, D>,
    /// Variance that comes from outside on that step.
    pub(super) noise: SMatrix<f64, D, D>,
    /// The state before the data of this time.
    pub(super) predicted: Gaussian<D>,
    /// The state after them.
    pub(super) updated: Gaussian<D>,
}

/// The state at one time given the one at the next: `offset + gain · next`, and a root of
/// the variance about it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Back<const D: usize> {
    pub(super) offset: SVector<f64, D>,
    pub(super) gain: SMatrix<f64, D, D>,
    pub(super) root: SMatrix<f64, D, D>,
}

/// Runs back over the steps of a filter: the distributions given all data, and each state
/// given the next one (the last by itself).
pub(super) fn smooth<const D: usize>(steps: &[Step<D>]) -> (Vec<Gaussian<D>>, Vec<Back<D>>) {
    let mut smoothed: Vec<Gaussian<D>> = Vec::with_capacity(steps.len());
    let mut backs = Vec::with_capacity(steps.len());
    for (index, step) in steps.iter().enumerate().rev() {
        let Gaussian { mean, variance } = step.updated;
        let (Some(next), Some(later)) = (steps.get(index + 1), smoothed.last()) else {
            smoothed.push(step.updated);
            backs.push(Back {
                offset: mean,
                gain: SMatrix::zeros(),
                root: root(variance),
            });
            continue;
        };
        let predicted = &next.predicted;
        let cross = next.transition * variance;
        // A variance that rounding has made singular leaves nothing to be learnt.
        let gain = predicted
            .variance
            .cholesky()
            .map(|factor| factor.solve(&cross).transpose());
        let gain = gain.unwrap_or_else(SMatrix::zeros);
        // Joseph's form here too: the variance of a start that nothing is known of is so large
        // that a difference would be rounding.
        let kept = SMatrix::identity() - gain * next.transition;
        let given = kept * variance * kept.transpose() + gain * next.noise * gain.transpose();
        let given = root(symmetric(given));
        backs.push(Back {
            offset: mean - gain * predicted.mean,
            gain,
            root: given,
        });
        // A sum of squares: a difference of variances may round to less than none.
        let variance = gain * later.variance * gain.transpose() + given * given.transpose();
        smoothed.push(Gaussian {
            mean: mean + gain * (later.mean - predicted.mean),
            variance: symmetric(variance),
        });
    }
    smoothed.reverse();
    backs.reverse();
    (smoothed, backs)
}

fn symmetric<const D: usize>(matrix: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    0.5 * (matrix + matrix.transpose())
}

/// A lower triangular root of a variance; directions in which rounding has left none have
/// none.
fn root<const D: usize>(mut variance: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    let largest = variance.diagonal().amax();
    let mut root = SMatrix::zeros();
    for column in 0..D {
        let pivot = variance[(column, column)];
        if pivot <= f64::EPSILON * largest {
            continue;
        }
        let direction = variance.column(column) / pivot.sqrt();
        variance -= direction * direction.transpose();
        for row in column..D {
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

    pub(super) fn push<const D: usize>(&mut self, innovation: Innovation<D>) {
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
