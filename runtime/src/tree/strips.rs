//! Which neighbours are computed together, and where their numbers stand.

use alloc::vec::Vec;
use core::ops::Range;

use super::generation::{Generation, Position};
use super::heights::Heights;
use super::heights::SmallSubtrees;

/// Neighbours of one generation, and their children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strip {
    /// Their generation.
    pub(super) generation: usize,
    /// How many they are.
    pub(super) length: usize,
    /// Where the first one stands.
    pub(super) first: Position,
    /// Where the first copy of its children stands, how many copies there are, and
    /// how far it is from one to the next ...
    pub(super) child: Position,
    pub(super) copies: usize,
    /// ... in the block's own arrays, and in arrays of the whole tree.
    pub(super) apart: usize,
    pub(super) whole_apart: usize,
    /// From one link to the next in arrays of the whole tree.
    pub(super) step: usize,
    /// True if the children are leaves.
    pub(super) leaves: bool,
    /// A register with at least so many lanes holds all children, one by one behind
    /// each other, and the next strip is theirs.
    pub(super) lanes: usize,
    /// Where children are found by attachments, those of these links to their
    /// parents: from one number to another. There, `copies` is 0 for links without
    /// children, and 1 otherwise.
    pub(super) attachments: (usize, usize),
}

impl Strip {
    /// Where the sums of a link stand, of a tree of any shape.
    #[inline(always)]
    pub(super) fn slot(&self, link: usize) -> usize {
        link - self.first.own + self.first.slot
    }
}

impl Strip {
    /// Links of one height in a tree of any shape, with those attachments.
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

/// Neighbours whose parents are neighbours in the same order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Attachment {
    /// The first parent, and its first child.
    pub(super) parent: usize,
    pub(super) child: usize,
    /// Where the sums of the first parent stand.
    pub(super) slot: usize,
    /// Number of children.
    pub(super) length: usize,
    /// No child of these parents has been attached before.
    pub(super) first: bool,
}

impl Attachment {
    /// Returns true if a child of this parent follows the ones here.
    fn goes_on(&self, parent: usize, first: bool) -> bool {
        self.first == first && parent == self.parent + self.length
    }
}

/// The links with children of a block, strip by strip from its first generation on.
///
/// Strips are the same for all blocks of a partition, but for where these start in arrays of
/// the whole tree. What has seen once that [`reach`](Self::reach) numbers are there
/// needs no other question: strips are made here alone, and none goes beyond.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strips {
    list: Vec<Strip>,
    attachments: Vec<Attachment>,
    /// Of a tree of any shape: what goes up at once, the last one first.
    subtrees: Vec<SmallSubtrees>,
    reach: Reach,
    branching: usize,
}

/// How many numbers there have to be, registers of any width behind the last ones
/// included but for arrays of the whole tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Reach {
    /// In a block's arrays of all links.
    pub(super) own: usize,
    /// In its arrays of links with children.
    pub(super) slot: usize,
    /// In arrays of the whole tree from the block's start on.
    pub(super) whole: usize,
}

impl Strips {
    /// Of generations from the generation `first` on, `inner` of which are computed and
    /// have children: leaves below the last of them, or links of other blocks.
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

    /// The strips of a tree of any shape, with one parent a link, which stands before
    /// it in the order of the strips.
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

    /// How many copies of children there are, if they are as many for all strips;
    /// otherwise 0.
    #[inline(always)]
    pub(super) fn branching(&self) -> usize {
        self.branching
    }

    /// For all of them.
    #[inline(always)]
    pub(super) fn reach(&self) -> Reach {
        self.reach
    }
}

impl Reach {
    /// Reaches as far as one strip more.
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

    /// Goes over the last place of every width in every copy, one number after the other.
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
