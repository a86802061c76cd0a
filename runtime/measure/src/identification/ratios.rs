//! Products of powers of parameters that the data determine although they leave the parameters
//! open.

use nalgebra::{DMatrix, DVector};

use super::fit::{ParameterEstimate, Standing};
use super::task::FitTask;

/// Separator between the factors in the name of a ratio.
pub const TIMES: &str = " · ";
/// Separator before each divisor in the name of a ratio.
pub const DIVIDED: &str = " / ";
/// Largest relative change of a product, for a relative change of 1 of a fixed unknown, that counts
/// as zero.
const UNCHANGED: f64 = 1e-4;
/// Smallest part of a product of powers that must be independent of the previous products.
const NEW: f64 = 1e-6;

/// Exponents of products of powers of the unknowns; each product is independent of the previous
/// ones.
pub(super) struct Ratios {
    exponents: Vec<DVector<f64>>,
}

impl Ratios {
    /// Finds the products that do not change along any open direction: quotients of two parameters,
    /// and of two parameters and a third. `changes` has one column per direction.
    pub(super) fn new(
        task: &FitTask<'_>,
        globals: &[f64],
        estimates: &[ParameterEstimate],
        changes: &DMatrix<f64>,
    ) -> Self {
        let count = globals.len();
        let is_open = |index: &usize| {
            let hangs = !matches!(
                estimates[*index].standing,
                Standing::Determined | Standing::AtBound
            );
            hangs && globals[*index] != 0.0
        };
        let open: Vec<usize> = (0..task.unknown.len()).filter(is_open).collect();
        let mut found = Self {
            exponents: Vec::new(),
        };
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let mut consider = |factors: &[usize], divisor: usize| {
            let mut own = DVector::zeros(count);
            factors.iter().for_each(|&factor| own[factor] += 1.0);
            own[divisor] -= 1.0;
            if changes.tr_mul(&own).amax() > UNCHANGED {
                return;
            }
            let mut rest = own.clone();
            for other in &basis {
                rest.axpy(-other.dot(&own), other, 1.0);
            }
            if rest.norm_squared() > NEW {
                basis.push(rest.normalize());
                found.exponents.push(own);
            }
        };
        for (place, &factor) in open.iter().enumerate() {
            for &divisor in &open[place + 1..] {
                consider(&[factor], divisor);
            }
        }
        for (place, &factor) in open.iter().enumerate() {
            for &other in &open[place + 1..] {
                for &divisor in &open {
                    if divisor != factor && divisor != other {
                        consider(&[factor, other], divisor);
                    }
                }
            }
        }
        found
    }

    /// Returns the derivatives of the relative changes of the products by the free globals, in
    /// units of their scales.
    pub(super) fn combinations(
        &self,
        task: &FitTask<'_>,
        globals: &[f64],
        free: &[usize],
    ) -> DMatrix<f64> {
        DMatrix::from_fn(self.exponents.len(), free.len(), |row, column| {
            let global = free[column];
            match self.exponents[row][global] {
                0.0 => 0.0,
                exponent => exponent * task.scales[global] / globals[global],
            }
        })
    }

    /// Returns the estimates of the products, with their relative standard deviations.
    pub(super) fn estimates(
        self,
        task: &FitTask<'_>,
        globals: &[f64],
        naive: &[f64],
        by_blocks: Option<&[f64]>,
    ) -> Vec<ParameterEstimate> {
        let exponents = self.exponents.iter().enumerate();
        let estimate = |(row, exponents): (usize, &DVector<f64>)| {
            let all = || exponents.iter().enumerate();
            let powers = all().map(|(index, exponent)| globals[index].powf(*exponent));
            let value: f64 = powers.product();
            let of_sign = |sign: f64| -> Vec<&str> {
                let own = all().filter(|(_, exponent)| **exponent == sign);
                own.map(|(index, _)| task.names[index].as_str()).collect()
            };
            ParameterEstimate {
                name: format!(
                    "{}{DIVIDED}{}",
                    of_sign(1.0).join(TIMES),
                    of_sign(-1.0).join(DIVIDED)
                ),
                value,
                standing: Standing::Determined,
                naive: Some(naive[row] * value.abs()),
                by_blocks: by_blocks.map(|own| own[row] * value.abs()),
            }
        };
        exponents.map(estimate).collect()
    }
}
