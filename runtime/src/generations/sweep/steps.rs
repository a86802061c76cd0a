//! What neighbours take from their children and give to them, a vector at a time.

use super::level::{Leaves, Level, add, splat};
use crate::generations::columns::Copies;
use crate::generations::recursion::Recursion;
use crate::generations::vector::Vector;
use crate::scalar::Scalar;

/// Where the children of neighbours are.
pub(super) enum Children<'a, T, const C: usize, const R: usize> {
    /// They are leaves.
    Leaves(Leaves<'a, T, C>),
    /// All of them are lanes of one vector, which is at hand.
    Registers,
    /// Their answers are in memory, and the accelerations of their pivots.
    Memory(Copies<'a, T, R>),
}

impl<T: Scalar, const C: usize, const R: usize> Children<'_, T, C, R> {
    /// The sum of their answers. `answers` are those in registers.
    #[inline(always)]
    pub(super) fn answers<V, P, const L: usize, const K: usize>(
        &self,
        at: usize,
        level: &Level<'_, T, C, R, K>,
        answers: &[V; R],
    ) -> Option<[V; R]>
    where
        V: Vector<T>,
        P: Recursion<C, L, R, K>,
    {
        match self {
            Self::Leaves(leaves) => {
                let constants = splat::<T, V, C>(&leaves.constants);
                let mut copies = leaves.at(at)?;
                let mut sums = P::leaf(&constants, copies.next()?);
                while let Some(link) = copies.next() {
                    add(&mut sums, &P::leaf(&constants, link));
                }
                Some(P::joined(sums))
            }
            Self::Registers => {
                let [copies, apart] = level.copies;
                let mut sums = *answers;
                let mut copy = 1;
                while copy < copies {
                    let mut i = 0;
                    while i < R {
                        sums[i] = sums[i] + answers[i].behind(copy * apart);
                        i += 1;
                    }
                    copy += 1;
                }
                Some(sums)
            }
            Self::Memory(children) => {
                let mut copies = children.at(at)?;
                let mut sums = copies.load()?;
                while let Some(answers) = copies.load() {
                    add(&mut sums, &answers);
                }
                Some(sums)
            }
        }
    }

    /// Gives them the acceleration of their pivots, to `pivot` where they are in
    /// registers; computes them where they are leaves.
    #[inline(always)]
    pub(super) fn turn<V, P, const L: usize, const K: usize>(
        &self,
        at: usize,
        level: &Level<'_, T, C, R, K>,
        below: [V; 2],
        pivot: &mut [V; 2],
    ) -> Option<()>
    where
        V: Vector<T>,
        P: Recursion<C, L, R, K>,
    {
        match self {
            Self::Leaves(leaves) => {
                let constants = splat(&leaves.constants);
                let (mut copies, mut places) = (leaves.at(at)?, leaves.alpha.at(at));
                while let Some(link) = copies.next() {
                    places.store(P::turn_leaf(&constants, link, below))?;
                }
            }
            Self::Registers => {
                let [x, y] = below;
                *pivot = [x.repeat(level.length), y.repeat(level.length)];
            }
            Self::Memory(children) => {
                let mut copies = children.at::<V>(at)?;
                while copies.store(&below).is_some() {}
            }
        }
        Some(())
    }
}
