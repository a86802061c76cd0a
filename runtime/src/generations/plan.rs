//! How a tree is taken apart.

use alloc::vec::Vec;

use super::part::{Part, Shape};

/// Trees of up to so many links are computed in one piece: their numbers fit
/// into the second cache.
const WHOLE: usize = 8192;

/// Neighbours in a part of a larger tree: whole vectors, and runs that are long
/// enough to be fetched ahead.
pub(super) const WIDTH: usize = 256;

/// The number of links of each generation, and where the tree is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    counts: Vec<usize>,
    starts: Vec<usize>,
    /// The generation in which the parts start; none where the tree is one.
    pub(super) cut: Option<usize>,
}

impl Plan {
    /// For a tree with so many copies of each generation under each link of the
    /// one before.
    pub(super) fn new(copies: &[usize]) -> Self {
        let (mut counts, mut starts) = (Vec::new(), Vec::new());
        let (mut count, mut start) = (1, 0);
        for &copies in copies {
            count *= copies;
            counts.push(count);
            starts.push(start);
            start += count;
        }
        starts.push(start);
        let mut plan = Self {
            counts,
            starts,
            cut: None,
        };
        if start > WHOLE {
            // The longest subtrees that fit with their neighbours.
            let inner = 1..copies.len().saturating_sub(1);
            let fits = |&generation: &usize| {
                let below: usize = plan.counts.iter().skip(generation).sum();
                let count = plan.count(generation).max(1);
                count >= WIDTH && (below / count).saturating_mul(WIDTH) <= WHOLE
            };
            plan.cut = inner.clone().find(fits).or(inner.last());
        }
        plan
    }

    /// All of them.
    pub(super) fn links(&self) -> usize {
        self.start(self.generations())
    }

    pub(super) fn generations(&self) -> usize {
        self.counts.len()
    }

    pub(super) fn count(&self, generation: usize) -> usize {
        self.counts.get(generation).copied().unwrap_or(0)
    }

    /// The first link of a generation; of the one behind the last, the number of
    /// links.
    pub(super) fn start(&self, generation: usize) -> usize {
        self.starts.get(generation).copied().unwrap_or(0)
    }

    fn shape(&self) -> Shape<'_> {
        Shape {
            counts: &self.counts,
            starts: &self.starts,
        }
    }

    /// The generations above the cut, or the whole tree.
    pub(super) fn top(&self) -> Part<'_> {
        Part {
            shape: self.shape(),
            first: 0,
            end: self.cut.unwrap_or(self.generations()),
            start: 0,
            width: 1,
        }
    }

    /// The subtrees of the cut's links from `start` on.
    pub(super) fn window(&self, cut: usize, start: usize) -> Part<'_> {
        Part {
            shape: self.shape(),
            first: cut,
            end: self.generations(),
            start,
            width: WIDTH.min(self.count(cut) - start),
        }
    }
}
