//! Small differences with back-reaction, under external torques.

use super::{SmallDifferences, differences};
use crate::scalar::Scalar;
use crate::system::Motion;
use crate::system::function::functions;

/// [`SmallOde`](type@super::SmallOde) under external torques. These are an
/// [`Action`](crate::system::Action): a function of the time, of the coordinates (angles, then
/// differences) and of their rates, which writes one generalized torque per coordinate.
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
pub type SmallUnderTorques<P, A> = Motion<P, functions::SmallDifferencesUnderTorques, A>;

impl<P, A> SmallUnderTorques<P, A> {
    /// Creates the system of a model (or of a reference to one) under the torques that
    /// `torques(time, angles, rates, out)` writes.
    pub fn new<T: Scalar>(model: P, torques: A) -> Self
    where
        P: SmallDifferences<T>,
        A: Fn(T, &[T], &[T], &mut [T]),
    {
        Self::of(model, torques)
    }

    /// Creates the system of a model (or of a reference to one) under torques of a type that
    /// implements [`Action`](crate::system::Action), or under a vector of constant torques.
    pub fn of<T: Scalar>(model: P, torques: A) -> Self
    where
        P: SmallDifferences<T>,
    {
        let differences = differences(P::TRANSVERSE, P::SMALL);
        Self::new_of(model, 0, differences, torques)
    }

    /// Returns the torques.
    pub fn torques(&self) -> &A {
        &self.action
    }

    /// Returns the torques, so that they can be changed.
    pub fn torques_mut(&mut self) -> &mut A {
        &mut self.action
    }
}
