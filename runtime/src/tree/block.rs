//! Which links are computed together.

use core::ops::Range;

use super::strips::Strips;

/// The neighbours of one generation in a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Generation {
    /// Copies of this generation under each link of the one before.
    pub(super) copies: usize,
    /// How many links there are, and in the whole tree.
    pub(super) count: usize,
    pub(super) whole_count: usize,
    /// Where the first one stands in the block's arrays of all links, and in those
    /// of links with children.
    pub(super) own: usize,
    pub(super) slot: usize,
    /// Where the generation starts in the whole tree.
    pub(super) whole: usize,
    /// There they are so many strips of neighbours of this length, ...
    pub(super) strips: usize,
    pub(super) length: usize,
    /// ... so far apart.
    pub(super) stride: usize,
    /// From one neighbour to the next in the whole tree: 1, but for one link after the
    /// other of states in lanes.
    pub(super) step: usize,
    /// Where the generation before starts in the whole tree, and its number of links;
    /// none for the root.
    pub(super) above: Option<(usize, usize)>,
}

/// The generations of `width` neighbours in the first of some generations, and of their
/// children, copy by copy, and so on. In arrays of links with children, a generation
/// starts where a register of any width would, and has room for a whole one.
///
/// A block has arrays of its own, in which its links stand as if there were no
/// others.
pub(super) fn generations(
    copies: &[usize],
    starts: &[usize],
    counts: &[usize],
    first: usize,
    [width, widest]: [usize; 2],
) -> impl Iterator<Item = Generation> {
    let stride = counts.get(first).copied().unwrap_or(1).max(1);
    let (mut own, mut slot) = (0, 0);
    let rows = copies.iter().zip(starts).zip(counts).enumerate();
    rows.skip(first)
        .map(move |(generation, ((&copies, &whole), &whole_count))| {
            let count = whole_count / stride * width;
            let is_whole = width == stride;
            let one_by_one = widest == 1;
            let generation = Generation {
                copies,
                count,
                whole_count,
                own,
                slot,
                whole,
                strips: match is_whole || one_by_one {
                    true => 1,
                    false => count / width.max(1),
                },
                length: if is_whole || one_by_one { count } else { width },
                stride,
                step: if one_by_one { stride } else { 1 },
                above: generation
                    .checked_sub(1)
                    .and_then(|above| Some((*starts.get(above)?, *counts.get(above)?))),
            };
            own += count;
            slot += count.next_multiple_of(widest);
            generation
        })
}

impl Generation {
    /// Links of a tree of any shape, as if they were one.
    #[inline(always)]
    pub(super) fn of_links(links: Range<usize>) -> Self {
        let (start, links) = (links.start, links.len());
        Self {
            copies: 1,
            count: links,
            whole_count: links,
            own: start,
            slot: start,
            whole: start,
            strips: 1,
            length: links,
            stride: 1,
            step: 1,
            above: None,
        }
    }
}

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

/// Neighbours of a generation: where the first one stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Position {
    /// In the block's own arrays of all links.
    pub(super) own: usize,
    /// In its arrays of links with children.
    pub(super) slot: usize,
    /// In arrays of the whole tree.
    pub(super) whole: usize,
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
