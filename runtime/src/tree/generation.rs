//! Generations, and where their links stand.

use core::ops::Range;

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
