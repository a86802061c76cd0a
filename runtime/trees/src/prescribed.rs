//! Links whose motion is given from outside.

use std::sync::Arc;

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{
    LaneCourses, LaneOde, LinkCourse, LinkCourses, Ode, PrescribedMotion, Workspace, course_room,
    on_course,
};
use branched_pendulum::tree::Tree;
use branched_pendulum_codegen::scene::Scene;

use crate::equations::HeldEquations;
use crate::tree::PendulumTree;

/// The equations of a tree some of whose links may be held, and which ones.
#[derive(Clone, Debug)]
pub(crate) struct HeldLinks<T> {
    sets: Arc<[Vec<usize>]>,
    tree: Tree<HeldEquations, T>,
}

impl<T: Scalar> HeldLinks<T> {
    /// None without sets of links.
    pub(crate) fn of(
        scene: &Scene,
        parents: &[u32],
        gravity: T,
        rows: impl FnOnce() -> Vec<T>,
    ) -> Option<Self> {
        let sets = scene.prescribed.iter();
        let sets = sets.map(|set| set.links.iter().map(|link| link.0).collect());
        (!scene.prescribed.is_empty()).then(|| Self {
            sets: sets.collect(),
            tree: Tree::with_parents(parents, &rows(), [T::from_f64(0.0), gravity]),
        })
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> HeldLinks<S> {
        HeldLinks {
            sets: Arc::clone(&self.sets),
            tree: self.tree.cast(convert),
        }
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Returns the sets of links whose motion can be given, as indices of these: one set for
    /// each `prescribed(…)` of the description.
    pub fn prescribed_sets(&self) -> &[Vec<usize>] {
        self.held.as_ref().map_or(&[], |held| &held.sets)
    }

    /// Writes the angular accelerations (rad/s²) of all links where those of a set of links
    /// are given, and the reactions (N m): the torques on these links that make them move
    /// so, beyond those from outside. NaN where lengths do not fit or there is no such set.
    /// O(links).
    ///
    /// # Examples
    ///
    /// A hand turns the limb, and the twig follows:
    ///
    /// ```
    /// use branched_pendulum::system::{PrescribedMotion, Workspace};
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let branch = PendulumTree::parse(
    ///     "gravity = 9.81,
    ///      limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3)],
    ///      prescribed(limb)",
    /// )?;
    /// assert_eq!(branch.prescribed_sets(), [[0]]);
    /// let motion = PrescribedMotion {
    ///     theta: &[0.0, 0.0],
    ///     omega: &[0.0, 0.0],
    ///     torques: &[0.0, 0.0],
    ///     prescribed: &[2.0],
    /// };
    /// let (mut alpha, mut reaction) = ([0.0; 2], [0.0]);
    /// let results = [&mut alpha[..], &mut reaction];
    /// branch.accelerations_prescribed_with(&mut Workspace::new(), 0, 0.0, motion, results);
    /// assert!((alpha[1] + 2.0 * 0.5 * 1.5 / 0.3).abs() < 1e-14);
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    pub fn accelerations_prescribed_with(
        &self,
        workspace: &mut Workspace<T>,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        results: [&mut [T]; 2],
    ) {
        let acting = self.acting(time, Some(motion.torques));
        let (drive, mut sum) = (acting.drive, [T::from_f64(0.0)]);
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        match &self.held {
            Some(HeldLinks { tree, sets }) => {
                let links = sets.get(set).map(Vec::as_slice);
                tree.accelerations_prescribed_with(workspace, drive, links, motion, results);
            }
            None => results
                .into_iter()
                .for_each(|result| result.fill(T::from_f64(f64::NAN))),
        }
    }

    /// Does so in the arithmetic of `T`, compiled for the instructions that the caller
    /// chooses.
    #[inline(always)]
    fn evaluate_prescribed(
        &self,
        set: usize,
        time: T,
        motion: PrescribedMotion<'_, T>,
        results: [&mut [T]; 2],
    ) {
        let acting = self.acting(time, Some(motion.torques));
        let (drive, mut sum) = (acting.drive, [T::from_f64(0.0)]);
        let torques = acting.on_links(motion.torques.len(), &mut sum);
        let torques = torques.unwrap_or_default();
        let motion = PrescribedMotion { torques, ..motion };
        if let Some(HeldLinks { tree, sets }) = &self.held {
            let links = sets.get(set).map(Vec::as_slice);
            tree.evaluate_prescribed(drive, links, motion, results);
        }
    }
}

/// A tree of which a set of links moves as a function of time, as a system of first-order
/// equations, as [`PrescribedOde`](branched_pendulum::system::PrescribedOde) is for compiled
/// models. Of the prescribed links the state is to start as the function says, and stays so.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::{PendulumTree, PrescribedTree};
///
/// let branch = PendulumTree::parse(
///     "gravity = 9.81,
///      limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3)],
///      prescribed(limb)",
/// )?;
/// let hand = |time: f64, course: &mut [[f64; 3]]| {
///     let (sine, cosine) = (2.0 * time).sin_cos();
///     course[0] = [0.3 * sine, 0.6 * cosine, -1.2 * sine];
/// };
/// let held = PrescribedTree::new(branch, 0, hand).expect("it has that set");
/// let start = State::from_positions_and_velocities(0.0, &[0.0, 0.0], &[0.6, 0.0])?;
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let end = method.integrate(&held, &start, 3.0, |_| ControlFlow::Continue(()))?.state;
/// assert!((end.values[0] - 0.3 * 6.0_f64.sin()).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PrescribedTree<T, F> {
    tree: PendulumTree<T>,
    set: usize,
    course: F,
}

impl<T: Scalar, F: LinkCourses<T>> PrescribedTree<T, F> {
    /// Returns the tree whose links of that set move as `course(time, out)` writes: angle
    /// (rad), angular velocity (rad/s) and angular acceleration (rad/s²) of each. `None`
    /// without such a set.
    pub fn new(tree: PendulumTree<T>, set: usize, course: F) -> Option<Self>
    where
        F: Fn(T, &mut [LinkCourse<T>]),
    {
        Self::of(tree, set, course)
    }

    /// Returns it with motions of a type of their own, as those of each lane.
    pub fn of(tree: PendulumTree<T>, set: usize, course: F) -> Option<Self> {
        tree.prescribed_sets().get(set)?;
        Some(Self { tree, set, course })
    }

    /// Returns the tree.
    pub fn tree(&self) -> &PendulumTree<T> {
        &self.tree
    }

    /// Writes the reactions (N m) on the links of the set in a state at `time` (s): the
    /// torques that make them move so. NaN where lengths do not fit. Allocates.
    pub fn reactions_into(&self, time: T, state: &[T], reactions: &mut [T]) {
        let nan = T::from_f64(f64::NAN);
        let mut rates = vec![nan; state.len()];
        let links = self.held_links();
        let mut room = self.room();
        let held = (links, &self.course);
        let count = self.tree.links();
        let moved = on_course(count, held, time, state, &mut rates, &mut room);
        let Some((motion, [alpha, _])) = moved else {
            return reactions.fill(nan);
        };
        let (workspace, results) = (&mut Workspace::new(), [alpha, reactions]);
        let tree = &self.tree;
        tree.accelerations_prescribed_with(workspace, self.set, time, motion, results);
    }

    fn held_links(&self) -> &[usize] {
        self.tree
            .prescribed_sets()
            .get(self.set)
            .map_or(&[], Vec::as_slice)
    }

    fn room(&self) -> Vec<T> {
        vec![T::from_f64(0.0); course_room(self.tree.links(), self.held_links().len())]
    }
}

impl<T: Scalar, F: LinkCourses<T>> Ode<T> for PrescribedTree<T, F> {
    fn dimension(&self) -> usize {
        2 * self.tree.links()
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let (links, held) = (self.tree.links(), self.held_links());
        let (room, workspace) = workspace.with_inner(course_room(links, held.len()));
        let held = (held, &self.course);
        let moved = on_course(links, held, time, state, rates, room);
        if let Some((motion, results)) = moved {
            let tree = &self.tree;
            tree.accelerations_prescribed_with(workspace, self.set, time, motion, results);
        }
    }
}

impl<T: Scalar, F: LaneCourses<T>> LaneOde<T> for PrescribedTree<T, F> {
    type Of<S: Scalar> = PrescribedTree<S, F::Of<S>>;

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        PrescribedTree {
            tree: self.tree.cast(&convert),
            set: self.set,
            course: self.course.on_scalar(&convert),
        }
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        let PrescribedTree { tree, set, course } = system;
        let held = system.held_links();
        let (links, mut room) = (tree.links(), system.room());
        let held = (held, course);
        let moved = on_course(links, held, time, state, rates, &mut room);
        if let Some((motion, results)) = moved {
            tree.evaluate_prescribed(*set, time, motion, results);
        }
    }

    fn shape(&self) -> usize {
        self.tree.described.shape
    }
}
