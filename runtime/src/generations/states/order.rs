//! The links of a tree in generations depth first, children before their parents.

use crate::generations::part::Stage;

/// A link by its generation and its number there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) generation: usize,
    pub(super) index: usize,
}

/// A link under its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Above {
    /// Which copy it is, and whether that is the last.
    pub(super) copy: usize,
    pub(super) last: bool,
    pub(super) parent: Place,
}

/// The links with children, each after those below it, copy by copy.
///
/// Nothing is stored: copy `c` under link `i` of a generation of `n` links is
/// number `c n + i` of the next one, which says where to go next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order<'a> {
    stages: &'a [Stage],
    /// The generation whose children are leaves.
    pub(super) stems: usize,
    /// How many leaves are under each of its links.
    pub(super) leaves: usize,
}

impl<'a> Order<'a> {
    /// None for a tree of one generation.
    #[inline(always)]
    pub(super) fn new(stages: &'a [Stage]) -> Option<Self> {
        Some(Self {
            stages,
            stems: stages.len().checked_sub(2)?,
            leaves: stages.last()?.copies,
        })
    }

    // Always in place: a call here gives up all wide registers.
    #[inline(always)]
    fn count(&self, generation: usize) -> usize {
        self.stages.get(generation).map_or(1, |stage| stage.count)
    }

    #[inline(always)]
    fn start(&self, generation: usize) -> usize {
        self.stages.get(generation).map_or(0, |stage| stage.whole)
    }

    #[inline(always)]
    fn copies(&self, generation: usize) -> usize {
        self.stages.get(generation).map_or(1, |stage| stage.copies)
    }

    /// How many links have children.
    #[inline(always)]
    pub(super) fn inners(&self) -> usize {
        self.start(self.stems + 1)
    }

    #[inline(always)]
    pub(super) fn first(&self) -> Place {
        Place {
            generation: self.stems,
            index: 0,
        }
    }

    /// Its number in the tree.
    #[inline(always)]
    pub(super) fn link(&self, place: Place) -> usize {
        self.start(place.generation) + place.index
    }

    /// That of a leaf under it.
    #[inline(always)]
    pub(super) fn leaf(&self, stem: Place, copy: usize) -> usize {
        let first = self.start(stem.generation + 1) + stem.index;
        first + copy * self.count(stem.generation)
    }

    /// None for the root.
    #[inline(always)]
    pub(super) fn above(&self, place: Place) -> Option<Above> {
        let generation = place.generation.checked_sub(1)?;
        let count = self.count(generation).max(1);
        let copy = place.index / count;
        Some(Above {
            copy,
            last: copy + 1 >= self.copies(place.generation),
            parent: Place {
                generation,
                index: place.index % count,
            },
        })
    }

    /// The first link with leaves of the next copy of it under the same parent.
    #[inline(always)]
    pub(super) fn beside(&self, place: Place) -> Place {
        let generation = place.generation.saturating_sub(1);
        Place {
            generation: self.stems,
            index: place.index + self.count(generation),
        }
    }

    /// The one after; none after the root.
    #[inline(always)]
    pub(super) fn after(&self, place: Place) -> Option<Place> {
        let above = self.above(place)?;
        Some(if above.last {
            above.parent
        } else {
            self.beside(place)
        })
    }

    /// The one before; none before the first.
    #[inline(always)]
    pub(super) fn before(&self, mut place: Place) -> Option<Place> {
        if place.generation < self.stems {
            let generation = place.generation + 1;
            let last = self.copies(generation) - 1;
            let index = place.index + last * self.count(place.generation);
            return Some(Place { generation, index });
        }
        loop {
            let above = self.above(place)?;
            if above.copy > 0 {
                let count = self.count(above.parent.generation);
                return Some(Place {
                    index: place.index - count,
                    ..place
                });
            }
            place = above.parent;
        }
    }
}

/// The numbers of all links, leaves too, children before their parents.
#[derive(Clone, Debug)]
pub(super) struct All<'a> {
    order: Order<'a>,
    place: Option<Place>,
    leaf: usize,
}

impl<'a> All<'a> {
    #[inline(always)]
    pub(super) fn new(order: Order<'a>) -> Self {
        Self {
            order,
            place: Some(order.first()),
            leaf: 0,
        }
    }

    /// A link and its parent; none at the end.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<(usize, Option<usize>)> {
        let place = self.place?;
        let own = self.order.link(place);
        if place.generation == self.order.stems && self.leaf < self.order.leaves {
            let leaf = self.order.leaf(place, self.leaf);
            self.leaf += 1;
            return Some((leaf, Some(own)));
        }
        self.leaf = 0;
        self.place = self.order.after(place);
        let above = self.order.above(place);
        Some((own, above.map(|above| self.order.link(above.parent))))
    }
}
