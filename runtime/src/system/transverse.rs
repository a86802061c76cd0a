//! Small differences between copies that move in phase.

use super::by_reference::by_reference;
use super::function::{At, Computes, functions};
use super::{Free, Motion, Pendulum, Workspace};
use crate::scalar::Scalar;

/// Set of copies that move in phase, and whose small differences obey separate equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TransverseSector {
    /// Name of the model's link that represents the copies.
    pub name: &'static str,
    /// Index of that link in the model; the links of its subtree follow it.
    pub first: usize,
    /// Number of links in the subtree, including the link itself. This is the number of
    /// differences.
    pub links: usize,
    /// Number of copies under one link of the whole tree.
    pub copies: usize,
    /// Number of links of the whole tree under which such copies hang and move in phase. The copies
    /// under each of these links have separate differences, which obey the same equations.
    pub holders: usize,
}

/// In-phase motion at one time, as slices with one value per link.
#[derive(Clone, Copy, Debug)]
pub struct InPhaseMotion<'a, T> {
    /// Angles, rad.
    pub theta: &'a [T],
    /// Angular velocities, rad/s.
    pub omega: &'a [T],
    /// Angular accelerations, rad/s².
    pub alpha: &'a [T],
}

/// Model of copies that move in phase, together with the equations of small differences between the
/// copies: `in_phase(…)` with `emit(transverse)`.
///
/// Copies of a sector have the angles θ + e δ, with any numbers e that add up to 0 over the copies
/// under one link and whose squares add up to the number of copies; ±1 for two. The differences δ
/// of the copies and of their subtrees follow linear equations, exact for infinitesimal
/// differences, whose coefficients depend on the in-phase motion (physics (12.2); for one link,
/// Hill's equation). So computing a threshold needs only that motion and a small linear system.
///
/// Sectors are counted in the order of [`TRANSVERSE`](Self::TRANSVERSE). Values are NaN
/// for a sector that does not exist and for slices of other lengths.
pub trait Transverse<T: Scalar>: Pendulum<T> + Computes<functions::LinearDifferences, T> {
    /// Sectors for which the model has equations of small differences.
    const TRANSVERSE: &'static [TransverseSector];

    /// Writes the second time derivatives (rad/s²) of a sector's differences, given the differences
    /// (rad) and their rates (rad/s).
    fn transverse_accelerations_into(
        &self,
        sector: usize,
        time: T,
        motion: InPhaseMotion<'_, T>,
        difference: &[T],
        difference_rate: &[T],
        accelerations: &mut [T],
    );

    /// Writes the angular accelerations of the in-phase motion, then those of a sector's
    /// differences. Common parts are computed once.
    #[inline]
    fn transverse_motion_into(
        &self,
        sector: usize,
        time: T,
        [theta, omega]: [&[T]; 2],
        [differences, rates]: [&[T]; 2],
        accelerations: &mut [T],
    ) {
        let at = At {
            time,
            index: sector,
        };
        let given = [theta, omega, differences, rates];
        self.compute_with(&mut Workspace::new(), at, &given, &mut [accelerations]);
    }

    /// Returns the energy (J) of the differences between the copies under one link, including
    /// potential energy. It is quadratic in the differences.
    fn transverse_energy_of(
        &self,
        sector: usize,
        theta: &[T],
        difference: &[T],
        difference_rate: &[T],
    ) -> T;

    /// Returns the energy transfer W (watts) into the differences: the rate of change of their
    /// energy without friction and drag.
    fn transverse_transfer_of(
        &self,
        sector: usize,
        time: T,
        motion: InPhaseMotion<'_, T>,
        difference: &[T],
        difference_rate: &[T],
    ) -> T;

    /// Returns the power (W) of friction and drag on the energy of the differences. NaN if friction
    /// is not viscous, because it then depends on the in-phase motion; see
    /// [`transverse_friction_power_along`](Self::transverse_friction_power_along).
    fn transverse_friction_power_of(&self, sector: usize, difference_rate: &[T]) -> T;

    /// Returns the power (in W) of friction and drag on the energy of the differences,
    /// viscous or not.
    fn transverse_friction_power_along(
        &self,
        sector: usize,
        _motion: InPhaseMotion<'_, T>,
        difference_rate: &[T],
    ) -> T {
        self.transverse_friction_power_of(sector, difference_rate)
    }
}

/// An in-phase motion and the small differences of one sector as a first-order system: the state is
/// the angles, the differences, the angular velocities and the rates of the differences. The
/// equations of the differences are linear, so the scale of the differences is arbitrary. External
/// torques that are equal on all copies change the in-phase motion only.
///
/// ```
/// # #[cfg(feature = "macros")] {
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::TransverseOde;
///
/// /// The paper's pendulum, its children in phase.
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     in_phase(child),
///     emit(transverse),
/// )]
/// struct InPhase;
///
/// // Growth of the antiphase mode within 10 s of a release with vertical children.
/// let model = InPhase::new();
/// let ode = TransverseOde::new(&model, 0).unwrap();
/// let growth = |degrees: f64| {
///     let start = State::at_rest(0.0, &[degrees.to_radians(), 0.0, 1.0]);
///     let mut largest = 0.0_f64;
///     let method = Dop853::new(Options::with_tolerance(1e-10));
///     method.integrate(&ode, &start, 10.0, |step| {
///         largest = largest.max(step.end()[2].abs());
///         ControlFlow::Continue(())
///     })?;
///     Ok::<_, IntegrationError<f64>>(largest)
/// };
/// assert!(growth(42.0).unwrap() < 10.0 && growth(44.0).unwrap() > 10.0);
/// # }
/// ```
pub type TransverseOde<P> = Motion<P, functions::LinearDifferences, Free>;

impl<P> TransverseOde<P> {
    /// Creates the first-order system of a model (or of a reference to one): its in-phase motion
    /// and the differences of the sector with that index; `None` if there is no such sector.
    pub fn new<T: Scalar>(model: P, sector: usize) -> Option<Self>
    where
        P: Transverse<T>,
    {
        let differences = P::TRANSVERSE.get(sector)?.links;
        Some(Self::new_of(model, sector, differences, Free))
    }
}

by_reference! {
    impl<T: Scalar> Transverse<T> for &P {
        const TRANSVERSE: &'static [TransverseSector];
        fn transverse_accelerations_into(
            &self, sector: usize, time: T, motion: InPhaseMotion<'_, T>, difference: &[T],
            difference_rate: &[T], accelerations: &mut [T]
        );
        fn transverse_energy_of(
            &self, sector: usize, theta: &[T], difference: &[T], difference_rate: &[T]
        ) -> T;
        fn transverse_transfer_of(
            &self, sector: usize, time: T, motion: InPhaseMotion<'_, T>, difference: &[T],
            difference_rate: &[T]
        ) -> T;
        fn transverse_friction_power_of(&self, sector: usize, difference_rate: &[T]) -> T;
        fn transverse_friction_power_along(
            &self, sector: usize, motion: InPhaseMotion<'_, T>, difference_rate: &[T]
        ) -> T;
    }
}
