//! Where the numbers of a tree by rule stand while its scales are computed.
//!
//! In a column each generation has room for a register behind its last link: a register
//! may reach beyond a generation, and what it writes there is never read as a link's.

use crate::simd::WIDEST;

/// Most generations of a tree whose energies are known by scale: budgets of deeper ones
/// are NaN. Branches of two are then more links than an index counts.
pub const MOST_GENERATIONS: usize = 34;

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
    generations: [ScaleGeneration; MOST_GENERATIONS],
    count: usize,
    /// Number of links.
    pub(super) links: usize,
    /// Length of a column of all links, and of one of parts.
    pub(super) column: usize,
    pub(super) parts: usize,
    /// Number of generations that do not fill the widest register, and number of links of
    /// the first one that does.
    narrow: usize,
    filling: usize,
}

impl ScaleShape {
    /// Of so many neighbours with all below them. The neighbours are the first of the
    /// copies, 1 for a whole tree. None where there are too many generations.
    pub(super) fn new(copies: impl ExactSizeIterator<Item = usize>) -> Option<Self> {
        let mut shape = Self {
            generations: [ScaleGeneration::default(); MOST_GENERATIONS],
            count: copies.len(),
            links: 0,
            column: 0,
            parts: 0,
            narrow: 0,
            filling: usize::MAX,
        };
        if copies.len() == 0 || copies.len() > MOST_GENERATIONS {
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
            match count < WIDEST {
                true => shape.narrow += 1,
                false => shape.filling = shape.filling.min(count),
            }
            shape.links += count;
            shape.column += (count + WIDEST).next_multiple_of(WIDEST);
            let scales = 0..=number;
            shape.parts += scales
                .map(|scale| shape.period(scale, number) + WIDEST)
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

    /// Number of different values that parts in a scale have in one generation. Values
    /// repeat along it, since copies of a link have the number of the link modulo the
    /// number of links of their generation.
    pub(super) fn values(&self, scale: usize) -> usize {
        self.at(scale).count
    }

    /// Links behind which parts in a scale are the same again: as many as fill a
    /// register, or all.
    #[inline(always)]
    pub(super) fn period(&self, scale: usize, generation: usize) -> usize {
        let filling = self.at(generation).count.min(self.filling);
        self.values(scale).max(filling)
    }

    /// Place of the parts of a generation in a scale in a column of parts: behind those in
    /// the scales before, of which each has a register more than its period, which begins
    /// anew there.
    #[inline(always)]
    pub(super) fn part(&self, scale: usize, generation: usize) -> usize {
        let (own, narrow) = (self.at(generation), scale.min(self.narrow));
        let periods =
            narrow * own.count.min(self.filling) + (self.at(scale).whole - self.at(narrow).whole);
        own.part + periods + scale * WIDEST
    }

    /// The generation where large trees are cut, and how many neighbours of it make one
    /// block with all below them: one that fits into the second cache, whose
    /// neighbours' parents are neighbours. Small trees are not cut.
    pub(super) fn cut(&self) -> Option<(usize, usize)> {
        if self.links <= WHOLE {
            return None;
        }
        let wide = (0..self.count).find(|&number| self.at(number).count >= WIDE)?;
        let width = self.at(wide).count;
        let fits = |&number: &usize| {
            let first = self.at(number);
            (self.links - first.whole) / first.count * width <= BLOCK
        };
        let last = self.count - 1;
        let cut = (wide + 1..self.count).find(fits).unwrap_or(last);
        (cut > wide).then_some((cut, width))
    }
}

/// Trees of more links are cut into blocks of about so many.
const WHOLE: usize = 4096;
const BLOCK: usize = 1536;

/// Neighbours of a block's first generation: they stand side by side in the tree.
const WIDE: usize = 64;

#[cfg(test)]
mod tests {
    use super::{ScaleShape, WIDEST};

    /// Parts follow each other without a gap, and have their place.
    #[test]
    fn parts_stand_one_behind_the_other() {
        for copies in [
            &[1, 2, 2, 2, 2, 2, 2][..],
            &[1, 3, 3, 3],
            &[1, 2],
            &[1, 40, 3],
            &[16, 2],
        ] {
            let shape = ScaleShape::new(copies.iter().copied()).unwrap();
            let mut end = 0;
            for generation in 0..shape.count() {
                for scale in 0..=generation {
                    assert_eq!(shape.part(scale, generation), end, "{copies:?}");
                    let period = shape.period(scale, generation);
                    assert!(period >= WIDEST || period == shape.at(generation).count);
                    assert_eq!(period % shape.values(scale), 0);
                    end += period + WIDEST;
                }
            }
            assert_eq!(end, shape.parts);
        }
    }
}
