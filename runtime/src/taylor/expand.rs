//! The recurrences of a tree.
//!
//! Let γ + iσ = e^(i(θ−θ₀)) for each link, θ₀ its angle at the start, and
//! C + iS the second derivative of that. The equation of motion is
//!
//! γ_i X_i − σ_i Y_i + bias_i = 0, X = M S − T C, Y = M C + T S,
//!
//! with M_ij = A_ij cos(θ_i − θ_j) + B_ij sin(θ_i − θ_j), the mass matrix, and
//! T_ij = A_ij sin(θ_i − θ_j) − B_ij cos(θ_i − θ_j), both at the start. X and Y
//! are the force, times its lever, on each link, across and along what it was at
//! the start, its own inertia and its weight included. Four products of series a
//! link are all there is, for a tree of any shape and depth.
//!
//! In each order X follows from the equation, C from lower orders, and then
//! S = M⁻¹ (X + T C): one inverse serves all orders. From order 28 on, which is that of
//! tolerances near rounding, the S of order 0 is refined once more.

use super::bias::{Constant, Moving};
use super::lanes;
use super::levers::Coupling;
use super::orders::{MATRICES, Orders};
use super::quad::Quad;
use super::rows::SERIES;
use crate::scalar::Scalar;

/// Where an expansion starts.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a, T, const N: usize> {
    /// Angles θ, rad.
    pub theta: &'a [T; N],
    /// Angular velocities ω, rad/s.
    pub omega: &'a [T; N],
    /// sin θ.
    pub sines: [T; N],
    /// cos θ.
    pub cosines: [T; N],
    /// What else stands in the equation of motion, Σ M_ij α_j + … + bias_i = 0.
    pub bias: [T; N],
}

/// What stays the same in all expansions of a tree.
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a, T, const N: usize> {
    /// Diagonal of the mass matrix, kg m².
    pub inertias: [T; N],
    /// The mass matrix outside the diagonal.
    pub couplings: &'a [Coupling<T>],
    /// G_i of the torque −G_i sin θ_i − F_i cos θ_i of gravity, J.
    pub weights: [T; N],
    /// F_i of the same, J.
    pub lateral_weights: [T; N],
}

/// Coefficients of one order of what a torque may depend on, of all links.
#[derive(Clone, Copy, Debug)]
pub struct Known<T, const N: usize> {
    /// Which order.
    pub order: usize,
    /// Of the angles.
    pub theta: [T; N],
    /// Of the angular velocities.
    pub omega: [T; N],
    /// Of their sines.
    pub sines: [T; N],
    /// Of their cosines.
    pub cosines: [T; N],
}

/// Quads that [`expand`] works in, for `links` links and polynomials of order
/// `order`.
#[must_use]
pub const fn workspace(links: usize, order: usize) -> usize {
    links.div_ceil(4) * (SERIES * (order + 1) + MATRICES * links)
}

/// Writes the Taylor coefficients of the motion from `start`, order by order:
/// those of the angles, then those of the angular velocities. `M` must be
/// ⌈N/4⌉.
///
/// `bias`, if there is one, returns the coefficient of an order of
/// [`Start::bias`]. It is called with every order from 1 on, in turn.
///
/// Where `M` or the length of `work` ([`workspace`]) does not fit, or a
/// coupling names a link that is not there, all coefficients are NaN.
///
/// Complexity: O(n² + n p) for each of p orders of n links, and O(n³) for the
/// inverse. Uses AVX2 and FMA for `f64` where the machine has them: results
/// there differ by rounding from those elsewhere.
#[inline(always)]
pub fn expand<T: Scalar, const N: usize, const M: usize, F>(
    start: &Start<'_, T, N>,
    tree: &Tree<'_, T, N>,
    coefficients: &mut [[[T; N]; 2]],
    work: &mut [Quad<T>],
    bias: Option<F>,
) where
    F: FnMut(&Known<T, N>) -> [T; N],
{
    let order = coefficients.len().saturating_sub(1);
    let (vectors, _) = work.as_chunks_mut::<M>();
    let mut links = tree.couplings.iter().flat_map(|coupling| coupling.links);
    let fits = M == N.div_ceil(4) && links.all(|link| link < N);
    if !fits || vectors.len() * M < workspace(N, order) {
        coefficients
            .as_flattened_mut()
            .as_flattened_mut()
            .fill(T::from_f64(f64::NAN));
        return;
    }
    let orders = coefficients.iter_mut();
    for (row, angles) in orders.zip([start.theta, start.omega]) {
        // Velocities of order 1 follow.
        *row = [*angles, *start.omega];
    }
    if T::SEVERAL {
        let (rows, _) = vectors.as_chunks_mut::<SERIES>();
        lanes::Orders {
            start,
            tree,
            coefficients,
            rows,
            bias,
        }
        .run();
        return;
    }
    match bias {
        Some(bias) => T::run_packs(Orders {
            start,
            tree,
            coefficients,
            vectors,
            bias: Moving(bias),
        }),
        None => T::run_packs(Orders {
            start,
            tree,
            coefficients,
            vectors,
            bias: Constant,
        }),
    }
}
