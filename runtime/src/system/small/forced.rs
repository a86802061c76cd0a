//! Small differences that act back, under torques from outside.

use super::{SmallDifferences, coordinates, differences};
use crate::scalar::Scalar;
use crate::system::function::{At, Computes, compute_in, functions};
use crate::system::second_order::{CastSecondOrder, HandedOver, SecondOrder, SecondOrderOde};
use crate::system::transverse::parts;
use crate::system::{Forced, LaneTorques, Torques, Workspace};

/// A model of [`SmallDifferences`] that takes torques from outside: `emit(small)` with
/// `emit(forces)`.
///
/// Generalized torques stand as angles do: those on the angles in phase, each the sum
/// of the torques on all copies, and those on the differences, Σ e Q with the weights e
/// of the copies; [`DifferencePatterns::torques`](crate::system::DifferencePatterns::torques)
/// forms both. Their power on the model's energy is that of torques times rates, exactly.
/// Torques on differences count as small as these: the errors are then of the orders that
/// they have without torques.
pub trait ForcedDifferences<T: Scalar>:
    SmallDifferences<T> + Forced<T> + Computes<functions::SmallDifferencesUnderTorques, T>
{
    /// Writes the second time derivatives (in rad/s²) of the angles in phase and, behind
    /// them, of the differences, under torques (in N m): of angles, rates and torques those
    /// in phase and those of differences. NaN for slices of other lengths.
    #[inline]
    fn small_accelerations_under_into(
        &self,
        time: T,
        [theta, difference]: [&[T]; 2],
        [omega, difference_rate]: [&[T]; 2],
        [torques, on_differences]: [&[T]; 2],
        accelerations: &mut [T],
    ) {
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
}

impl<T: Scalar, P> ForcedDifferences<T> for P where
    P: SmallDifferences<T> + Forced<T> + Computes<functions::SmallDifferencesUnderTorques, T>
{
}

/// [`SmallOde`](type@super::SmallOde) under [`Torques`]: functions of the time, of angles and
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
/// let end = method.run(&pushed, &start, 60.0)?.state;
/// let [_, one, other] = patterns.to_whole(&end.values)[..3] else { unreachable!() };
/// assert!(one > other && other > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type SmallUnderTorques<P, F> = SecondOrderOde<NearlyPushed<P, F>>;

/// A model nearly in phase and the torques on it: [`SmallUnderTorques`].
#[derive(Clone, Copy, Debug)]
pub struct NearlyPushed<P, F> {
    model: P,
    differences: usize,
    torques: HandedOver<F>,
}

impl<P, F> SecondOrderOde<NearlyPushed<P, F>> {
    /// The model, or a reference to one, under the torques that
    /// `torques(time, angles, rates, out)` writes.
    pub fn new<T: Scalar>(model: P, torques: F) -> Self
    where
        P: SmallDifferences<T>,
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self::of(model, torques)
    }

    /// The model, or a reference to one, under [`Torques`] of a type of their own, or
    /// under a vector of those that stay as they are.
    pub fn of<T: Scalar>(model: P, torques: F) -> Self
    where
        P: SmallDifferences<T>,
    {
        SecondOrderOde(NearlyPushed {
            model,
            differences: differences(P::TRANSVERSE, P::SMALL),
            torques: HandedOver(torques),
        })
    }

    /// Returns the torques, to change them.
    pub fn torques_mut(&mut self) -> &mut F {
        &mut self.0.torques.0
    }
}

impl<T: Scalar, P, F> SecondOrder<T> for NearlyPushed<P, F>
where
    P: Computes<functions::SmallDifferencesUnderTorques, T>,
    F: Torques<T>,
{
    fn coordinates(&self) -> usize {
        self.model.links() + self.differences
    }

    #[inline(always)]
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        [first, second]: [&mut [T]; 2],
    ) {
        // Torques stand where the rates of the angles will.
        self.torques.0.torques_into(time, angles, velocities, first);
        let split = |values| parts(self.model.links(), values);
        let ([theta, difference], [omega, rate]) = (split(angles), split(velocities));
        let [torques, on_differences] = parts(self.model.links(), first);
        let given = [theta, omega, difference, rate, torques, on_differences];
        compute_in(
            &self.model,
            workspace,
            At::time(time),
            &given,
            &mut [second],
        );
        first.copy_from_slice(velocities);
    }
}

impl<T: Scalar, P, F> CastSecondOrder<T> for NearlyPushed<P, F>
where
    P: ForcedDifferences<T>,
    F: LaneTorques<T>,
{
    type On<S: Scalar> =
        NearlyPushed<<P as Computes<functions::SmallDifferencesUnderTorques, T>>::On<S>, F::Of<S>>;

    const COORDINATES: Option<usize> = coordinates(P::KNOWN_LINKS, P::TRANSVERSE, P::SMALL);

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        let model = &self.model;
        NearlyPushed {
            model: Computes::<functions::SmallDifferencesUnderTorques, T>::on(model, &convert),
            differences: self.differences,
            torques: HandedOver(self.torques.0.on_scalar(&convert)),
        }
    }

    fn shape(&self) -> usize {
        self.model.shape()
    }
}
