//! Many states of one tree, each in a lane.
//!
//! Where a [`Batch`](crate::batch::Batch) has a register of each number, the links
//! need no neighbours: one subtree goes up after the other, each so small that what is
//! passed on in it stays in the first cache, then what is above them up and down, then
//! the subtrees down, the last one first. Three values of each link are kept for the
//! way down, and as many more of those with children.
//!
//! # Which bits
//! The equations are those of one state, and so is the order of each sum: a state
//! has the bits that it has alone.

mod packing;
mod pieces;
mod table;
mod turns;
mod walk;

use core::marker::PhantomData;

use packing::{Alone, Packed};

use super::Generations;
use super::pool::Pool;
use super::recursion::Recursion;
use super::table::Table;
use crate::scalar::Scalar;
use crate::scalar::register::Register;
use crate::system::rescale::InRegisters;

/// A model and room for its values.
struct WithRoom<'m, 'r, M, T> {
    model: &'m M,
    room: &'r mut [T],
}

impl<P, R, const C: usize, const L: usize, const A: usize, const K: usize> InRegisters<R>
    for WithRoom<'_, '_, Generations<P, R::Lane, C, L, A, K>, R::Lane>
where
    P: Recursion<C, L, A, K>,
    R: Register,
{
    #[inline(always)]
    fn evaluate(
        &mut self,
        _time: R,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        let packing = PhantomData::<Packed<R>>;
        let _ = walk::evaluate(packing, self.model, self.room, theta, omega, alpha);
    }
}

impl<P, R, const C: usize, const A: usize, const K: usize> InRegisters<R>
    for WithRoom<'_, '_, Table<P, R::Lane, C, A, K>, R::Lane>
where
    P: Recursion<C, A, A, K>,
    R: Register,
{
    #[inline(always)]
    fn evaluate(
        &mut self,
        _time: R,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        let packing = PhantomData::<Packed<R>>;
        let _ = table::evaluate(packing, self.model, self.room, theta, omega, alpha);
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
    pub fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Generations<P, S, C, L, R, K> {
        Generations {
            tree: self.tree.rescale(convert),
            recursion: PhantomData,
        }
    }

    /// The accelerations in the arithmetic of `T`, as
    /// [`Rescale::evaluate`](crate::Rescale::evaluate).
    #[inline(always)]
    pub fn evaluate(
        &self,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let pool = self.tree.pool();
        let mut room = pool.take(self.room(), T::from_f64(0.0));
        let packing = PhantomData::<Alone<T>>;
        let _ = walk::evaluate(packing, self, &mut room, theta, omega, alpha);
        pool.give_back(room);
    }

    /// How many values a state takes in a batch.
    #[doc(hidden)]
    #[must_use]
    pub fn room(&self) -> usize {
        walk::room::<P, C, L, R, K>(self.tree.plan())
    }

    /// Many states in registers, with so much room for each.
    #[doc(hidden)]
    #[inline(always)]
    pub fn in_registers<V: Register<Lane = T>>(&self, room: &mut [T]) -> impl InRegisters<V> {
        WithRoom { model: self, room }
    }
}

impl<P, T, const C: usize, const R: usize, const K: usize> Table<P, T, C, R, K>
where
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    /// The accelerations in the arithmetic of `T`, as
    /// [`Rescale::evaluate`](crate::Rescale::evaluate).
    #[inline(always)]
    pub fn evaluate(
        &self,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let mut room = self.pool.take(self.room(), T::from_f64(0.0));
        let packing = PhantomData::<Alone<T>>;
        let _ = table::evaluate(packing, self, &mut room, theta, omega, alpha);
        self.pool.give_back(room);
    }

    /// The same tree on other scalars.
    #[must_use]
    pub fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Table<P, S, C, R, K> {
        Table {
            parents: self.parents,
            depths: self.depths.clone(),
            order: self.order.clone(),
            constants: self.constants.iter().map(|row| row.map(&convert)).collect(),
            hanging: self.hanging.iter().map(|row| row.map(&convert)).collect(),
            root: self.root.map(&convert),
            energies: self.energies.iter().map(|row| row.map(&convert)).collect(),
            pool: Pool::new(),
            recursion: PhantomData,
        }
    }

    fn deepest(&self) -> usize {
        self.order
            .last()
            .map_or(0, |&link| depth(&self.depths, link))
    }

    /// How many values a state takes in a batch.
    #[doc(hidden)]
    #[must_use]
    pub fn room(&self) -> usize {
        table::room::<P, C, R, K>(self.deepest())
    }

    /// Many states in registers, with so much room for each.
    #[doc(hidden)]
    #[inline(always)]
    pub fn in_registers<V: Register<Lane = T>>(&self, room: &mut [T]) -> impl InRegisters<V> {
        WithRoom { model: self, room }
    }
}

/// Of a link, 0 where there is none.
fn depth(depths: &[u32], link: u32) -> usize {
    depths.get(link as usize).map_or(0, |&depth| depth as usize)
}

// A loop: `map` and `from_fn` are not always inlined, and must be.
#[inline(always)]
fn sum<V: Scalar, const N: usize>(mut a: [V; N], b: [V; N]) -> [V; N] {
    for i in 0..N {
        a[i] = a[i] + b[i];
    }
    a
}
