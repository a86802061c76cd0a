//! Branching of the links of an orbit (set of equal copies of one link) into copies.

use crate::exact::Rational;
use crate::scene::Coordinate;
use crate::scene::{LinkId, Scene};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A difference: index of the group, and number of the difference from 1.
pub(in crate::program) type DifferenceId = (usize, usize);

/// A sector: one difference, or `None` for the means.
pub(in crate::program) type SectorId = Option<DifferenceId>;

/// The links of one orbit.
#[derive(Clone, Debug)]
pub(in crate::program) struct OrbitLinks {
    /// Number of links in the orbit.
    pub(super) links: usize,
    /// Orbit of the links' parents.
    pub(super) parent: Option<usize>,
    /// Outermost branching, if there is one.
    pub(super) branch: Option<Branch>,
    /// Names of the mean and the differences.
    names: BTreeMap<SectorId, String>,
}

impl OrbitLinks {
    /// Returns the name of the mean, or of a difference.
    pub(super) fn name(&self, sector: SectorId) -> &str {
        self.names.get(&sector).map_or("", String::as_str)
    }
}

/// A branching into copies on the path from the root to an orbit.
#[derive(Clone, Debug)]
pub(in crate::program) struct Branch {
    /// Index of the group in the scene.
    pub(super) group: usize,
    /// Further branchings within each copy.
    pub(super) copies: Vec<Option<Branch>>,
    /// Number of the orbit's links in one copy.
    pub(super) links_per_copy: usize,
}

impl Branch {
    /// Returns the number of differences between the copies.
    pub(super) fn differences(&self) -> usize {
        self.copies.len() - 1
    }

    /// Returns the sum of the squared Helmert weights over the links of the orbit.
    pub(super) fn norm(&self, difference: usize) -> i64 {
        (difference * (difference + 1) * self.links_per_copy) as i64
    }
}

/// Returns the weight of copy `copy` (from 0) in difference number `difference` (from 1): 1 for the
/// first `difference` copies, −`difference` for the next one, and 0 for later ones.
pub(super) fn weight(difference: usize, copy: usize) -> i64 {
    match copy {
        copy if copy < difference => 1,
        copy if copy == difference => -(difference as i64),
        _ => 0,
    }
}

/// Returns the nonzero coefficients Σ_a w_ja w_ia w_la / Σ_a w_ja² with their indices i and l: the
/// part in difference j of the product of differences i and l, for the given number of copies.
///
/// Of the weights of the highest index, the copies before it have 1 and those after it 0. The sum
/// is therefore that of the other two weights, which are orthogonal: their norm if they are equal;
/// 0, the sum of the third weight, if the highest index occurs twice; and m − m³ for three equal
/// indices.
pub(super) fn structure(copies: usize, j: usize) -> impl Iterator<Item = (usize, usize, Rational)> {
    (1..copies).flat_map(move |i| {
        let others = match i.cmp(&j) {
            Ordering::Less => i..i + 1,
            Ordering::Equal => j..copies,
            Ordering::Greater => j..j + 1,
        };
        others.filter_map(move |l| {
            let norm = |r: usize| (r * (r + 1)) as i64;
            let sum = match i.cmp(&l) {
                Ordering::Equal if i == j => j as i64 - (j as i64).pow(3),
                Ordering::Equal => norm(i),
                _ => norm(j),
            };
            let ratio = Rational::from_ratio(sum, norm(j))?;
            (!ratio.is_zero()).then_some((i, l, ratio))
        })
    })
}

/// Returns the orbits of a scene in its order, parents first.
pub(in crate::program) fn orbits(scene: &Scene, coordinates: &[Coordinate]) -> Vec<OrbitLinks> {
    let names = |number: usize| {
        let named = coordinates.iter().filter_map(|coordinate| {
            let (orbit, sector) = coordinate.kind.orbit_and_difference();
            (orbit == number).then(|| (sector, coordinate.name.clone()))
        });
        named.collect()
    };
    let chain = |link: LinkId| {
        let mut chain = Vec::new();
        let mut at = Some(link);
        while let Some(here) = at {
            let membership = scene.groups.iter().enumerate().find_map(|(group, g)| {
                let copy = g.copies.iter().position(|&copy| copy == here)?;
                Some((group, copy))
            });
            chain.extend(membership);
            at = scene.links[here.0].parent;
        }
        chain.reverse();
        chain
    };
    scene
        .orbits
        .iter()
        .enumerate()
        .map(|(number, orbit)| {
            let chains: Vec<Vec<(usize, usize)>> =
                orbit.links.iter().map(|&link| chain(link)).collect();
            let chains: Vec<&[(usize, usize)]> = chains.iter().map(Vec::as_slice).collect();
            let parent = scene.links[orbit.links[0].0].parent;
            OrbitLinks {
                links: orbit.links.len(),
                parent: parent.map(|LinkId(link)| scene.links[link].orbit.0),
                branch: branch(scene, &chains),
                names: names(number),
            }
        })
        .collect()
}

fn branch(scene: &Scene, chains: &[&[(usize, usize)]]) -> Option<Branch> {
    let &(group, _) = chains.first()?.first()?;
    let copies: Vec<Option<Branch>> = (0..scene.groups[group].copies.len())
        .map(|copy| {
            let inside: Vec<&[(usize, usize)]> = chains
                .iter()
                .filter(|chain| chain[0].1 == copy)
                .map(|chain| &chain[1..])
                .collect();
            branch(scene, &inside)
        })
        .collect();
    let links_per_copy = chains.len() / copies.len();
    Some(Branch {
        group,
        copies,
        links_per_copy,
    })
}

#[cfg(test)]
mod tests {
    use super::{structure, weight};
    use crate::exact::Rational;

    #[test]
    fn structure_constants_are_sums_over_copies() {
        for copies in 2..7 {
            for j in 1..copies {
                let sum = |i, l| -> i64 {
                    let terms = (0..copies).map(|a| weight(j, a) * weight(i, a) * weight(l, a));
                    terms.sum()
                };
                let pairs = (1..copies).flat_map(|i| (1..copies).map(move |l| (i, l)));
                let expected: Vec<_> = pairs
                    .filter(|&(i, l)| sum(i, l) != 0)
                    .filter_map(|(i, l)| {
                        let ratio = Rational::from_ratio(sum(i, l), (j * (j + 1)) as i64)?;
                        Some((i, l, ratio))
                    })
                    .collect();
                assert_eq!(structure(copies, j).collect::<Vec<_>>(), expected);
            }
        }
    }
}
