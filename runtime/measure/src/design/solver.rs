//! Minimisation of the sum of squared misses within the bounds.

use std::cell::RefCell;
use std::convert::Infallible;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian,
    Residual, TrustRegionReflective,
};
use nalgebra::DMatrix;

/// Largest number of steps from one start.
const STEPS: u64 = 40;
/// Largest number of shorter and shorter steps that are tried from one point.
const TRIES: usize = 12;
/// Gradient of half the sum of squares at which the search ends.
const FLAT: f64 = 1e-10;
/// Half the distance between the points of a difference quotient, in widths of the ranges.
const APART: f64 = 1e-4;

/// Residuals as a function of the position within the bounds: 0 is the lower and 1 the upper bound
/// of each parameter. Residuals without a value are NaN.
pub(super) struct Residuals<'a> {
    pub(super) of: &'a dyn Fn(&[f64]) -> Vec<f64>,
}

impl Residuals<'_> {
    /// Returns the derivatives of the residuals by the position, one row for each residual, by
    /// central differences; by differences to one side at a bound and next to points without
    /// values.
    pub(super) fn derivatives(&self, place: &[f64]) -> DMatrix<f64> {
        let centre = (self.of)(place);
        let mut derivatives = DMatrix::zeros(centre.len(), place.len());
        for column in 0..place.len() {
            let shifted = |by: f64| {
                let mut shifted = place.to_vec();
                shifted[column] = (place[column] + by).clamp(0.0, 1.0);
                let values = (self.of)(&shifted);
                let has_values = values.iter().all(|value| value.is_finite());
                has_values.then_some((shifted[column], values))
            };
            let here = || Some((place[column], centre.clone()));
            let left = shifted(-APART).or_else(here);
            let right = shifted(APART).or_else(here);
            let (Some((from, left)), Some((to, right))) = (left, right) else {
                continue;
            };
            for (row, (left, right)) in left.iter().zip(&right).enumerate() {
                derivatives[(row, column)] = (right - left) / (to - from);
            }
        }
        derivatives
    }

    /// Returns the point with the smallest sum of squared residuals that a search from `start`
    /// reaches.
    pub(super) fn minimise(&self, start: &[f64]) -> Vec<f64> {
        let problem = Bounded {
            residuals: self,
            lower: vec![0.0; start.len()],
            upper: vec![1.0; start.len()],
            best: RefCell::new((f64::INFINITY, start.to_vec())),
        };
        let solver = TrustRegionReflective::new()
            .with_absolute_scaled_gradient_tolerance(FLAT)
            .with_max_inner_attempts(TRIES);
        // The best point counts, also if the solver ends with an error.
        let _ = Executor::from_start(&problem, solver, start.to_vec())
            .max_iter(STEPS)
            .run();
        let (squares, place) = problem.best.into_inner();
        self.at_bounds(place, squares)
    }

    /// Moves parameters that are next to a bound onto it if this does not increase the sum of
    /// squares: the method stays inside the bounds.
    fn at_bounds(&self, place: Vec<f64>, squares: f64) -> Vec<f64> {
        let moved = place.iter().map(|&own| match own {
            own if own < APART => 0.0,
            own if own > 1.0 - APART => 1.0,
            own => own,
        });
        let moved: Vec<f64> = moved.collect();
        match sum_of_squares(&(self.of)(&moved)) <= squares {
            true => moved,
            false => place,
        }
    }
}

pub(super) fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// The problem in the form of the crate `basin`, with the best point so far.
struct Bounded<'a> {
    residuals: &'a Residuals<'a>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    best: RefCell<(f64, Vec<f64>)>,
}

impl Constraints for &Bounded<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        let bounds = BoxBounds::new(Some(&self.lower), Some(&self.upper));
        ConstraintSet::new().with_bounds(bounds)
    }
}

impl Residual for &Bounded<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Infallible;

    fn residual(&self, place: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let residuals = (self.residuals.of)(place);
        let squares = sum_of_squares(&residuals);
        let mut best = self.best.borrow_mut();
        if squares < best.0 {
            *best = (squares, place.clone());
        }
        Ok(residuals)
    }
}

impl Jacobian for &Bounded<'_> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, place: &Vec<f64>) -> Result<DenseMatrix, Infallible> {
        let own = self.residuals.derivatives(place).transpose();
        // Column by column, which is row by row of the transposed matrix.
        Ok(DenseMatrix::from_row_slice(
            own.ncols(),
            own.nrows(),
            own.as_slice(),
        ))
    }
}
