//! Equations of one link, as the attribute emits them.

use crate::scalar::Scalar;
pub use crate::simd::Row;

/// Motion of one link, or of several links or states, one in each lane of `V`.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion<V> {
    /// Sine of the angle.
    pub sine: V,
    /// Cosine of the angle.
    pub cosine: V,
    /// Angular velocity, in rad/s.
    pub omega: V,
    /// Angle relative to the parent, in rad; the absolute angle for the root.
    pub joint_angle: V,
    /// Angular velocity relative to the parent, in rad/s; the absolute one for the root.
    pub joint_rate: V,
    /// External torque (a generalized force), in N m; for a prescribed link, its angular
    /// acceleration in rad/s².
    pub outside_torque: V,
    /// 1 for a prescribed link, whose acceleration is given; 0 for all others.
    pub prescribed: V,
}

impl<V: Copy> LinkMotion<V> {
    /// Creates the motion of a link from sine, cosine and angular velocity; joint motion and
    /// external torque are unspecified.
    #[inline(always)]
    pub(super) fn turning(sine: V, cosine: V, omega: V) -> Self {
        // The unspecified fields repeat other values, so that they take no register.
        Self {
            sine,
            cosine,
            omega,
            joint_angle: omega,
            joint_rate: omega,
            outside_torque: omega,
            prescribed: omega,
        }
    }
}

/// Equations of one link of a tree: the articulated-body recursion in the plane. A value `V` holds
/// a number of one link, or numbers of several links or states, one in each lane. A tree evaluates
/// them in an upward and a downward pass.
///
/// All rows are arrays, for example `type Response<V: Scalar> = [V; 5];`. All links use the same
/// units of length and mass, so that responses of the children of one pivot can be added. Every
/// function is `#[inline(always)]`.
///
/// # Source
/// R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7; in the plane `docs/physics.md`,
/// section 10.
pub trait LinkEquations: Copy + Send + Sync + 'static {
    /// Constants of a link.
    type Constants<V: Scalar>: Row<V>;

    /// Response of a subtree to the acceleration of its pivot: articulated inertia (three numbers)
    /// and bias force (two), and, if joints have torques, the torque of the joint on the parent.
    type Response<V: Scalar>: Row<V>;

    /// Sum of the responses of all children, transferred to their parent's pivot; identical to
    /// [`Response`](Self::Response) if all children share one pivot.
    type Sums<V: Scalar>: Row<V>;

    /// Numbers of a link with children that the upward pass keeps for the downward pass.
    type Elimination<V: Scalar>: Row<V>;

    /// Numbers that a link passes to its children in the downward pass. The first two are the
    /// acceleration of their pivot if all children share one.
    type Carried<V: Scalar>: Row<V>;

    /// Number of copies of each generation under each link of the one before, 1 for the root;
    /// constants then have one row per generation. Empty for a tree given link by link, whose
    /// constants have one row per link. A tree with more links than memory can hold is rejected by
    /// the compiler.
    const COPIES: &'static [usize];

    /// Names of the generations; empty if the tree is given link by link.
    const NAMES: &'static [&'static str];

    /// True if the functions use [`joint_angle`](LinkMotion::joint_angle) or
    /// [`joint_rate`](LinkMotion::joint_rate).
    const JOINTS: bool;

    /// True if the last constant of a link is a torque. Every evaluation sets it for the root; it
    /// is zero for other links.
    const TORQUE: bool;

    /// True if the functions use external torques ([`outside_torque`](LinkMotion::outside_torque)).
    const FORCED: bool = false;

    /// True if springs and friction act between links that are not parent and child
    /// ([`Tree::with_spring_dampers`](super::Tree::with_spring_dampers)), or along lines
    /// ([`Tree::with_translational_spring_dampers`](super::Tree::with_translational_spring_dampers)).
    /// The functions then use external torques.
    const COUPLED: bool = false;

    /// True if links may be prescribed, that is, have given accelerations
    /// ([`prescribed`](LinkMotion::prescribed)). For such a link the functions return the torque that its
    /// motion needs instead of the acceleration.
    const PRESCRIBED: bool = false;

    /// Returns the response of a link without children to the acceleration of its pivot.
    fn leaf<V: Scalar>(constants: &Self::Constants<V>, link: LinkMotion<V>) -> Self::Response<V>;

    /// Transfers the response of a child to the pivot of its parent, whose motion is given. If all
    /// children share one pivot, returns the response unchanged.
    fn attach<V: Scalar>(
        child: &Self::Constants<V>,
        parent: LinkMotion<V>,
        response: Self::Response<V>,
    ) -> Self::Sums<V>;

    /// Computes the response of a link with children from the sum `below` of their responses, and
    /// the numbers that the link needs in the downward pass.
    fn inner<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        below: Self::Sums<V>,
    ) -> (Self::Response<V>, Self::Elimination<V>);

    /// Returns the acceleration of a child's pivot. If all children share one pivot, this is part
    /// of the numbers that the parent passes on. Joint angle and rate of the parent are not used
    /// here nor in [`attach`](Self::attach).
    fn pivot<V: Scalar>(
        child: &Self::Constants<V>,
        parent: LinkMotion<V>,
        carried: Self::Carried<V>,
    ) -> [V; 2];

    /// Returns the angular acceleration of a link with children, and the numbers that it passes to
    /// them.
    fn accelerate<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        elimination: Self::Elimination<V>,
        pivot: [V; 2],
    ) -> (V, Self::Carried<V>);

    /// Returns the angular acceleration of a link without children, given the acceleration of its
    /// pivot.
    fn accelerate_leaf<V: Scalar>(
        constants: &Self::Constants<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
    ) -> V;
}
