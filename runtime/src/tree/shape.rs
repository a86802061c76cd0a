//! Topology of a tree, and iteration over its links.

use alloc::sync::Arc;

/// Topology of a tree, given by the parents of its links or by its generations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The index of each link's parent, which is smaller than the link's; 0 for the root.
    Parents(&'static [u32]),
    /// The index of each link's parent, for a tree that is built at run time.
    Shared(Arc<[u32]>),
    /// Number of copies of each generation under each link of the generation before, 1 for the
    /// root. Links are ordered as in a [`Tree`](super::Tree).
    Generations(&'static [usize]),
}

/// Consecutive links whose parents are consecutive too.
#[derive(Clone, Copy)]
pub(super) struct Neighbours {
    /// Index of the first link, and of its parent (`None` for the root).
    pub(super) link: usize,
    pub(super) parent: Option<usize>,
    pub(super) count: usize,
    /// Index of the row of constants that these links share.
    pub(super) row: usize,
}

impl Neighbours {
    /// Iterates over the links, each with its parent.
    #[inline(always)]
    pub(super) fn each(self) -> impl Iterator<Item = (usize, Option<usize>)> {
        let parent = move |index| self.parent.map(|parent| parent + index);
        (0..self.count).map(move |index| (self.link + index, parent(index)))
    }
}

impl Shape {
    pub(super) fn links(&self) -> usize {
        match self {
            Self::Parents(parents) => parents.len(),
            Self::Shared(parents) => parents.len(),
            Self::Generations(copies) => super::links(copies),
        }
    }

    /// Returns the number of rows of constants: one for each link, or for each generation.
    pub(super) fn rows(&self) -> usize {
        match self {
            Self::Parents(parents) => parents.len(),
            Self::Shared(parents) => parents.len(),
            Self::Generations(copies) => copies.len(),
        }
    }

    /// Iterates over the links from the root to the leaves, strip by strip (runs of neighbours).
    #[inline(always)]
    pub(super) fn strips(&self) -> impl DoubleEndedIterator<Item = Neighbours> {
        let strips = match self {
            Self::Parents(parents) => parents.len(),
            Self::Shared(parents) => parents.len(),
            Self::Generations(copies) => copies.iter().sum(),
        };
        (0..strips).filter_map(|number| self.strip(number))
    }

    /// Returns the strip with this number, if it exists.
    #[inline(always)]
    fn strip(&self, number: usize) -> Option<Neighbours> {
        let listed = |parents: &[u32]| {
            let parent = *parents.get(number)? as usize;
            Some(Neighbours {
                link: number,
                parent: (number > 0).then_some(parent),
                count: 1,
                row: number,
            })
        };
        match self {
            Self::Parents(parents) => listed(parents),
            Self::Shared(parents) => listed(parents),
            Self::Generations(copies) => strip_of_generations(copies, number),
        }
    }
}

/// Returns the strip with this number in a tree by generations: the links of one generation that
/// are the same copy under their parents. O(generations).
fn strip_of_generations(copies: &[usize], number: usize) -> Option<Neighbours> {
    let mut copy = number;
    // First link of the generation before, its number of links, and first link of this one.
    let (mut above, mut count, mut start) = (0, 1, 0);
    for (generation, &copies) in copies.iter().enumerate() {
        if copy < copies {
            return Some(Neighbours {
                link: start + copy * count,
                parent: (generation > 0).then_some(above),
                count,
                row: generation,
            });
        }
        copy -= copies;
        count *= copies;
        (above, start) = (start, start + count);
    }
    None
}
