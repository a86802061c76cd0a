//! Order of the links of a tree of any shape by height, the distance to the deepest leaf below.

use alloc::vec::Vec;
use core::ops::Range;

/// Group of small neighbouring subtrees of a tree of any shape: the links whose sines and cosines
/// are computed together, and the strips of the upward pass that follows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SmallSubtrees {
    pub(super) links: Range<usize>,
    pub(super) strips: Range<usize>,
}

/// Links from the root on, ordered by height: the distance to the deepest leaf below.
///
/// Among links of one height, links whose children have the same heights are neighbours, and
/// children are in the order of their parents. Then long runs of links have long runs of children,
/// and fewer runs have to be joined.
pub(super) struct Heights {
    /// Index of the link at each position.
    pub(super) order: Vec<u32>,
    /// Position of the parent of the link at each position; 0 for the root.
    pub(super) parents: Vec<u32>,
    /// Ranges of positions that form a strip, each after the strips of its parents.
    pub(super) strips: Vec<Range<usize>>,
    /// Groups of subtrees that are computed together in the upward pass, the last group first.
    pub(super) subtrees: Vec<SmallSubtrees>,
    /// Number of links, counted from the root, whose sines and cosines are computed before those of
    /// all others.
    pub(super) above: usize,
}

impl Heights {
    /// Sorts the links of a tree, given the parent of each link. Parents must come before their
    /// children; a parent that does not is replaced by the link before.
    pub(super) fn new(parents: &[u32]) -> Self {
        let parent = |link: usize| {
            let before = link.saturating_sub(1);
            parents
                .get(link)
                .map_or(0, |&parent| before.min(parent as usize))
        };
        let links = parents.len();
        let mut heights = alloc::vec![0_usize; links];
        let mut children: Vec<Vec<usize>> = alloc::vec![Vec::new(); links];
        for link in (1..links).rev() {
            let above = parent(link);
            heights[above] = heights[above].max(heights[link] + 1);
            children[above].push(link);
        }
        let mut kinds: Vec<Vec<usize>> = Vec::with_capacity(links);
        for children in &mut children {
            // The highest first; among equal ones, the first link.
            children.reverse();
            children.sort_by_key(|&child| core::cmp::Reverse(heights[child]));
            kinds.push(children.iter().map(|&child| heights[child]).collect());
        }
        let mut strips = alloc::vec![Vec::new(); heights.first().map_or(0, |&root| root + 1)];
        if let Some(top) = strips.last_mut() {
            top.push(0);
        }
        let mut order = Vec::with_capacity(links);
        let mut ranges = Vec::new();
        while let Some(mut strip) = strips.pop() {
            // Links with more children first: among neighbouring parents, those with one more child
            // are then the first ones.
            strip.sort_by(|&one: &usize, &other: &usize| kinds[other].cmp(&kinds[one]));
            let most = strip.iter().map(|&link| children[link].len()).max();
            for number in 0..most.unwrap_or(0) {
                for &link in &strip {
                    if let Some(&child) = children[link].get(number) {
                        strips[heights[child]].push(child);
                    }
                }
            }
            ranges.push(order.len()..order.len() + strip.len());
            order.append(&mut strip);
        }
        let mut places = alloc::vec![0_u32; links];
        for (place, &link) in (0..).zip(&order) {
            places[link] = place;
        }
        Self {
            parents: order.iter().map(|&link| places[parent(link)]).collect(),
            order: order.iter().map(|&link| link as u32).collect(),
            subtrees: alloc::vec![SmallSubtrees {
                links: 0..links,
                strips: 0..ranges.len(),
            }],
            strips: ranges,
            above: 0,
        }
    }

    /// Returns for each link the index of the sum of its children's responses in the workspace.
    /// Subtrees that are computed one after the other share the same part of the workspace, which
    /// follows the part of the links above.
    pub(super) fn slots(&self) -> Vec<usize> {
        let mut slots: Vec<usize> = (0..self.parents.len()).collect();
        let subtrees = self.subtrees.iter();
        for some in subtrees.filter(|some| some.links.start >= self.above) {
            for (slot, own) in (self.above..).zip(&mut slots[some.links.clone()]) {
                *own = slot;
            }
        }
        slots
    }

    /// Returns the same links grouped into subtrees of at most `most` links, one after the other
    /// and each by height, after the links above them. The numbers that links of a subtree exchange
    /// are then close in memory. The responses of a link's children are added in the same order as
    /// if all links were sorted by height, so that the sum has the same bits.
    pub(super) fn in_subtrees(self, most: usize) -> Self {
        let links = self.order.len();
        let parent = |place: usize| self.parents[place] as usize;
        let mut heights = alloc::vec![0; links];
        for (height, strip) in self.strips.iter().rev().enumerate() {
            heights[strip.clone()].fill(height);
        }
        let mut sizes = alloc::vec![1; links];
        let mut children: Vec<Vec<usize>> = alloc::vec![Vec::new(); links];
        for place in (1..links).rev() {
            sizes[parent(place)] += sizes[place];
            children[parent(place)].push(place);
        }
        let mut order: Vec<usize> = (0..links).filter(|&place| sizes[place] > most).collect();
        let above = order.len();
        let (mut strips, mut subtrees) = (Vec::new(), Vec::<SmallSubtrees>::new());
        let mut next = Vec::from_iter((links > 0).then_some(0));
        while let Some(place) = next.pop() {
            let (start, strip) = (order.len(), strips.len());
            if sizes[place] > most {
                if let Ok(own) = order[..above].binary_search(&place) {
                    strips.push(own..own + 1);
                }
                // The link pushed first comes last and goes up first: the lowest.
                children[place].sort_unstable_by_key(|&child| (heights[child], child));
                next.append(&mut children[place]);
            } else {
                order.push(place);
                lay_down(&mut order, start, &mut children, &heights, &mut strips);
            }
            let own = SmallSubtrees {
                links: start..order.len(),
                strips: strip..strips.len(),
            };
            // Neighbouring subtrees that fit together are combined.
            match subtrees.last_mut() {
                Some(last) if own.links.end - last.links.start <= most => {
                    (last.links.end, last.strips.end) = (own.links.end, own.strips.end);
                }
                _ => subtrees.push(own),
            }
        }
        subtrees.push(SmallSubtrees {
            links: 0..above,
            strips: strips.len()..strips.len(),
        });
        let mut places = alloc::vec![0_u32; links];
        for (new, &place) in (0..).zip(&order) {
            places[place] = new;
        }
        Self {
            parents: order.iter().map(|&place| places[parent(place)]).collect(),
            order: order.iter().map(|&place| self.order[place]).collect(),
            strips,
            subtrees,
            above,
        }
    }
}

/// Appends the links below the last link of `order`, whose position is `start`, sorted by height,
/// and their strips.
fn lay_down(
    order: &mut Vec<usize>,
    start: usize,
    children: &mut [Vec<usize>],
    heights: &[usize],
    strips: &mut Vec<Range<usize>>,
) {
    let mut inner = start;
    while let Some(&place) = order.get(inner) {
        order.append(&mut children[place]);
        inner += 1;
    }
    order[start..].sort_unstable();
    let mut end = start;
    for links in order[start..].chunk_by(|&one, &other| heights[one] == heights[other]) {
        strips.push(end..end + links.len());
        end += links.len();
    }
}
