//! Small differences that act back on the motion that they are beside.

mod forced;

pub use forced::{ForcedDifferences, NearlyPushed, SmallUnderTorques};

use super::by_reference::by_reference;
use super::function::{At, Computes, functions};
use super::second_order::{CastSecondOrder, SecondOrder, SecondOrderOde};
use super::transverse::{parts, with_differences};
use super::{Transverse, TransverseSector, Workspace};
use crate::scalar::Scalar;

/// A model of copies in phase whose small differences act back on the motion: `in_phase(…)`
/// with `emit(small)`, or `emit(small(child, …))` for some sectors.
///
/// The equations are those of the Lagrangian of the whole tree through second order in
/// the differences δ of the sectors (physics (12.4)): linear in δ, quadratic in what δ does to
/// the angles in phase, and with an energy of their own that friction and drives alone
/// change. Without differences the motion is the one in phase, and tiny differences
/// follow [`Transverse`].
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
    /// The sectors that act back, by their index in
    /// [`TRANSVERSE`](Transverse::TRANSVERSE): differences stand in this order.
    const SMALL: &'static [usize];

    /// Writes the second time derivatives (in rad/s²) of the angles in phase and, behind
    /// them, of the differences.
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

    /// Returns the energy (in J) of the whole tree through second order in the
    /// differences, kinetic and potential.
    fn small_energy_of(
        &self,
        theta: &[T],
        omega: &[T],
        difference: &[T],
        difference_rate: &[T],
    ) -> T;
}

/// Returns the number of differences that act back in a model of these sectors.
pub(super) const fn differences(sectors: &[TransverseSector], small: &[usize]) -> usize {
    let (mut count, mut index) = (0, 0);
    while index < small.len() {
        count += sectors[small[index]].links;
        index += 1;
    }
    count
}

/// Returns the number of angles and differences, where that of links is known.
pub(super) const fn coordinates(
    links: Option<usize>,
    sectors: &[TransverseSector],
    small: &[usize],
) -> Option<usize> {
    match links {
        Some(links) => Some(links + differences(sectors, small)),
        None => None,
    }
}

/// The angles in phase and the small differences that act back on them as a first-order
/// system: the state is the angles, the differences of all sectors in the order of
/// [`SMALL`](SmallDifferences::SMALL), the angular velocities and the rates of the
/// differences.
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
pub type SmallOde<P> = SecondOrderOde<Nearly<P>>;

/// A model nearly in phase: [`SmallOde`](type@SmallOde).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearly<P> {
    model: P,
    differences: usize,
}

/// Returns the angles in phase and the small differences of a model, or of a reference to one,
/// as a first-order system.
#[allow(non_snake_case)]
pub fn SmallOde<T: Scalar, P: SmallDifferences<T>>(model: P) -> SmallOde<P> {
    SecondOrderOde(Nearly {
        model,
        differences: differences(P::TRANSVERSE, P::SMALL),
    })
}

impl<P> SecondOrderOde<Nearly<P>> {
    /// Returns the energy (in J) of a state; NaN for one of another length.
    pub fn energy<T: Scalar>(&self, state: &[T]) -> T
    where
        P: SmallDifferences<T>,
    {
        let Self(Nearly { model, differences }) = self;
        let half = model.links() + differences;
        if state.len() != 2 * half {
            return T::from_f64(f64::NAN);
        }
        let (angles, velocities) = state.split_at(half);
        let [theta, difference] = parts(model.links(), angles);
        let [omega, difference_rate] = parts(model.links(), velocities);
        model.small_energy_of(theta, omega, difference, difference_rate)
    }
}

impl<T: Scalar, P: Computes<functions::SmallDifferences, T>> SecondOrder<T> for Nearly<P> {
    fn coordinates(&self) -> usize {
        self.model.links() + self.differences
    }

    #[inline(always)]
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: [&[T]; 2],
        rates: [&mut [T]; 2],
    ) {
        with_differences(&self.model, workspace, At::time(time), state, rates);
    }
}

impl<T: Scalar, P: SmallDifferences<T>> CastSecondOrder<T> for Nearly<P> {
    type On<S: Scalar> = Nearly<<P as Computes<functions::SmallDifferences, T>>::On<S>>;

    const COORDINATES: Option<usize> = coordinates(P::KNOWN_LINKS, P::TRANSVERSE, P::SMALL);

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        Nearly {
            model: Computes::<functions::SmallDifferences, T>::on(&self.model, convert),
            differences: self.differences,
        }
    }

    fn shape(&self) -> usize {
        self.model.shape()
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
