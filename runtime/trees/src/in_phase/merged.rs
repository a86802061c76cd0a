//! Copies that move in phase as one link each.

use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_codegen::scene::{FrictionLaw, PassiveTorques};

use crate::numbers::LinkNumbers;

/// A link of the motion in phase: one, or all copies of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct MergedLink {
    /// The first of its links in the whole tree.
    pub(super) first: usize,
    /// Number of the parent among the merged links; of the root 0.
    pub(super) parent: usize,
    /// Others hang from it.
    pub(super) carries: bool,
    /// Number of its difference, where the first two copies differ in it.
    pub(super) difference: Option<usize>,
}

/// A link of the whole tree among merged ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    /// The merged link that it is part of.
    pub(super) merged: usize,
    /// What the difference of that link adds to its angle for each unit: 1 in the first copy, −1
    /// in the second one, zero in others.
    pub(super) sign: f64,
    /// Part of a small torque on it in that on the difference.
    pub(super) share: f64,
}

/// The links of a motion in phase: a parent stands before its children.
#[derive(Clone, Debug)]
pub(super) struct MergedLinks {
    pub(super) links: Vec<MergedLink>,
    pub(super) members: Vec<Member>,
    pub(super) differences: usize,
}

impl MergedLinks {
    /// Merges the copies. Their state is that of angles followed by angular velocities.
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

    /// Adds the differences of the first two copies, and of all that hangs from them. None of
    /// links that are not merged, and of those that hang from two links in phase, which their
    /// difference sets apart.
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

    /// Returns the links with their constants: what copies have of mass, stiffness and friction is
    /// added up.
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

    /// Returns a number by which merged trees of other shapes differ.
    pub(super) fn shape(&self) -> usize {
        let mut hasher = DefaultHasher::new();
        for member in &self.members {
            (member.merged, member.sign.to_bits()).hash(&mut hasher);
        }
        hasher.finish() as usize
    }
}

/// A link and all that hangs from it.
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

/// A quantity that copies have in the ratio of all their masses, moments of inertia and torques:
/// copies of unlike masses can move alike too.
fn size(links: &[LinkNumbers], own: &[usize]) -> f64 {
    let numbers = own.iter().filter_map(|&link| links.get(link));
    numbers.map(|link| (link.mass + link.inertia).high()).sum()
}

/// Adds the constants of a copy to those of others.
fn with(sum: &LinkNumbers, copy: &LinkNumbers) -> LinkNumbers {
    let (own, other) = (&sum.passive, &copy.passive);
    let law = |place: usize| FrictionLaw {
        coulomb: own.laws[place].coulomb + other.laws[place].coulomb,
        quadratic: own.laws[place].quadratic + other.laws[place].quadratic,
        width: own.laws[place].width,
    };
    LinkNumbers {
        mass: sum.mass + copy.mass,
        inertia: sum.inertia + copy.inertia,
        passive: PassiveTorques {
            friction: own.friction + other.friction,
            drag: own.drag + other.drag,
            spring: own.spring + other.spring,
            rest: own.rest,
            laws: [law(0), law(1)],
        },
        ..*sum
    }
}
