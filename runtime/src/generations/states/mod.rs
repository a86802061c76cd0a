//! Many states of one tree, each in a lane.
//!
//! Where a [`Batch`](crate::batch::Batch) has a register of each number, the links
//! need no neighbours: one subtree goes up after the other, each so small that what is
//! passed on in it stays in the first cache, then what is above them up and down, then
//! the subtrees down, the last one first. Three values of each link are kept for the
//! way down, and as many more of those with children. A table goes link by link, depth
//! first, and passes on one row for each depth.
//!
//! # Which bits
//! The equations are those of one state, and so is the order of each sum: a state
//! has the bits that it has alone.

mod packing;
mod pieces;
mod places;
mod stack;
mod table;
mod turns;
mod walk;

use core::marker::PhantomData;

use packing::{Alone, Packed, Packing};

use super::Generations;
use super::places::{PlacedRecursion, PlacedTable};
use super::pool::Pool;
use super::recursion::Recursion;
use super::root::RootDrive;
use super::table::Table;
use crate::scalar::Scalar;
use crate::scalar::register::Register;
use crate::system::cast::InRegisters;

/// A tree in loops that is computed in values of any packing.
trait States<T: Scalar> {
    /// Room for evaluations of one state.
    fn pool(&self) -> &Pool<T>;

    /// How many values an evaluation needs room for.
    fn room(&self) -> usize;

    /// Gives the accelerations, link by link in any order. None, and not all of them,
    /// where the room is too small.
    fn solve<N: Packing<Number = T>>(
        &self,
        drive: Option<RootDrive<N::Value>>,
        room: &mut [T],
        theta: impl Fn(usize) -> N::Value,
        omega: impl Fn(usize) -> N::Value,
        alpha: impl FnMut(usize, N::Value),
    ) -> Option<()>;

    /// The same for values that are numbers, in room of the tree's own.
    #[inline(always)]
    fn solve_alone(
        &self,
        drive: Option<RootDrive<T>>,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let mut room = self.pool().take(self.room(), T::from_f64(0.0));
        let _ = self.solve::<Alone<T>>(drive, &mut room, theta, omega, alpha);
        self.pool().give_back(room);
    }
}

/// A tree at one time of its drive, and room for its values.
struct WithRoom<'m, 'r, M, T> {
    model: &'m M,
    drive: Option<RootDrive<T>>,
    room: &'r mut [T],
}

impl<M, R> InRegisters<R> for WithRoom<'_, '_, M, R::Lane>
where
    M: States<R::Lane>,
    R: Register,
{
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        let drive = self.drive.map(|drive| drive.map(R::splat));
        let _ = self
            .model
            .solve::<Packed<R>>(drive, self.room, theta, omega, alpha);
    }
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Generations<P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    /// The same tree on other scalars; computed on as many threads.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Generations<P, S, C, L, R, K> {
        Generations {
            tree: self.tree.cast(convert),
            recursion: PhantomData,
        }
    }
}

impl<P, T, const C: usize, const R: usize, const K: usize> Table<P, T, C, R, K>
where
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    /// The same tree on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Table<P, S, C, R, K> {
        Table {
            shape: self.shape.clone(),
            constants: self.constants.iter().map(|row| row.map(&convert)).collect(),
            hanging: self.hanging.iter().map(|row| row.map(&convert)).collect(),
            root: self.root.map(&convert),
            energies: self.energies.iter().map(|row| row.map(&convert)).collect(),
            pool: Pool::new(),
            recursion: PhantomData,
        }
    }
}

impl<P, T, const C: usize, const R: usize, const S: usize, const K: usize>
    PlacedTable<P, T, C, R, S, K>
where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
{
    /// The same tree on other scalars.
    #[must_use]
    pub fn cast<V: Scalar>(&self, convert: impl Fn(T) -> V) -> PlacedTable<P, V, C, R, S, K> {
        PlacedTable {
            shape: self.shape.clone(),
            constants: self.constants.iter().map(|row| row.map(&convert)).collect(),
            hanging: self.hanging.iter().map(|row| row.map(&convert)).collect(),
            root: self.root.map(&convert),
            pool: Pool::new(),
            recursion: PhantomData,
        }
    }
}

/// What emitted models ask for, of all kinds of loops alike.
macro_rules! evaluations {
    (impl [$($generics:tt)*] $tree:ty, $equations:path) => {
        impl<P, T, $($generics)*> $tree
        where
            P: $equations,
            T: Scalar,
        {
            /// The accelerations in the arithmetic of `T`, as
            /// [`Cast::evaluate`](crate::Cast::evaluate).
            #[inline(always)]
            pub fn evaluate(
                &self,
                theta: impl Fn(usize) -> T,
                omega: impl Fn(usize) -> T,
                alpha: impl FnMut(usize, T),
            ) {
                self.solve_alone(None, theta, omega, alpha);
            }

            /// The same for a driven tree, at a time of this drive.
            #[inline(always)]
            pub fn driven_evaluate(
                &self,
                drive: RootDrive<T>,
                theta: impl Fn(usize) -> T,
                omega: impl Fn(usize) -> T,
                alpha: impl FnMut(usize, T),
            ) {
                self.solve_alone(Some(drive), theta, omega, alpha);
            }

            /// How many values a state takes in a batch.
            #[doc(hidden)]
            #[must_use]
            pub fn room(&self) -> usize {
                States::room(self)
            }

            /// Many states in registers, with so much room for each.
            #[doc(hidden)]
            #[inline(always)]
            pub fn in_registers<V: Register<Lane = T>>(
                &self,
                drive: Option<RootDrive<T>>,
                room: &mut [T],
            ) -> impl InRegisters<V> {
                WithRoom {
                    model: self,
                    drive,
                    room,
                }
            }
        }
    };
}

evaluations! {
    impl [const C: usize, const L: usize, const R: usize, const K: usize]
    Generations<P, T, C, L, R, K>, Recursion<C, L, R, K>
}
evaluations! {
    impl [const C: usize, const R: usize, const K: usize]
    Table<P, T, C, R, K>, Recursion<C, R, R, K>
}
evaluations! {
    impl [const C: usize, const R: usize, const S: usize, const K: usize]
    PlacedTable<P, T, C, R, S, K>, PlacedRecursion<C, R, S, K>
}

// A loop: `map` and `from_fn` are not always inlined, and must be.
#[inline(always)]
fn sum<V: Scalar, const N: usize>(mut a: [V; N], b: [V; N]) -> [V; N] {
    for i in 0..N {
        a[i] = a[i] + b[i];
    }
    a
}
