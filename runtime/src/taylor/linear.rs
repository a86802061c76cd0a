//! The linear system of one order of the equations of motion.

use super::expand::{Connectivity, LinkConstants, Start};
use crate::simd::Simd;

/// The equations X, Y = linear functions of S, C at a start, solved for S and Y.
pub(super) trait OrderSystem<T, const N: usize>: Sized {
    /// Forms what serves all orders.
    fn new<C: Connectivity<N>, P: Simd<T>>(
        start: &Start<'_, T, N>,
        constants: &LinkConstants<T, N>,
    ) -> Self;

    /// Returns `base` and what is added to it: S and Y where X = `force` and
    /// C = `cosine`.
    fn add_solution<C: Connectivity<N>, P: Simd<T>, const M: usize>(
        &self,
        base: [[P; M]; 2],
        force: &[P; M],
        cosine: &[P; M],
    ) -> [[P; M]; 2];
}
