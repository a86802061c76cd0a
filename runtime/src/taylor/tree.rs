//! Constants for Taylor expansions of trees whose number of links is not a compile-time constant.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::friction::NonViscousFriction;
use super::links::TreeLinks;
use crate::scalar::Scalar;
use crate::spring_dampers::SpringDamper;
use crate::translational::TranslationalSpringDamper;

/// Constants of a link in the Taylor recurrences, in any consistent units of mass and length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesLink<T> {
    /// Index of the parent. Parents come before their children; the value is ignored for the root.
    pub parent: usize,
    /// Diagonal entry M of the mass matrix.
    pub inertia: T,
    /// First moment (h, e) of the mass that the link carries, about the link's pivot, along and
    /// across the link.
    pub moment: [T; 2],
    /// Position (ℓ, w) of the link's pivot relative to the parent's pivot, along and across the
    /// parent; unused for the root.
    pub attachment: [T; 2],
    /// Coefficients G and F of the torque of gravity, −G sin θ − F cos θ. If the root's pivot is
    /// driven, they are torques at a gravity of 1.
    pub weight: [T; 2],
    /// Coefficient of viscous friction in the pivot, on the rate relative to the parent.
    pub friction: T,
    /// Coefficient of viscous drag on the link's absolute rate.
    pub drag: T,
    /// Stiffness of the spring in the pivot.
    pub spring: T,
    /// Relative angle at which the spring is relaxed, in rad.
    pub rest: T,
}

/// Constants of the equation of motion of a tree with any number of links, in the form that the
/// Taylor recurrences use.
#[derive(Clone, Debug)]
pub struct SeriesTree<T> {
    pub(super) hanging: Arc<Topology>,
    pub(super) inertias: Vec<T>,
    pub(super) moments: Vec<[T; 2]>,
    pub(super) attachments: Vec<[T; 2]>,
    pub(super) weights: Vec<T>,
    pub(super) lateral_weights: Vec<T>,
    /// Friction, drag, spring stiffness and rest angle of each link; empty if all are zero.
    pub(super) passive: Vec<[T; 4]>,
    /// Springs and viscous friction between links that are not parent and child.
    pub(super) spring_dampers: Vec<SpringDamper<T>>,
    /// Springs, repulsions and dampers along lines between points.
    pub(super) lines: Vec<TranslationalSpringDamper<T>>,
    pub(super) non_viscous: Vec<NonViscousFriction<T>>,
    /// Factor that converts torques from N m to the units of the links.
    pub(super) share: T,
}

/// Topology of a tree: parents, links with children, leaves.
#[derive(Debug)]
pub(super) struct Topology {
    parents: Vec<usize>,
    leaves: Vec<usize>,
    carriers: Vec<usize>,
    lateral: bool,
}

impl TreeLinks for &Topology {
    #[inline(always)]
    fn count(&self) -> usize {
        self.parents.len()
    }

    #[inline(always)]
    fn parent(&self, link: usize) -> usize {
        self.parents[link]
    }

    #[inline(always)]
    fn leaves(&self) -> &[usize] {
        &self.leaves
    }

    #[inline(always)]
    fn carriers(&self) -> &[usize] {
        &self.carriers
    }

    #[inline(always)]
    fn lateral(&self) -> bool {
        self.lateral
    }
}

/// Tells which optional parts of a tree [`SeriesTree`] has to store.
#[derive(Clone, Copy, Debug)]
pub struct SeriesForm {
    /// True if a centre of mass or a pivot lies off a link's axis.
    pub lateral: bool,
    /// True if a link has viscous friction, drag or a spring.
    pub passive: bool,
}

impl<T: Scalar> SeriesTree<T> {
    /// Creates the tree of these links, the root first and parents before their children. `share`
    /// is the factor that converts torques in N m to the units of the links.
    ///
    /// A link whose parent comes after it is attached to the root; friction of links that do not
    /// exist is ignored.
    #[must_use]
    pub fn new(
        links: &[SeriesLink<T>],
        non_viscous: Vec<NonViscousFriction<T>>,
        share: T,
        SeriesForm { lateral, passive }: SeriesForm,
    ) -> Self {
        let numbered = links.iter().enumerate();
        let parents: Vec<usize> = numbered
            .map(|(link, own)| if own.parent < link { own.parent } else { 0 })
            .collect();
        let mut carries = alloc::vec![false; links.len()];
        // The root passes nothing on, but belongs to the links with children.
        if let Some(root) = carries.first_mut() {
            *root = true;
        }
        for &parent in parents.iter().skip(1) {
            carries[parent] = true;
        }
        let listed = |this: bool| {
            let links = (0..links.len()).rev();
            links.filter(|link| carries[*link] == this).collect()
        };
        let hanging = Topology {
            leaves: listed(false),
            carriers: listed(true),
            parents,
            lateral,
        };
        let own = links.iter().filter(|_| passive);
        let passive = own.map(|own| [own.friction, own.drag, own.spring, own.rest]);
        let count = links.len();
        Self {
            hanging: Arc::new(hanging),
            inertias: links.iter().map(|own| own.inertia).collect(),
            moments: links.iter().map(|own| own.moment).collect(),
            attachments: links.iter().map(|own| own.attachment).collect(),
            weights: links.iter().map(|own| own.weight[0]).collect(),
            lateral_weights: links.iter().map(|own| own.weight[1]).collect(),
            passive: passive.collect(),
            spring_dampers: Vec::new(),
            lines: Vec::new(),
            non_viscous: non_viscous
                .into_iter()
                .filter(|law| is_of(law, count))
                .collect(),
            share,
        }
    }

    /// Adds springs and friction between links that are not parent and child, in the units of the
    /// links. Entries of links that do not exist are ignored.
    #[must_use]
    pub fn with_spring_dampers(mut self, spring_dampers: Vec<SpringDamper<T>>) -> Self {
        let count = self.inertias.len();
        for own in spring_dampers {
            let [link, other] = own.links;
            if link.max(other) >= count {
                continue;
            }
            let other = Some(other);
            let non_viscous = own.law.map(|law| NonViscousFriction { link, other, law });
            self.non_viscous.extend(non_viscous);
            self.spring_dampers.push(own);
        }
        self
    }

    /// Adds springs, repulsions and dampers along lines between points, with lengths in m and
    /// torques in the units of the links. Lines on links that do not exist are ignored.
    #[must_use]
    pub fn with_lines(mut self, lines: Vec<TranslationalSpringDamper<T>>) -> Self {
        let count = self.inertias.len();
        let is_of =
            |own: &TranslationalSpringDamper<T>| own.arms.iter().all(|arm| arm.link < count);
        self.lines.extend(lines.into_iter().filter(is_of));
        self
    }

    /// Converts every constant with `convert`.
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SeriesTree<S> {
        let pairs = |pairs: &[[T; 2]]| pairs.iter().map(|pair| pair.map(&convert)).collect();
        let numbers = |numbers: &[T]| numbers.iter().copied().map(&convert).collect();
        let non_viscous = self.non_viscous.iter().map(|law| law.map(&convert));
        SeriesTree {
            hanging: Arc::clone(&self.hanging),
            inertias: numbers(&self.inertias),
            moments: pairs(&self.moments),
            attachments: pairs(&self.attachments),
            weights: numbers(&self.weights),
            lateral_weights: numbers(&self.lateral_weights),
            passive: self.passive.iter().map(|own| own.map(&convert)).collect(),
            spring_dampers: self
                .spring_dampers
                .iter()
                .map(|own| own.map(&convert))
                .collect(),
            lines: self.lines.iter().map(|own| own.map(&convert)).collect(),
            non_viscous: non_viscous.collect(),
            share: convert(self.share),
        }
    }
}

/// Returns true if all links of a friction law exist in a tree of `count` links.
fn is_of<T>(law: &NonViscousFriction<T>, count: usize) -> bool {
    law.link < count && law.other.is_none_or(|other| other < count)
}
