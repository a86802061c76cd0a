//! Large trees: equations of motion in loops.
//!
//! The attribute emits the equations of one link ([`LinkEquations`]). A [`Tree`] evaluates them in
//! an upward pass (leaves to root) and a downward pass. Time and memory are proportional to the
//! number of links; code size and compile time do not depend on it.
//!
//! # Strips
//! Links that are computed together form a strip: neighbours in memory, several in a vector
//! register. In a tree by rule a generation is a strip, with one row of constants. In any other
//! tree all links of one height are a strip, with constants in columns; the height is the distance
//! to the deepest leaf below. Many states of one tree are computed in the same order, with a
//! register of states in place of each number.
//!
//! # Order of the links in a tree by rule
//! Generation by generation from the root on. Within a generation the first copies under all
//! parents come first, in the order of the parents, then the second copies: copy `c` (from 0) under
//! link `i` of a generation of `n` links has index `c · n + i` in the next one. Neighbours then
//! have neighbouring parents, and no vector has to be gathered. [`Tree::link`] finds a link by its
//! path from the root.
//!
//! # Cost
//! O(links). Beyond some thousand links the lower generations are computed block by block, each
//! block small enough for the cache; from [`THREADED`] links on, with several threads. The result
//! has the same bits for any number of threads.
//!
//! # Source
//! R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7 (articulated-body algorithm), in
//! the plane; `docs/physics.md`, section 2.

mod block;
mod bodies;
mod columns;
mod copies;
mod coupled;
mod equations;
mod evaluate;
mod generation;
mod heights;
mod interface;
mod layout;
mod memory;
mod motion;
mod output;
mod partition;
mod plan;
mod prefetch;
mod prescribed;
mod properties;
mod pullback;
mod root;
mod scales;
mod shape;
mod shared;
mod skeleton;
mod small;
mod states;
mod strips;
mod sum;
mod sweep;
mod threads;

use alloc::vec::Vec;
use core::marker::PhantomData;
use core::num::NonZeroUsize;

pub use crate::system::LinkName;
pub use bodies::{Bodies, BodyEquations, LinkSlopes, PointEquations};
pub use equations::{LinkEquations, LinkMotion, Row};
pub use properties::PropertyTable;
pub use pullback::{
    ParameterSlopes, PassiveLink, PivotDrive, PullbackTree, StateSlopes, VirtualMotion,
    VirtualPower, WeightedState,
};
pub use root::RootDrive;
pub use scales::{MOST_GENERATIONS, ScaleEquations, ScaleTree};
pub use shape::Shape;
pub use small::{LinkStates, SmallTree};

use crate::scalar::kind::{compiled, compiled_once};
use crate::scalar::{Scalar, at};
use crate::simd::{Part, Simd, outlined, wide_slice};
use crate::spring_dampers::SpringDampers;
use crate::system::pendulum::put;
use crate::system::{InRegisters, Workspace};
use crate::translational::TranslationalSpringDampers;
use copies::links;
use memory::Sizes;
use partition::Policy;
use skeleton::{ByGeneration, ByLink, Skeleton};

/// Number of links from which on a tree is computed on all cores, unless [`Tree::set_threads`] sets
/// the number of threads. For fewer links, starting threads takes longer than they save.
pub const THREADED: usize = 1 << 19;

/// A large tree: its topology and constants, with the equations `E` of its links. Emitted models
/// contain one.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree<E, T> {
    skeleton: Skeleton<T>,
    /// Springs and friction between links that are not parent and child.
    spring_dampers: SpringDampers<T>,
    /// Springs and dampers along lines between points of links, and to the ground.
    translational: TranslationalSpringDampers<T>,
    equations: PhantomData<E>,
}

impl<E: LinkEquations, T: Scalar> Tree<E, T> {
    /// True if the tree is so large that it may be computed in blocks.
    const IN_BLOCKS: bool = links(Self::COPIES) > Policy::ONE_STATE.whole;

    /// Number of values per link. Too large a tree, which would not fit into memory, is rejected at
    /// compile time.
    const SIZES: Sizes = Sizes::of::<E, T>().of_links(links(Self::COPIES));

    /// Creates a tree that is described by generations. `rows` holds one row of constants per
    /// generation; `root` is the acceleration of the root's pivot relative to free fall, in the
    /// units of the equations.
    #[must_use]
    pub fn new(rows: Vec<T>, root: [T; 2]) -> Self {
        let skeleton = compiled::<ByGeneration, T>();
        let threads = match Self::IN_BLOCKS {
            true => threads::default(links(Self::COPIES)),
            false => 1,
        };
        Self::of_skeleton(skeleton(Self::COPIES, Self::SIZES, rows, root, threads))
    }

    /// Creates a tree of any shape, from the parent of each link and a row of constants for each
    /// link. A parent comes before its children; the root's parent is 0.
    ///
    /// # Panics
    /// If the tree has more links than fit into memory.
    #[must_use]
    pub fn with_parents(parents: &[u32], rows: &[T], root: [T; 2]) -> Self {
        let skeleton = compiled::<ByLink, T>();
        let sizes = Self::SIZES.of_links(parents.len());
        Self::of_skeleton(skeleton(parents, sizes, rows, root))
    }

    /// Creates a tree without springs and friction between its links from its topology and
    /// constants.
    fn of_skeleton(skeleton: Skeleton<T>) -> Self {
        let links = skeleton.plan.links();
        Self {
            skeleton,
            spring_dampers: SpringDampers::of_runs(links, None).unwrap_or_default(),
            translational: TranslationalSpringDampers::of_runs(links, None).unwrap_or_default(),
            equations: PhantomData,
        }
    }

    /// Sets the number of threads, which is used if the tree is large enough to be computed in
    /// blocks. Results do not depend on it.
    pub fn set_threads(&mut self, threads: NonZeroUsize) {
        self.skeleton.set_threads(threads.get());
    }

    /// Writes the angular accelerations, as
    /// [`Pendulum::accelerations_with`](crate::Pendulum::accelerations_with); for a driven tree at
    /// one time of its drive.
    pub fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let given = LinkStates {
            theta,
            omega,
            torques: None,
        };
        self.accelerate(workspace, drive, given, alpha);
    }

    /// Writes the angular accelerations under external torques, as
    /// [`Pendulum::accelerations_under_with`](crate::Pendulum::accelerations_under_with). NaN for
    /// equations without external torques ([`LinkEquations::FORCED`]).
    pub fn accelerations_under_with(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        [theta, omega, torques]: [&[T]; 3],
        alpha: &mut [T],
    ) {
        let given = LinkStates {
            theta,
            omega,
            torques: Some(torques),
        };
        self.accelerate(workspace, drive, given, alpha);
    }

    /// Writes the accelerations without external torques, with a workspace that is allocated for
    /// each call.
    pub fn accelerations_into(
        &self,
        drive: Option<RootDrive<T>>,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.accelerations_with(&mut Workspace::new(), drive, theta, omega, alpha);
    }

    /// Returns the same tree with a root that is not accelerated and with zeros in some `columns` of
    /// constants; if these hold the torques of joints and of drag, the tree without gravity, springs
    /// and friction. It has no springs and dampers between its links.
    pub(super) fn inertia_alone(&self, columns: &[usize]) -> Self {
        Self::of_skeleton(self.skeleton.at_rest_without(columns))
    }

    /// Returns the same tree with constants of another scalar type and the same number of threads.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Tree<E, S> {
        Tree {
            skeleton: self.skeleton.cast(&convert),
            spring_dampers: self.spring_dampers.cast(&convert),
            translational: self.translational.cast(convert),
            equations: PhantomData,
        }
    }

    /// Passes the acceleration of each link to `alpha`, computed in the arithmetic of `T`, as
    /// [`Pendulum::evaluate`](crate::Pendulum::evaluate) does. Allocates.
    #[inline(always)]
    pub fn evaluate(
        &self,
        drive: Option<RootDrive<T>>,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let mut buffer = alloc::vec![T::from_f64(0.0); self.workspace_len()];
        let none = |_| [T::from_f64(0.0); 2];
        self.accelerate_states::<T>(drive, &mut buffer, theta, omega, none, alpha);
    }

    /// Writes the accelerations under external torques, computed in the arithmetic of `T`. NaN if a
    /// slice does not have one number per link, and for equations without external torques.
    #[inline(always)]
    pub fn evaluate_under(
        &self,
        drive: Option<RootDrive<T>>,
        [theta, omega, torques]: [&[T]; 3],
        alpha: &mut [T],
    ) {
        let given = LinkStates {
            theta,
            omega,
            torques: Some(torques),
        };
        self.evaluate_given(&mut Workspace::new(), drive, given, alpha);
    }

    /// Writes the accelerations with or without external torques. This is a separate function that
    /// all callers share, because it is long; it is compiled for the vector instructions of the
    /// numbers.
    pub fn evaluate_apart(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        outlined::<0, T, _, _>(self, (workspace, drive, given, alpha));
    }

    #[inline(always)]
    fn evaluate_given(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        let LinkStates {
            theta,
            omega,
            torques,
        } = given;
        let links = self.skeleton.plan.links();
        let fit = torques.is_none_or(|torques| E::FORCED && torques.len() == links);
        if !fit || [theta.len(), omega.len(), alpha.len()] != [links; 3] {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        let buffer = workspace.numbers(self.workspace_len());
        let zero = T::from_f64(0.0);
        let torque = |link| torques.map_or(zero, |torques| at(torques, link));
        self.accelerate_states::<T>(
            drive,
            buffer,
            |link| at(theta, link),
            |link| at(omega, link),
            |link| [torque(link), zero],
            |link, value| put(alpha, link, value),
        );
    }

    /// Returns the workspace length that a batch needs for one register of states.
    #[doc(hidden)]
    #[must_use]
    pub fn workspace_len(&self) -> usize {
        let torques = match E::COUPLED {
            true => self.skeleton.plan.links(),
            false => 0,
        };
        states::workspace_len(&self.skeleton) + torques
    }

    /// Returns the evaluator of many states in registers, which uses `room` as workspace.
    #[doc(hidden)]
    #[inline(always)]
    pub fn in_registers<V: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        buffer: &mut [T],
    ) -> impl InRegisters<V> {
        WithWorkspace {
            tree: self,
            drive: drive.map(|drive| drive.map(V::splat)),
            buffer: match wide_slice::<T, V>(buffer) {
                Some(values) => LentOrOwn::Lent(values),
                None => LentOrOwn::Own(alloc::vec![V::from_f64(0.0); self.workspace_len()]),
            },
        }
    }
}

/// Arguments of [`Tree::evaluate_apart`] and [`SmallTree::evaluate_apart`].
type ApartArguments<'a, T> = (
    &'a mut Workspace<T>,
    Option<RootDrive<T>>,
    LinkStates<'a, T>,
    &'a mut [T],
);

impl<E: LinkEquations, T: Scalar> Part<0, ApartArguments<'_, T>> for Tree<E, T> {
    type Output = ();

    #[inline(always)]
    fn part(&self, (workspace, drive, given, alpha): ApartArguments<'_, T>) {
        self.evaluate_given(workspace, drive, given, alpha);
    }
}

/// A tree at one time of its drive, with the workspace for several states in registers.
struct WithWorkspace<'t, 'r, E, T, V> {
    tree: &'t Tree<E, T>,
    drive: Option<RootDrive<V>>,
    buffer: LentOrOwn<'r, V>,
}

/// Workspace, either the caller's or allocated.
enum LentOrOwn<'r, V> {
    Lent(&'r mut [V]),
    Own(Vec<V>),
}

impl<E: LinkEquations, T: Scalar, V: Simd<T>> InRegisters<V> for WithWorkspace<'_, '_, E, T, V> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        alpha: impl FnMut(usize, V),
    ) {
        let buffer = match &mut self.buffer {
            LentOrOwn::Lent(values) => &mut **values,
            LentOrOwn::Own(values) => values,
        };
        let none = |_| [V::from_f64(0.0); 2];
        self.tree
            .accelerate_states(self.drive, buffer, theta, omega, none, alpha);
    }
}

/// Converts exact numbers to a model's scalar. Each exact number is given as two `f64`: the nearest
/// one, and the one nearest to the remainder.
#[must_use]
pub fn numbers<T: Scalar>(exact: &[[f64; 2]]) -> Vec<T> {
    compiled::<Numbers, T>()(exact)
}

fn rounded<T: Scalar>(exact: &[[f64; 2]]) -> Vec<T> {
    let number = |&[high, low]: &[f64; 2]| T::from_parts(high, low);
    exact.iter().map(number).collect()
}

compiled_once! {
    /// Function pointer to [`rounded`].
    Numbers<T> = rounded: fn(&[[f64; 2]]) -> Vec<T>
}

#[cfg(test)]
mod tests;
