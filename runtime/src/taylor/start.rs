//! Start of an expansion: the initial state, and the constants of the links.

use super::buffer::SharedNumbers;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// State from which an expansion starts.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a, T, const N: usize> {
    /// Angles θ, in rad.
    pub theta: &'a [T; N],
    /// Angular velocities ω, in rad/s.
    pub omega: &'a [T; N],
    /// Sines of the angles.
    pub sines: [T; N],
    /// Cosines of the angles.
    pub cosines: [T; N],
    /// Bias of the equation of motion Σ M_ij α_j + … + bias_i = 0.
    pub bias: [T; N],
}

/// Constants of a tree's equation of motion, in any consistent units of mass and length.
#[derive(Clone, Copy, Debug)]
pub struct LinkConstants<T, const N: usize> {
    /// Diagonal elements M_ii of the mass matrix.
    pub inertias: [T; N],
    /// First moment (h, e) of the mass that the link carries, about the link's pivot, along and
    /// across the link.
    pub moments: [[T; 2]; N],
    /// Position (ℓ, w) of the link's pivot relative to the parent's pivot, along and across the
    /// parent; unused for the root.
    pub attachments: [[T; 2]; N],
    /// Coefficient G of the torque of gravity, −G sin θ − F cos θ.
    pub weights: [T; N],
    /// Coefficient F of the torque of gravity, −G sin θ − F cos θ.
    pub lateral_weights: [T; N],
}

/// State of all links at the start of an expansion, with a number of links that need not be known
/// at compile time; see [`Start`].
#[derive(Clone, Copy)]
pub(super) struct Origin<'a, T, S> {
    pub(super) omega: &'a [T],
    pub(super) sines: S,
    pub(super) cosines: S,
    pub(super) bias: S,
}

/// Constants of all links, with a number of links that need not be known at compile time; see
/// [`LinkConstants`].
#[derive(Clone, Copy)]
pub(super) struct Constants<'a, T> {
    pub(super) inertias: &'a [T],
    pub(super) moments: &'a [[T; 2]],
    pub(super) attachments: &'a [[T; 2]],
    pub(super) weights: &'a [T],
    pub(super) lateral_weights: &'a [T],
}

impl<T: Copy, S: SharedNumbers<T>> Origin<'_, T, S> {
    /// Restricts the state to the first `links` links; the compiler knows the length if possible.
    #[inline(always)]
    pub(super) fn first_links(self, links: usize) -> Self {
        Self {
            omega: self.omega.first_links(links),
            sines: self.sines.first_links(links),
            cosines: self.cosines.first_links(links),
            bias: self.bias.first_links(links),
        }
    }
}

impl<T> Constants<'_, T> {
    /// Restricts the constants to the first `links` links; the compiler knows the length if
    /// possible.
    #[inline(always)]
    pub(super) fn first_links(self, links: usize) -> Self {
        Self {
            inertias: &self.inertias[..links],
            moments: &self.moments[..links],
            attachments: &self.attachments[..links],
            weights: &self.weights[..links],
            lateral_weights: &self.lateral_weights[..links],
        }
    }
}

/// Returns G and F of the torques G sin θ + F cos θ of gravity: w y − l x and w x + l y, for the
/// weights (w, l) and the coefficient (x, y) of the acceleration, which is (0, 1) without `fall`.
#[inline(always)]
pub(super) fn weights<T: Scalar, P: Simd<T>>(fall: Option<[T; 2]>, weight: [P; 2]) -> [P; 2] {
    let Some(fall) = fall else { return weight };
    let ([x, y], [w, l]) = (fall.map(P::splat), weight);
    [(w * y).minus_product(l, x), (w * x).plus_product(l, y)]
}
