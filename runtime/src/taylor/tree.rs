//! Trees whose number of links no type tells.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::expand::{Expansion, workspace};
use super::lent::{LentRooms, lent};
use super::links::TreeLinks;
use super::orders::{Constants, Origin};
use super::room::RoomsOfFew;
use super::torques::{RoughFriction, TreeTorques, law_room};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::simd::{Quad, Simd};

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
    inertias: Vec<T>,
    moments: Vec<[T; 2]>,
    attachments: Vec<[T; 2]>,
    weights: Vec<T>,
    lateral_weights: Vec<T>,
    /// Friction, drag, spring and rest of each link, if any has some.
    pub(super) passive: Vec<[T; 4]>,
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
    /// TreeLinks of parents that come behind them, and friction of links that there are not, are
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
            rough: rough.into_iter().filter(|law| law.link < count).collect(),
            share,
        }
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
            rough: rough.collect(),
            share: convert(self.share),
        }
    }

    /// Returns the number of quads that [`expand`](Self::expand) works in, to order `order`.
    #[must_use]
    pub fn workspace(&self, order: usize) -> usize {
        let links = self.inertias.len();
        let laws = self.rough.len() * law_room(order);
        workspace(links, order) + lent(links) + 3 * links.div_ceil(4) + laws
    }

    /// Writes the Taylor coefficients of the motion through angles `theta` and angular
    /// velocities `omega`, order by order: those of the angles, then those of the angular
    /// velocities.
    ///
    /// `drive` has for each order the acceleration of the root's pivot, across and along the
    /// direction of gravity, with gravity in order 0, and the torque on the root in N m, if
    /// there is a drive; [`SeriesLink::weight`] is at a gravity of one then. Where lengths do
    /// not fit, all coefficients are NaN.
    #[inline(always)]
    pub fn expand(
        &self,
        [theta, omega]: [&[T]; 2],
        drive: Option<&[Quad<T>]>,
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    ) {
        let links = self.inertias.len();
        let count = coefficients.len() / (2 * links).max(1);
        let order = count.saturating_sub(1);
        let fits = [theta.len(), omega.len()] == [links; 2]
            && coefficients.len() == 2 * links * count
            && work.len() >= self.workspace(order)
            && drive.is_none_or(|drive| drive.len() >= count);
        if !fits || links == 0 {
            coefficients.fill(T::from_f64(f64::NAN));
            return;
        }
        let mut halves = coefficients.chunks_exact_mut(links);
        for angles in [theta, omega] {
            // Velocities of order 1 follow.
            if let (Some(own), Some(next)) = (halves.next(), halves.next()) {
                own.copy_from_slice(angles);
                next.copy_from_slice(omega);
            }
        }
        let (work, rest) = work.split_at_mut(workspace(links, order));
        let quads = links.div_ceil(4);
        let (free, rest) = rest.split_at_mut(lent(links));
        let (sines, rest) = rest.split_at_mut(quads);
        let (cosines, rest) = rest.split_at_mut(quads);
        let (first, laws) = rest.split_at_mut(quads);
        turn(theta, sines, cosines);
        let mut torques = TreeTorques {
            tree: self,
            drive,
            laws,
            room: law_room(order),
        };
        torques.start([theta, omega], first);
        let expansion = Expansion {
            links: &*self.hanging,
            origin: Origin {
                omega,
                sines: &*sines,
                cosines: &*cosines,
                bias: &*first,
            },
            constants: Constants {
                inertias: &self.inertias,
                moments: &self.moments,
                attachments: &self.attachments,
                weights: &self.weights,
                lateral_weights: &self.lateral_weights,
            },
            coefficients,
            count,
        };
        T::by_kind(InRooms {
            expansion,
            free,
            work,
            torques,
        });
    }
}

/// Runs an expansion in the room that serves its numbers.
struct InRooms<'a, 'w, T> {
    expansion: Expansion<'w, T, &'a Hanging, &'w [Quad<T>]>,
    free: &'w mut [Quad<T>],
    work: &'w mut [Quad<T>],
    torques: TreeTorques<'w, T>,
}

impl<T: Scalar> ByKind<T> for InRooms<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        let links = self.expansion.links.count();
        // Few plain numbers lie in registers. Others are too many for these, and compiling room
        // for few of them apart would take twice the time.
        if const { size_of::<T>() <= size_of::<f64>() } {
            match links {
                1..=4 => {
                    let rooms = RoomsOfFew::<4, 1> { links };
                    self.expansion.run(rooms, self.work, self.torques);
                }
                5..=8 => {
                    let rooms = RoomsOfFew::<8, 2> { links };
                    self.expansion.run(rooms, self.work, self.torques);
                }
                _ => self.in_lent_room(),
            }
        } else {
            self.in_lent_room();
        }
    }

    #[inline(always)]
    fn of_wide<W: Scalar>(self)
    where
        T: Simd<W>,
    {
        self.in_lent_room();
    }
}

impl<T: Scalar> InRooms<'_, '_, T> {
    #[inline(always)]
    fn in_lent_room(self) {
        let links = self.expansion.links.count();
        let free = self.free;
        let rooms = LentRooms { free, links };
        self.expansion.run(rooms, self.work, self.torques);
    }
}

/// Writes sines and cosines of all links, zeros where there is no link.
#[inline(always)]
fn turn<T: Scalar>(theta: &[T], sines: &mut [Quad<T>], cosines: &mut [Quad<T>]) {
    for ((four, sines), cosines) in theta.chunks(4).zip(sines).zip(cosines) {
        let mut angles = [T::from_f64(0.0); 4];
        for (angle, own) in angles.iter_mut().zip(four) {
            *angle = *own;
        }
        (sines.0, cosines.0) = T::sin_cos_each(&angles);
    }
}
