//! What is done with the links of one generation, a vector at a time.

use core::marker::PhantomData;

use super::{Level, splat, sum};
use crate::generations::recursion::Recursion;
use crate::generations::vector::{Step, Vector};
use crate::scalar::Scalar;

/// Links above leaves, and these, on the way up.
pub(super) struct Stems<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) [T; C],
    pub(super) PhantomData<P>,
);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for Stems<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Self(level, leaf_constants, _) = self;
        let constants = splat::<T, V, C>(leaf_constants);
        let mut below = None;
        for copy in 0..level.copies {
            let leaves = level.links.window(level.child(copy).own, level.rows)?;
            let answers = P::leaf(&constants, leaves.motion(index)?);
            below = Some(match below {
                Some(below) => sum(below, answers),
                None => answers,
            });
        }
        let constants = splat(&level.constants);
        let (answers, kept) = P::stem(&constants, level.own.motion(index)?, below?);
        level.answers.store(index, answers)?;
        level.kept.store(index, kept)
    }
}

/// Links above inner links, on the way up.
pub(super) struct Inners<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) PhantomData<P>,
);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for Inners<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Self(level, _) = self;
        let child = |copy| level.all_answers.window(level.child(copy).slot, level.rows);
        let mut below: [V; R] = child(0)?.load(index)?;
        for copy in 1..level.copies {
            below = sum(below, child(copy)?.load(index)?);
        }
        let constants = splat(&level.constants);
        let (answers, kept) = P::inner(&constants, level.own.motion(index)?, below);
        level.answers.store(index, answers)?;
        level.kept.store(index, kept)
    }
}

/// Links above leaves, and these, on the way down.
pub(super) struct TurnStems<
    'a,
    P,
    T,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) [T; C],
    pub(super) PhantomData<P>,
);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for TurnStems<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Self(level, leaf_constants, _) = self;
        let (kept, pivot) = (level.kept.load(index)?, level.answers.load(index)?);
        let constants = splat::<T, V, C>(&level.constants);
        let (acceleration, below) = P::turn(&constants, level.own.motion(index)?, kept, pivot);
        let length = level.length;
        level.alpha.store(index, acceleration, length);
        let constants = splat(leaf_constants);
        for copy in 0..level.copies {
            let child = level.child(copy);
            let leaves = level.links.window(child.own, level.rows)?;
            let acceleration = P::turn_leaf(&constants, leaves.motion(index)?, below);
            level
                .all_alpha
                .store(child.whole + index, acceleration, length);
        }
        Some(())
    }
}

/// Links above inner links, on the way down.
pub(super) struct TurnInners<
    'a,
    P,
    T,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
>(pub(super) Level<'a, T, C, R, K>, pub(super) PhantomData<P>);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for TurnInners<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Self(level, _) = self;
        let (kept, pivot) = (level.kept.load(index)?, level.answers.load(index)?);
        let constants = splat::<T, V, C>(&level.constants);
        let (acceleration, below) = P::turn(&constants, level.own.motion(index)?, kept, pivot);
        level.alpha.store(index, acceleration, level.length);
        for copy in 0..level.copies {
            let child = level.child(copy).slot;
            let pivots = level.all_answers.window(child, level.rows)?;
            pivots.store(index, below)?;
        }
        Some(())
    }
}
