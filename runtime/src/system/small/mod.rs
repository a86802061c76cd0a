//! Small differences between copies, which act back on the in-phase motion.

mod forced;

pub use forced::SmallUnderTorques;

use super::by_reference::by_reference;
use super::function::{At, Computes, functions};
use super::motion::parts;
use super::{Free, Motion, Transverse, TransverseSector, Workspace};
use crate::scalar::Scalar;

/// Model of copies that move in phase, with small differences that act back on this motion:
/// `in_phase(…)` with `emit(small)`, or `emit(small(child, …))` for some sectors.
///
/// The equations are those of the Lagrangian of the whole tree through second order in the
/// differences δ of the sectors (physics (12.4)): linear in δ for the differences, quadratic in δ
/// for the in-phase angles. They have an energy that only friction and drives change. Without
/// differences the motion is the in-phase motion, and tiny differences follow [`Transverse`].
///
/// Copies have the angles θ + e δ as in [`Transverse`]; δ belongs to the copies under one
/// holder, or to those of all holders with squares of e that add up to the number of
/// copies under one. For pairs the error of δ̈ is of third order in δ, and that of θ̈ of
/// fourth; for more copies one order less. Differences of a radian and more are far beyond
/// it: the kinetic energy through second order is not positive there, and the motion may
/// end.
///
/// Values are NaN for slices of other lengths.
pub trait SmallDifferences<T: Scalar>:
    Transverse<T> + Computes<functions::SmallDifferences, T>
{
    /// Indices in [`TRANSVERSE`](Transverse::TRANSVERSE) of the sectors that act back on the
    /// in-phase motion. States contain the differences in this order.
    const SMALL: &'static [usize];

    /// Writes the second time derivatives (rad/s²) of the in-phase angles, then of the differences.
    #[inline]
    fn small_accelerations_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        difference: &[T],
        difference_rate: &[T],
        accelerations: &mut [T],
    ) {
        let given = [theta, omega, difference, difference_rate];
        Computes::<functions::SmallDifferences, T>::compute_with(
            self,
            &mut Workspace::new(),
            At::time(time),
            &given,
            &mut [accelerations],
        );
    }

    /// Writes the second time derivatives (rad/s²) of the in-phase angles, then of the differences,
    /// under torques (N m). Each pair of slices has the values of the in-phase angles, then of the
    /// differences. NaN for slices of other lengths. Compiled models have this function if the
    /// description has `emit(small)` and `emit(forces)`.
    ///
    /// Generalized torques have the order of the coordinates: first one for each in-phase angle, which
    /// is the sum of the torques on all copies, then one for each difference, Σ e Q with the torques Q
    /// and weights e of the copies;
    /// [`DifferencePatterns::torques`](crate::system::DifferencePatterns::torques) computes both. Their
    /// power is exactly Σ torque · rate. Torques on differences must be as small as the differences:
    /// the errors then have the same order as without torques.
    #[inline]
    fn small_accelerations_under_into(
        &self,
        time: T,
        [theta, difference]: [&[T]; 2],
        [omega, difference_rate]: [&[T]; 2],
        [torques, on_differences]: [&[T]; 2],
        accelerations: &mut [T],
    ) where
        Self: Computes<functions::SmallDifferencesUnderTorques, T>,
    {
        let given = [
            theta,
            omega,
            difference,
            difference_rate,
            torques,
            on_differences,
        ];
        Computes::<functions::SmallDifferencesUnderTorques, T>::compute_with(
            self,
            &mut Workspace::new(),
            At::time(time),
            &given,
            &mut [accelerations],
        );
    }

    /// Returns the energy (J) of the whole tree up to second order in the differences, kinetic and
    /// potential.
    fn small_energy_of(
        &self,
        theta: &[T],
        omega: &[T],
        difference: &[T],
        difference_rate: &[T],
    ) -> T;
}

/// Returns the number of differences that act back, in a model with these sectors.
pub(super) const fn differences(sectors: &[TransverseSector], small: &[usize]) -> usize {
    let (mut count, mut index) = (0, 0);
    while index < small.len() {
        count += sectors[small[index]].links;
        index += 1;
    }
    count
}

/// First-order system of the in-phase angles and of the small differences that act back on them:
/// the state is the angles, the differences of all sectors in the order of
/// [`SMALL`](SmallDifferences::SMALL), the angular velocities and the rates of the differences.
///
/// ```
/// # #[cfg(feature = "macros")] {
/// use branched_pendulum::SmallDifferences;
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::SmallOde;
///
/// /// The paper's pendulum.
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     in_phase(child),
///     emit(small),
/// )]
/// struct NearlyInPhase;
///
/// // Antiphase motion of the children swings the parent, by terms of second order.
/// let model = NearlyInPhase::new();
/// let parent = |difference: f64| {
///     let start = State::at_rest(0.0, &[0.0, 0.2, difference]);
///     let method = Dop853::new(Options::with_tolerance(1e-12));
///     let end = method.run(&SmallOde(&model), &start, 1.0);
///     end.unwrap().state.values[0]
/// };
/// let reaction = |difference: f64| (parent(difference) - parent(0.0)) / difference.powi(2);
/// assert!((reaction(2e-3) / reaction(1e-3) - 1.0).abs() < 1e-3);
/// # }
/// ```
pub type SmallOde<P> = Motion<P, functions::SmallDifferences, Free>;

/// Creates the first-order system of a model (or of a reference to one): its in-phase angles and
/// small differences.
#[allow(non_snake_case)]
pub fn SmallOde<T: Scalar, P: SmallDifferences<T>>(model: P) -> SmallOde<P> {
    Motion::new_of(model, 0, differences(P::TRANSVERSE, P::SMALL), Free)
}

impl<P> SmallOde<P> {
    /// Returns the energy (J) of a state; NaN for a state of a wrong length.
    pub fn energy<T: Scalar>(&self, state: &[T]) -> T
    where
        P: SmallDifferences<T>,
    {
        let model = &self.model;
        let half = model.links() + self.differences();
        if state.len() != 2 * half {
            return T::from_f64(f64::NAN);
        }
        let (angles, velocities) = state.split_at(half);
        let [theta, difference] = parts(model.links(), angles);
        let [omega, difference_rate] = parts(model.links(), velocities);
        model.small_energy_of(theta, omega, difference, difference_rate)
    }
}

by_reference! {
    impl<T: Scalar> SmallDifferences<T> for &P {
        const SMALL: &'static [usize];
        fn small_energy_of(
            &self, theta: &[T], omega: &[T], difference: &[T], difference_rate: &[T]
        ) -> T;
    }
}
