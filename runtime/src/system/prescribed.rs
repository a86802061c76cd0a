//! Pendulums of which some links are moved.

use alloc::vec::Vec;
use core::fmt;

use super::by_reference::by_reference;
use super::model::twice;
use super::ode::halves;
use super::{Forced, LaneOde, Model, Ode, Workspace};
use crate::scalar::Scalar;

/// A state, and what acts on it from outside.
#[derive(Clone, Copy, Debug)]
pub struct PrescribedMotion<'a, T> {
    /// Angles of all links, rad.
    pub theta: &'a [T],
    /// Angular velocities of all links, rad/s.
    pub omega: &'a [T],
    /// Generalized torques from outside on all links, N m.
    pub torques: &'a [T],
    /// Angular accelerations of the prescribed links, rad/s².
    pub prescribed: &'a [T],
}

/// A model of which some links can be moved as the caller says: a hand holds them, a
/// motor turns them. `prescribed(LINK, …)` in the description; each such entry is a set of
/// links, which move together, and the model moves by itself all the same wherever it is
/// not asked for a set.
#[diagnostic::on_unimplemented(
    message = "no link of `{Self}` has a prescribed motion",
    note = "a model has some with `prescribed(LINK)` in its attribute"
)]
pub trait Prescribed<T: Scalar>: Forced<T> {
    /// Returns the indices of the links of a set, if there is one of that number: sets count in
    /// the order of the description.
    fn prescribed_links(&self, set: usize) -> Option<&[usize]>;

    /// Writes the angular accelerations (rad/s²) of all links where those of a set are
    /// given, and the reactions: the torques (N m) on these links that make them move so,
    /// beyond those from outside. Their power is that of the reactions times the
    /// velocities of their links. NaN where lengths do not fit or there is no such set.
    fn accelerations_prescribed_into(
        &self,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        alpha: &mut [T],
        reactions: &mut [T],
    );

    /// Writes the same, in memory that the caller keeps, as
    /// [`Pendulum::accelerations_with`](super::Pendulum::accelerations_with). Integrators
    /// call this one.
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
        let _ = workspace;
        self.accelerations_prescribed_into(set, time, motion, alpha, reactions);
    }

    /// Writes the same of this pendulum on other scalars, in their arithmetic: of as many
    /// states at a time as a vector register holds.
    ///
    /// Write `#[inline(always)]`: the caller chooses the instructions that this is
    /// compiled for.
    fn accelerations_prescribed_of<S: Scalar>(
        pendulum: &Self::Of<S>,
        set: usize,
        time: S,
        motion: PrescribedMotion<'_, S>,
        alpha: &mut [S],
        reactions: &mut [S],
    );
}

by_reference! {
    impl<T: Scalar> Prescribed<T> for &P {
        for fn accelerations_prescribed_of<S: Scalar>(
            pendulum: &Self::Of<S>, set: usize, time: S, motion: PrescribedMotion<'_, S>,
            alpha: &mut [S], reactions: &mut [S]
        );
        fn accelerations_prescribed_with(
            &self, workspace: &mut Workspace<T>, set: usize, time: T,
            motion: PrescribedMotion<'_, T>, alpha: &mut [T], reactions: &mut [T]
        );
        fn accelerations_prescribed_into(
            &self, set: usize, time: T, motion: PrescribedMotion<'_, T>, alpha: &mut [T],
            reactions: &mut [T]
        );
        fn prescribed_links(&self, set: usize) -> Option<&[usize]>;
    }
}

/// Angle, angular velocity and angular acceleration of a link.
pub type LinkCourse<T> = [T; 3];

/// Prescribed motion of links as a function of time. Functions `|time, course| …` are some.
pub trait LinkCourses<T> {
    /// Writes the motion of each link of a set at `time` (s).
    fn courses_into(&self, time: T, course: &mut [LinkCourse<T>]);
}

impl<T, F: Fn(T, &mut [LinkCourse<T>])> LinkCourses<T> for F {
    #[inline]
    fn courses_into(&self, time: T, course: &mut [LinkCourse<T>]) {
        self(time, course);
    }
}

/// A course whose constants can be taken to any scalar, for ensembles in lanes, as
/// [`LaneTorques`](super::LaneTorques).
pub trait LaneCourses<T: Scalar>: LinkCourses<T> {
    /// This course on other scalars.
    type Of<S: Scalar>: LinkCourses<S>;

    /// Takes every constant through `convert`, as
    /// [`Model::cast`](super::Model::cast).
    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;
}

/// A pendulum of which a set of links moves as a function of time, as a first-order
/// system in absolute angles: the state is the angles of all links followed by their
/// angular velocities. Of the prescribed links it is to start as the function says, and
/// stays so; the equations take their motion from the function alone.
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
/// let end = method.integrate(&held, &start, 3.0, |_| ControlFlow::Continue(()))?.state;
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
#[derive(Clone)]
pub struct PrescribedOde<P, F> {
    pendulum: P,
    index: usize,
    held: Vec<usize>,
    course: F,
}

impl<P, F> PrescribedOde<P, F> {
    /// The pendulum, or a reference to one, of which the links of that set move as
    /// `course(time, out)` writes; `None` without such a set.
    pub fn new<T: Scalar>(pendulum: P, set: usize, course: F) -> Option<Self>
    where
        P: Prescribed<T>,
        F: Fn(T, &mut [LinkCourse<T>]),
    {
        Self::of(pendulum, set, course)
    }

    /// The pendulum with motions of a type of their own, as those of each lane; `None`
    /// without such a set.
    pub fn of<T: Scalar>(pendulum: P, set: usize, course: F) -> Option<Self>
    where
        P: Prescribed<T>,
        F: LinkCourses<T>,
    {
        let held = pendulum.prescribed_links(set)?.to_vec();
        Some(Self {
            pendulum,
            index: set,
            held,
            course,
        })
    }

    /// Returns the indices of the prescribed links.
    pub fn held_links(&self) -> &[usize] {
        &self.held
    }

    /// Writes the reactions (N m) on the links of the set in a state at `time`: the
    /// torques that make them move so. Allocates.
    pub fn reactions_into<T: Scalar>(&self, time: T, state: &[T], reactions: &mut [T])
    where
        P: Prescribed<T>,
        F: LinkCourses<T>,
    {
        let nan = T::from_f64(f64::NAN);
        if reactions.len() != self.held.len() {
            return reactions.fill(nan);
        }
        let mut rates = alloc::vec![nan; state.len()];
        let mut workspace = Workspace::new();
        let (room, workspace) =
            workspace.with_inner(course_room(self.pendulum.links(), self.held.len()));
        let held = (&*self.held, &self.course);
        let moved = on_course(self.pendulum.links(), held, time, state, &mut rates, room);
        let Some((motion, [alpha, _])) = moved else {
            return reactions.fill(nan);
        };
        self.pendulum
            .accelerations_prescribed_with(workspace, self.index, time, motion, alpha, reactions);
    }
}

/// Returns how many numbers [`on_course`] takes room for.
pub fn course_room(links: usize, held: usize) -> usize {
    3 * links + 5 * held
}

/// The motion of a state of so many links, of which some are on a course, and the places of
/// the accelerations and of the reactions; the rates of the angles are written. None where
/// lengths do not fit.
#[inline(always)]
pub fn on_course<'r, T: Scalar>(
    links: usize,
    (held, course): (&[usize], &impl LinkCourses<T>),
    time: T,
    state: &[T],
    rates: &'r mut [T],
    room: &'r mut [T],
) -> Option<(PrescribedMotion<'r, T>, [&'r mut [T]; 2])> {
    let (_, [velocities, alpha]) = halves(links, state, rates)?;
    let (all, own) = room.split_at_mut(3 * links);
    let (motion, torques) = all.split_at_mut(2 * links);
    let (courses, others) = own.split_at_mut(3 * held.len());
    let (prescribed, reactions) = others.split_at_mut(held.len());
    torques.fill(T::from_f64(0.0));
    motion.copy_from_slice(state);
    let (theta, omega) = motion.split_at_mut(links);
    let (courses, _) = courses.as_chunks_mut::<3>();
    course.courses_into(time, courses);
    for ((&link, &mut [angle, rate, alpha]), prescribed) in
        held.iter().zip(courses).zip(&mut *prescribed)
    {
        *prescribed = alpha;
        if let (Some(theta), Some(omega)) = (theta.get_mut(link), omega.get_mut(link)) {
            (*theta, *omega) = (angle, rate);
        }
    }
    velocities.copy_from_slice(omega);
    let motion = PrescribedMotion {
        theta,
        omega,
        torques,
        prescribed,
    };
    Some((motion, [alpha, reactions]))
}

impl<P: fmt::Debug, F> fmt::Debug for PrescribedOde<P, F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            pendulum,
            index: _,
            held,
            course: _,
        } = self;
        formatter
            .debug_struct("PrescribedOde")
            .field("pendulum", pendulum)
            .field("held", held)
            .finish_non_exhaustive()
    }
}

impl<T: Scalar, P: Prescribed<T>, F: LinkCourses<T>> Ode<T> for PrescribedOde<P, F> {
    fn dimension(&self) -> usize {
        2 * self.pendulum.links()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let (room, workspace) =
            workspace.with_inner(course_room(self.pendulum.links(), self.held.len()));
        let held = (&*self.held, &self.course);
        let moved = on_course(self.pendulum.links(), held, time, state, rates, room);
        if let Some((motion, [alpha, reactions])) = moved {
            self.pendulum.accelerations_prescribed_with(
                workspace, self.index, time, motion, alpha, reactions,
            );
        }
    }
}

impl<T: Scalar, P: Prescribed<T>, F: LaneCourses<T>> LaneOde<T> for PrescribedOde<P, F> {
    type Of<S: Scalar> = PrescribedOde<P::Of<S>, F::Of<S>>;

    const DIMENSION: Option<usize> = twice(P::KNOWN_LINKS);

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        PrescribedOde {
            pendulum: self.pendulum.cast(&convert),
            index: self.index,
            held: self.held.clone(),
            course: self.course.on_scalar(&convert),
        }
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        let PrescribedOde {
            pendulum,
            index,
            held,
            course,
        } = system;
        let links = pendulum.links();
        let mut room = alloc::vec![S::from_f64(0.0); course_room(links, held.len())];
        let held = (held.as_slice(), course);
        let moved = on_course(links, held, time, state, rates, &mut room);
        if let Some((motion, [alpha, reactions])) = moved {
            P::accelerations_prescribed_of(pendulum, *index, time, motion, alpha, reactions);
        }
    }

    fn shape(&self) -> usize {
        self.pendulum.shape()
    }
}
