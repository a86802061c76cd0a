//! Strips: neighbouring links that are computed together, and the positions of their numbers.

use alloc::vec::Vec;
use core::ops::Range;

use super::generation::{Generation, Position};
use super::heights::Heights;
use super::heights::SmallSubtrees;

/// Strip: neighbouring links of one generation, and their children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strip {
    /// Index of their generation.
    pub(super) generation: usize,
    /// Number of links.
    pub(super) length: usize,
    /// Position of the first link.
    pub(super) first: Position,
    /// Position of the first child of the first link; meaningless if there are no children.
    pub(super) child: Position,
    pub(super) copies: usize,
    /// Distance between two copies of the children in the block's own arrays.
    pub(super) apart: usize,
    pub(super) whole_apart: usize,
    /// Distance between neighbouring links in the arrays of the whole tree.
    pub(super) step: usize,
    /// True if the children are leaves.
    pub(super) leaves: bool,
    /// Smallest number of lanes of a register that holds all children of the strip, if these form
    /// the next strip.
    pub(super) lanes: usize,
    /// Range of the attachments (runs of children) that connect these links to their parents, for
    /// trees of any shape. `copies` is then 0 for links without children and 1 otherwise.
    pub(super) attachments: (usize, usize),
}

impl Strip {
    /// Returns the index of a link's sums in the workspace, for a tree of any shape.
    #[inline(always)]
    pub(super) fn slot(&self, link: usize) -> usize {
        link - self.first.own + self.first.slot
    }
}

impl Strip {
    /// Creates the strip of links of one height in a tree of any shape, with their attachments.
    fn of_height(
        links: Range<usize>,
        slot: usize,
        has_child: bool,
        attachments: (usize, usize),
    ) -> Self {
        let place = Position {
            own: links.start,
            slot,
            whole: links.start,
        };
        Self {
            generation: 0,
            length: links.len(),
            first: place,
            child: place,
            copies: usize::from(has_child),
            apart: 0,
            whole_apart: 0,
            step: 1,
            leaves: false,
            lanes: usize::MAX,
            attachments,
        }
    }
}

/// Attachment: neighbouring links whose parents are neighbours in the same order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Attachment {
    /// Index of the first parent, and of its first child.
    pub(super) parent: usize,
    pub(super) child: usize,
    /// Index of the first parent's sums in the workspace.
    pub(super) slot: usize,
    /// Number of children.
    pub(super) length: usize,
    /// True if these are the first children that are attached to their parents, so that the sums
    /// are set instead of increased.
    pub(super) first: bool,
}

impl Attachment {
    /// Returns true if the next child, with the parent `parent`, continues this attachment.
    fn goes_on(&self, parent: usize, first: bool) -> bool {
        self.first == first && parent == self.parent + self.length
    }
}

/// Links with children of a block, strip by strip from its first generation on.
///
/// All blocks of a partition have the same strips, except for their start in arrays of the whole
/// tree. Strips are created only here, and none exceeds [`reach`](Self::reach), so that a caller
/// that has checked this length once needs no other check.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strips {
    list: Vec<Strip>,
    attachments: Vec<Attachment>,
    /// For a tree of any shape: groups of subtrees that are computed together in the upward pass,
    /// the last group first.
    subtrees: Vec<SmallSubtrees>,
    reach: Reach,
    branching: usize,
}

/// Lengths of arrays that the strips of a block require. They include a register of any width after
/// the last link, except in arrays of the whole tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Reach {
    /// Length of the block's arrays with one number per link.
    pub(super) own: usize,
    /// Length of the block's arrays with one number per link with children.
    pub(super) slot: usize,
    /// Length of the arrays of the whole tree, counted from the block's start.
    pub(super) whole: usize,
}

impl Strips {
    /// Creates the strips of a block's generations, which start with generation `first` of the
    /// tree. `inner` of them are computed in this block and have children: leaves, or links of
    /// other blocks.
    pub(super) fn new(
        generations: &[Generation],
        first: usize,
        inner: usize,
        has_leaves: bool,
        widest: usize,
    ) -> Self {
        let mut list = Vec::new();
        let mut reach = Reach::default();
        let computed = inner.min(generations.len().saturating_sub(1));
        for (number, pair) in generations.windows(2).take(computed).enumerate() {
            let [generation, below] = pair else { continue };
            let last = number + 1 == computed;
            let leaves = last && has_leaves;
            let lanes = match last || below.strips > 1 {
                true => usize::MAX,
                false => below.count,
            };
            for span in 0..generation.strips {
                let own = span * generation.length;
                let strip = Strip {
                    generation: first + number,
                    length: generation.length,
                    first: Position {
                        own: generation.own + own,
                        slot: generation.slot + own,
                        whole: generation.whole + span * generation.stride,
                    },
                    child: Position {
                        own: below.own + own,
                        slot: below.slot + own,
                        whole: below.whole + span * generation.stride,
                    },
                    copies: below.copies,
                    apart: generation.count,
                    whole_apart: generation.whole_count,
                    step: generation.step,
                    leaves,
                    lanes,
                    attachments: (0, 0),
                };
                reach.take(&strip, widest);
                list.push(strip);
            }
        }
        let copies = list.first().map_or(0, |strip| strip.copies);
        let branching = match list.iter().all(|strip| strip.copies == copies) {
            true => copies,
            false => 0,
        };
        Self {
            list,
            attachments: Vec::new(),
            subtrees: Vec::new(),
            reach,
            branching,
        }
    }

    /// Creates the strips of a tree of any shape, from the order of its links by height.
    pub(super) fn by_height(heights: &Heights, widest: usize) -> Self {
        let Heights {
            parents,
            strips,
            subtrees,
            ..
        } = heights;
        let links = parents.len();
        let slots = heights.slots();
        let mut list = Vec::with_capacity(strips.len());
        let mut attachments: Vec<Attachment> = Vec::new();
        let mut has_child = alloc::vec![false; links];
        for &Range { start, end } in strips.iter().rev() {
            let from = attachments.len();
            // The root has no parent.
            let children = start.max(1)..end;
            let own = parents.get(children.clone()).unwrap_or_default();
            for (child, &parent) in children.zip(own) {
                let parent = parent as usize;
                let first = !has_child[parent];
                let last = attachments.get_mut(from..);
                match last.and_then(<[Attachment]>::last_mut) {
                    Some(last) if last.goes_on(parent, first) => last.length += 1,
                    _ => attachments.push(Attachment {
                        parent,
                        child,
                        slot: slots[parent],
                        length: 1,
                        first,
                    }),
                }
                has_child[parent] = true;
            }
            let own = (from, attachments.len());
            list.push(Strip::of_height(
                start..end,
                slots[start],
                has_child[start],
                own,
            ));
        }
        list.reverse();
        Self {
            list,
            attachments,
            subtrees: subtrees.clone(),
            reach: Reach {
                own: links + widest,
                slot: links + widest,
                whole: links,
            },
            branching: 0,
        }
    }

    #[inline(always)]
    pub(super) fn subtrees(&self) -> &[SmallSubtrees] {
        &self.subtrees
    }

    #[inline(always)]
    pub(super) fn attachments(&self) -> &[Attachment] {
        &self.attachments
    }

    #[inline(always)]
    pub(super) fn list(&self) -> &[Strip] {
        &self.list
    }

    /// Returns the number of copies of children if it is the same for all strips, otherwise 0.
    #[inline(always)]
    pub(super) fn branching(&self) -> usize {
        self.branching
    }

    /// Returns the lengths of arrays that the strips require.
    #[inline(always)]
    pub(super) fn reach(&self) -> Reach {
        self.reach
    }
}

impl Reach {
    /// Increases the required lengths for one more strip.
    fn take(&mut self, strip: &Strip, widest: usize) {
        let others = strip.copies.saturating_sub(1);
        let in_register = strip.length.max(widest);
        let (child, last) = (strip.child, others * strip.apart + in_register);
        let spread = strip.length.saturating_sub(1) * strip.step + 1;
        self.own = self.own.max(strip.first.own + in_register);
        self.slot = self.slot.max(strip.first.slot + in_register);
        self.whole = self.whole.max(strip.first.whole + spread);
        if strip.leaves {
            self.own = self.own.max(child.own + last);
            let last = others * strip.whole_apart + spread;
            self.whole = self.whole.max(child.whole + last);
        } else {
            self.slot = self.slot.max(child.slot + last);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::WIDEST;
    use crate::tree::generation::generations;

    /// Checks for registers of every width that the last position of each copy is within the
    /// arrays, number by number.
    fn all_places_are_within_reach(copies: &[usize], first: usize, width: usize) {
        let (mut counts, mut starts, mut links) = (Vec::new(), Vec::new(), 0);
        for &copies in copies {
            let count = counts.last().map_or(1, |count| count * copies);
            counts.push(count);
            starts.push(links);
            links += count;
        }
        let generations: Vec<Generation> =
            generations(copies, &starts, &counts, first, [width, WIDEST]).collect();
        let inner = generations.len() - 1;
        for has_leaves in [false, true] {
            let strips = Strips::new(&generations, first, inner, has_leaves, WIDEST);
            let reach = strips.reach();
            let neighbours: usize = generations[..inner]
                .iter()
                .map(|generation| generation.count)
                .sum();
            let listed: usize = strips.list().iter().map(|strip| strip.length).sum();
            assert_eq!(listed, neighbours, "{copies:?}");
            let mut ends = Reach::default();
            for strip in strips.list() {
                for lanes in [1, 2, 4, 8, WIDEST] {
                    let last = strip.length.saturating_sub(lanes);
                    ends.own = ends.own.max(strip.first.own + last + lanes);
                    ends.slot = ends.slot.max(strip.first.slot + last + lanes);
                    ends.whole = ends.whole.max(strip.first.whole + strip.length);
                    for copy in 0..strip.copies {
                        let (own, whole) = (copy * strip.apart, copy * strip.whole_apart);
                        if strip.leaves {
                            ends.own = ends.own.max(strip.child.own + own + last + lanes);
                            ends.whole = ends.whole.max(strip.child.whole + whole + strip.length);
                        } else {
                            ends.slot = ends.slot.max(strip.child.slot + own + last + lanes);
                        }
                    }
                }
            }
            assert!(
                ends.own <= reach.own && ends.slot <= reach.slot && ends.whole == reach.whole,
                "{copies:?}: {ends:?} {reach:?}"
            );
            // The last block starts `width` links before the end of its generation.
            let last = counts[first] - width;
            assert!(last + reach.whole <= links, "{copies:?}: {reach:?}");
        }
    }

    #[test]
    fn no_run_goes_beyond_what_is_asked_for() {
        all_places_are_within_reach(&[1, 2], 0, 1);
        all_places_are_within_reach(&[1, 5, 1, 2], 0, 1);
        all_places_are_within_reach(&[1, 2, 2, 2, 2, 2, 2, 2], 0, 1);
        all_places_are_within_reach(&[1, 17, 3, 2], 1, 17);
        all_places_are_within_reach(&[1, 600, 14, 11, 4], 1, 256);
        all_places_are_within_reach(&[1, 600, 14, 11, 4], 3, 271);
    }
}
