//! The equations of one link, as the attribute writes them.

use crate::scalar::Scalar;
pub use crate::simd::Row;

/// The motion of a link, or of as many links (or states) as `V` has lanes.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion<V> {
    /// Sine of the angle.
    pub sine: V,
    /// Cosine of the angle.
    pub cosine: V,
    /// Angular velocity, rad/s.
    pub omega: V,
    /// Angle less the parent's, rad; the root's own for the root.
    pub joint_angle: V,
    /// Angular velocity less the parent's, rad/s; the root's own for the root.
    pub joint_rate: V,
    /// Generalized torque from outside, N m; of a held link its angular acceleration, rad/s².
    pub outside_torque: V,
    /// 1 for a held link, whose acceleration is given, and 0 for others.
    pub held: V,
}

impl<V: Copy> LinkMotion<V> {
    /// A link that turns; what acts in its joint and from outside is left open.
    #[inline(always)]
    pub(super) fn turning(sine: V, cosine: V, omega: V) -> Self {
        // No number of their own, which would take a register.
        Self {
            sine,
            cosine,
            omega,
            joint_angle: omega,
            joint_rate: omega,
            outside_torque: omega,
            held: omega,
        }
    }
}

/// The equations of one link of a tree, for as many links (or states) side by side
/// as a value has lanes: the articulated-body recursion in the plane. A tree takes
/// them from the leaves to the root and back.
///
/// All rows are arrays, as in `type Response<V: Scalar> = [V; 5];`. Lengths and
/// masses are in units that all links share, so that responses of the children of
/// one pivot are simply added. Every function is `#[inline(always)]`.
///
/// # Source
/// R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7; in the plane
/// `docs/physics.md`, section 10.
pub trait LinkEquations: Copy + Send + Sync + 'static {
    /// Constants of a link.
    type Constants<V: Scalar>: Row<V>;

    /// Articulated inertia (three numbers) and bias force (two) of a subtree; where
    /// joints have torques, the torque of the joint on the parent.
    type Response<V: Scalar>: Row<V>;

    /// Responses of all children, attached to their parent and summed; the same as
    /// [`Response`](Self::Response) where all children share one pivot.
    type Sums<V: Scalar>: Row<V>;

    /// Numbers kept of a link with children for the way down.
    type Elimination<V: Scalar>: Row<V>;

    /// Numbers that a link with children hands them on the way down. The first two
    /// are the acceleration of their pivot where all share one.
    type Carried<V: Scalar>: Row<V>;

    /// Copies of each generation under each link of the one before, 1 for the root:
    /// constants are a row a generation then. Empty for a tree whose shape is given
    /// link by link, with a row a link. A tree of more links than memory can hold is not
    /// compiled.
    const COPIES: &'static [usize];

    /// Names of the generations; empty where [`COPIES`](Self::COPIES) is.
    const NAMES: &'static [&'static str];

    /// The functions read [`joint_angle`](LinkMotion::joint_angle) or
    /// [`joint_rate`](LinkMotion::joint_rate).
    const JOINTS: bool;

    /// The last of the constants is a torque on the root, which every evaluation
    /// states anew; it is zero for the other links.
    const TORQUE: bool;

    /// The functions read [`outside_torque`](LinkMotion::outside_torque).
    const FORCED: bool = false;

    /// Springs and friction act between links that are not parent and child
    /// ([`Tree::with_spring_dampers`](super::Tree::with_spring_dampers)), or along lines
    /// ([`Tree::with_translational_spring_dampers`](super::Tree::with_translational_spring_dampers)).
    /// The functions read torques from outside then.
    const COUPLED: bool = false;

    /// The functions read [`held`](LinkMotion::held): links may have given accelerations,
    /// and what is told of these in place of accelerations are the torques that they take.
    const HELD: bool = false;

    /// Returns the response of a link without children.
    fn leaf<V: Scalar>(constants: &Self::Constants<V>, link: LinkMotion<V>) -> Self::Response<V>;

    /// Returns the response of a child about the pivot of its parent, whose motion
    /// is given: the response as it is where all children share one pivot.
    fn attach<V: Scalar>(
        child: &Self::Constants<V>,
        parent: LinkMotion<V>,
        response: Self::Response<V>,
    ) -> Self::Sums<V>;

    /// Returns the response of a link with children, and what it needs on the way
    /// down.
    fn inner<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        below: Self::Sums<V>,
    ) -> (Self::Response<V>, Self::Elimination<V>);

    /// Returns the acceleration of a child's pivot: what the parent hands down as it
    /// is where all children share one. (Joint angle and rate of a parent are left
    /// open here and for [`attach`](Self::attach).)
    fn pivot<V: Scalar>(
        child: &Self::Constants<V>,
        parent: LinkMotion<V>,
        carried: Self::Carried<V>,
    ) -> [V; 2];

    /// Returns the angular acceleration of a link with children, and what it hands
    /// them.
    fn accelerate<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        elimination: Self::Elimination<V>,
        pivot: [V; 2],
    ) -> (V, Self::Carried<V>);

    /// Returns the angular acceleration of a link without children.
    fn accelerate_leaf<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
    ) -> V;
}
