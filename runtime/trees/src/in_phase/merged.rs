//! Merging of copies that move in phase: all copies of a link become one link.

use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_codegen::scene::{FrictionContact, PassiveTorques};

use crate::numbers::LinkNumbers;

/// Link of an in-phase tree: a single link, or all of its copies merged.
#[derive(Clone, Copy, Debug)]
pub(super) struct MergedLink {
    /// Index, in the whole tree, of the first link that is merged here.
    pub(super) first: usize,
    /// Index of the parent among the merged links; 0 for the root.
    pub(super) parent: usize,
    /// True if the link has children.
    pub(super) carries: bool,
    /// Index of the link's difference, if the first two copies differ in this link.
    pub(super) difference: Option<usize>,
}

/// Link of the whole tree, as a part of a merged link.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    /// Index of the merged link that it belongs to.
    pub(super) merged: usize,
    /// Factor of the difference in this link's angle: 1 in the first copy, −1 in the second, 0 in
    /// all others.
    pub(super) sign: f64,
    /// Factor of a small torque on this link in the torque on the difference.
    pub(super) share: f64,
}

/// All links of an in-phase tree, parents before children.
#[derive(Clone, Debug)]
pub(super) struct MergedLinks {
    pub(super) links: Vec<MergedLink>,
    pub(super) members: Vec<Member>,
    pub(super) differences: usize,
}

impl MergedLinks {
    /// Merges the copies; their groups refer to states of angles followed by angular velocities.
    pub(super) fn of(parents: &[Option<usize>], copies: &Copies) -> Self {
        let mut first: Vec<usize> = (0..parents.len()).collect();
        for group in copies.groups() {
            let least = group.iter().copied().min().unwrap_or(0);
            for &link in group {
                if let Some(own) = first.get_mut(link) {
                    *own = least;
                }
            }
        }
        let mut links: Vec<MergedLink> = Vec::new();
        let mut members: Vec<Member> = Vec::new();
        for (link, &first) in first.iter().enumerate() {
            let merged = match members.get(first) {
                Some(member) => member.merged,
                None => {
                    let above = parents.get(link).copied().flatten();
                    let parent = above.and_then(|above| members.get(above));
                    let parent = parent.map_or(0, |parent| parent.merged);
                    if let (Some(_), Some(place)) = (above, links.get_mut(parent)) {
                        place.carries = true;
                    }
                    links.push(MergedLink {
                        first,
                        parent,
                        carries: false,
                        difference: None,
                    });
                    links.len() - 1
                }
            };
            members.push(Member {
                merged,
                sign: 0.0,
                share: 0.0,
            });
        }
        Self {
            links,
            members,
            differences: 0,
        }
    }

    /// Adds the differences of the first two copies and of their subtrees. Returns `None` for links
    /// that are not merged. It also returns `None` if the parents of the two copies are two
    /// different links that are in phase, because the difference would separate these.
    pub(super) fn differing(&mut self, whole: &[LinkNumbers], copies: &Copies) -> Option<()> {
        let &[one, other, ..] = copies.groups().first()?.as_slice() else {
            return None;
        };
        let merged = |link: usize| self.members.get(link).map(|own| own.merged);
        let [above, beside] = [one, other].map(|link| whole.get(link)?.parent);
        let is_apart = above != beside && above.and_then(merged) == beside.and_then(merged);
        let both = [one, other].map(|copy| carried(whole, copy));
        let of_both = [&both[0], &both[1]].map(|copy| copy.iter().copied().filter_map(merged));
        let [of_one, of_other] = of_both.map(Iterator::collect::<BTreeSet<usize>>);
        if is_apart || one == other || of_one != of_other {
            return None;
        }
        let alike = (0..self.members.len()).filter(|&link| merged(link) == merged(one));
        let all: f64 = alike.map(|copy| size(whole, &carried(whole, copy))).sum();
        for (copy, sign) in both.iter().zip([1.0, -1.0]) {
            let share = 0.5 * sign * all / size(whole, copy);
            for &link in copy {
                if let Some(member) = self.members.get_mut(link) {
                    (member.sign, member.share) = (sign, share);
                }
            }
        }
        for link in &mut self.links {
            link.difference = None;
        }
        for (number, &link) in of_one.iter().enumerate() {
            if let Some(own) = self.links.get_mut(link) {
                own.difference = Some(number);
            }
        }
        self.differences = of_one.len();
        Some(())
    }

    /// Returns the merged links with their constants, which are the sums of the copies' masses,
    /// stiffnesses and frictions.
    pub(super) fn numbers(&self, whole: &[LinkNumbers]) -> Vec<LinkNumbers> {
        let mut sums: Vec<Option<LinkNumbers>> = vec![None; self.links.len()];
        for (own, member) in whole.iter().zip(&self.members) {
            let parent = own.parent.and_then(|parent| self.members.get(parent));
            let parent = parent.map(|member| member.merged);
            if let Some(sum) = sums.get_mut(member.merged) {
                *sum = Some(match sum {
                    None => LinkNumbers { parent, ..*own },
                    Some(others) => with(others, own),
                });
            }
        }
        sums.into_iter().flatten().collect()
    }

    /// Returns a number that differs between merged trees of different topology.
    pub(super) fn shape(&self) -> usize {
        let mut hasher = DefaultHasher::new();
        for member in &self.members {
            (member.merged, member.sign.to_bits()).hash(&mut hasher);
        }
        hasher.finish() as usize
    }
}

/// Returns the indices of a link and of all links below it.
fn carried(links: &[LinkNumbers], first: usize) -> Vec<usize> {
    let mut hangs = vec![false; links.len()];
    for (link, numbers) in links.iter().enumerate() {
        let above = numbers.parent.and_then(|parent| hangs.get(parent));
        let hangs_too = link == first || above.copied().unwrap_or(false);
        if let Some(place) = hangs.get_mut(link) {
            *place = hangs_too;
        }
    }
    (0..links.len()).filter(|&link| hangs[link]).collect()
}

/// Returns a measure of a copy's size: masses, moments of inertia and torques of copies must be in
/// the ratio of these. Copies whose masses differ by a common factor can move in phase too.
fn size(links: &[LinkNumbers], own: &[usize]) -> f64 {
    let numbers = own.iter().filter_map(|&link| links.get(link));
    numbers.map(|link| (link.mass + link.inertia).high()).sum()
}

/// Returns `sum` with the constants of a copy added.
fn with(sum: &LinkNumbers, copy: &LinkNumbers) -> LinkNumbers {
    let (own, other) = (&sum.passive, &copy.passive);
    let law = |place: FrictionContact| {
        let (own, other) = (own.law(place), other.law(place));
        own.combined(other, |a, b| *a + *b)
    };
    LinkNumbers {
        mass: sum.mass + copy.mass,
        inertia: sum.inertia + copy.inertia,
        passive: PassiveTorques {
            friction: own.friction + other.friction,
            drag: own.drag + other.drag,
            spring: own.spring + other.spring,
            rest: own.rest,
            laws: FrictionContact::ALL.map(law),
        },
        ..*sum
    }
}
