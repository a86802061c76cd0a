//! Errors in the construction of a linear model of small motions.

use crate::errors::errors;

errors! {
    /// Reason why the [`Linear`](super::Linear) model of a system cannot be built.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum LinearError {
        /// The number of rows of a matrix, or the length of a vector, is not the number of links.
        Length {
            /// Name of the matrix or vector: `"near"`, `"mass"`, `"stiffness"` or `"damping"`.
            name: &'static str,
            /// Number of links.
            expected: usize,
            /// Number of rows found, or of entries in one of the rows.
            found: usize,
        } => "`{name}` has {found} numbers for {expected} links",
        /// The system has more links than dense matrices can handle.
        Size {
            /// Number of links.
            links: usize,
            /// The largest number of links that is accepted.
            most: usize,
        } => "{links} links are too many for a linear model, which can have at most {most}: \
            reduce the tree by `in_phase(…)`",
        /// An entry of a matrix, or an acceleration near the equilibrium, is infinite or NaN.
        NotFinite => "the matrices or accelerations of the model contain an infinite number or NaN",
        /// The search for an equilibrium met a singular stiffness matrix, or did not converge.
        NoEquilibrium => "found no equilibrium: start nearer to one, at time 0",
        /// The mass matrix is not positive definite: some motion has no inertia.
        MassNotPositiveDefinite => "the mass matrix is not positive definite: some motion has no \
            inertia",
        /// The derivatives of the torques by angles or by velocities are not symmetric: the system
        /// is not a tree with springs and friction.
        NotSymmetric {
            /// Name of the matrix that is not symmetric: `"stiffness"` or `"damping"`.
            matrix: &'static str,
        } => "the {matrix} matrix is not symmetric",
        /// The length of a frame is not positive and finite.
        Frame {
            /// Length of the frame, s.
            value: f64,
        } => "the length of a frame is {value} s: it must be positive and finite",
    }
}

impl core::error::Error for LinearError {}
