//! Constants of springs and friction between links that are not parent and child, and the sums of
//! symmetric coordinates that they depend on.
//!
//! Between all copies under one link the linear torques are diagonal in the differences: each is n
//! κ times one coordinate, with n computed from the weights alone.

use super::series::TruncatedSeries;
use super::tree::SectorId;
use crate::mechanics::PairElement;
use crate::scene::{Coordinate, PassiveTorques};
use std::collections::BTreeMap;

/// A sum of symmetric coordinates: orbit (set of equal copies of one link), sector and weight of
/// each.
pub(super) type WeightedSum = Vec<((usize, SectorId), i64)>;

/// Values of a spring-damper between two links, or between all copies of a node.
pub(in crate::program) struct SpringDamperValues {
    pub(in crate::program) passive: PassiveTorques<TruncatedSeries>,
    /// Numbers n and sums u of coordinates in the spring's energy ½ κ Σ n (u − ρ)². Each sum
    /// belongs to one sector, unless springs couple sectors.
    pub(super) strains: Vec<(i64, WeightedSum)>,
    /// Numbers n and sums u of coordinates in the power −c Σ n u² of viscous friction.
    pub(super) slips: Vec<(i64, WeightedSum)>,
    /// Difference of the two angles, for each pair of links.
    pub(super) pairs: Vec<WeightedSum>,
}

impl SpringDamperValues {
    /// Creates the spring-dampers of all pairs; `passive` returns the constants of a pair.
    /// `couples` is true if their springs together couple sectors.
    pub(in crate::program) fn of(
        pairs: &[PairElement],
        coordinates: &[Coordinate],
        couples: bool,
        mut passive: impl FnMut(&PairElement) -> PassiveTorques<TruncatedSeries>,
    ) -> Vec<Self> {
        let mut found: Vec<Self> = Vec::new();
        for same in pairs.chunk_by(|a, b| a.pair.spring_damper == b.pair.spring_damper) {
            let sums: Vec<Vec<(usize, i64)>> = same
                .iter()
                .map(|own| own.pair.weights(coordinates))
                .collect();
            let named = |sum: &Vec<(usize, i64)>| -> WeightedSum {
                let own = sum.iter();
                own.map(|&(index, weight)| (coordinates[index].kind.orbit_and_difference(), weight))
                    .collect()
            };
            let slips: Vec<(i64, WeightedSum)> = match sums.as_slice() {
                [sum] => vec![(1, named(sum))],
                sums => squares(sums)
                    .into_iter()
                    .map(|(index, number)| (number, named(&vec![(index, 1)])))
                    .collect(),
            };
            found.push(Self {
                passive: passive(&same[0]),
                strains: match couples {
                    true => slips.clone(),
                    false => by_sector(&slips),
                },
                slips,
                pairs: sums.iter().map(named).collect(),
            });
        }
        found
    }
}

/// Splits the sums by sector. Terms that couple sectors cancel between the springs.
fn by_sector(sums: &[(i64, WeightedSum)]) -> Vec<(i64, WeightedSum)> {
    let mut parts = Vec::new();
    for (number, sum) in sums {
        let mut sectors: Vec<SectorId> = Vec::new();
        for &((_, sector), _) in sum {
            if !sectors.contains(&sector) {
                sectors.push(sector);
            }
        }
        for sector in sectors {
            let own = sum.iter().filter(|((_, known), _)| *known == sector);
            parts.push((*number, own.copied().collect()));
        }
    }
    parts
}

/// Returns Σ w² of each coordinate over the differences between all copies under one link. Products
/// of two coordinates cancel.
fn squares(sums: &[Vec<(usize, i64)>]) -> BTreeMap<usize, i64> {
    let mut squares = BTreeMap::new();
    for &(index, weight) in sums.iter().flatten() {
        *squares.entry(index).or_default() += weight * weight;
    }
    squares
}
