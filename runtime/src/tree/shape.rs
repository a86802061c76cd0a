//! Which link hangs on which, and how links are gone through.

use alloc::sync::Arc;

/// Parents of the links.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The parent of each link, before it; the root's own is 0.
    Parents(&'static [u32]),
    /// Parents likewise, of a tree that is not known before the program runs.
    Shared(Arc<[u32]>),
    /// Copies of each generation under each link of the one before, 1 for the
    /// root; links stand as in a [`Tree`](super::Tree).
    Generations(&'static [usize]),
}

/// Links that stand side by side, as their parents do.
#[derive(Clone, Copy)]
pub(super) struct Neighbours {
    /// The first one, and its parent, but for the root.
    pub(super) link: usize,
    pub(super) parent: Option<usize>,
    pub(super) count: usize,
    /// Number of the row that they share.
    pub(super) row: usize,
}

impl Neighbours {
    /// Each of them, and its parent.
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

    /// Goes from the root to the leaves, strip by strip.
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

/// All links from the root to the leaves, neighbours at a time.
pub(super) struct StripWalk<'a> {
    shape: &'a Shape,
    /// The next link, its generation, and which copy it is under its parent.
    link: usize,
    generation: usize,
    copy: usize,
    /// Where the generation before starts, and how many links it has.
    above: (usize, usize),
    /// Where this one starts.
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
