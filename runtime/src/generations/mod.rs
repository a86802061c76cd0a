//! Large trees: equations of motion in loops over generations.
//!
//! A tree that is given by rule has links of one kind in each generation. The
//! attribute writes the equations of one link of each kind ([`Recursion`]);
//! [`Generations`] takes them through the tree, from the leaves to the root and
//! back, several siblings in a vector register. Time and memory are proportional
//! to the number of links; code and the time to compile it do not depend on it.
//!
//! # Order of the links
//! Generation by generation from the root on. Within a generation the first
//! copies under all parents come first, in the order of the parents, then the
//! second copies: copy `c` (from 0) under link `i` of a generation of `n` links
//! has number `c · n + i` in the next one. Neighbours then have neighbouring
//! parents, and no vector has to be gathered. [`Generations::link`] finds a link
//! by its path from the root.
//!
//! # Cost
//! O(links). Beyond some thousand links the lower generations are computed part
//! by part, each one small enough for the cache; from [`THREADED`] links on, on
//! several threads. The result has the same bits for any number of threads.
//!
//! # Trees of irregular shape
//! have constants for each link, and a [`Table`] takes the same equations through
//! them link by link.
//!
//! # Source
//! R. Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7
//! (articulated-body algorithm), in the plane; `docs/physics.md`, section 2.

mod bodies;
mod boundary;
mod columns;
mod cut;
mod energy;
mod evaluate;
mod layout;
mod links;
mod memory;
mod name;
mod part;
mod places;
mod plan;
mod pool;
mod prefetch;
mod recursion;
mod root;
mod runs;
mod shared;
mod states;
mod sweep;
mod table;
mod table_energy;
mod threads;
mod tree;
mod turns;
mod vector;
pub(crate) mod vectors;

use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::num::NonZeroUsize;

pub use bodies::{Bodies, Hanging};
#[doc(hidden)]
pub use evaluate::Kernels;
pub use name::LinkName;
pub use places::{PlacedRecursion, PlacedTable};
pub use recursion::{Motion, Recursion};
pub use root::RootDrive;
pub use table::{Table, rows};
#[doc(hidden)]
pub use tree::{Loops, Tree};
#[doc(hidden)]
pub use vector::{Single, SliceKernel, Vector, Vectors};
#[doc(hidden)]
pub use vectors::With;

use crate::scalar::Scalar;

/// Trees of at least so many links are computed on all cores, unless
/// [`Generations::set_threads`] says otherwise: below, threads cost more than
/// they save.
pub const THREADED: usize = 1 << 17;

/// A tree in generations: its constants, and room for evaluations.
///
/// Emitted models hold one. `P` are the equations; see [`Recursion`] for the
/// numbers. Room for an evaluation is allocated by the first one, and again by
/// evaluations at the same time in other threads; nothing is allocated after
/// that. (Without the feature `std` every evaluation allocates.)
pub struct Generations<P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    tree: Tree<T>,
    recursion: PhantomData<P>,
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Generations<P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    /// A tree with the constants of each generation, what its root takes from
    /// above, and the constants of the energies, none where these are not asked
    /// for.
    ///
    /// A row of `motion` is what the equations read. One of `energies` has, in SI
    /// units, half of the mass, the first moment m d and half of the moment of
    /// inertia I + m d² about the pivot, the distance ℓ of the children's pivots,
    /// g h, and half of the stiffness of the torsion spring; h is the first moment
    /// about the pivot of what hangs on it, the subtrees of the children as masses
    /// in their pivots.
    #[must_use]
    pub fn new(motion: Vec<[T; C]>, root: [T; 2], energies: &[[T; 6]]) -> Self {
        let sizes = memory::Sizes {
            answers: R,
            kept: K,
            joints: P::JOINTS,
        };
        let tree = T::loops().tree;
        Self {
            tree: tree(P::COPIES, sizes, motion.into_flattened(), root, energies),
            recursion: PhantomData,
        }
    }

    /// Computes on so many threads, where the tree is large enough to be taken
    /// apart. Results do not depend on it.
    pub fn set_threads(&mut self, threads: NonZeroUsize) {
        self.tree.set_threads(threads.get());
    }

    /// Writes the angular accelerations, as
    /// [`Pendulum::accelerations_into`](crate::Pendulum::accelerations_into).
    pub fn accelerations_into(&self, theta: &[T], omega: &[T], alpha: &mut [T]) {
        let kernels = Kernels::of::<P, C, L, R, K>();
        (T::loops().accelerations_into)(&self.tree, &kernels, theta, omega, alpha);
    }

    /// The same for a driven tree, at a time of this drive.
    pub fn driven_accelerations_into(
        &self,
        drive: RootDrive<T>,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let kernels = Kernels::of::<P, C, L, R, K>();
        (T::loops().driven_accelerations_into)(&self.tree, &kernels, drive, theta, omega, alpha);
    }

    /// Kinetic energy, J. NaN for slices of another length than there are links.
    #[must_use]
    pub fn kinetic_energy(&self, theta: &[T], omega: &[T]) -> T {
        (T::loops().kinetic_energy)(&self.tree, theta, omega)
    }

    /// Potential energy, J, zero where every link hangs straight down. NaN for a
    /// slice of another length than there are links.
    #[must_use]
    pub fn potential_energy(&self, theta: &[T]) -> T {
        (T::loops().potential_energy)(&self.tree, theta)
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Generations<P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
{
    /// Index of the link that one comes to from the root by these copies, each
    /// counted from 0; the empty path is the root's. None where there is no such
    /// link.
    #[must_use]
    pub fn link(path: &[usize]) -> Option<usize> {
        let (mut start, mut count, mut index) = (0, 1, 0);
        let mut copies = P::COPIES.iter().skip(1);
        for &copy in path {
            let copies = *copies.next()?;
            if copy >= copies {
                return None;
            }
            start += count;
            index += copy * count;
            count *= copies;
        }
        Some(start + index)
    }

    /// The path from the root to a link: the inverse of [`link`](Self::link).
    #[must_use]
    pub fn path(index: usize) -> Option<Vec<usize>> {
        let (generation, mut rest) = place::<P, C, L, R, K>(index)?;
        let copies = P::COPIES.get(1..=generation).unwrap_or_default();
        let mut path = Vec::with_capacity(generation);
        for &copies in copies {
            path.push(rest % copies);
            rest /= copies;
        }
        Some(path)
    }

    /// The name of a link.
    #[must_use]
    pub fn link_name(index: usize) -> Option<LinkName> {
        let (generation, index) = place::<P, C, L, R, K>(index)?;
        Some(LinkName {
            stem: P::NAMES.get(generation)?,
            copies: P::COPIES.get(1..=generation)?,
            index,
        })
    }
}

/// Generation of a link, and its number there.
fn place<P, const C: usize, const L: usize, const R: usize, const K: usize>(
    index: usize,
) -> Option<(usize, usize)>
where
    P: Recursion<C, L, R, K>,
{
    let (mut count, mut rest) = (1, index);
    for (generation, copies) in P::COPIES.iter().enumerate() {
        count *= copies;
        match rest.checked_sub(count) {
            Some(beyond) => rest = beyond,
            None => return Some((generation, rest)),
        }
    }
    None
}

impl<P, T: Clone, const C: usize, const L: usize, const R: usize, const K: usize> Clone
    for Generations<P, T, C, L, R, K>
{
    /// The copy has room of its own.
    fn clone(&self) -> Self {
        let Self { tree, recursion } = self;
        Self {
            tree: tree.clone(),
            recursion: *recursion,
        }
    }
}

impl<P, T: PartialEq, const C: usize, const L: usize, const R: usize, const K: usize> PartialEq
    for Generations<P, T, C, L, R, K>
{
    /// Whether they are the same tree, however it is computed.
    fn eq(&self, other: &Self) -> bool {
        self.tree == other.tree
    }
}

impl<P, T: fmt::Debug, const C: usize, const L: usize, const R: usize, const K: usize> fmt::Debug
    for Generations<P, T, C, L, R, K>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tree, recursion: _ } = self;
        f.debug_struct("Generations")
            .field("constants", &tree.constants)
            .field("root", &tree.root)
            .field("energies", &tree.energies)
            .field("threads", &tree.threads)
            .finish_non_exhaustive()
    }
}
