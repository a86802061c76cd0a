//! Pendulums in which the motion of some links is prescribed.

use alloc::vec::Vec;
use core::fmt;

use super::function::{At, Computes, functions};
use super::{Action, CastAction, Motion, Pendulum, Workspace};
use crate::scalar::Scalar;

/// State of a tree with prescribed links: angles, velocities, external torques, and the
/// accelerations of the prescribed links.
#[derive(Clone, Copy, Debug)]
pub struct PrescribedMotion<'a, T> {
    /// Angles of all links, rad.
    pub theta: &'a [T],
    /// Angular velocities of all links, rad/s.
    pub omega: &'a [T],
    /// Generalized external torques on all links, N m.
    pub torques: &'a [T],
    /// Angular accelerations of the prescribed links, rad/s².
    pub prescribed: &'a [T],
}

impl<'a, T> PrescribedMotion<'a, T> {
    /// Returns the slices of [`AccelerationsOfHeldLinks`](functions::AccelerationsOfHeldLinks).
    #[inline(always)]
    fn slices(self) -> [&'a [T]; 4] {
        let Self {
            theta,
            omega,
            torques,
            prescribed,
        } = self;
        [theta, omega, torques, prescribed]
    }

    /// Creates the motion from four slices; `None` for another number of slices.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    pub fn of(slices: &[&'a [T]]) -> Option<Self> {
        let &[theta, omega, torques, prescribed] = slices else {
            return None;
        };
        Some(Self {
            theta,
            omega,
            torques,
            prescribed,
        })
    }
}

/// A model in which the motion of some links can be prescribed, as by a hand or a motor:
/// `prescribed(LINK, …)` in the description. Each such entry defines a set of links that are
/// prescribed together. Functions that take no set compute the motion without prescribed links.
#[diagnostic::on_unimplemented(
    message = "no link of `{Self}` has a prescribed motion",
    note = "a model has some with `prescribed(LINK)` in its attribute"
)]
pub trait Prescribed<T: Scalar>:
    Pendulum<T>
    + Computes<functions::AccelerationsUnderTorques, T>
    + Computes<functions::AccelerationsOfHeldLinks, T>
{
    /// Returns the indices of the links in a set of prescribed links; `None` if there is no set
    /// with that index. Sets are numbered in the order of the description.
    fn prescribed_links(&self, set: usize) -> Option<&[usize]>;

    /// Writes the angular accelerations (rad/s²) of all links and the reactions: the torques (N m)
    /// that make the links of the set follow their prescribed motion, in addition to the external
    /// torques. The power of the reactions is Σ reaction · angular velocity. NaN if a length is
    /// wrong or the set does not exist.
    #[inline]
    fn accelerations_prescribed_into(
        &self,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        alpha: &mut [T],
        reactions: &mut [T],
    ) {
        let workspace = &mut Workspace::new();
        self.accelerations_prescribed_with(workspace, set, time, motion, alpha, reactions);
    }

    /// Writes the same results, using memory that the caller keeps, as
    /// [`Pendulum::accelerations_with`](super::Pendulum::accelerations_with) does.
    #[inline]
    fn accelerations_prescribed_with(
        &self,
        workspace: &mut Workspace<T>,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        alpha: &mut [T],
        reactions: &mut [T],
    ) {
        Computes::<functions::AccelerationsOfHeldLinks, T>::compute_with(
            self,
            workspace,
            At { time, index: set },
            &motion.slices(),
            &mut [alpha, reactions],
        );
    }
}

impl<T: Scalar, P: Prescribed<T>> Prescribed<T> for &P {
    fn prescribed_links(&self, set: usize) -> Option<&[usize]> {
        (**self).prescribed_links(set)
    }
}

/// Angle (rad), angular velocity (rad/s) and angular acceleration (rad/s²) of a prescribed link.
pub type LinkCourse<T> = [T; 3];

/// A pendulum of which a set of links moves as a function of time, as a first-order system in
/// absolute angles: the state is the angles of all links followed by their angular velocities. The
/// start state should agree with the function for the prescribed links; later states then agree as
/// well. The equations take the motion of these links from the function only.
///
/// # Examples
///
/// A hand swings a limb to and fro, and the twig follows:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::PrescribedOde;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5) [
///         twig: rod(mass = 0.1, length = 0.3, friction = 1e-3)
///     ],
///     prescribed(limb),
///     emit(energies),
/// )]
/// struct Branch;
///
/// let branch = Branch::new();
/// let (width, pace) = (0.3_f64, 2.0_f64);
/// let hand = |time: f64, course: &mut [[f64; 3]]| {
///     let (sine, cosine) = (pace * time).sin_cos();
///     course[0] = [width * sine, pace * width * cosine, -pace * pace * width * sine];
/// };
/// let held = PrescribedOde::new(&branch, 0, hand).expect("it has that set");
/// let start = State::from_positions_and_velocities(0.0, &[0.0, 0.0], &[0.6, 0.0])?;
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let end = method.run(&held, &start, 3.0)?.state;
/// assert!((end.values[0] - 0.3 * 6.0_f64.sin()).abs() < 1e-9);
///
/// // The torque that the hand exerts: under it the free tree moves in the same way.
/// let mut torque = [0.0];
/// held.reactions_into(end.time, &end.values, &mut torque);
/// let (theta, omega) = (end.positions().try_into()?, end.velocities().try_into()?);
/// let [alpha, _] = branch.accelerations_under(theta, omega, &[torque[0], 0.0]);
/// assert!((alpha + pace * pace * theta[0]).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type PrescribedOde<P, C> = Motion<P, functions::AccelerationsOfHeldLinks, Courses<C>>;

/// Prescribed motion of the links of a set.
#[derive(Clone, Debug)]
pub struct Courses<C> {
    links: Vec<usize>,
    course: C,
}

impl<T, C: Action<T>> Action<T> for Courses<C> {
    #[inline]
    fn act(&self, time: T, theta: &[T], omega: &[T], values: &mut [T]) {
        self.course.act(time, theta, omega, values);
    }

    fn prescribed_links(&self) -> &[usize] {
        &self.links
    }
}

impl<T: Scalar, C: CastAction<T>> CastAction<T> for Courses<C> {
    type Of<S: Scalar> = Courses<C::Of<S>>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        Courses {
            links: self.links.clone(),
            course: self.course.cast(convert),
        }
    }
}

/// Prescribed motion as a function `|time, course| …` of the time.
#[derive(Clone, Copy)]
pub struct CourseFn<F>(F);

impl<F> fmt::Debug for CourseFn<F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_tuple("CourseFn").finish_non_exhaustive()
    }
}

impl<T, F: Fn(T, &mut [LinkCourse<T>])> Action<T> for CourseFn<F> {
    #[inline]
    fn act(&self, time: T, _: &[T], _: &[T], values: &mut [T]) {
        let (courses, _) = values.as_chunks_mut();
        (self.0)(time, courses);
    }
}

impl<P, F> PrescribedOde<P, CourseFn<F>> {
    /// Creates the system of a pendulum (or of a reference to one) in which `course(time, out)`
    /// writes the motion of the links of the set; `None` if there is no such set.
    pub fn new<T: Scalar>(pendulum: P, set: usize, course: F) -> Option<Self>
    where
        P: Prescribed<T>,
        F: Fn(T, &mut [LinkCourse<T>]),
    {
        Self::of(pendulum, set, CourseFn(course))
    }
}

impl<P, C> PrescribedOde<P, C> {
    /// Creates the system of a pendulum (or of a reference to one) with a motion of a type that
    /// implements [`Action`]; `None` if there is no such set.
    pub fn of<T: Scalar>(pendulum: P, set: usize, course: C) -> Option<Self>
    where
        P: Prescribed<T>,
        C: Action<T>,
    {
        let links = pendulum.prescribed_links(set)?.to_vec();
        Some(Self::new_of(pendulum, set, 0, Courses { links, course }))
    }

    /// Returns the indices of the prescribed links.
    pub fn prescribed_links(&self) -> &[usize] {
        &self.action.links
    }

    /// Writes the reactions (N m) on the links of the set at `time` (s): the torques that make the
    /// links follow their prescribed motion. Allocates.
    pub fn reactions_into<T: Scalar>(&self, time: T, state: &[T], reactions: &mut [T])
    where
        P: Prescribed<T>,
        C: Action<T>,
    {
        let nan = T::from_f64(f64::NAN);
        let links = self.model.links();
        if reactions.len() != self.action.links.len() || state.len() != 2 * links {
            return reactions.fill(nan);
        }
        let mut rates = alloc::vec![nan; state.len()];
        let rates = rates.split_at_mut(links).into();
        let workspace = Some(&mut Workspace::new());
        let state = state.split_at(links).into();
        self.write_prescribed(workspace, time, state, rates, Some(reactions));
    }
}
