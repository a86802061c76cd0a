//! Straight springs that do not couple sectors (sets of symmetric coordinates: all means, or one
//! difference between copies) (physics (19.10)).
//!
//! The length of a straight spring usually depends on several sectors. Springs of zero rest length
//! are an exception if they connect every two copies under one link, at the same point of each
//! copy. Their energy depends only on the sectors of these copies' differences.

use std::collections::BTreeMap;

use super::{
    DescribedLinePotential, DescribedTranslationalSpringDamper, Group, LineEnds, LinkId, Quantity,
    Scene, SpringDamperEnds, SpringLine,
};
use crate::report::NoChord;

/// Straight springs between the same point of every two copies of a group.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedChordSpring {
    /// Index of the group of copies.
    pub group: usize,
    /// κ r² between two copies, in J: stiffness times the squared distance of the point from the
    /// pivot, summed over the springs between the two.
    pub strength: Quantity,
}

impl Scene {
    /// Returns the straight springs of each group of copies, summed over all clauses, if every
    /// straight spring is of this kind. The groups are those of the whole tree.
    ///
    /// # Errors
    /// The indices in [`Scene::translational`] of the clauses that are not of this kind, each with
    /// the reason.
    pub fn chord_springs(
        &self,
        groups: &[Group],
    ) -> Result<Vec<DescribedChordSpring>, BTreeMap<usize, NoChord>> {
        let mut other: BTreeMap<usize, NoChord> = BTreeMap::new();
        let mut pairs: BTreeMap<[usize; 2], Vec<(usize, Quantity)>> = BTreeMap::new();
        let group_of = by_link(groups);
        for line in self.lines() {
            let index = line.spring_damper;
            match chord(&self.translational[index], &line, &group_of) {
                Ok((links, strength)) => pairs.entry(links).or_default().push((index, strength)),
                Err(cause) => {
                    other.entry(index).or_insert(cause);
                }
            }
        }
        let mut springs = Vec::new();
        for (group, own) in groups.iter().enumerate() {
            let of_pair = |a: usize, b: usize| {
                let found = pairs.get(&[a.min(b), a.max(b)]);
                found.map_or(&[][..], Vec::as_slice)
            };
            let copies: Vec<usize> = own.copies.iter().map(|&LinkId(copy)| copy).collect();
            let two = |(place, &a): (usize, &usize)| {
                let others = copies[place + 1..].iter();
                others.map(move |&b| of_pair(a, b)).collect::<Vec<_>>()
            };
            let all: Vec<&[(usize, Quantity)]> = copies.iter().enumerate().flat_map(two).collect();
            let Some(first) = all.first().copied() else {
                continue;
            };
            if all.iter().all(|pair| are_equal(first, pair)) {
                let strength = sum(first);
                if !strength.is_zero() {
                    springs.push(DescribedChordSpring { group, strength });
                }
                continue;
            }
            // A `siblings` clause is equal between all copies and cannot cause the difference.
            for &(index, _) in all.into_iter().flatten() {
                let ends = &self.translational[index].ends;
                if matches!(ends, LineEnds::Links(SpringDamperEnds::Links(_), _)) {
                    other.entry(index).or_insert(NoChord::SomeCopies);
                }
            }
        }
        match other.is_empty() {
            true => Ok(springs),
            false => Err(other),
        }
    }
}

/// Returns, for each link that is a copy, the index of its group.
fn by_link(groups: &[Group]) -> BTreeMap<usize, usize> {
    let groups = groups.iter().enumerate();
    let copies = groups.flat_map(|(group, own)| {
        let copies = own.copies.iter();
        copies.map(move |&LinkId(copy)| (copy, group))
    });
    copies.collect()
}

fn sum(springs: &[(usize, Quantity)]) -> Quantity {
    Quantity::sum(springs.iter().map(|(_, strength)| strength.clone()))
}

fn are_equal(one: &[(usize, Quantity)], other: &[(usize, Quantity)]) -> bool {
    let (one, other) = (sum(one), sum(other));
    one == other || Quantity::sum([one, other.negative()]).is_zero()
}

/// Returns the two connected copies, in the order of the line, and κ r² in J.
fn chord(
    own: &DescribedTranslationalSpringDamper,
    line: &SpringLine,
    group_of: &BTreeMap<usize, usize>,
) -> Result<([usize; 2], Quantity), NoChord> {
    let (LineEnds::Links(_, [first, second]), &[LinkId(a), LinkId(b)]) =
        (&own.ends, line.links.as_slice())
    else {
        return Err(NoChord::Guy);
    };
    if !own.friction.is_zero() {
        return Err(NoChord::Damper);
    }
    let mut stiffness = Quantity::zero();
    for potential in &own.potentials {
        match potential {
            DescribedLinePotential::InversePower { .. } => return Err(NoChord::Repulsion),
            DescribedLinePotential::Spring { rest, .. } if !rest.is_zero() => {
                return Err(NoChord::Rest);
            }
            DescribedLinePotential::Spring { stiffness: own, .. } => stiffness = own.clone(),
        }
    }
    match [a, b].map(|link| group_of.get(&link)) {
        [Some(one), Some(other)] if one == other => {}
        _ => return Err(NoChord::OtherLinks),
    }
    // Arms of other links remain if the two pivots differ.
    let are_alone = line
        .arms
        .iter()
        .all(|(LinkId(link), _)| [a, b].contains(link));
    if first != second || !are_alone {
        return Err(NoChord::OtherPlaces);
    }
    let squares = [&first.along, &first.lateral]
        .map(|component| Quantity::product([component.clone(), component.clone()]));
    let strength = Quantity::product([stiffness, Quantity::sum(squares)]);
    Ok(([a.min(b), a.max(b)], strength))
}
