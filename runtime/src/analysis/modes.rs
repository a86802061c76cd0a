//! Linear modes about an equilibrium.
//!
//! Small motions q obey M q̈ + K q = 0 with the mass matrix M and the stiffness
//! matrix K of the equilibrium. Modes are the solutions of K x = λ M x; their
//! frequencies are √λ / 2π. With M = L Lᵀ (Cholesky) they are the eigenvectors
//! of the symmetric matrix L⁻¹ K L⁻ᵀ: G. H. Golub, C. F. Van Loan, *Matrix
//! Computations*, 4th edition, Johns Hopkins 2013, section 8.7.

use core::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, SymmetricEigen};

use crate::errors::errors;

/// The linear modes of a system, by ascending frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// Frequencies of the modes in Hz, in ascending order.
    pub frequencies_hz: Vec<f64>,
    /// Shapes of the modes: `shapes[k][i]` is the component of mode k along coordinate i, in
    /// kg^(-1/2) m^(-1). Shapes are orthonormal with respect to the mass matrix (xᵀ M x = 1), and
    /// their largest component is positive. Modes of equal frequency span a space; the basis of it
    /// that is returned is arbitrary.
    pub shapes: Vec<Vec<f64>>,
}

impl Modes {
    /// Returns the modes of a system with mass matrix `mass` (kg m²) and stiffness matrix
    /// `stiffness` (N m/rad), both given row by row.
    ///
    /// The matrices do not show if they belong to an equilibrium; about other angles no motion
    /// stays small. [`at_rest`](Self::at_rest) also checks the torques.
    ///
    /// Eigenvalues that vanish to rounding count as zero: a coordinate without stiffness has a mode
    /// of 0 Hz. Effort and memory grow as n³ and n².
    ///
    /// # Errors
    ///
    /// [`ModesError`] if the matrices are empty, not square, of different size,
    /// not finite or not symmetric, if the mass matrix is not positive definite
    /// or if the stiffness is negative in some direction: the equilibrium is
    /// then unstable and has no such frequency.
    ///
    /// # Examples
    ///
    /// Two equal pendulums of 1 Hz, coupled by a spring:
    ///
    /// ```
    /// use branched_pendulum::analysis::Modes;
    ///
    /// let stiffness = (2.0 * std::f64::consts::PI).powi(2);
    /// let spring = 0.1 * stiffness;
    /// let modes = Modes::new(
    ///     &[[1.0, 0.0], [0.0, 1.0]],
    ///     &[[stiffness + spring, -spring], [-spring, stiffness + spring]],
    /// )?;
    /// assert!((modes.frequencies_hz[0] - 1.0).abs() < 1e-14);
    /// assert!((modes.frequencies_hz[1] - 1.2_f64.sqrt()).abs() < 1e-14);
    /// # Ok::<(), branched_pendulum::analysis::ModesError>(())
    /// ```
    pub fn new<R: AsRef<[f64]>>(mass: &[R], stiffness: &[R]) -> Result<Self, ModesError> {
        let mass = symmetric_matrix("mass", mass)?;
        let stiffness = symmetric_matrix("stiffness", stiffness)?;
        Self::of(mass, stiffness)
    }

    /// Returns the modes about an equilibrium: angles at which the `torques` −∂U/∂θ (N m, one per
    /// coordinate) vanish. They are the torques M α of a system at rest, with the mass matrix M and
    /// the accelerations α.
    ///
    /// A torque counts as zero if a change of the angles by a millionth of a radian cancels it.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new); [`ModesError::NotAtRest`] if a torque is larger than that.
    ///
    /// # Examples
    ///
    /// A rod that hangs down, and one held at an angle of 0.3 rad:
    ///
    /// ```
    /// use branched_pendulum::analysis::{Modes, ModesError};
    ///
    /// let about = |angle: f64| {
    ///     let (sine, cosine) = angle.sin_cos();
    ///     Modes::at_rest(&[[0.1]], &[[4.0 * cosine]], &[-4.0 * sine])
    /// };
    /// let exact = 40_f64.sqrt() / std::f64::consts::TAU;
    /// assert!((about(0.0)?.frequencies_hz[0] - exact).abs() < 1e-14);
    /// assert!(matches!(about(0.3), Err(ModesError::NotAtRest { .. })));
    /// # Ok::<(), ModesError>(())
    /// ```
    pub fn at_rest<R: AsRef<[f64]>>(
        mass: &[R],
        stiffness: &[R],
        torques: &[f64],
    ) -> Result<Self, ModesError> {
        let mass = symmetric_matrix("mass", mass)?;
        let stiffness = symmetric_matrix("stiffness", stiffness)?;
        check_rest(&stiffness, torques)?;
        Self::of(mass, stiffness)
    }

    fn of(mass: DMatrix<f64>, stiffness: DMatrix<f64>) -> Result<Self, ModesError> {
        if mass.nrows() != stiffness.nrows() {
            return Err(ModesError::SizeMismatch {
                mass: mass.nrows(),
                stiffness: stiffness.nrows(),
            });
        }
        let cholesky = Cholesky::new(mass).ok_or(ModesError::MassNotPositiveDefinite)?;
        let lower = cholesky.l();
        // L^-1 K L^-T = L^-1 (L^-1 K)^T, K being symmetric.
        let reduced = lower
            .solve_lower_triangular(&stiffness)
            .and_then(|half| lower.solve_lower_triangular(&half.transpose()))
            .ok_or(ModesError::MassNotPositiveDefinite)?;
        let reduced = (&reduced + reduced.transpose()) * 0.5;
        let largest = reduced.amax();
        let eigen = SymmetricEigen::try_new(reduced, f64::EPSILON, MAX_SWEEPS)
            .ok_or(ModesError::NoConvergence)?;
        let shapes = lower
            .tr_solve_lower_triangular(&eigen.eigenvectors)
            .ok_or(ModesError::MassNotPositiveDefinite)?;

        let n = eigen.eigenvalues.len();
        let rounding = 8.0 * n as f64 * f64::EPSILON * largest;
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let mut modes = Self {
            frequencies_hz: Vec::with_capacity(n),
            shapes: Vec::with_capacity(n),
        };
        for index in order {
            let eigenvalue = eigen.eigenvalues[index];
            if eigenvalue < -rounding {
                return Err(ModesError::NegativeStiffness { eigenvalue });
            }
            let squared = if eigenvalue <= rounding {
                0.0
            } else {
                eigenvalue
            };
            modes.frequencies_hz.push(squared.sqrt() / TAU);
            let shape = shapes.column(index);
            let sign = if shape[shape.iamax()] < 0.0 {
                -1.0
            } else {
                1.0
            };
            modes
                .shapes
                .push(shape.iter().map(|component| sign * component).collect());
        }
        Ok(modes)
    }
}

/// Largest number of sweeps of the eigenvalue iteration. Implicit QR needs two or three sweeps per
/// eigenvalue; this is enough for thousands of them.
const MAX_SWEEPS: usize = 100_000;

/// Largest relative asymmetry that counts as rounding in a computed matrix.
const ASYMMETRY: f64 = 1e-12;

/// Largest distance (rad) from an equilibrium at which angles still count as an equilibrium.
const MISSED: f64 = 1e-6;

/// Returns an error if the torques at rest (N m) are too large to be cancelled by such a small
/// change of the angles.
pub(super) fn check_rest(stiffness: &DMatrix<f64>, torques: &[f64]) -> Result<(), ModesError> {
    if torques.len() != stiffness.nrows() {
        return Err(ModesError::Torques {
            torques: torques.len(),
            rows: stiffness.nrows(),
        });
    }
    let rows = stiffness.row_iter().map(|row| row.amax());
    let left = torques.iter().zip(rows).map(|(torque, stiffest)| {
        // False for NaN too.
        let is_small = torque.abs() <= MISSED * stiffest;
        if is_small { 0.0 } else { torque.abs() }
    });
    let left: Vec<f64> = left.collect();
    let largest = (0..left.len()).max_by(|&a, &b| left[a].total_cmp(&left[b]));
    match largest {
        Some(coordinate) if left[coordinate] != 0.0 => Err(ModesError::NotAtRest {
            coordinate,
            torque: torques[coordinate],
            torques: torques.to_vec(),
        }),
        _ => Ok(()),
    }
}

pub(super) fn symmetric_matrix<R: AsRef<[f64]>>(
    matrix: &'static str,
    rows: &[R],
) -> Result<DMatrix<f64>, ModesError> {
    let n = rows.len();
    if n == 0 {
        return Err(ModesError::Empty { matrix });
    }
    for (row, values) in rows.iter().enumerate() {
        let columns = values.as_ref().len();
        if columns != n {
            return Err(ModesError::NotSquare {
                matrix,
                rows: n,
                row,
                columns,
            });
        }
    }
    let dense = DMatrix::from_fn(n, n, |row, column| rows[row].as_ref()[column]);
    let scale = dense.amax();
    for row in 0..n {
        for column in 0..n {
            let value = dense[(row, column)];
            if !value.is_finite() {
                return Err(ModesError::NotFinite {
                    matrix,
                    row,
                    column,
                    value,
                });
            }
            if (value - dense[(column, row)]).abs() > ASYMMETRY * scale {
                return Err(ModesError::NotSymmetric {
                    matrix,
                    row,
                    column,
                });
            }
        }
    }
    Ok(dense)
}

errors! {
    /// Reason why a system has no linear modes.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum ModesError {
        /// A matrix has no rows.
        Empty {
            /// Name of the matrix: `"mass"` or `"stiffness"`.
            matrix: &'static str,
        } => "the {matrix} matrix has no rows",
        /// The number of entries in a row is not the number of rows.
        NotSquare {
            /// Name of the matrix: `"mass"` or `"stiffness"`.
            matrix: &'static str,
            /// Number of rows.
            rows: usize,
            /// Index of the row.
            row: usize,
            /// Number of entries in that row.
            columns: usize,
        } => "the {matrix} matrix is not square: {rows} rows, but {columns} entries in row {row}",
        /// An entry is infinite or NaN.
        NotFinite {
            /// Name of the matrix: `"mass"` or `"stiffness"`.
            matrix: &'static str,
            /// Index of the row.
            row: usize,
            /// Index of the column.
            column: usize,
            /// Value of the entry.
            value: f64,
        } => "entry ({row}, {column}) of the {matrix} matrix is {value}",
        /// The matrix is not symmetric: an entry differs from the transposed one by more than
        /// rounding.
        NotSymmetric {
            /// Name of the matrix: `"mass"` or `"stiffness"`.
            matrix: &'static str,
            /// Index of the row.
            row: usize,
            /// Index of the column.
            column: usize,
        } => "the {matrix} matrix is not symmetric at ({row}, {column})",
        /// The mass matrix and the stiffness matrix have different sizes.
        SizeMismatch {
            /// Number of rows of the mass matrix.
            mass: usize,
            /// Number of rows of the stiffness matrix.
            stiffness: usize,
        } => "the mass matrix has {mass} rows and the stiffness matrix {stiffness}",
        /// The number of torques is not the number of coordinates.
        Torques {
            /// Number of torques.
            torques: usize,
            /// Number of rows of the matrices.
            rows: usize,
        } => "got {torques} torques for matrices with {rows} rows: the numbers must be equal",
        /// The angles are not an equilibrium: torques act on the system at rest.
        NotAtRest {
            /// Index of the coordinate on which the largest torque acts.
            coordinate: usize,
            /// The largest torque, N m.
            torque: f64,
            /// Torques on all coordinates, N m.
            torques: Vec<f64>,
        } => "the angles are not an equilibrium: at rest, a torque of {torque} N m acts on \
            coordinate {coordinate}. Use the angles that `equilibrium` finds near them",
        /// The mass matrix is not positive definite: some motion has no inertia.
        MassNotPositiveDefinite => "the mass matrix is not positive definite: some motion has no \
            inertia",
        /// The equilibrium is unstable: the stiffness matrix is negative in some direction.
        NegativeStiffness {
            /// The negative eigenvalue λ of K x = λ M x, 1/s².
            eigenvalue: f64,
        } => "the equilibrium is unstable: a squared angular frequency is {eigenvalue} 1/s^2",
        /// The eigenvalue iteration did not converge.
        NoConvergence => "the eigenvalue iteration did not converge",
    }
}

impl core::error::Error for ModesError {}
