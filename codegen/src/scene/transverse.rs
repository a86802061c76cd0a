//! Sectors whose differences can grow beside an in-phase motion.

use super::{LinkId, NodeMotion, Scene};

/// Copies that move in phase, and what hangs from them: the links whose small
/// differences between the copies follow linear equations of their own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TransverseCopies {
    /// Name of the scene's link that stands for the copies.
    pub name: String,
    /// The first of its links; the others follow.
    pub first: LinkId,
    /// Number of links that the scene has from there on in the subtree.
    pub links: usize,
    /// Copies under one link of the whole tree.
    pub copies: usize,
    /// Links of the whole tree that hold such copies and move alike.
    pub holders: usize,
}

impl Scene {
    /// The sectors of copies in phase, in the order of their links.
    pub fn transverse_sectors(&self) -> Vec<TransverseCopies> {
        let Some(reduction) = &self.reduction else {
            return Vec::new();
        };
        let orbits = &reduction.orbits;
        let mut sectors = Vec::new();
        for (index, orbit) in orbits.iter().enumerate() {
            let moves = matches!(orbit.motion, NodeMotion::Moving { .. });
            if !(orbit.in_phase && orbit.copies > 1 && moves) {
                continue;
            }
            let above = orbits[..index].iter().filter(|above| above.end > index);
            let holders = above
                .filter(|above| above.in_phase)
                .map(|above| above.copies);
            let holders: usize = holders.product();
            let of_orbit = |known: &&super::Orbit| known.node == orbit.name;
            for &first in self
                .orbits
                .iter()
                .filter(of_orbit)
                .flat_map(|known| &known.links)
            {
                sectors.push(TransverseCopies {
                    name: self.links[first.0].name.clone(),
                    first,
                    links: self.subtree(first),
                    copies: orbit.copies,
                    holders,
                });
            }
        }
        sectors.sort_by_key(|sector| sector.first);
        sectors
    }

    /// Number of links of a subtree, which stand one after the other.
    fn subtree(&self, LinkId(first): LinkId) -> usize {
        let below = self.links[first + 1..].iter();
        let inside = below.take_while(|link| link.parent >= Some(LinkId(first)));
        1 + inside.count()
    }
}
