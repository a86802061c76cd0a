//! Large trees: equations of motion in loops.
//!
//! The attribute writes the equations of one link ([`LinkEquations`]); a [`Tree`]
//! takes them from the leaves to the root and back. Time and memory are proportional
//! to the number of links; code and the time to compile it do not depend on it.
//!
//! # Strips
//! Links that are computed together are a strip: neighbours in memory, several in a
//! vector register. In a tree by rule a generation is a strip, with one row of
//! constants; in any other tree all links of one height are one, height being the
//! distance to the deepest leaf below, with constants in columns. Many states of one
//! tree go the same way, with a register of states in place of each number.
//!
//! # Order of the links in a tree by rule
//! Generation by generation from the root on. Within a generation the first
//! copies under all parents come first, in the order of the parents, then the
//! second copies: copy `c` (from 0) under link `i` of a generation of `n` links
//! has number `c · n + i` in the next one. Neighbours then have neighbouring
//! parents, and no vector has to be gathered. [`Tree::link`] finds a link by its path
//! from the root.
//!
//! # Cost
//! O(links). Beyond some thousand links the lower generations are computed block by
//! block, each one small enough for the cache; from [`THREADED`] links on, on several
//! threads. The result has the same bits for any number of threads.
//!
//! # Source
//! R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7
//! (articulated-body algorithm), in the plane; `docs/physics.md`, section 2.

mod block;
mod bodies;
mod columns;
mod copies;
mod coupled;
mod equations;
mod evaluate;
mod generation;
mod heights;
mod held;
mod interface;
mod layout;
mod memory;
mod motion;
mod output;
mod partition;
mod plan;
mod prefetch;
mod properties;
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
pub use bodies::{Bodies, BodyEquations, PointEquations};
pub use equations::{LinkEquations, LinkMotion, Row};
pub use properties::PropertyTable;
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

/// Trees of at least so many links are computed on all cores, unless
/// [`Tree::set_threads`] says otherwise: below, threads cost more than they save.
pub const THREADED: usize = 1 << 17;

/// A large tree: its shape and constants, and the equations `E` of its links. Emitted
/// models hold one.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree<E, T> {
    skeleton: Skeleton<T>,
    /// What acts on the difference of two links' angles, of links that are not parent and child.
    spring_dampers: SpringDampers<T>,
    /// What acts along lines between points of links, and to the ground.
    translational: TranslationalSpringDampers<T>,
    equations: PhantomData<E>,
}

impl<E: LinkEquations, T: Scalar> Tree<E, T> {
    /// The tree is so large that it may be computed in blocks.
    const IN_BLOCKS: bool = links(Self::COPIES) > Policy::ONE_STATE.whole;

    /// Numbers of a link. Equations of a tree by generations that is too large for memory are
    /// not compiled.
    const SIZES: Sizes = Sizes::of::<E, T>().of_links(links(Self::COPIES));

    /// A tree by generations, with a row of constants for each, one after the other,
    /// and the acceleration of the root's pivot against gravity, in the unit of the
    /// equations.
    #[must_use]
    pub fn new(rows: Vec<T>, root: [T; 2]) -> Self {
        let skeleton = compiled::<ByGeneration, T>();
        let threads = match Self::IN_BLOCKS {
            true => threads::default(links(Self::COPIES)),
            false => 1,
        };
        Self::of_skeleton(skeleton(Self::COPIES, Self::SIZES, rows, root, threads))
    }

    /// A tree of any shape, with the parent of each link, which stands before it (the
    /// root's own is 0), and a row of constants for each.
    ///
    /// # Panics
    /// Of more links than memory has room for, as a vector of so many numbers does.
    #[must_use]
    pub fn with_parents(parents: &[u32], rows: &[T], root: [T; 2]) -> Self {
        let skeleton = compiled::<ByLink, T>();
        let sizes = Self::SIZES.of_links(parents.len());
        Self::of_skeleton(skeleton(parents, sizes, rows, root))
    }

    /// A tree between whose links nothing acts.
    fn of_skeleton(skeleton: Skeleton<T>) -> Self {
        let links = skeleton.plan.links();
        Self {
            skeleton,
            spring_dampers: SpringDampers::of_runs(links, None).unwrap_or_default(),
            translational: TranslationalSpringDampers::of_runs(links, None).unwrap_or_default(),
            equations: PhantomData,
        }
    }

    /// Computes on so many threads, where the tree is large enough to be taken
    /// apart. Results do not depend on it.
    pub fn set_threads(&mut self, threads: NonZeroUsize) {
        self.skeleton.set_threads(threads.get());
    }

    /// Writes the angular accelerations, as
    /// [`Pendulum::accelerations_with`](crate::Pendulum::accelerations_with), of a
    /// driven tree at a time of its drive.
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

    /// Writes the angular accelerations under torques from outside, as
    /// [`Forced::accelerations_under_with`](crate::Forced::accelerations_under_with):
    /// NaN for equations that read none
    /// ([`LinkEquations::FORCED`]).
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

    /// Writes the accelerations without torques from outside, in memory that is
    /// allocated for this once.
    pub fn accelerations_into(
        &self,
        drive: Option<RootDrive<T>>,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.accelerations_with(&mut Workspace::new(), drive, theta, omega, alpha);
    }

    /// Returns the same tree on other scalars; computed on as many threads.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Tree<E, S> {
        Tree {
            skeleton: self.skeleton.cast(&convert),
            spring_dampers: self.spring_dampers.cast(&convert),
            translational: self.translational.cast(convert),
            equations: PhantomData,
        }
    }

    /// Tells the accelerations in the arithmetic of `T`, as
    /// [`Pendulum::evaluate`](crate::Pendulum::evaluate). Allocates.
    #[inline(always)]
    pub fn evaluate(
        &self,
        drive: Option<RootDrive<T>>,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let mut room = alloc::vec![T::from_f64(0.0); self.room()];
        let none = |_| [T::from_f64(0.0); 2];
        self.accelerate_states::<T>(drive, &mut room, theta, omega, none, alpha);
    }

    /// Writes the accelerations under torques from outside, likewise; NaN where lengths
    /// do not fit, and for equations that read none.
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
        self.evaluate_given(drive, given, alpha);
    }

    /// Writes the accelerations likewise, under torques or none, in a function of its own that all
    /// callers share: it is long. The function is compiled for the instructions of the numbers.
    pub fn evaluate_apart(
        &self,
        drive: Option<RootDrive<T>>,
        given: LinkStates<'_, T>,
        alpha: &mut [T],
    ) {
        outlined::<0, T, _, _>(self, (drive, given, alpha));
    }

    #[inline(always)]
    fn evaluate_given(
        &self,
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
        let mut room = alloc::vec![T::from_f64(0.0); self.room()];
        let zero = T::from_f64(0.0);
        let torque = |link| torques.map_or(zero, |torques| at(torques, link));
        self.accelerate_states::<T>(
            drive,
            &mut room,
            |link| at(theta, link),
            |link| at(omega, link),
            |link| [torque(link), zero],
            |link, value| put(alpha, link, value),
        );
    }

    /// Returns how many values a register of states takes in a batch.
    #[doc(hidden)]
    #[must_use]
    pub fn room(&self) -> usize {
        let torques = match E::COUPLED {
            true => self.skeleton.plan.links(),
            false => 0,
        };
        states::room(&self.skeleton) + torques
    }

    /// Returns many states in registers, with so much room for each.
    #[doc(hidden)]
    #[inline(always)]
    pub fn in_registers<V: Simd<T>>(
        &self,
        drive: Option<RootDrive<T>>,
        room: &mut [T],
    ) -> impl InRegisters<V> {
        WithRoom {
            tree: self,
            drive: drive.map(|drive| drive.map(V::splat)),
            room: match wide_slice::<T, V>(room) {
                Some(values) => LentOrOwn::Lent(values),
                None => LentOrOwn::Own(alloc::vec![V::from_f64(0.0); self.room()]),
            },
        }
    }
}

/// Arguments of [`Tree::evaluate_apart`].
type ApartArguments<'a, T> = (Option<RootDrive<T>>, LinkStates<'a, T>, &'a mut [T]);

impl<E: LinkEquations, T: Scalar> Part<0, ApartArguments<'_, T>> for Tree<E, T> {
    type Output = ();

    #[inline(always)]
    fn part(&self, (drive, given, alpha): ApartArguments<'_, T>) {
        self.evaluate_given(drive, given, alpha);
    }
}

/// A tree at one time of its drive, and room for the values of states.
struct WithRoom<'t, 'r, E, T, V> {
    tree: &'t Tree<E, T>,
    drive: Option<RootDrive<V>>,
    room: LentOrOwn<'r, V>,
}

/// Memory for values.
enum LentOrOwn<'r, V> {
    Lent(&'r mut [V]),
    Own(Vec<V>),
}

impl<E: LinkEquations, T: Scalar, V: Simd<T>> InRegisters<V> for WithRoom<'_, '_, E, T, V> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> V,
        omega: impl Fn(usize) -> V,
        alpha: impl FnMut(usize, V),
    ) {
        let room = match &mut self.room {
            LentOrOwn::Lent(values) => &mut **values,
            LentOrOwn::Own(values) => values,
        };
        let none = |_| [V::from_f64(0.0); 2];
        self.tree
            .accelerate_states(self.drive, room, theta, omega, none, alpha);
    }
}

/// Returns numbers in a model's scalar. Each is given as the `f64` nearest to it and
/// the `f64` nearest to the rest.
#[must_use]
pub fn numbers<T: Scalar>(exact: &[[f64; 2]]) -> Vec<T> {
    compiled::<Numbers, T>()(exact)
}

fn rounded<T: Scalar>(exact: &[[f64; 2]]) -> Vec<T> {
    let number = |&[high, low]: &[f64; 2]| T::from_parts(high, low);
    exact.iter().map(number).collect()
}

compiled_once! {
    /// [`rounded`].
    Numbers<T> = rounded: fn(&[[f64; 2]]) -> Vec<T>
}

#[cfg(test)]
mod tests;
