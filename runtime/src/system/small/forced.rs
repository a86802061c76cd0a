//! Small differences that act back, under torques from outside.

use core::fmt;

use super::{SmallDifferences, differences, dimension};
use crate::scalar::Scalar;
use crate::system::by_reference::by_reference;
use crate::system::forced::under;
use crate::system::{Forced, LaneOde, LaneTorques, Model, Ode, Torques};

/// A model of [`SmallDifferences`] that takes torques from outside: `emit(small)` with
/// `emit(forces)`.
///
/// Generalized torques stand as angles do: those on the angles in phase, each the sum
/// of the torques on all copies, and those on the differences, Σ e Q with the weights e
/// of the copies; [`DifferencePatterns::torques`](crate::system::DifferencePatterns::torques)
/// forms both. Their power on the model's energy is that of torques times rates, exactly.
/// Torques on differences count as small as these: the errors are then of the orders that
/// they have without torques.
pub trait ForcedDifferences<T: Scalar>: SmallDifferences<T> + Forced<T> {
    /// Writes the second time derivatives (in rad/s²) of the angles in phase and, behind
    /// them, of the differences, under torques (in N m): of angles, rates and torques those
    /// in phase and those of differences. NaN for slices of other lengths.
    fn small_accelerations_under_into(
        &self,
        time: T,
        angles: [&[T]; 2],
        rates: [&[T]; 2],
        torques: [&[T]; 2],
        accelerations: &mut [T],
    );

    /// Writes those of this model on other scalars, in their arithmetic, as
    /// [`small_accelerations_of`](SmallDifferences::small_accelerations_of).
    fn small_accelerations_under_of<S: Scalar>(
        model: &Self::Of<S>,
        time: S,
        angles: [&[S]; 2],
        rates: [&[S]; 2],
        torques: [&[S]; 2],
        accelerations: &mut [S],
    );
}

by_reference! {
    impl<T: Scalar> ForcedDifferences<T> for &P {
        for fn small_accelerations_under_of<S: Scalar>(
            model: &Self::Of<S>, time: S, angles: [&[S]; 2], rates: [&[S]; 2],
            torques: [&[S]; 2], accelerations: &mut [S]
        );
        fn small_accelerations_under_into(
            &self, time: T, angles: [&[T]; 2], rates: [&[T]; 2], torques: [&[T]; 2],
            accelerations: &mut [T]
        );
    }
}

/// [`SmallOde`](super::SmallOde) under [`Torques`]: functions of the time, of angles and
/// differences one behind the other, and of their rates, which write as many generalized
/// torques.
///
/// # Examples
///
/// A gust that pushes one of two twigs more than the other:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{DifferencePatterns, SmallUnderTorques};
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     stem: rod(mass = 0.2, length = 0.3, friction = 1e-2) [
///         twig: rod(mass = 0.1, length = 0.2, friction = 1e-3) * 2
///     ],
///     in_phase(twig),
///     emit(small, forces),
/// )]
/// struct Branch;
///
/// let patterns = DifferencePatterns::of::<f64, _>(&Branch::new(), Branch::WHOLE)?;
/// // On the stem and the two twigs; on the stem, both twigs and their difference.
/// let gust = patterns.torques(&[0.02, 0.008, 0.004]);
/// assert!((gust[1] - 0.012).abs() < 1e-15 && (gust[2] - 0.004).abs() < 1e-15);
/// let pushed = SmallUnderTorques::of(Branch::new(), gust);
/// let method = Dop853::new(Options::with_tolerance(1e-9));
/// let start = State::at_rest(0.0, &[0.0; 3]);
/// let end = method.integrate(&pushed, &start, 60.0, |_| ControlFlow::Continue(()))?.state;
/// let [_, one, other] = patterns.to_whole(&end.values)[..3] else { unreachable!() };
/// assert!(one > other && other > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct SmallUnderTorques<P, F> {
    model: P,
    torques: F,
}

impl<P, F> SmallUnderTorques<P, F> {
    /// The model, or a reference to one, under the torques that
    /// `torques(time, angles, rates, out)` writes.
    pub fn new<T>(model: P, torques: F) -> Self
    where
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self { model, torques }
    }

    /// The model, or a reference to one, under [`Torques`] of a type of their own, or
    /// under a vector of those that stay as they are.
    pub fn of(model: P, torques: F) -> Self {
        Self { model, torques }
    }

    /// Returns the torques, to change them.
    pub fn torques_mut(&mut self) -> &mut F {
        &mut self.torques
    }
}

impl<P: fmt::Debug, F> fmt::Debug for SmallUnderTorques<P, F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { model, torques: _ } = self;
        formatter
            .debug_struct("SmallUnderTorques")
            .field("model", model)
            .finish_non_exhaustive()
    }
}

impl<T: Scalar, P: ForcedDifferences<T>, F: Torques<T>> Ode<T> for SmallUnderTorques<P, F> {
    fn dimension(&self) -> usize {
        2 * (self.model.links() + differences(P::TRANSVERSE, P::SMALL))
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let Self { model, torques } = self;
        let half = model.links() + differences(P::TRANSVERSE, P::SMALL);
        if let Some((given, out)) = under(half, torques, time, state, rates) {
            let ([theta, omega], [first, second]) = (given, out);
            let (angles, rates) = (parts(model.links(), theta), parts(model.links(), omega));
            let torques = parts(model.links(), first);
            model.small_accelerations_under_into(time, angles, rates, torques, second);
            first.copy_from_slice(omega);
        }
    }
}

impl<T: Scalar, P: ForcedDifferences<T>, F: LaneTorques<T>> LaneOde<T> for SmallUnderTorques<P, F> {
    type Of<S: Scalar> = SmallUnderTorques<P::Of<S>, F::Of<S>>;

    const DIMENSION: Option<usize> = dimension(P::KNOWN_LINKS, P::TRANSVERSE, P::SMALL);

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        SmallUnderTorques {
            model: self.model.cast(&convert),
            torques: self.torques.on_scalar(&convert),
        }
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        let SmallUnderTorques { model, torques } = system;
        let half = model.links() + differences(P::TRANSVERSE, P::SMALL);
        if let Some((given, out)) = under(half, torques, time, state, rates) {
            let ([theta, omega], [first, second]) = (given, out);
            let (angles, rates) = (parts(model.links(), theta), parts(model.links(), omega));
            let torques = parts(model.links(), first);
            P::small_accelerations_under_of(model, time, angles, rates, torques, second);
            first.copy_from_slice(omega);
        }
    }
}

/// Returns the values of angles in phase, and those of differences.
#[inline(always)]
fn parts<T>(links: usize, values: &[T]) -> [&[T]; 2] {
    let (in_phase, differences) = values.split_at(links.min(values.len()));
    [in_phase, differences]
}
