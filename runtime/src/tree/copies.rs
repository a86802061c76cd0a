//! Links of trees by generations: how many there are, and which is where.

use alloc::vec::Vec;

use super::{LinkEquations, LinkName, Tree};

impl<E: LinkEquations, T> Tree<E, T> {
    /// Copies whose products are numbers.
    pub(super) const COPIES: &'static [usize] = {
        links(E::COPIES);
        E::COPIES
    };

    /// Index of the link that one comes to from the root by these copies, each
    /// counted from 0; the empty path is the root's. None where there is no such
    /// link, or the tree is not by generations.
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

    /// The path from the root to a link: the inverse of [`link`](Self::link).
    #[must_use]
    pub fn path(index: usize) -> Option<Vec<usize>> {
        let (generation, mut rest) = place(Self::COPIES, index)?;
        let copies = Self::COPIES.get(1..=generation).unwrap_or_default();
        let mut path = Vec::with_capacity(generation);
        for &copies in copies {
            path.push(rest % copies);
            rest /= copies;
        }
        Some(path)
    }

    /// The name of a link of a tree by generations.
    #[must_use]
    pub fn link_name(index: usize) -> Option<LinkName<'static>> {
        let (generation, index) = place(Self::COPIES, index)?;
        Some(LinkName {
            stem: E::NAMES.get(generation)?,
            copies: Self::COPIES.get(1..=generation)?,
            index,
        })
    }
}

/// Returns the number of links of a tree by generations.
///
/// # Panics
/// Where they are more than a number holds: constants ask for it, and such a tree is not
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

/// Returns the generation of a link, and its number there.
pub(super) fn place(copies: &[usize], index: usize) -> Option<(usize, usize)> {
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
