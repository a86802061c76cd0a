//! The textbook method: the whole mass matrix is factorised by Cholesky's method.

use nalgebra::{DMatrix, DVector};

use super::table::{GRAVITY, Link, couplings};

/// A tree of any shape with the mass matrix A(θ) = A_ij cos(θ_i − θ_j).
#[derive(Clone, Debug)]
pub struct Dense {
    coupling: DMatrix<f64>,
    weight: Vec<f64>,
    sines: Vec<f64>,
    cosines: Vec<f64>,
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl Dense {
    /// For a tree.
    #[must_use]
    pub fn new(links: &[Link]) -> Self {
        let n = links.len();
        let (coupling, moment) = couplings(links);
        Self {
            coupling: DMatrix::from_fn(n, n, |i, j| coupling[i][j]),
            weight: moment.iter().map(|moment| GRAVITY * moment).collect(),
            sines: vec![0.0; n],
            cosines: vec![0.0; n],
            matrix: DMatrix::zeros(n, n),
            right: DVector::zeros(n),
        }
    }

    /// Writes the angular accelerations; NaN if the Cholesky factorisation fails.
    pub fn accelerations(&mut self, theta: &[f64], omega: &[f64], alpha: &mut [f64]) {
        let n = self.weight.len();
        for (i, theta) in theta.iter().enumerate() {
            (self.sines[i], self.cosines[i]) = theta.sin_cos();
            self.right[i] = -self.weight[i] * self.sines[i];
        }
        for (j, omega) in omega.iter().enumerate() {
            for i in 0..n {
                let coupling = self.coupling[(i, j)];
                let sine = self.sines[i] * self.cosines[j] - self.cosines[i] * self.sines[j];
                let cosine = self.cosines[i] * self.cosines[j] + self.sines[i] * self.sines[j];
                self.matrix[(i, j)] = coupling * cosine;
                self.right[i] -= coupling * sine * omega * omega;
            }
        }
        // nalgebra factors a matrix that it owns: it is lent and taken back.
        let matrix = std::mem::replace(&mut self.matrix, DMatrix::zeros(0, 0));
        match matrix.cholesky() {
            Some(factors) => {
                factors.solve_mut(&mut self.right);
                alpha.copy_from_slice(self.right.as_slice());
                self.matrix = factors.unpack_dirty();
            }
            None => {
                alpha.fill(f64::NAN);
                self.matrix = DMatrix::zeros(n, n);
            }
        }
    }
}
