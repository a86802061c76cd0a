//! How a tree in generations is taken apart for many states.

use crate::generations::part::Stage;
use crate::generations::plan::Plan;

/// Subtrees of up to so many links: what is passed on in one, with its motion, stays
/// in the first caches. A quarter or a half of it takes as long.
const LINKS: usize = 127;

/// Consecutive generations below one link: a subtree, or what is above all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'a> {
    stages: &'a [Stage],
    /// Its generations with children, from that of its first link on.
    first: usize,
    pub(super) inner: usize,
    /// Number of the first link in its generation, and how many there are.
    start: usize,
    stride: usize,
    /// The first rows of its links, in arrays of all links, of those with children,
    /// and of what is passed on.
    turns: usize,
    kept: usize,
    passed: usize,
}

/// The links of one generation of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// Copies of them under each link of the generation before.
    pub(super) copies: usize,
    pub(super) length: usize,
    /// The first one in the tree, and how far the next is.
    link: usize,
    stride: usize,
    /// Rows of the first one.
    pub(super) turns: usize,
    pub(super) kept: usize,
    pub(super) passed: usize,
}

impl Level {
    /// Number of a link in the tree.
    #[inline(always)]
    pub(super) fn link(&self, index: usize) -> usize {
        self.link + index * self.stride
    }
}

impl Piece<'_> {
    #[inline(always)]
    pub(super) fn level(&self, generation: usize) -> Option<Level> {
        let (stage, first) = (self.stages.get(generation)?, self.stages.get(self.first)?);
        let stride = self.stride.max(1);
        let before = (stage.whole - first.whole) / stride;
        Some(Level {
            copies: stage.copies,
            length: stage.count / stride,
            link: stage.whole + self.start,
            stride,
            turns: self.turns + before,
            kept: self.kept + before,
            passed: self.passed + before,
        })
    }

    /// Generations with children, from the root on.
    #[inline(always)]
    pub(super) fn generations(&self) -> core::ops::Range<usize> {
        self.first..self.inner
    }

    /// Where its first link stands in the generation before; none for the root.
    #[inline(always)]
    pub(super) fn above(&self) -> Option<usize> {
        let above = self.stages.get(self.first.checked_sub(1)?)?;
        Some(above.whole + self.start % above.count.max(1))
    }
}

/// The pieces of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pieces<'a> {
    stages: &'a [Stage],
    /// The generation in which the subtrees start.
    pub(super) cut: usize,
    /// The links above, how many subtrees there are, and the links of one, and those
    /// with children.
    pub(super) above: usize,
    pub(super) count: usize,
    pub(super) links: usize,
    inner: usize,
}

impl<'a> Pieces<'a> {
    /// None for a tree of one generation. Not for use where registers are full: it
    /// is called.
    #[inline(never)]
    pub(super) fn new(plan: &'a Plan) -> Option<Self> {
        let stages = plan.stages();
        let stems = stages.len().checked_sub(2)?;
        let all = plan.links();
        let links = |stage: &Stage| (all - stage.whole) / stage.count.max(1);
        let small = |stage: &Stage| links(stage) <= LINKS;
        let cut = stages
            .iter()
            .position(small)
            .map_or(stems, |cut| cut.min(stems));
        let (stage, last) = (stages.get(cut)?, stages.last()?);
        Some(Self {
            stages,
            cut,
            above: stage.whole,
            count: stage.count,
            links: links(stage),
            inner: (last.whole - stage.whole) / stage.count.max(1),
        })
    }

    /// Rows for all links with children.
    pub(super) fn kept(&self) -> usize {
        self.above + self.count * self.inner
    }

    /// Rows for what is passed on: above the subtrees, of their first links, and in one
    /// of them.
    pub(super) fn passed(&self) -> usize {
        self.above + self.count + self.inner
    }

    /// Generations of leaves.
    #[inline(always)]
    pub(super) fn leaves(&self) -> usize {
        self.stages.len() - 1
    }

    /// What is above the subtrees.
    #[inline(always)]
    pub(super) fn top(&self) -> Piece<'a> {
        Piece {
            stages: self.stages,
            first: 0,
            inner: self.cut,
            start: 0,
            stride: 1,
            turns: 0,
            kept: 0,
            passed: 0,
        }
    }

    #[inline(always)]
    pub(super) fn subtree(&self, index: usize) -> Piece<'a> {
        Piece {
            stages: self.stages,
            first: self.cut,
            inner: self.leaves(),
            start: index,
            stride: self.count,
            turns: self.above + index * self.links,
            kept: self.above + index * self.inner,
            passed: self.above + self.count,
        }
    }
}
