//! What a walk through a table, depth first, keeps and passes on.

use super::packing::{Packing, Rows};
use super::turns::{self, Turns};
use crate::generations::links::Shape;
use crate::generations::memory::take;
use crate::scalar::Scalar;

/// Values that it needs room for.
pub(super) fn room<const S: usize, const E: usize, const K: usize>(
    shape: &Shape,
    joints: bool,
) -> usize {
    let links = shape.parents.len();
    turns::room(links, joints) + links * K + shape.levels() * (S + E)
}

/// The motions of all links; `K` values kept of each with children, in the order of
/// the way up; and by depth, of the one link that is being worked on there: the sum of
/// its children's `S` values, and on the way down `E` values for its children.
pub(super) struct Stack<'a, N: Packing, const S: usize, const E: usize, const K: usize> {
    pub(super) turns: Turns<'a, N>,
    sums: Rows<'a, N::Number, S>,
    ends: Rows<'a, N::Number, E>,
    kept: Rows<'a, N::Number, K>,
    /// Rows of `kept` in use.
    height: usize,
}

impl<'a, N: Packing, const S: usize, const E: usize, const K: usize> Stack<'a, N, S, E, K> {
    /// Forms the motions; none where the room is too small.
    #[inline(always)]
    pub(super) fn new(
        shape: &Shape,
        joints: bool,
        mut room: &'a mut [N::Number],
        theta: &impl Fn(usize) -> N::Value,
        omega: &impl Fn(usize) -> N::Value,
    ) -> Option<Self> {
        let (links, levels, room) = (shape.parents.len(), shape.levels(), &mut room);
        let mut sums = Rows(take(room, levels * S * N::COUNT));
        for depth in 0..levels {
            sums.store::<N, S>(depth, [N::Value::from_f64(0.0); S])?;
        }
        let ends = Rows(take(room, levels * E * N::COUNT));
        let kept = Rows(take(room, links * K * N::COUNT));
        let mut turns = Turns::new(core::mem::take(room), joints);
        turns.form_all(shape, theta, omega)?;
        Some(Self {
            turns,
            sums,
            ends,
            kept,
            height: 0,
        })
    }

    /// The sum for a link of this depth; nothing is left for the next one.
    #[inline(always)]
    pub(super) fn below(&mut self, depth: usize) -> Option<[N::Value; S]> {
        let below = self.sums.load::<N, S>(depth)?;
        self.sums
            .store::<N, S>(depth, [N::Value::from_f64(0.0); S])?;
        Some(below)
    }

    /// Joins a child to the sum for a link of this depth, value by value.
    #[inline(always)]
    pub(super) fn join(
        &mut self,
        depth: usize,
        child: impl Fn(usize, N::Value) -> N::Value,
    ) -> Option<()> {
        let mut sums = self.sums.load::<N, S>(depth)?;
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = child(i, *sum);
        }
        self.sums.store::<N, S>(depth, sums)
    }

    #[inline(always)]
    pub(super) fn push(&mut self, kept: [N::Value; K]) -> Option<()> {
        self.height += 1;
        self.kept.store::<N, K>(self.height - 1, kept)
    }

    /// What was kept last.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<[N::Value; K]> {
        self.height = self.height.checked_sub(1)?;
        self.kept.load::<N, K>(self.height)
    }

    /// Passes values on to the children of a link of this depth.
    #[inline(always)]
    pub(super) fn hand(&mut self, depth: usize, values: [N::Value; E]) -> Option<()> {
        self.ends.store::<N, E>(depth, values)
    }

    /// What the link of this depth has passed on.
    #[inline(always)]
    pub(super) fn handed(&self, depth: usize) -> Option<[N::Value; E]> {
        self.ends.load::<N, E>(depth)
    }
}
