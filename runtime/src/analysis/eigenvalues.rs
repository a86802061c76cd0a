//! Eigenvalues of real matrices that need not be symmetric.

use nalgebra::{Complex, DMatrix, Schur};

/// Steps of the QR iteration for each row, after which the search ends. A matrix whose iteration
/// converges takes a few.
const STEPS: usize = 100;

/// Returns the eigenvalues. Returns `None` if the matrix contains an infinite number or NaN, or if
/// the QR iteration does not converge.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if !matrix.iter().all(|value| value.is_finite()) {
        return None;
    }
    let steps = STEPS * matrix.nrows();
    let schur = Schur::try_new(matrix.clone(), f64::EPSILON, steps)?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_has_two_and_a_matrix_with_nan_has_none() {
        let mut matrix = DMatrix::from_row_slice(2, 2, &[0.0, -1.0, 1.0, 0.0]);
        let found = eigenvalues(&matrix).unwrap();
        assert!(found.iter().all(|own| (own.im.abs() - 1.0).abs() < 1e-15));
        matrix[(0, 1)] = f64::NAN;
        assert_eq!(eigenvalues(&matrix), None);
    }
}
