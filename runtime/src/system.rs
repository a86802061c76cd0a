//! The traits that emitted code implements, and the systems that integrators
//! see.
//!
//! A description becomes a type that implements [`Pendulum`] (accelerations in
//! absolute angles), [`Energy`], and, where the tree has identical siblings,
//! [`SymmetricPendulum`]. Integrators know none of these: they integrate an
//! [`Ode`], a first-order system. [`AbsoluteAngles`] and
//! [`SymmetricCoordinates`] turn one into the other.

mod by_reference;
mod canonical;
pub(crate) mod cast;
mod coordinates;
mod first_integral;
mod forced;
mod lane_ode;
mod link_name;
mod ode;
mod parametric;
mod patterns;
pub(crate) mod positions;
mod prescribed;
mod small;
mod state;
mod taylor;
mod transverse;
mod whole_tree;
mod workspace;

use crate::scalar::Scalar;
use by_reference::by_reference;

pub use canonical::{Canonical, CanonicalVariables};
#[doc(hidden)]
pub use cast::InRegisters;
pub use cast::{Cast, CastOde};
pub use coordinates::{AbsoluteAngles, SymmetricCoordinates};
pub use first_integral::{CanonicalEnergy, FirstIntegral};
pub use forced::{Forced, LaneTorques, Torques, UnderTorques};
pub use lane_ode::LaneOde;
pub use link_name::LinkName;
pub use ode::{Ode, OdeFn};
pub use parametric::Parametric;
pub use patterns::{DifferencePatterns, PatternError};
pub use positions::{LinkPoint, LinkProperties, Positions};
pub use prescribed::{
    LaneCourses, LinkCourse, LinkCourses, Prescribed, PrescribedLinks, PrescribedMotion,
    PrescribedOde,
};
#[doc(hidden)]
pub use prescribed::{course_room, on_course};
pub use small::{ForcedDifferences, SmallDifferences, SmallOde, SmallUnderTorques};
pub use state::{LengthMismatch, State};
pub use taylor::{RatesOnly, TaylorOde, TaylorPendulum};
pub use transverse::{InPhaseMotion, Transverse, TransverseOde, TransverseSector};
pub use whole_tree::{WholeLengthError, WholeTree};
#[doc(hidden)]
pub use whole_tree::{WholeMotion, WholeOrbit};
pub use workspace::Workspace;

/// Equations of motion in absolute angles.
///
/// Angles are measured from the downward vertical (from the upward one where gravity is
/// written as negative), in radians; links stand in parent-before-child order.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of motion in `{T}`",
    note = "a model has them in its own numbers: `model.cast(…)` takes it to others, `linearised(AbsoluteAngles(&model))` to those of variational equations"
)]
pub trait Pendulum<T: Scalar> {
    /// Number of links, each with one angle.
    const LINKS: usize;

    /// Names of the links, as described, in the order of the angles. Empty for
    /// trees whose code is loops over generations: their links are too many for a
    /// list, and have a [`link_name`](Self::link_name) all the same.
    const LINK_NAMES: &'static [&'static str];

    /// Name of the link with that index, if there is one.
    #[must_use]
    fn link_name(index: usize) -> Option<LinkName> {
        Self::LINK_NAMES
            .get(index)
            .map(|name| LinkName::listed(name))
    }

    /// Writes the angular accelerations, in rad/s², of a pendulum with angles
    /// `theta` (rad) and angular velocities `omega` (rad/s) at `time` (s).
    ///
    /// Emitted models in `f64` and `f32` fuse products with sums where the machine
    /// can: [`scalar`](crate::scalar#which-bits).
    ///
    /// All three slices have length [`LINKS`](Self::LINKS). An implementation
    /// must stay memory-safe for other lengths and must not make up values;
    /// filling `alpha` with NaN is the way to say that there is no answer.
    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]);

    /// Writes the same accelerations as
    /// [`accelerations_into`](Self::accelerations_into), in memory that the caller
    /// keeps: for trees in loops, which would allocate it for every evaluation.
    #[inline]
    fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let _ = workspace;
        self.accelerations_into(time, theta, omega, alpha);
    }
}

by_reference! {
    impl<T: Scalar> Pendulum<T> for &P {
        const LINKS: usize;
        const LINK_NAMES: &'static [&'static str];
        static fn link_name(index: usize) -> Option<LinkName>;
        fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]);
        fn accelerations_with(
            &self, workspace: &mut Workspace<T>, time: T, theta: &[T], omega: &[T], alpha: &mut [T]
        );
    }
}

/// Equations of motion in symmetric coordinates: means and differences of
/// identical sibling subtrees.
///
/// There are as many coordinates as links. A set of differences that is
/// exactly zero, with its rates, has accelerations that are exactly zero.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no symmetric coordinates in `{T}`",
    note = "a tree with identical siblings has them with `emit(symmetric)` in its attribute"
)]
pub trait SymmetricPendulum<T: Scalar>: Pendulum<T> {
    /// Names of the coordinates, in order.
    const COORDINATE_NAMES: &'static [&'static str];

    /// Writes the second time derivatives of the coordinates, in rad/s², for
    /// `coordinates` (rad) and `rates` (rad/s) at `time` (s).
    ///
    /// Lengths as in [`Pendulum::accelerations_into`].
    fn symmetric_accelerations_into(
        &self,
        time: T,
        coordinates: &[T],
        rates: &[T],
        accelerations: &mut [T],
    );
}

by_reference! {
    impl<T: Scalar> SymmetricPendulum<T> for &P {
        const COORDINATE_NAMES: &'static [&'static str];
        fn symmetric_accelerations_into(
            &self, time: T, coordinates: &[T], rates: &[T], accelerations: &mut [T]
        );
    }
}

/// Kinetic and potential energy in absolute angles, in joules.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know its energies in `{T}`",
    note = "a model knows them with `emit(energies)` in its attribute"
)]
pub trait Energy<T: Scalar>: Pendulum<T> {
    /// Kinetic energy for angles `theta` (rad) and angular velocities `omega`
    /// (rad/s); both of length [`Pendulum::LINKS`].
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;

    /// Potential energy for angles `theta` (rad), of length
    /// [`Pendulum::LINKS`]; zero where all angles are zero and the springs at rest.
    fn potential_energy_of(&self, theta: &[T]) -> T;

    /// Returns the kinetic energy, in memory that the caller keeps: trees in loops
    /// need some, and allocate it for every call of
    /// [`kinetic_energy_of`](Self::kinetic_energy_of).
    #[inline]
    fn kinetic_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let _ = workspace;
        self.kinetic_energy_of(theta, omega)
    }

    /// Returns the potential energy, in memory that the caller keeps.
    #[inline]
    fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let _ = workspace;
        self.potential_energy_of(theta)
    }
}

by_reference! {
    impl<T: Scalar> Energy<T> for &P {
        fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;
        fn potential_energy_of(&self, theta: &[T]) -> T;
        fn kinetic_energy_with(
            &self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]
        ) -> T;
        fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T;
    }
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::{AbsoluteAngles, Ode, Pendulum, State, SymmetricCoordinates, SymmetricPendulum};
    use crate::scalar::Scalar;

    struct Uncoupled;

    impl<T: Scalar> Pendulum<T> for Uncoupled {
        const LINKS: usize = 2;
        const LINK_NAMES: &'static [&'static str] = &["left", "right"];

        fn accelerations_into(&self, time: T, theta: &[T], _omega: &[T], alpha: &mut [T]) {
            for (alpha, theta) in alpha.iter_mut().zip(theta) {
                *alpha = time - *theta;
            }
        }
    }

    impl<T: Scalar> SymmetricPendulum<T> for Uncoupled {
        const COORDINATE_NAMES: &'static [&'static str] = &["mean", "difference"];

        fn symmetric_accelerations_into(&self, _time: T, _q: &[T], rates: &[T], out: &mut [T]) {
            out.copy_from_slice(rates);
        }
    }

    #[test]
    fn adapters_put_velocities_first_and_accelerations_second() {
        let mut rates = [0.0; 4];
        AbsoluteAngles(&Uncoupled).rates(10.0, &[1.0, 2.0, 3.0, 4.0], &mut rates);
        assert_eq!(rates, [3.0, 4.0, 9.0, 8.0]);
        SymmetricCoordinates(&Uncoupled).rates(10.0, &[1.0, 2.0, 3.0, 4.0], &mut rates);
        assert_eq!(rates, [3.0, 4.0, 3.0, 4.0]);
        let ode: &dyn Ode<f64> = &AbsoluteAngles(&Uncoupled);
        assert_eq!(ode.dimension(), 4);
    }

    #[test]
    fn a_state_of_wrong_length_gets_nan_and_no_panic() {
        let mut rates = [0.0_f64; 3];
        AbsoluteAngles(&Uncoupled).rates(0.0, &[1.0, 2.0, 3.0], &mut rates);
        assert!(rates.iter().all(|rate| rate.is_nan()));
    }

    #[test]
    fn halves_of_a_state() {
        let state = State::from_positions_and_velocities(0.5, &[1.0, 2.0], &[3.0, 4.0]).unwrap();
        assert_eq!(state.time, 0.5);
        assert_eq!(state.positions(), [1.0, 2.0]);
        assert_eq!(state.velocities(), [3.0, 4.0]);
        assert_eq!(State::at_rest(0.0, &[1.0]).values, [1.0, 0.0]);
        let error = State::from_positions_and_velocities(0.0, &[1.0], &[]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a state needs as many velocities as positions, but got 1 positions and 0 velocities"
        );
    }
}
