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

    /// Iterates over the links from the root to the leaves, strip by strip (runs of neighbours).
    #[inline(always)]
    pub(super) fn strips(&self) -> StripWalk<'_> {
        StripWalk {
            shape: self,
            link: 0,
            generation: 0,
            copy: 0,
            above: (0, 1),
            start: 0,
        }
    }
}

/// Iterator over all links from the root to the leaves, several neighbours at a time.
pub(super) struct StripWalk<'a> {
    shape: &'a Shape,
    /// Index of the next link, its generation, and its number among the copies under its parent.
    link: usize,
    generation: usize,
    copy: usize,
    /// Index of the first link of the generation before, and its number of links.
    above: (usize, usize),
    /// First link of this generation.
    start: usize,
}

impl Iterator for StripWalk<'_> {
    type Item = Neighbours;

    #[inline(always)]
    fn next(&mut self) -> Option<Neighbours> {
        let link = self.link;
        let copies = match self.shape {
            Shape::Parents(parents) => return self.listed(parents),
            Shape::Shared(parents) => return self.listed(parents),
            Shape::Generations(copies) => copies,
        };
        while self.copy == *copies.get(self.generation)? {
            self.above = (self.start, self.above.1 * self.copy);
            (self.start, self.copy) = (link, 0);
            self.generation += 1;
        }
        let (above, count) = self.above;
        self.copy += 1;
        self.link += count;
        Some(Neighbours {
            link,
            parent: (self.generation > 0).then_some(above),
            count,
            row: self.generation,
        })
    }
}

impl StripWalk<'_> {
    #[inline(always)]
    fn listed(&mut self, parents: &[u32]) -> Option<Neighbours> {
        let link = self.link;
        let parent = *parents.get(link)? as usize;
        self.link += 1;
        Some(Neighbours {
            link,
            parent: (link > 0).then_some(parent),
            count: 1,
            row: link,
        })
    }
}
