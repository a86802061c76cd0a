//! Which links are computed together.

use super::generation::{Generation, Position};
use super::strips::Strips;

/// Consecutive generations of the subtrees of neighbouring links.
#[derive(Clone, Copy, Debug)]
pub(super) struct SubtreeBlock<'a> {
    /// The generations, and where the last one's links have children, these.
    pub(super) generations: &'a [Generation],
    /// How many generations have children.
    pub(super) inner: usize,
    /// True if there is one more, of leaves.
    pub(super) has_leaves: bool,
    /// The first of the neighbours, counted in its generation.
    pub(super) start: usize,
    pub(super) width: usize,
    /// Numbers in the widest register that computes it.
    pub(super) widest: usize,
    /// True if its results are written once it has gone up.
    pub(super) ends: bool,
    /// Links with children.
    pub(super) strips: &'a Strips,
}

impl<'a> SubtreeBlock<'a> {
    /// The generations whose links are computed here.
    pub(super) fn own_generations(&self) -> &'a [Generation] {
        let count = self.inner + usize::from(self.has_leaves);
        self.generations.get(..count).unwrap_or_default()
    }

    /// Number of links.
    pub(super) fn links(&self) -> usize {
        let last = self.own_generations().last();
        last.map_or(0, |last| last.own + last.count)
    }

    /// How many places links with children take, with those of children that are
    /// not computed here.
    pub(super) fn slots(&self) -> usize {
        let count = self.generations.len();
        let count = count.saturating_sub(usize::from(self.has_leaves));
        let last = self.generations.get(..count).and_then(<[Generation]>::last);
        last.map_or(0, |last| {
            last.slot + last.count.next_multiple_of(self.widest)
        })
    }

    /// Returns true if it takes all links of its generations.
    #[inline(always)]
    pub(super) fn is_whole(&self) -> bool {
        let first = self.generations.first();
        first.is_none_or(|first| first.stride == self.width)
    }

    /// How far the links of the next block are, where this one is not the whole.
    #[inline(always)]
    pub(super) fn ahead(&self) -> Option<usize> {
        (!self.is_whole()).then_some(self.width)
    }

    /// Where the first link of a strip stands.
    #[inline(always)]
    pub(super) fn place(&self, generation: &Generation, strip: usize) -> Position {
        let own = strip * generation.length;
        Position {
            own: generation.own + own,
            slot: generation.slot + own,
            whole: generation.whole + self.start + strip * generation.stride,
        }
    }

    /// All links in spans of neighbours: where one starts in the block's own arrays
    /// and in the whole tree's, and how many there are. A whole tree is one.
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
