//! The recursion through a tree in generations, subtree by subtree.

use core::marker::PhantomData;

use super::packing::{Packing, Rows, splat};
use super::pieces::{Level, Piece, Pieces};
use super::turns::{self, Turns};
use super::{States, sum};
use crate::generations::Generations;
use crate::generations::memory::take;
use crate::generations::pool::Pool;
use crate::generations::recursion::Recursion;
use crate::generations::root::RootDrive;
use crate::scalar::Scalar;

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> States<T>
    for Generations<P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    fn pool(&self) -> &Pool<T> {
        self.tree.pool()
    }

    fn room(&self) -> usize {
        let plan = self.tree.plan();
        let others = Pieces::new(plan).map_or(0, |pieces| pieces.passed() * R + pieces.kept() * K);
        turns::room(plan.links(), P::JOINTS) + others
    }

    #[inline(always)]
    fn solve<N: Packing<Number = T>>(
        &self,
        drive: Option<RootDrive<N::Value>>,
        mut room: &mut [T],
        theta: impl Fn(usize) -> N::Value,
        omega: impl Fn(usize) -> N::Value,
        mut alpha: impl FnMut(usize, N::Value),
    ) -> Option<()> {
        let pieces = Pieces::new(self.tree.plan())?;
        let room = &mut room;
        let mut walk = Walk::<N, P, C, L, R, K> {
            constants: self.tree.constants.as_chunks().0,
            torque: drive.map(|drive| drive.torque),
            leaves: pieces.leaves(),
            passed: Rows(take(room, pieces.passed() * R * N::COUNT)),
            kept: Rows(take(room, pieces.kept() * K * N::COUNT)),
            turns: Turns::new(core::mem::take(room), P::JOINTS),
            recursion: PhantomData,
        };
        // What is formed behind the last link of one is written over by the next.
        let top = pieces.top();
        walk.turn(&top, pieces.above, &theta, &omega)?;
        for index in 0..pieces.count {
            let piece = pieces.subtree(index);
            walk.turn(&piece, pieces.links, &theta, &omega)?;
            walk.stems_up(&piece)?;
            walk.inners_up(&piece, piece.inner - 1)?;
            walk.hand(&piece, pieces.above + index)?;
        }
        walk.inners_up(&top, top.inner)?;
        let root = RootDrive::above(splat::<N, 2>(&self.tree.root), drive);
        walk.passed.store::<N, 2>(0, root)?;
        walk.inners_down(&top, top.inner, &mut alpha)?;
        for index in (0..pieces.count).rev() {
            let piece = pieces.subtree(index);
            walk.hand_back(&piece, pieces.above + index)?;
            walk.inners_down(&piece, piece.inner - 1, &mut alpha)?;
            walk.stems_down(&piece, &mut alpha)?;
        }
        Some(())
    }
}

/// What all pieces are computed with and in.
struct Walk<'a, N: Packing, P, const C: usize, const L: usize, const R: usize, const K: usize> {
    constants: &'a [[N::Number; C]],
    /// On the root.
    torque: Option<N::Value>,
    /// The generation of leaves.
    leaves: usize,
    /// Answers on the way up, accelerations of pivots on the way down.
    passed: Rows<'a, N::Number, R>,
    kept: Rows<'a, N::Number, K>,
    turns: Turns<'a, N>,
    recursion: PhantomData<P>,
}

impl<N, P, const C: usize, const L: usize, const R: usize, const K: usize>
    Walk<'_, N, P, C, L, R, K>
where
    N: Packing,
    P: Recursion<C, L, R, K>,
{
    #[inline(always)]
    fn constants(&self, generation: usize) -> Option<[N::Value; C]> {
        let row = splat::<N, C>(self.constants.get(generation)?);
        Some(match self.torque {
            Some(torque) if P::TORQUE && generation == 0 => RootDrive::row(torque, &row),
            _ => row,
        })
    }

    /// Motions of so many links of a piece.
    #[inline(always)]
    fn turn(
        &mut self,
        piece: &Piece<'_>,
        count: usize,
        theta: &impl Fn(usize) -> N::Value,
        omega: &impl Fn(usize) -> N::Value,
    ) -> Option<()> {
        let mut generation = piece.generations().start;
        let mut level = piece.level(generation)?;
        let mut above: Option<Level> = None;
        let (mut index, mut under) = (0, 0);
        let first = level.turns;
        let next = || {
            let link = level.link(index);
            let parent = match above {
                Some(above) => Some(above.link(under)),
                None => piece.above(),
            };
            index += 1;
            under += 1;
            if above.is_some_and(|above| under == above.length) {
                under = 0;
            }
            if index == level.length {
                // Behind the last link there is room for what nobody reads.
                if let Some(below) = piece.level(generation + 1) {
                    above = Some(level);
                    level = below;
                    generation += 1;
                }
                (index, under) = (0, 0);
            }
            (link, parent)
        };
        self.turns.form(first, count, next, theta, omega)
    }

    /// Links above leaves, and these.
    #[inline(always)]
    fn stems_up(&mut self, piece: &Piece<'_>) -> Option<()> {
        let (level, below) = (piece.level(self.leaves - 1)?, piece.level(self.leaves)?);
        let leaf_constants = self.constants(self.leaves)?;
        let constants = self.constants(self.leaves - 1)?;
        for index in 0..level.length {
            let mut row = below.turns + index;
            let mut answers = P::leaf(&leaf_constants, self.turns.motion(row)?);
            for _ in 1..below.copies {
                row += level.length;
                answers = sum(answers, P::leaf(&leaf_constants, self.turns.motion(row)?));
            }
            let motion = self.turns.motion(level.turns + index)?;
            let (answers, kept) = P::stem(&constants, motion, answers);
            self.passed.store::<N, R>(level.passed + index, answers)?;
            self.kept.store::<N, K>(level.kept + index, kept)?;
        }
        Some(())
    }

    /// The generations before `end`, from the last to the first.
    #[inline(always)]
    fn inners_up(&mut self, piece: &Piece<'_>, end: usize) -> Option<()> {
        let mut below = piece.level(end)?;
        for generation in (piece.generations().start..end).rev() {
            let level = piece.level(generation)?;
            let constants = self.constants(generation)?;
            for index in 0..level.length {
                let mut row = below.passed + index;
                let mut answers = self.passed.load::<N, R>(row)?;
                for _ in 1..below.copies {
                    row += level.length;
                    answers = sum(answers, self.passed.load::<N, R>(row)?);
                }
                let motion = self.turns.motion(level.turns + index)?;
                let (answers, kept) = P::inner(&constants, motion, answers);
                self.passed.store::<N, R>(level.passed + index, answers)?;
                self.kept.store::<N, K>(level.kept + index, kept)?;
            }
            below = level;
        }
        Some(())
    }

    /// What a subtree answers, to a row of what is above.
    #[inline(always)]
    fn hand(&mut self, piece: &Piece<'_>, row: usize) -> Option<()> {
        let own = piece.level(piece.generations().start)?.passed;
        let answers = self.passed.load::<N, R>(own)?;
        self.passed.store::<N, R>(row, answers)
    }

    /// And the acceleration of its pivot back.
    #[inline(always)]
    fn hand_back(&mut self, piece: &Piece<'_>, row: usize) -> Option<()> {
        let own = piece.level(piece.generations().start)?.passed;
        let pivot = self.passed.load::<N, 2>(row)?;
        self.passed.store::<N, 2>(own, pivot)
    }

    /// The generations before `end`, from the first to the last.
    #[inline(always)]
    fn inners_down(
        &mut self,
        piece: &Piece<'_>,
        end: usize,
        alpha: &mut impl FnMut(usize, N::Value),
    ) -> Option<()> {
        for generation in piece.generations().start..end {
            let (level, below) = (piece.level(generation)?, piece.level(generation + 1)?);
            let constants = self.constants(generation)?;
            for index in 0..level.length {
                let pivot = self.passed.load::<N, 2>(level.passed + index)?;
                let kept = self.kept.load::<N, K>(level.kept + index)?;
                let motion = self.turns.motion(level.turns + index)?;
                let (acceleration, end) = P::turn(&constants, motion, kept, pivot);
                alpha(level.link(index), acceleration);
                let mut row = below.passed + index;
                for _ in 0..below.copies {
                    self.passed.store::<N, 2>(row, end)?;
                    row += level.length;
                }
            }
        }
        Some(())
    }

    /// Links above leaves, and these.
    #[inline(always)]
    fn stems_down(
        &mut self,
        piece: &Piece<'_>,
        alpha: &mut impl FnMut(usize, N::Value),
    ) -> Option<()> {
        let (level, below) = (piece.level(self.leaves - 1)?, piece.level(self.leaves)?);
        let leaf_constants = self.constants(self.leaves)?;
        let constants = self.constants(self.leaves - 1)?;
        for index in 0..level.length {
            let pivot = self.passed.load::<N, 2>(level.passed + index)?;
            let kept = self.kept.load::<N, K>(level.kept + index)?;
            let motion = self.turns.motion(level.turns + index)?;
            let (acceleration, end) = P::turn(&constants, motion, kept, pivot);
            alpha(level.link(index), acceleration);
            let mut leaf = index;
            for _ in 0..below.copies {
                let motion = self.turns.motion(below.turns + leaf)?;
                alpha(below.link(leaf), P::turn_leaf(&leaf_constants, motion, end));
                leaf += level.length;
            }
        }
        Some(())
    }
}
