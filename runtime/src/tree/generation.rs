//! Generations of a tree, and the positions of their links in arrays.

use core::ops::Range;

/// Links of one generation in a block; they are neighbours in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Generation {
    /// Number of copies of this generation under each link of the one before.
    pub(super) copies: usize,
    /// Number of links of the generation in the block, and in the whole tree.
    pub(super) count: usize,
    pub(super) whole_count: usize,
    /// Index of the generation's first link in the block's array of all links, and in its array of
    /// links with children.
    pub(super) own: usize,
    pub(super) slot: usize,
    /// Index of the generation's first link in the arrays of the whole tree.
    pub(super) whole: usize,
    /// Number of strips (runs of neighbouring links) of the generation in the whole tree, and their
    /// length.
    pub(super) strips: usize,
    pub(super) length: usize,
    /// Distance between the starts of two strips in the arrays of the whole tree.
    pub(super) stride: usize,
    /// Distance between neighbouring links in the arrays of the whole tree: 1, except for many
    /// states in lanes, whose links are computed one by one.
    pub(super) step: usize,
    /// Generation before this one: index of its first link in the whole tree, and its number of
    /// links; `None` for the root.
    pub(super) above: Option<(usize, usize)>,
}

/// Iterates over the generations of a block: `width` neighbouring links in the first generation,
/// then all of their children, copy by copy, and so on. In arrays of links with children, each
/// generation starts at a boundary of the widest register and is padded to whole registers.
///
/// A block has its own arrays, which contain its links only.
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
    /// Returns a range of links of a tree of any shape, treated as one generation.
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

/// Position of neighbouring links of a generation in the arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Position {
    /// Index in the block's arrays of all links.
    pub(super) own: usize,
    /// Index in the block's arrays of links with children.
    pub(super) slot: usize,
    /// Index in the arrays of the whole tree.
    pub(super) whole: usize,
}
