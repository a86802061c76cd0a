//! Pendulums of which some links are moved.

use alloc::vec::Vec;

use super::function::{At, Computes, compute_in, functions};
use super::second_order::{CastSecondOrder, HandedOver, SecondOrder, SecondOrderOde};
use super::{Forced, Workspace};
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

impl<'a, T> PrescribedMotion<'a, T> {
    /// The slices of [`AccelerationsOfHeldLinks`](functions::AccelerationsOfHeldLinks).
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

    /// The motion that slices are.
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

/// A model of which some links can be moved as the caller says: a hand holds them, a
/// motor turns them. `prescribed(LINK, …)` in the description; each such entry is a set of
/// links, which move together, and the model moves by itself all the same wherever it is
/// not asked for a set.
#[diagnostic::on_unimplemented(
    message = "no link of `{Self}` has a prescribed motion",
    note = "a model has some with `prescribed(LINK)` in its attribute"
)]
pub trait Prescribed<T: Scalar>:
    Forced<T> + Computes<functions::AccelerationsOfHeldLinks, T>
{
    /// Returns the indices of the links of a set, if there is one of that number: sets count in
    /// the order of the description.
    fn prescribed_links(&self, set: usize) -> Option<&[usize]>;

    /// Writes the angular accelerations (rad/s²) of all links where those of a set are
    /// given, and the reactions: the torques (N m) on these links that make them move so,
    /// beyond those from outside. Their power is that of the reactions times the
    /// velocities of their links. NaN where lengths do not fit or there is no such set.
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

    /// Writes the same, in memory that the caller keeps, as
    /// [`Pendulum::accelerations_with`](super::Pendulum::accelerations_with).
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
pub type PrescribedOde<P, F> = SecondOrderOde<LinksOnCourse<P, F>>;

/// A pendulum and the course of some of its links: [`PrescribedOde`].
#[derive(Clone, Debug)]
pub struct LinksOnCourse<P, F> {
    pendulum: P,
    set: usize,
    links: Vec<usize>,
    course: HandedOver<F>,
}

impl<P, F> SecondOrderOde<LinksOnCourse<P, F>> {
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
        let links = pendulum.prescribed_links(set)?.to_vec();
        Some(SecondOrderOde(LinksOnCourse {
            pendulum,
            set,
            links,
            course: HandedOver(course),
        }))
    }

    /// Returns the indices of the prescribed links.
    pub fn held_links(&self) -> &[usize] {
        &self.0.links
    }

    /// Writes the reactions (N m) on the links of the set in a state at `time`: the
    /// torques that make them move so. Allocates.
    pub fn reactions_into<T: Scalar>(&self, time: T, state: &[T], reactions: &mut [T])
    where
        P: Prescribed<T>,
        F: LinkCourses<T>,
    {
        let (Self(held), nan) = (self, T::from_f64(f64::NAN));
        let links = held.pendulum.links();
        if reactions.len() != held.links.len() || state.len() != 2 * links {
            return reactions.fill(nan);
        }
        let mut rates = alloc::vec![nan; state.len()];
        let rates = rates.split_at_mut(links).into();
        let workspace = Some(&mut Workspace::new());
        held.write(
            workspace,
            time,
            state.split_at(links).into(),
            rates,
            Some(reactions),
        );
    }
}

impl<P, F> LinksOnCourse<P, F> {
    /// Writes velocities and accelerations, and reactions for whom asks for them.
    #[inline(always)]
    fn write<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [theta, omega]: [&[T]; 2],
        [velocities, alpha]: [&mut [T]; 2],
        asked: Option<&mut [T]>,
    ) where
        P: Computes<functions::AccelerationsOfHeldLinks, T>,
        F: LinkCourses<T>,
    {
        let (links, held) = (theta.len(), self.links.len());
        let mut own = Workspace::new();
        let is_kept = workspace.is_some();
        let (room, inner) = workspace
            .unwrap_or(&mut own)
            .with_inner(3 * links + 5 * held);
        let (all, rest) = room.split_at_mut(3 * links);
        let (motion, torques) = all.split_at_mut(2 * links);
        let (courses, rest) = rest.split_at_mut(3 * held);
        let (prescribed, reactions) = rest.split_at_mut(held);
        let (angles, rates) = motion.split_at_mut(links);
        torques.fill(T::from_f64(0.0));
        angles.copy_from_slice(theta);
        rates.copy_from_slice(omega);
        let (courses, _) = courses.as_chunks_mut::<3>();
        self.course.0.courses_into(time, courses);
        for ((&link, &mut [angle, rate, alpha]), prescribed) in
            self.links.iter().zip(courses).zip(&mut *prescribed)
        {
            *prescribed = alpha;
            if let (Some(own_angle), Some(own_rate)) = (angles.get_mut(link), rates.get_mut(link)) {
                (*own_angle, *own_rate) = (angle, rate);
            }
        }
        velocities.copy_from_slice(rates);
        let at = At {
            time,
            index: self.set,
        };
        let given: [&[T]; 4] = [angles, rates, torques, prescribed];
        let results = &mut [alpha, asked.unwrap_or(reactions)];
        compute_in(
            &self.pendulum,
            is_kept.then_some(inner),
            at,
            &given,
            results,
        );
    }
}

impl<T: Scalar, P, F> SecondOrder<T> for LinksOnCourse<P, F>
where
    P: Computes<functions::AccelerationsOfHeldLinks, T>,
    F: LinkCourses<T>,
{
    fn coordinates(&self) -> usize {
        self.pendulum.links()
    }

    #[inline(always)]
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: [&[T]; 2],
        rates: [&mut [T]; 2],
    ) {
        self.write(workspace, time, state, rates, None);
    }
}

impl<T: Scalar, P, F> CastSecondOrder<T> for LinksOnCourse<P, F>
where
    P: Computes<functions::AccelerationsOfHeldLinks, T>,
    F: LaneCourses<T>,
{
    type On<S: Scalar> = LinksOnCourse<P::On<S>, F::Of<S>>;

    const COORDINATES: Option<usize> = P::KNOWN_LINKS;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        LinksOnCourse {
            pendulum: self.pendulum.on(&convert),
            set: self.set,
            links: self.links.clone(),
            course: HandedOver(self.course.0.on_scalar(&convert)),
        }
    }

    // The links of lane 0 stand for those of all.
    fn shape(&self) -> usize {
        self.pendulum.shape().wrapping_add(self.set)
    }
}
