//! Blocks of a large tree: sets of links that are computed together so that their numbers fit into
//! the cache.

use super::generation::{Generation, Position};
use super::strips::Strips;

/// Block of a tree: consecutive generations of the subtrees of neighbouring links.
#[derive(Clone, Copy, Debug)]
pub(super) struct SubtreeBlock<'a> {
    /// Generations of the block, followed by the children of the last one, if it has any.
    pub(super) generations: &'a [Generation],
    /// Number of generations with children.
    pub(super) inner: usize,
    /// True if the last generation of the block is followed by a generation of leaves.
    pub(super) has_leaves: bool,
    /// Index of the first of the neighbouring links within its generation.
    pub(super) start: usize,
    pub(super) width: usize,
    /// Number of lanes of the widest vector register that computes the block.
    pub(super) widest: usize,
    /// True if the accelerations are written directly after the upward pass.
    pub(super) ends: bool,
    /// Strips (links that are computed together) among the links with children.
    pub(super) strips: &'a Strips,
}

impl<'a> SubtreeBlock<'a> {
    /// Returns the generations whose links are computed in this block.
    pub(super) fn own_generations(&self) -> &'a [Generation] {
        let count = self.inner + usize::from(self.has_leaves);
        self.generations.get(..count).unwrap_or_default()
    }

    /// Returns the number of links.
    pub(super) fn links(&self) -> usize {
        let last = self.own_generations().last();
        last.map_or(0, |last| last.own + last.count)
    }

    /// Returns the number of entries for links with children, including those whose children are
    /// computed elsewhere.
    pub(super) fn slots(&self) -> usize {
        let count = self.generations.len();
        let count = count.saturating_sub(usize::from(self.has_leaves));
        let last = self.generations.get(..count).and_then(<[Generation]>::last);
        last.map_or(0, |last| {
            last.slot + last.count.next_multiple_of(self.widest)
        })
    }

    /// Returns true if the block contains all links of each of its generations.
    #[inline(always)]
    pub(super) fn is_whole(&self) -> bool {
        let first = self.generations.first();
        first.is_none_or(|first| first.stride == self.width)
    }

    /// Returns the distance from the links of this block to the links of the next block; `None` if
    /// this block is the whole tree.
    #[inline(always)]
    pub(super) fn ahead(&self) -> Option<usize> {
        (!self.is_whole()).then_some(self.width)
    }

    /// Returns the position, in the arrays, of the first link of a strip.
    #[inline(always)]
    pub(super) fn place(&self, generation: &Generation, strip: usize) -> Position {
        let own = strip * generation.length;
        Position {
            own: generation.own + own,
            slot: generation.slot + own,
            whole: generation.whole + self.start + strip * generation.stride,
        }
    }

    /// Iterates over the links of the block as spans of neighbours: start in the block's arrays,
    /// start in the arrays of the whole tree, and length. A whole tree is one span.
    #[inline(always)]
    pub(super) fn spans(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let whole = self.is_whole();
        let generations = match whole {
            true => self.generations.get(..1).unwrap_or_default(),
            false => self.own_generations(),
        };
        let links = self.links();
        generations.iter().flat_map(move |generation| {
            (0..generation.strips).map(move |strip| {
                let Position { own, whole: at, .. } = self.place(generation, strip);
                (own, at, if whole { links } else { generation.length })
            })
        })
    }
}
