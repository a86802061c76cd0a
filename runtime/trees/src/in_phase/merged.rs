//! Copies that move in phase as one link each.

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

    /// Adds the differences of the first two copies, and of all that hangs from them.
    pub(super) fn differing(&mut self, whole: &[LinkNumbers], copies: &Copies) {
        let Some(group) = copies.groups().first() else {
            return;
        };
        let hanging: Vec<Vec<usize>> = group.iter().map(|&copy| carried(whole, copy)).collect();
        let sizes: Vec<f64> = hanging.iter().map(|copy| size(whole, copy)).collect();
        let all: f64 = sizes.iter().sum();
        for ((copy, size), sign) in hanging.iter().zip(&sizes).zip([1.0, -1.0]) {
            for &link in copy {
                let Some(member) = self.members.get_mut(link) else {
                    continue;
                };
                (member.sign, member.share) = (sign, 0.5 * sign * all / size);
                if let Some(own) = self.links.get_mut(member.merged) {
                    own.difference = Some(0);
                }
            }
        }
        let differing = self.links.iter_mut();
        let differing = differing.filter_map(|link| link.difference.as_mut());
        self.differences = 0;
        for number in differing {
            *number = self.differences;
            self.differences += 1;
        }
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
