//! Partition of generations into blocks.

use alloc::vec::Vec;

use core::ops::Range;

use super::block::SubtreeBlock;
use super::generation::Generation;
use super::strips::Strips;
use crate::simd::WIDEST;

/// Sizes that determine how a tree is divided into blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Policy {
    /// Largest number of links of a tree that is computed as one block; also the largest number of
    /// links of a block.
    pub(super) whole: usize,
    /// Largest number of links of a block without leaves. Links with children need more numbers
    /// than leaves.
    pub(super) inner: usize,
    /// Number of neighbouring links in the first generation of a block.
    pub(super) width: usize,
    /// Number of lanes of the widest vector register.
    pub(super) widest: usize,
    /// True if everything above the blocks that contain the leaves is one block of any size. For a
    /// tree of any shape, true if the tree is divided at all.
    pub(super) once: bool,
}

impl Policy {
    /// Sizes for the evaluation of one state: the numbers of a block fit into the second-level
    /// cache. The width is a multiple of all vector lengths, and strips are long enough for
    /// prefetching.
    pub(super) const ONE_STATE: Self = Self {
        whole: 8192,
        inner: 4096,
        width: 256,
        widest: WIDEST,
        once: false,
    };

    /// Sizes for many states in lanes: the numbers of one subtree and its motion stay in the
    /// first-level cache. A quarter or half of this size is equally fast.
    pub(super) const STATES: Self = Self {
        whole: 127,
        inner: 127,
        width: 1,
        widest: 1,
        once: true,
    };

    /// Returns the number of blocks into which `links` neighbouring links of a generation are
    /// divided. If too few links for a register remain, the last block takes them too.
    fn blocks(&self, links: usize) -> usize {
        links.saturating_sub(self.widest) / self.width + 1
    }
}

/// Largest number of links for which the results of the upward pass are kept for the downward pass,
/// because they fit into the third-level cache.
const KEPT: usize = 1 << 18;

/// Number of links, without leaves, from which on several threads share the blocks.
const THREADED: usize = 1 << 14;

/// Consecutive generations of a tree, divided into blocks. Each block starts with neighbouring
/// links of the first of these generations.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Partition {
    /// Index of the partition's first generation, and the number of links of that generation.
    pub(super) first: usize,
    pub(super) count: usize,
    /// Number of links in all generations of the partition.
    links: usize,
    /// Sizes by which the blocks were chosen.
    policy: Policy,
    /// True if blocks keep the results of the upward pass for the downward pass.
    pub(super) keeps: bool,
    /// True if the tree's last generation belongs to the partition. If not, the last generation of
    /// each block is the first one of the next partition.
    pub(super) has_leaves: bool,
    /// Generations of a block, and of the last block, which may contain another number of links.
    block: Generations,
    last: Generations,
}

/// Generations of a block, with their strips.
#[derive(Clone, Debug, PartialEq)]
struct Generations {
    generations: Vec<Generation>,
    strips: Strips,
}

impl Generations {
    /// Creates the value from the generations of a block, which start with generation `first` of
    /// the tree.
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
    /// Creates the partition. Its first generation has `count` links, all its generations together
    /// have `links` links.
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

    /// Returns how many of the available threads to use for this partition.
    fn threads(&self, threads: usize) -> usize {
        match self.has_leaves || self.links >= THREADED {
            true => threads.max(1),
            false => 1,
        }
    }

    /// Iterates over the threads, and returns for each the links of the first generation whose
    /// blocks it computes.
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

    /// Iterates over the blocks that start with the links `links` of the first generation.
    pub(super) fn windows(
        &self,
        links: &Range<usize>,
    ) -> impl ExactSizeIterator<Item = SubtreeBlock<'_>> + use<'_> {
        let first = links.start;
        let blocks = 0..self.policy.blocks(links.len());
        blocks.map(move |block| self.window(first + block * self.policy.width))
    }

    /// Returns the block whose first link is link `start` of the first generation.
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

    /// Returns the largest block.
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
