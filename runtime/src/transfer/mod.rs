//! Energy transfer W between the sectors of any tree with copies, computed from numbers at run
//! time.
//!
//! A [`SymmetricTree`] is a tree given by numbers, with the sectors that its copies define (sets of
//! symmetric coordinates: all means, or one difference between copies). It provides symmetric
//! coordinates and their momenta, energies of the sectors in each definition, and the transfers W
//! into them: exact, by orders of the amplitude, in the published form, and the powers of friction,
//! the drive and external torques. No code is compiled for a single tree, so that trees read while
//! a program runs can use it (`branched_pendulum_trees::PendulumTree::symmetric`). The formulas are
//! those of compiled models (`docs/physics.md`, sections 5, 9 and 14), in absolute angles. Terms of
//! small differences therefore have rounding errors in proportion to the in-phase motion, whereas
//! those of compiled models are in proportion to the differences.

mod block;
mod budget;
mod chords;
mod constants;
mod exact;
mod forces;
mod memory;
mod motion;
mod orders;
mod parseval;
mod pattern;
mod sector;
mod shape;
mod springs;
mod states;
#[cfg(test)]
mod tests;

pub use budget::{EnergyDefinition, SectorBudget};
pub use chords::ChordSpring;
pub use constants::RigidLink;
pub use forces::NonConservative;
pub use orders::{Order, OrderedTransfers, TransfersByForm};

use alloc::sync::Arc;
use alloc::vec::Vec;

use chords::Chords;
use constants::{MassConstants, moments, rounded};
use forces::Passive;
use shape::SymmetricShape;
use springs::SectorSprings;

use crate::friction::FrictionLaw;
use crate::scalar::{Double, Scalar, at};
use crate::sectors::{Sector, Sectors};
use crate::spring_dampers::SpringDampers;

/// A tree with copies in numbers `T`, in its symmetric coordinates.
///
/// Functions take a state in one of the forms of [`StateInput`] and write one result per
/// [sector](Sectors::sectors). The caller keeps the workspace: the first evaluation allocates it,
/// later ones allocate nothing. Effort: O(n · depth²) from momenta and O(n · depth) from velocities
/// of n links.
///
/// # Examples
///
/// The paper's pendulum: W into the antiphase mode as published, to second and fourth order of
/// the amplitude, and exact.
///
/// ```
/// use branched_pendulum::friction::FrictionLaw;
/// use branched_pendulum::scalar::Double;
/// use branched_pendulum::sectors::{Sector, SectorCoordinate};
/// use branched_pendulum::system::Workspace;
/// use branched_pendulum::transfer::{StateInput, RigidLink, SymmetricTree};
/// use branched_pendulum::{Transfer, TransferForm};
///
/// let link = |parent, mass, com, inertia, pivot| RigidLink {
///     parent,
///     mass,
///     inertia,
///     com: [com, 0.0],
///     pivot: [pivot, 0.0],
///     spring: 0.0,
///     rest: 0.0,
///     friction: 0.0,
///     drag: 0.0,
///     laws: [FrictionLaw::none(); 2],
/// };
/// let child = link(Some(0), 0.10531, 0.043, 0.516e-3, 0.27);
/// let links = [link(None, 0.12880, 0.084, 1.88e-3, 0.0), child, child];
/// let sector = |name: &str, coordinates: &[(&str, &[(usize, f64)])]| {
///     let coordinates = coordinates.iter();
///     let coordinates = coordinates
///         .map(|(name, weights)| SectorCoordinate::new(name.to_string(), weights.to_vec()));
///     Sector::new(name.to_owned(), coordinates.collect())
/// };
/// let sectors = [
///     sector("in_phase", &[("theta_parent", &[(0, 1.0)]), ("theta_m", &[(1, 1.0), (2, 1.0)])]),
///     sector("d", &[("theta_d", &[(1, 1.0), (2, -1.0)])]),
/// ];
/// let tree = SymmetricTree::<f64>::new(&links, 9.80665, &sectors).unwrap();
///
/// let (coordinates, momenta) = ([0.4, 0.3, 0.01], [0.02, -0.004, 2e-4]);
/// let given = StateInput::Momenta { coordinates: &coordinates, momenta: &momenta };
/// let (mut workspace, mut w) = (Workspace::new(), [Transfer::default(); 2]);
/// let mut into_d = |form| {
///     tree.transfers(&mut workspace, form, given, &mut w);
///     w[1].total()
/// };
/// let exact = into_d(TransferForm::Exact);
/// let error = |w: f64| (w / exact - 1.0).abs();
/// assert!(error(into_d(TransferForm::Angle(1))) > 0.1);
/// assert!(error(into_d(TransferForm::Amplitude(2))) < 1e-3);
/// assert!(error(into_d(TransferForm::Amplitude(4))) < 1e-6);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricTree<T> {
    shape: Arc<SymmetricShape>,
    whole: MassConstants<T>,
    mean: Option<MeanTree<T>>,
    bodies: Vec<RigidLink<T>>,
    passive: Passive<T>,
    spring_dampers: SpringDampers<T>,
    /// Springs between links that are not parent and child.
    springs: SectorSprings<T>,
    chords: Chords<T>,
}

/// The tree in which the copies of each node have the mean of their constants, and the differences
/// from it.
#[derive(Clone, Debug, PartialEq)]
struct MeanTree<T> {
    equal: MassConstants<T>,
    /// Constants of the tree minus the constants of the mean tree.
    beyond: MassConstants<T>,
}

/// A state of a tree, in one of several sets of variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StateInput<'a, T> {
    /// Angles (rad) and angular velocities (rad/s) of the links.
    Absolute {
        /// Angles.
        theta: &'a [T],
        /// Angular velocities.
        omega: &'a [T],
    },
    /// Symmetric coordinates (rad) and their rates (rad/s), as in measured data.
    Rates {
        /// Coordinates.
        coordinates: &'a [T],
        /// Rates of the coordinates.
        rates: &'a [T],
    },
    /// Symmetric coordinates (rad) and their canonical momenta (kg m²/s).
    Momenta {
        /// Coordinates.
        coordinates: &'a [T],
        /// Momenta of the coordinates.
        momenta: &'a [T],
    },
}

impl<T> StateInput<'_, T> {
    fn lengths(&self) -> [usize; 2] {
        match self {
            Self::Absolute { theta, omega } => [theta.len(), omega.len()],
            Self::Rates { coordinates, rates } => [coordinates.len(), rates.len()],
            Self::Momenta {
                coordinates,
                momenta,
            } => [coordinates.len(), momenta.len()],
        }
    }
}

impl<T: Scalar> SymmetricTree<T> {
    /// Creates a tree of these links, all copies of which are equal. `gravity` is in m/s²; it is
    /// negative for an upright tree, whose angles are measured from the upward vertical.
    ///
    /// Returns `None` if there are no links, if a link comes before its parent, or if the sectors do not have one
    /// coordinate for each link.
    pub fn new<S: Scalar + Into<Double>>(
        links: &[RigidLink<S>],
        gravity: S,
        sectors: &[Sector],
    ) -> Option<Self> {
        Self::with_unequal_copies(links, gravity, sectors, &[])
    }

    /// Creates a tree in which some copies differ. `nodes` lists, for each node of the description
    /// whose copies differ, all its links.
    ///
    /// Returns `None` in the same cases as [`new`](Self::new), and if `nodes` contains links that
    /// do not exist.
    pub fn with_unequal_copies<S: Scalar + Into<Double>>(
        links: &[RigidLink<S>],
        gravity: S,
        sectors: &[Sector],
        nodes: &[Vec<usize>],
    ) -> Option<Self> {
        let links: Vec<RigidLink<Double>> =
            links.iter().map(|link| link.cast(Into::into)).collect();
        let gravity: Double = gravity.into();
        let parents = links.iter().map(|link| link.parent).collect();
        let shape = SymmetricShape::new(parents, sectors)?;
        if nodes.iter().flatten().any(|&link| link >= links.len()) {
            return None;
        }
        let whole = MassConstants::new(&shape.pattern, &links, gravity);
        let mean = (!nodes.is_empty()).then(|| {
            let equal = whole.mean(&shape.pattern, nodes);
            MeanTree {
                beyond: whole.less(&equal).rounded(),
                equal: equal.rounded(),
            }
        });
        let zero = Double::from_f64(0.0);
        let is_viscous = |link: &RigidLink<Double>| [link.friction, link.drag] != [zero; 2];
        let is_braked = |link: &RigidLink<Double>| !link.laws.iter().all(FrictionLaw::is_none);
        let viscous = links.iter();
        let viscous = viscous.map(|link| [link.friction, link.drag].map(rounded));
        let laws = links.iter();
        let laws = laws.map(|link| link.laws.map(|law| law.map(rounded)));
        let moments = moments(&links).into_iter();
        let passive = Passive {
            viscous: match links.iter().any(is_viscous) {
                true => viscous.collect(),
                false => Vec::new(),
            },
            laws: match links.iter().any(is_braked) {
                true => laws.collect(),
                false => Vec::new(),
            },
            moments: moments.map(|moment| moment.map(rounded)).collect(),
            stands: gravity.high() < 0.0,
        };
        Some(Self {
            shape: Arc::new(shape),
            whole: whole.rounded(),
            mean,
            bodies: links.iter().map(|link| link.cast(rounded)).collect(),
            passive,
            spring_dampers: SpringDampers::default(),
            springs: SectorSprings::default(),
            chords: Chords::default(),
        })
    }

    /// Returns the tree with springs and friction between links that are not parent and child.
    ///
    /// Returns `None` if they are made for another number of links, or if springs couple sectors,
    /// which then have no separate energies. Springs between links of one sector couple none;
    /// neither does the same spring between every two copies of a node under one link. A spring
    /// that is not at rest at equal angles may connect means only.
    #[must_use]
    pub fn with_spring_dampers(mut self, spring_dampers: SpringDampers<Double>) -> Option<Self> {
        if spring_dampers.is_empty() {
            return Some(self);
        }
        if spring_dampers.links() != self.links() {
            return None;
        }
        self.springs = SectorSprings::of(&self.shape, &spring_dampers)?;
        self.spring_dampers = spring_dampers.cast(rounded);
        Some(self)
    }

    /// Returns the tree with straight springs between copies, whose energy is a sum over sectors.
    /// Other straight springs couple sectors in general.
    ///
    /// Returns `None` if the links are not all copies of a node under one link, or occur twice.
    #[must_use]
    pub fn with_straight_springs(mut self, springs: &[ChordSpring<Double>]) -> Option<Self> {
        self.chords = Chords::of(&self.shape, springs)?;
        Some(self)
    }

    /// Sets whether the tree stands upright (true) or hangs, independent of the sign of its
    /// gravity. The y axis of the drive points upwards in both cases.
    #[must_use]
    pub fn standing(mut self, stands: bool) -> Self {
        self.passive.stands = stands;
        self
    }

    /// Converts the constants of the tree to another scalar type by `convert`, which should not
    /// change their values.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SymmetricTree<S> {
        SymmetricTree {
            shape: Arc::clone(&self.shape),
            whole: self.whole.cast(&convert),
            mean: self.mean.as_ref().map(|mean| MeanTree {
                equal: mean.equal.cast(&convert),
                beyond: mean.beyond.cast(&convert),
            }),
            bodies: self.bodies.iter().map(|body| body.cast(&convert)).collect(),
            passive: self.passive.cast(&convert),
            spring_dampers: self.spring_dampers.cast(&convert),
            springs: self.springs.cast(&convert),
            chords: self.chords.cast(&convert),
        }
    }

    /// Returns the number of links.
    #[must_use]
    pub fn links(&self) -> usize {
        self.shape.links()
    }

    /// Returns true if copies differ.
    #[must_use]
    pub fn has_unequal_copies(&self) -> bool {
        self.mean.is_some()
    }

    /// Returns the index of the sector with the given name.
    #[must_use]
    pub fn sector(&self, name: &str) -> Option<usize> {
        let mut sectors = self.sectors().iter();
        sectors.position(|sector| sector.name() == name)
    }

    /// Returns the moment of inertia M_ii (kg m²) of a link about its pivot, in which the links
    /// below it count as point masses at their pivots; NaN for a link that does not exist.
    #[must_use]
    pub fn inertia(&self, link: usize) -> T {
        at(&self.whole.inertia, link)
    }

    /// Returns G and F (N m) of a link's part G (1 − cos θ) + F sin θ of the potential energy; NaN
    /// for a link that does not exist.
    #[must_use]
    pub fn gravity(&self, link: usize) -> [T; 2] {
        let lateral = self.whole.lateral_gravity.get(link);
        let lateral = lateral.copied().unwrap_or(T::from_f64(0.0));
        [at(&self.whole.gravity, link), lateral]
    }

    /// Returns μ and ν (kg m²) of the entry μ cos (θ_i − θ_j) + ν sin (θ_i − θ_j) of the mass
    /// matrix between a link i and its ancestor j; zero between other links.
    #[must_use]
    pub fn coupling(&self, link: usize, above: usize) -> [T; 2] {
        let zero = T::from_f64(0.0);
        if link >= self.links() {
            return [zero; 2];
        }
        let mut entries = self.shape.pattern.upwards(link);
        let place = entries.find(|(_, other)| *other == above);
        let of = |list: &[T]| {
            let value = place.and_then(|(place, _)| list.get(place));
            value.copied().unwrap_or(zero)
        };
        [of(&self.whole.coupling), of(&self.whole.lateral_coupling)]
    }

    /// Returns the constants from which energies of sectors are computed: the constants of the mean
    /// tree if copies differ, else the tree's own.
    #[inline(always)]
    fn equal(&self) -> &MassConstants<T> {
        match &self.mean {
            Some(mean) => &mean.equal,
            None => &self.whole,
        }
    }
}

impl<T> Sectors for SymmetricTree<T> {
    fn sectors(&self) -> &[Sector] {
        &self.shape.sectors
    }
}
