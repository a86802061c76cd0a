//! Trees described by generations: number of links, and the conversion between the index of a link
//! and its path.

use alloc::vec::Vec;

use super::{LinkEquations, LinkName, Tree};

impl<E: LinkEquations, T> Tree<E, T> {
    /// Number of copies of each generation under each link of the generation before; it must be
    /// known at compile time.
    pub(super) const COPIES: &'static [usize] = {
        links(E::COPIES);
        E::COPIES
    };

    /// Returns the index of the link at the end of a path from the root. The path contains one
    /// number per generation: which copy to take, counted from 0. The empty path leads to the root.
    /// `None` if there is no such link, or if the tree is not described by generations.
    #[must_use]
    pub fn link(path: &[usize]) -> Option<usize> {
        let (mut start, mut count, mut index) = (0, *Self::COPIES.first()?, 0);
        let mut copies = Self::COPIES.iter().skip(1);
        for &copy in path {
            let copies = *copies.next()?;
            if copy >= copies {
                return None;
            }
            start += count;
            index += copy * count;
            count *= copies;
        }
        Some(start + index)
    }

    /// Returns the path from the root to a link; the inverse of [`link`](Self::link).
    #[must_use]
    pub fn path(index: usize) -> Option<Vec<usize>> {
        let (generation, mut rest) = generation_and_index(Self::COPIES, index)?;
        let copies = Self::COPIES.get(1..=generation).unwrap_or_default();
        let mut path = Vec::with_capacity(generation);
        for &copies in copies {
            path.push(rest % copies);
            rest /= copies;
        }
        Some(path)
    }

    /// Returns the name of a link, for a tree that is described by generations.
    #[must_use]
    pub fn link_name(index: usize) -> Option<LinkName<'static>> {
        let (generation, index) = generation_and_index(Self::COPIES, index)?;
        Some(LinkName {
            stem: E::NAMES.get(generation)?,
            copies: Self::COPIES.get(1..=generation)?,
            index,
        })
    }
}

/// Returns the number of links of a tree with these numbers of copies in its generations.
///
/// # Panics
/// If the number of links overflows. It is called in constants, so that such a tree is not
/// compiled.
pub(super) const fn links(copies: &[usize]) -> usize {
    const TOO_MANY: &str = "the generations of a tree have more links than a number holds";
    let (mut links, mut count, mut generation) = (0_usize, 1_usize, 0);
    while generation < copies.len() {
        count = count.checked_mul(copies[generation]).expect(TOO_MANY);
        links = links.checked_add(count).expect(TOO_MANY);
        generation += 1;
    }
    links
}

/// Returns the generation of a link, and its index within the generation.
pub(super) fn generation_and_index(copies: &[usize], index: usize) -> Option<(usize, usize)> {
    let (mut count, mut rest) = (1, index);
    for (generation, copies) in copies.iter().enumerate() {
        count *= copies;
        if rest < count {
            return Some((generation, rest));
        }
        rest -= count;
    }
    None
}
