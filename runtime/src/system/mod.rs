//! The traits that emitted code implements, and the systems that integrators
//! see.
//!
//! A description becomes a type that implements [`Pendulum`] (accelerations in absolute angles),
//! [`Energy`], and, if the tree has identical siblings, [`SymmetricPendulum`]. Integrators do not
//! use these traits: they integrate an [`Ode`], a first-order system. [`AbsoluteAngles`] and
//! [`SymmetricCoordinates`](type@SymmetricCoordinates) convert a pendulum to such a system.

mod action;
mod by_reference;
mod canonical;
mod cast_ode;
mod coordinates;
mod derivatives;
mod energy;
mod first_integral;
mod forced;
mod function;
mod fused;
mod integral;
mod link_name;
mod model;
mod motion;
mod ode;
mod parametric;
mod patterns;
pub(crate) mod pendulum;
pub(crate) mod positions;
mod prescribed;
mod pullback;
mod small;
mod state;
mod taylor;
mod transverse;
mod whole_tree;
mod workspace;

pub use action::{Action, CastAction, Free};
pub use canonical::CanonicalVariables;
pub use cast_ode::CastOde;
pub use coordinates::{AbsoluteAngles, SymmetricCoordinates, SymmetricPendulum};
#[doc(hidden)]
pub use derivatives::{Slopes, gradient};
pub use energy::Energy;
pub use first_integral::{CanonicalEnergy, FirstIntegral, TotalEnergy};
pub use forced::UnderTorques;
pub use function::{At, Computes, MotionKind, SliceFunction, functions};
pub use integral::WithIntegral;
pub use link_name::LinkName;
pub use model::Model;
pub(crate) use model::known;
pub use motion::Motion;
pub use ode::{Ode, OdeFn};
pub use parametric::Parametric;
pub use patterns::{DifferencePatterns, PatternError};
#[doc(hidden)]
pub use pendulum::InRegisters;
pub use pendulum::Pendulum;
pub use positions::{LinkPoint, LinkProperties, Positions};
pub use prescribed::{CourseFn, Courses, LinkCourse, Prescribed, PrescribedMotion, PrescribedOde};
pub use pullback::{PullbackOde, PullbackWorkspace};
pub use small::{SmallDifferences, SmallOde, SmallUnderTorques};
pub use state::{LengthMismatch, State};
pub use taylor::{RatesOnly, TaylorOde, TaylorPendulum};
pub use transverse::{InPhaseMotion, Transverse, TransverseOde, TransverseSector};
pub use whole_tree::{WholeLengthError, WholeTree};
#[doc(hidden)]
pub use whole_tree::{WholeMotion, WholeOrbit};
pub use workspace::Workspace;

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::functions::SymmetricAccelerations;
    use super::{
        AbsoluteAngles, At, Computes, LinkName, Model, Ode, Pendulum, State, SymmetricCoordinates,
        SymmetricPendulum,
    };
    use crate::scalar::Scalar;

    struct Uncoupled;

    impl<T: Scalar> Model<T> for Uncoupled {
        type Of<S: Scalar> = Uncoupled;
        const KNOWN_LINKS: Option<usize> = Some(2);

        fn links(&self) -> usize {
            2
        }

        fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
            LinkName::in_list(&["left", "right"], index)
        }

        fn cast<S: Scalar>(&self, _: impl Fn(T) -> S) -> Uncoupled {
            Uncoupled
        }
    }

    impl<T: Scalar> Pendulum<T> for Uncoupled {
        fn evaluate(
            &self,
            time: T,
            theta: impl Fn(usize) -> T,
            _: impl Fn(usize) -> T,
            mut alpha: impl FnMut(usize, T),
        ) {
            for link in 0..2 {
                alpha(link, time - theta(link));
            }
        }
    }

    impl<T: Scalar> SymmetricPendulum<T> for Uncoupled {
        const COORDINATE_NAMES: &'static [&'static str] = &["mean", "difference"];
    }

    impl<T: Scalar> Computes<SymmetricAccelerations, T> for Uncoupled {
        type On<S: Scalar> = Uncoupled;

        fn on<S: Scalar>(&self, _: impl Fn(T) -> S) -> Uncoupled {
            Uncoupled
        }

        fn compute(&self, _: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
            if let (&[_, rates], [out]) = (given, results) {
                out.copy_from_slice(rates);
            }
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
