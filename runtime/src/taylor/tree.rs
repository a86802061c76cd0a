//! Trees whose number of links no type tells.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::friction::RoughFriction;
use super::links::TreeLinks;
use crate::scalar::Scalar;
use crate::spring_dampers::SpringDamper;
use crate::translational::TranslationalSpringDamper;

/// A link of a tree as the recurrences of Taylor coefficients take it, in any units of mass
/// and length that go together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesLink<T> {
    /// Number of the parent, which comes before the link. The root's does not count.
    pub parent: usize,
    /// M: the diagonal of the mass matrix.
    pub inertia: T,
    /// (h, e): the first moment, about the link's pivot, of the mass that the link
    /// carries, along and across.
    pub moment: [T; 2],
    /// (ℓ, w): where the link hangs on its parent, from the parent's pivot, along and
    /// across. The root's does not count.
    pub attachment: [T; 2],
    /// G and F of the torque −G sin θ − F cos θ of gravity; of a tree whose root's pivot is
    /// moved those at a gravity of one.
    pub weight: [T; 2],
    /// Viscous friction in the pivot, on the rate relative to the parent.
    pub friction: T,
    /// Viscous drag on the link's own rate.
    pub drag: T,
    /// Stiffness of the spring in the pivot.
    pub spring: T,
    /// Relative angle at which it is at rest, rad.
    pub rest: T,
}

/// Constants of the equation of motion of a tree of any number of links, as the recurrences
/// of Taylor coefficients take them.
#[derive(Clone, Debug)]
pub struct SeriesTree<T> {
    pub(super) hanging: Arc<Hanging>,
    pub(super) inertias: Vec<T>,
    pub(super) moments: Vec<[T; 2]>,
    pub(super) attachments: Vec<[T; 2]>,
    pub(super) weights: Vec<T>,
    pub(super) lateral_weights: Vec<T>,
    /// Friction, drag, spring and rest of each link, if any has some.
    pub(super) passive: Vec<[T; 4]>,
    /// Springs and viscous friction between links that are not parent and child.
    pub(super) spring_dampers: Vec<SpringDamper<T>>,
    /// What acts along lines between points.
    pub(super) lines: Vec<TranslationalSpringDamper<T>>,
    pub(super) rough: Vec<RoughFriction<T>>,
    /// What torques are multiplied by.
    pub(super) share: T,
}

/// How the links of a tree hang on each other.
#[derive(Debug)]
pub(super) struct Hanging {
    parents: Vec<usize>,
    leaves: Vec<usize>,
    carriers: Vec<usize>,
    lateral: bool,
}

impl TreeLinks for &Hanging {
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

/// What [`SeriesTree`] is asked to hold of a tree beside its links.
#[derive(Clone, Copy, Debug)]
pub struct SeriesForm {
    /// True if some centre of mass or pivot lies aside of a link's axis.
    pub lateral: bool,
    /// True if some link has friction or drag that is viscous, or a spring.
    pub passive: bool,
}

impl<T: Scalar> SeriesTree<T> {
    /// Returns the tree of these links, the root first and parents before their children.
    /// `share` is what torques in N m are multiplied by to be in the units of the links.
    ///
    /// Links of parents that come behind them, and friction of links that there are not, are
    /// as if they hung on the root, and left out.
    #[must_use]
    pub fn new(
        links: &[SeriesLink<T>],
        rough: Vec<RoughFriction<T>>,
        share: T,
        SeriesForm { lateral, passive }: SeriesForm,
    ) -> Self {
        let numbered = links.iter().enumerate();
        let parents: Vec<usize> = numbered
            .map(|(link, own)| if own.parent < link { own.parent } else { 0 })
            .collect();
        let mut carries = alloc::vec![false; links.len()];
        // The root hands nothing on, as one that carries the others.
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
        let hanging = Hanging {
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
            rough: rough.into_iter().filter(|law| is_of(law, count)).collect(),
            share,
        }
    }

    /// Returns the tree with springs and friction between links that are not parent and child, in
    /// the units of the links; those between links that there are not are left out.
    #[must_use]
    pub fn with_spring_dampers(mut self, spring_dampers: Vec<SpringDamper<T>>) -> Self {
        let count = self.inertias.len();
        for own in spring_dampers {
            let [link, other] = own.links;
            if link.max(other) >= count {
                continue;
            }
            let law = own.law.map(|[coulomb, quadratic, width]| RoughFriction {
                link,
                other: Some(other),
                coulomb,
                quadratic,
                width,
            });
            self.rough.extend(law);
            self.spring_dampers.push(own);
        }
        self
    }

    /// Returns the tree with what acts along lines between points, with lengths in m and torques
    /// in the units of the links; lines with arms of links that there are not are left out.
    #[must_use]
    pub fn with_lines(mut self, lines: Vec<TranslationalSpringDamper<T>>) -> Self {
        let count = self.inertias.len();
        let is_of =
            |own: &TranslationalSpringDamper<T>| own.arms.iter().all(|arm| arm.link < count);
        self.lines.extend(lines.into_iter().filter(is_of));
        self
    }

    /// Takes every constant through `convert`.
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SeriesTree<S> {
        let pairs = |pairs: &[[T; 2]]| pairs.iter().map(|pair| pair.map(&convert)).collect();
        let numbers = |numbers: &[T]| numbers.iter().copied().map(&convert).collect();
        let rough = self.rough.iter().map(|law| law.map(&convert));
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
            rough: rough.collect(),
            share: convert(self.share),
        }
    }
}

/// Returns true for friction of links of a tree of so many.
fn is_of<T>(law: &RoughFriction<T>, count: usize) -> bool {
    law.link < count && law.other.is_none_or(|other| other < count)
}
