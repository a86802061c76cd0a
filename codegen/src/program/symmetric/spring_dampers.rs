//! Constants of springs and friction between links that are not parent and child, and the sums
//! of symmetric coordinates that they act on.
//!
//! Between all copies under one link the sums of the linear torques are diagonal: n κ of one
//! coordinate by itself, with n formed of weights alone.

use super::series::TruncatedSeries;
use super::tree::SectorId;
use crate::mechanics::PairElement;
use crate::scene::{Coordinate, PassiveTorques};
use std::collections::BTreeMap;

/// A sum of symmetric coordinates, each by its orbit and sector, with their weights.
pub(super) type WeightedSum = Vec<((usize, SectorId), i64)>;

/// A spring-damper between two links, or between all copies of a node.
pub(in crate::program) struct SpringDamperValues {
    pub(in crate::program) passive: PassiveTorques<TruncatedSeries>,
    /// Numbers n and sums u with the energy ½ κ Σ n (u − ρ)² of the spring, each of one sector
    /// unless springs couple sectors.
    pub(super) strains: Vec<(i64, WeightedSum)>,
    /// Numbers n and sums u with the power −c Σ n u² of viscous friction.
    pub(super) slips: Vec<(i64, WeightedSum)>,
    /// Differences of the links, two by two.
    pub(super) pairs: Vec<WeightedSum>,
}

impl SpringDamperValues {
    /// All of the pairs' spring-dampers; `passive` says what the constants of a pair are.
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

/// The sums sector by sector: what couples these cancels between several springs.
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

/// Σ w² of each coordinate over the differences of all copies under one link; products of
/// two coordinates cancel.
fn squares(sums: &[Vec<(usize, i64)>]) -> BTreeMap<usize, i64> {
    let mut squares = BTreeMap::new();
    for &(index, weight) in sums.iter().flatten() {
        *squares.entry(index).or_default() += weight * weight;
    }
    squares
}
