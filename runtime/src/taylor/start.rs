//! What an expansion starts from: the state, and the constants of the links.

use super::room::SharedNumbers;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// State at which an expansion starts.
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
    /// Bias of the equation of motion, Σ M_ij α_j + … + bias_i = 0.
    pub bias: [T; N],
}

/// Constants of a tree's equation of motion, in any units of mass and length that
/// go together.
#[derive(Clone, Copy, Debug)]
pub struct LinkConstants<T, const N: usize> {
    /// M: the diagonal of the mass matrix.
    pub inertias: [T; N],
    /// (h, e): the first moment, about the link's pivot, of the mass that the link
    /// carries, along and across.
    pub moments: [[T; 2]; N],
    /// (ℓ, w): where the link hangs on its parent, from the parent's pivot, along and
    /// across. The root's does not count.
    pub attachments: [[T; 2]; N],
    /// G of the torque −G sin θ − F cos θ of gravity.
    pub weights: [T; N],
    /// F of the same.
    pub lateral_weights: [T; N],
}

/// State at which an expansion starts, of all links: [`Start`].
#[derive(Clone, Copy)]
pub(super) struct Origin<'a, T, S> {
    pub(super) omega: &'a [T],
    pub(super) sines: S,
    pub(super) cosines: S,
    pub(super) bias: S,
}

/// Constants of all links: [`LinkConstants`].
#[derive(Clone, Copy)]
pub(super) struct Constants<'a, T> {
    pub(super) inertias: &'a [T],
    pub(super) moments: &'a [[T; 2]],
    pub(super) attachments: &'a [[T; 2]],
    pub(super) weights: &'a [T],
    pub(super) lateral_weights: &'a [T],
}

impl<T: Copy, S: SharedNumbers<T>> Origin<'_, T, S> {
    /// Returns the first links' numbers, as many as the compiler may know them to be.
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
    /// Returns the first links' numbers, as many as the compiler may know them to be.
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

/// Torques G sin θ + F cos θ, with G and F the weights (w, l) at the acceleration (x, y) of an
/// order, w y − l x and w x + l y: at (0, 1) where there is none.
#[inline(always)]
pub(super) fn weights<T: Scalar, P: Simd<T>>(fall: Option<[T; 2]>, weight: [P; 2]) -> [P; 2] {
    let Some(fall) = fall else { return weight };
    let ([x, y], [w, l]) = (fall.map(P::splat), weight);
    [(w * y).minus_product(l, x), (w * x).plus_product(l, y)]
}
