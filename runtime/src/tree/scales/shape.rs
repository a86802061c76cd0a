//! Where the numbers of a tree by rule stand while its scales are computed.
//!
//! In a column each generation has room for a register behind its last link: a register
//! may reach beyond a generation, and what it writes there is never read as a link's.

use crate::tree::block::WIDEST;

/// Most generations: branches of two are then more links than an index counts.
const MOST: usize = 34;

/// A generation.
#[derive(Clone, Copy, Default)]
pub(super) struct ScaleGeneration {
    /// Copies under each link of the generation before.
    pub(super) copies: usize,
    /// Number of links.
    pub(super) count: usize,
    /// Place of the first link in the tree, and in a column.
    pub(super) whole: usize,
    pub(super) slot: usize,
    /// Place of the first number in a column of parts.
    part: usize,
}

/// The generations of a tree.
#[derive(Clone, Copy)]
pub(super) struct ScaleShape {
    generations: [ScaleGeneration; MOST],
    count: usize,
    /// Number of links.
    pub(super) links: usize,
    /// Length of a column of all links, and of one of parts.
    pub(super) column: usize,
    pub(super) parts: usize,
}

impl ScaleShape {
    /// Of so many neighbours with all below them. The neighbours are the first of the
    /// copies, 1 for a whole tree. None where there are too many generations.
    pub(super) fn new(copies: impl ExactSizeIterator<Item = usize>) -> Option<Self> {
        let mut shape = Self {
            generations: [ScaleGeneration::default(); MOST],
            count: copies.len(),
            links: 0,
            column: 0,
            parts: 0,
        };
        if copies.len() == 0 || copies.len() > MOST {
            return None;
        }
        let mut count = 1;
        for (number, copies) in copies.enumerate() {
            count *= copies;
            let place = shape.generations.get_mut(number)?;
            *place = ScaleGeneration {
                copies,
                count,
                whole: shape.links,
                slot: shape.column,
                part: shape.parts,
            };
            shape.links += count;
            shape.column += (count + WIDEST).next_multiple_of(WIDEST);
            shape.parts += (0..=number)
                .map(|scale| shape.stride(scale, number))
                .sum::<usize>();
        }
        Some(shape)
    }

    /// Number of generations, and of scales.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    pub(super) fn at(&self, generation: usize) -> ScaleGeneration {
        match self.generations.get(generation) {
            Some(generation) => *generation,
            None => ScaleGeneration::default(),
        }
    }

    /// Number of different values that parts in a scale have in one generation. They
    /// repeat along it, since copies of a link have the number of the link modulo the
    /// number of links of their generation.
    pub(super) fn values(&self, scale: usize) -> usize {
        self.at(scale).count
    }

    /// Links behind which parts in a scale are the same again: as many as fill a
    /// register, or all.
    pub(super) fn period(&self, scale: usize, generation: usize) -> usize {
        let mut counts = (scale..=generation).map(|number| self.at(number).count);
        let enough = counts.find(|&count| count >= WIDEST);
        enough.unwrap_or(self.at(generation).count)
    }

    /// Room for parts of a generation in a scale, with those behind a period once more.
    fn stride(&self, scale: usize, generation: usize) -> usize {
        self.period(scale, generation) + WIDEST
    }

    /// Place of the parts of a generation in a scale in a column of parts.
    pub(super) fn part(&self, scale: usize, generation: usize) -> usize {
        let before = (0..scale).map(|scale| self.stride(scale, generation));
        self.at(generation).part + before.sum::<usize>()
    }

    /// The generation where large trees are cut, and how many neighbours of it make one
    /// block with all below them: one that fits into the second cache, whose
    /// neighbours' parents are neighbours. Small trees are not cut: 0, 1.
    pub(super) fn cut(&self) -> (usize, usize) {
        let wide = (0..self.count).find(|&number| self.at(number).count >= WIDE);
        let Some(wide) = wide.filter(|_| self.links > WHOLE) else {
            return (0, 1);
        };
        let width = self.at(wide).count;
        let fits = |&number: &usize| {
            let first = self.at(number);
            (self.links - first.whole) / first.count * width <= BLOCK
        };
        let last = self.count - 1;
        match (wide + 1..self.count).find(fits) {
            Some(generation) => (generation, width),
            None if last > wide => (last, width),
            None => (0, 1),
        }
    }
}

/// Trees of more links are cut into blocks of about so many.
const WHOLE: usize = 4096;
const BLOCK: usize = 1536;

/// Neighbours of a block's first generation: pieces that are copied to it are so long.
const WIDE: usize = 64;
