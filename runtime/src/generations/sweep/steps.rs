//! What neighbours take from their children and give to them, a vector at a time.

use super::level::{Leaves, add, splat};
use crate::generations::columns::Copies;
use crate::generations::recursion::Recursion;
use crate::generations::vector::Vector;
use crate::scalar::Scalar;

/// Where the children of neighbours are: the one or the other.
// No enumeration: the compiler keeps these in registers, and does not one whose
// variants share their memory.
pub(super) struct Children<'a, T, const C: usize, const R: usize> {
    /// They are leaves.
    pub(super) leaves: Option<Leaves<'a, T, C>>,
    /// Their answers are in memory, and the accelerations of their pivots.
    pub(super) inner: Option<Copies<'a, T, R>>,
}

impl<T: Scalar, const C: usize, const R: usize> Children<'_, T, C, R> {
    /// The sum of their answers.
    #[inline(always)]
    pub(super) fn answers<V, P, const L: usize, const K: usize>(&self, at: usize) -> Option<[V; R]>
    where
        V: Vector<T>,
        P: Recursion<C, L, R, K>,
    {
        if let Some(leaves) = &self.leaves {
            let constants = splat::<T, V, C>(&leaves.constants);
            let mut copies = leaves.at(at)?;
            let mut sums = P::leaf(&constants, copies.next()?);
            while let Some(link) = copies.next() {
                add(&mut sums, &P::leaf(&constants, link));
            }
            return Some(P::joined(sums));
        }
        let mut copies = self.inner?.at(at)?;
        let mut sums = copies.load()?;
        while let Some(answers) = copies.load() {
            add(&mut sums, &answers);
        }
        Some(sums)
    }

    /// Gives them the acceleration of their pivots; computes them where they are
    /// leaves.
    #[inline(always)]
    pub(super) fn turn<V, P, const L: usize, const K: usize>(
        &self,
        at: usize,
        below: [V; 2],
    ) -> Option<()>
    where
        V: Vector<T>,
        P: Recursion<C, L, R, K>,
    {
        if let Some(leaves) = &self.leaves {
            let constants = splat(&leaves.constants);
            let (mut copies, mut places) = (leaves.at(at)?, leaves.alpha.at(at));
            while let Some(link) = copies.next() {
                places.store(P::turn_leaf(&constants, link, below))?;
            }
            return Some(());
        }
        let mut copies = self.inner?.at::<V>(at)?;
        while copies.store(&below).is_some() {}
        Some(())
    }
}
