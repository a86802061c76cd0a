//! Generations that are taken apart into blocks.

use alloc::vec::Vec;

use core::ops::Range;

use super::block::SubtreeBlock;
use super::generation::Generation;
use super::strips::Strips;
use crate::simd::WIDEST;

/// How a tree is taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Policy {
    /// Trees of up to so many links are computed in one block, and so many links in
    /// one.
    pub(super) whole: usize,
    /// So many links in a block if all of them have children: they take more numbers.
    pub(super) inner: usize,
    /// Neighbours in the first generation of a block.
    pub(super) width: usize,
    /// Numbers in the widest register.
    pub(super) widest: usize,
    /// True if all above the blocks of leaves is one block, however large; of a tree of any
    /// shape, if it is taken apart at all.
    pub(super) once: bool,
}

impl Policy {
    /// For one state: the numbers of a block fit into the second cache. The width is
    /// whole vectors, and strips that are long enough to be fetched ahead.
    pub(super) const ONE_STATE: Self = Self {
        whole: 8192,
        inner: 4096,
        width: 256,
        widest: WIDEST,
        once: false,
    };

    /// For states in lanes: the numbers that are handed on in one subtree stay, with its
    /// motion, in the first caches. A quarter or a half of it takes as long.
    pub(super) const STATES: Self = Self {
        whole: 127,
        inner: 127,
        width: 1,
        widest: 1,
        once: true,
    };

    /// Number of blocks of so many links. The last one also takes links that would be
    /// too few for a register.
    fn blocks(&self, links: usize) -> usize {
        links.saturating_sub(self.widest) / self.width + 1
    }
}

/// Of so many links, what is formed on the way up is kept for the way down: it fits
/// into the third cache.
const KEPT: usize = 1 << 18;

/// Of so many links without leaves or more, threads share the blocks.
const THREADED: usize = 1 << 14;

/// Some consecutive generations, in blocks that start with neighbours of the first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Partition {
    /// The first generation, and how many links it has.
    pub(super) first: usize,
    pub(super) count: usize,
    /// How many links there are in all of these generations.
    links: usize,
    /// How this was done.
    policy: Policy,
    /// True if blocks keep what is formed on the way up.
    pub(super) keeps: bool,
    /// True if the last generation of the tree is among them. If not, the generations of
    /// a block end with the generation behind.
    pub(super) has_leaves: bool,
    /// The generations of a block, and of the last one, which has another width.
    block: Generations,
    last: Generations,
}

/// The generations of a block.
#[derive(Clone, Debug, PartialEq)]
struct Generations {
    generations: Vec<Generation>,
    strips: Strips,
}

impl Generations {
    /// Of generations from the generation `first` on.
    fn new(generations: Vec<Generation>, first: usize, has_leaves: bool, widest: usize) -> Self {
        let inner = generations.len().saturating_sub(1);
        let strips = Strips::new(&generations, first, inner, has_leaves, widest);
        Self {
            generations,
            strips,
        }
    }
}

impl Partition {
    /// From a generation on with `count` links, and `links` in all of them; of the
    /// generations of so many neighbours.
    pub(super) fn new(
        first: usize,
        [count, links]: [usize; 2],
        has_leaves: bool,
        policy: Policy,
        generations: impl Fn(usize) -> Vec<Generation>,
    ) -> Self {
        let generations =
            |width| Generations::new(generations(width), first, has_leaves, policy.widest);
        Self {
            first,
            count,
            links,
            policy,
            keeps: links <= KEPT || policy.once,
            has_leaves,
            block: generations(policy.width.min(count)),
            last: generations(count - (policy.blocks(count) - 1) * policy.width),
        }
    }

    /// How many of so many threads are worth their while here.
    fn threads(&self, threads: usize) -> usize {
        match self.has_leaves || self.links >= THREADED {
            true => threads.max(1),
            false => 1,
        }
    }

    /// The links of the first generation that each of so many threads computes.
    pub(super) fn jobs(&self, threads: usize) -> impl Iterator<Item = Range<usize>> {
        let (count, Policy { width, widest, .. }) = (self.count, self.policy);
        let share = count.div_ceil(width).div_ceil(self.threads(threads));
        let each = share.max(1) * width;
        let starts = (0..count.saturating_sub(widest - 1).max(1)).step_by(each);
        starts.map(move |start| match count - start < each + widest {
            true => start..count,
            false => start..start + each,
        })
    }

    /// The blocks of the subtrees of these links of the first generation.
    pub(super) fn windows(
        &self,
        links: &Range<usize>,
    ) -> impl ExactSizeIterator<Item = SubtreeBlock<'_>> + use<'_> {
        let first = links.start;
        let blocks = 0..self.policy.blocks(links.len());
        blocks.map(move |block| self.window(first + block * self.policy.width))
    }

    /// The block that starts with a link.
    pub(super) fn window(&self, start: usize) -> SubtreeBlock<'_> {
        let rest = self.count - start;
        let Policy { width, widest, .. } = self.policy;
        let (
            width,
            Generations {
                generations,
                strips,
            },
        ) = match rest < width + widest {
            true => (rest, &self.last),
            false => (width, &self.block),
        };
        SubtreeBlock {
            generations,
            inner: generations.len().saturating_sub(1),
            has_leaves: self.has_leaves,
            start,
            width,
            widest,
            ends: false,
            strips,
        }
    }

    /// The largest block.
    pub(super) fn largest(&self) -> SubtreeBlock<'_> {
        let (first, last) = (self.window(0), self.policy.blocks(self.count) - 1);
        let last = self.window(last * self.policy.width);
        if first.width < last.width {
            last
        } else {
            first
        }
    }
}
