//! Transverse sectors: differences between identical copies that can grow while the copies move in
//! phase.

use super::{LinkId, NodeMotion, Scene};

/// Copies in phase and all that hangs from them. Small differences between the copies follow
/// separate linear equations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TransverseCopies {
    /// Name of the scene's link that represents the copies.
    pub name: String,
    /// Index of the first link of the subtree; the others follow.
    pub first: LinkId,
    /// Number of the scene's links in the subtree.
    pub links: usize,
    /// Number of copies under one link of the whole tree.
    pub copies: usize,
    /// Number of links of the whole tree, all in phase, that hold such copies.
    pub holders: usize,
}

impl Scene {
    /// Returns the transverse sectors, in the order of their links.
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

    /// Returns the number of links in a subtree, which have consecutive indices.
    fn subtree(&self, LinkId(first): LinkId) -> usize {
        let below = self.links[first + 1..].iter();
        let inside = below.take_while(|link| link.parent >= Some(LinkId(first)));
        1 + inside.count()
    }
}
