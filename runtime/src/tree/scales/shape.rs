//! Positions in memory of the numbers of a rule-based tree while its scales are computed.
//!
//! In a column each generation is padded by one register after its last link: a register may reach
//! past a generation, and the values written there are never read as those of a link.

use crate::simd::WIDEST;

/// Largest number of generations for which energies by scale are computed; budgets of deeper trees
/// are NaN. With two copies per generation, deeper trees have more links than an index can count.
pub const MOST_GENERATIONS: usize = 34;

/// Sizes and positions of one generation.
#[derive(Clone, Copy, Default)]
pub(super) struct ScaleGeneration {
    /// Number of copies under each link of the generation before.
    pub(super) copies: usize,
    /// Number of links.
    pub(super) count: usize,
    /// Index of the generation's first link in the tree, and its index in a column.
    pub(super) whole: usize,
    pub(super) slot: usize,
    /// Index of the generation's first number in a column of parts.
    part: usize,
}

/// The generations of a tree.
#[derive(Clone, Copy)]
pub(super) struct ScaleShape {
    generations: [ScaleGeneration; MOST_GENERATIONS],
    count: usize,
    /// Number of links.
    pub(super) links: usize,
    /// Length of a column with one number per link, and of a column of parts.
    pub(super) column: usize,
    pub(super) parts: usize,
    /// Number of generations that do not fill the widest register, and the number of links of the
    /// first generation that does.
    narrow: usize,
    filling: usize,
}

impl ScaleShape {
    /// Computes the sizes for some neighbouring links with everything below them. The first entry
    /// of `copies` is the number of these neighbours, 1 for a whole tree. Returns `None` if there
    /// are too many generations.
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

    /// Returns the number of generations, which is also the number of scales.
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

    /// Returns how many different values the parts in a scale have in its youngest generation. The
    /// values repeat along the generation, because copies of a link have the same index modulo the
    /// number of links of its generation.
    pub(super) fn values(&self, scale: usize) -> usize {
        self.at(scale).count
    }

    /// Returns the number of links after which the parts in a scale repeat within a generation; it
    /// is at least the length of a register if the generation has that many links.
    #[inline(always)]
    pub(super) fn period(&self, scale: usize, generation: usize) -> usize {
        let filling = self.at(generation).count.min(self.filling);
        self.values(scale).max(filling)
    }

    /// Returns the index at which the parts of a generation in a scale are stored, within a column
    /// of parts. They follow the parts in the previous scales. The parts in a scale take its period
    /// plus one register, in which the period is repeated.
    #[inline(always)]
    pub(super) fn part(&self, scale: usize, generation: usize) -> usize {
        let (own, narrow) = (self.at(generation), scale.min(self.narrow));
        let periods =
            narrow * own.count.min(self.filling) + (self.at(scale).whole - self.at(narrow).whole);
        own.part + periods + scale * WIDEST
    }

    /// Returns the generation at which a large tree is divided, and how many neighbouring links of
    /// that generation form a block, together with everything below them. A block fits into the
    /// second-level cache, and the parents of its neighbours are neighbours. Small trees are not
    /// divided.
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

/// Number of links above which a tree is divided into blocks; also the approximate size of a block.
const WHOLE: usize = 4096;
const BLOCK: usize = 1536;

/// Number of neighbours in a block's first generation; they are contiguous in the tree.
const WIDE: usize = 64;

#[cfg(test)]
mod tests {
    use super::{ScaleShape, WIDEST};

    /// Checks that parts of different scales are contiguous in memory, and that each has the right
    /// length.
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
