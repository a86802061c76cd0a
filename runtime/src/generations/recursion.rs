//! What the attribute writes for a tree in generations.

use crate::scalar::Scalar;

/// A link's motion, or that of several siblings in lanes.
#[derive(Clone, Copy, Debug)]
pub struct Motion<V> {
    /// sin θ.
    pub sine: V,
    /// cos θ.
    pub cosine: V,
    /// ω, rad/s.
    pub omega: V,
    /// θ less the parent's angle, rad; θ for the root.
    pub bend: V,
    /// ω less the parent's angular velocity, rad/s; ω for the root.
    pub bend_rate: V,
}

/// The equations of one link of every generation, for any number of siblings in
/// lanes: what a tree does is these functions, taken generation by generation.
///
/// `C` constants belong to a generation. An inner link answers its parent with
/// `R` numbers, which are summed over its siblings, a leaf with `L`; `K` numbers
/// are kept of an inner link on the way from the leaves to the root.
///
/// Each link's functions take 2 numbers from above: the acceleration of its pivot
/// (against gravity, in the direction that makes the formulas short), in a unit
/// of its generation's own.
///
/// Written by the attribute. Featherstone, Rigid Body Dynamics Algorithms, 2008,
/// ch. 7; `docs/physics.md`, section 2.
pub trait Recursion<const C: usize, const L: usize, const R: usize, const K: usize>:
    Send + Sync + 'static
{
    /// Number of links.
    const LINKS: usize;

    /// Copies of each generation under each link of the one before; 1 for the
    /// root. Empty for the links of a [`Table`](super::Table).
    const COPIES: &'static [usize];

    /// Names of the generations; empty for the links of a table.
    const NAMES: &'static [&'static str];

    /// Whether the functions read [`Motion::bend`] and [`Motion::bend_rate`].
    const JOINTS: bool;

    /// Whether the last column of the constants is a torque on the root, which
    /// every evaluation states anew ([`RootDrive`](super::RootDrive)); it is zero
    /// for the other links.
    const TORQUE: bool = false;

    /// What a leaf answers.
    fn leaf<V: Scalar>(constants: &[V; C], link: Motion<V>) -> [V; L];

    /// The sum of leaves' answers as one of other links' answers, for their parent.
    fn joined<V: Scalar>(below: [V; L]) -> [V; R];

    /// What a link answers whose children are leaves, with the sum of their
    /// answers; and what is kept.
    #[inline(always)]
    fn stem<V: Scalar>(constants: &[V; C], link: Motion<V>, below: [V; L]) -> ([V; R], [V; K]) {
        Self::inner(constants, link, Self::joined(below))
    }

    /// What a link answers whose children are no leaves, likewise.
    fn inner<V: Scalar>(constants: &[V; C], link: Motion<V>, below: [V; R]) -> ([V; R], [V; K]);

    /// Angular acceleration of an inner link, and the acceleration of its
    /// children's pivots.
    fn turn<V: Scalar>(
        constants: &[V; C],
        link: Motion<V>,
        kept: [V; K],
        pivot: [V; 2],
    ) -> (V, [V; 2]);

    /// Angular acceleration of a leaf.
    fn turn_leaf<V: Scalar>(constants: &[V; C], link: Motion<V>, pivot: [V; 2]) -> V;
}
