//! Why there is no linear model.

use crate::errors::errors;

errors! {
    /// Reason for which a system has no [`Linear`](super::Linear) model.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum LinearError {
        /// A matrix or a state has not as many rows as the system has links.
        Length {
            /// `"near"`, `"mass"`, `"stiffness"` or `"damping"`.
            name: &'static str,
            /// Number of links.
            expected: usize,
            /// Number of rows, or of entries in one of them.
            found: usize,
        } => "`{name}` has {found} numbers for {expected} links",
        /// More links than a model of dense matrices is for.
        Size {
            /// Number of links.
            links: usize,
            /// The largest number that there may be.
            most: usize,
        } => "{links} links are too many for a linear model, which takes at most {most}: reduce \
            the tree by `in_phase(…)`",
        /// A number is infinite or NaN: of a matrix, or an acceleration near the
        /// equilibrium.
        NotFinite => "a number of the model is infinite or NaN",
        /// The stiffness is singular on the way to an equilibrium, or no step of the search
        /// comes near one.
        NoEquilibrium => "no equilibrium was found: start nearer to one, at time 0",
        /// Some motion has no inertia.
        MassNotPositiveDefinite => "the mass matrix is not positive definite: some motion has no \
            inertia",
        /// Torques on two links do not depend on each other's angles or rates alike: such a
        /// system is no tree with springs and friction.
        NotSymmetric {
            /// `"stiffness"` or `"damping"`.
            matrix: &'static str,
        } => "the {matrix} matrix is not symmetric",
        /// A frame is not positive and finite.
        Frame {
            /// Length of the frame, s.
            value: f64,
        } => "a frame of {value} s is not positive and finite",
    }
}

impl core::error::Error for LinearError {}
