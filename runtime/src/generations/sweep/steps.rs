//! What is done with the links of one generation, a vector at a time.

use core::marker::PhantomData;

use super::level::{Leaves, Level, splat, sum};
use crate::generations::columns::Copies;
use crate::generations::recursion::Recursion;
use crate::generations::vector::{Step, Vector};
use crate::scalar::Scalar;

/// Links above leaves, and these, on the way up.
pub(super) struct Stems<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) Leaves<'a, T, C>,
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
        let Self(level, leaves, _) = self;
        let constants = splat::<T, V, C>(&leaves.constants);
        let mut copies = leaves.at(index)?;
        let mut below = P::leaf(&constants, copies.next()?);
        while let Some(link) = copies.next() {
            below = sum(below, P::leaf(&constants, link));
        }
        let constants = splat(&level.constants);
        let (answers, kept) = P::stem(&constants, level.own.motion(index)?, below);
        level.answers.store(index, answers)?;
        level.kept.store(index, kept)
    }
}

/// Links above inner links, on the way up.
pub(super) struct Inners<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) Copies<'a, T, R>,
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
        let Self(level, children, _) = self;
        let mut copies = children.at(index)?;
        let mut below: [V; R] = copies.load()?;
        while let Some(answers) = copies.load() {
            below = sum(below, answers);
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
    pub(super) Leaves<'a, T, C>,
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
        let Self(level, leaves, _) = self;
        let (kept, pivot) = (level.kept.load(index)?, level.answers.load(index)?);
        let constants = splat::<T, V, C>(&level.constants);
        let (acceleration, below) = P::turn(&constants, level.own.motion(index)?, kept, pivot);
        level.alpha.store(index, acceleration, level.length);
        let constants = splat(&leaves.constants);
        let (mut copies, mut places) = (leaves.at(index)?, leaves.alpha.at(index));
        while let Some(link) = copies.next() {
            places.store(P::turn_leaf(&constants, link, below))?;
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
>(
    pub(super) Level<'a, T, C, R, K>,
    pub(super) Copies<'a, T, R>,
    pub(super) PhantomData<P>,
);

impl<P, T, V, const C: usize, const L: usize, const R: usize, const K: usize> Step<V>
    for TurnInners<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
    V: Vector<T>,
{
    #[inline(always)]
    fn at(&mut self, index: usize) -> Option<()> {
        let Self(level, children, _) = self;
        let (kept, pivot) = (level.kept.load(index)?, level.answers.load(index)?);
        let constants = splat::<T, V, C>(&level.constants);
        let (acceleration, below) = P::turn(&constants, level.own.motion(index)?, kept, pivot);
        level.alpha.store(index, acceleration, level.length);
        let mut copies = children.at(index)?;
        while copies.store(below).is_some() {}
        Some(())
    }
}
