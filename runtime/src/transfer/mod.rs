//! Energy transfer W between the sectors of any tree with copies, from numbers alone.
//!
//! A [`SymmetricTree`] is a tree in numbers, with the sectors that its copies give it: symmetric
//! coordinates and their momenta, energies of the sectors by each definition, and W into them,
//! exact, by orders of the amplitude, as published, and by what friction, the drive and torques
//! from outside do. Nothing of it is compiled for one tree: trees that are read while a program
//! runs have it (`branched_pendulum_trees::PendulumTree::symmetric`). Formulas are those of
//! compiled models (`docs/physics.md`, sections 5, 9 and 14), in absolute angles: terms of small
//! differences have rounding errors of the size of the in-phase motion, where compiled ones have
//! those of the differences.

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

use crate::scalar::{Double, Scalar, at};
use crate::sectors::{Sector, Sectors};
use crate::spring_dampers::SpringDampers;

/// A tree with copies in numbers `T`, in its symmetric coordinates.
///
/// Functions take a state as it is [`Given`], and write a result for each
/// [sector](Sectors::sectors), with memory that the caller keeps: the first evaluation allocates
/// it, later ones allocate nothing. Effort: O(n · depth²) from momenta and O(n · depth) from
/// velocities of n links.
///
/// # Examples
///
/// The paper's pendulum: W into the antiphase mode as published, to second and fourth order of
/// the amplitude, and exact.
///
/// ```
/// use branched_pendulum::scalar::Double;
/// use branched_pendulum::sectors::{Sector, SectorCoordinate};
/// use branched_pendulum::system::Workspace;
/// use branched_pendulum::transfer::{Given, RigidLink, SymmetricTree};
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
///     laws: [0.0; 5],
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
/// let given = Given::Momenta { coordinates: &coordinates, momenta: &momenta };
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
    /// The springs among them.
    springs: SectorSprings<T>,
    chords: Chords<T>,
}

/// The tree of equal copies beside one whose copies differ.
#[derive(Clone, Debug, PartialEq)]
struct MeanTree<T> {
    equal: MassConstants<T>,
    /// The constants less these.
    beyond: MassConstants<T>,
}

/// A state of a tree, as it is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given<'a, T> {
    /// Angles (rad) and angular velocities (rad/s) of the links.
    Absolute {
        /// Angles.
        theta: &'a [T],
        /// Angular velocities.
        omega: &'a [T],
    },
    /// Symmetric coordinates (rad) and their rates (rad/s), as an experiment measures them.
    Rates {
        /// Coordinates.
        coordinates: &'a [T],
        /// Their rates.
        rates: &'a [T],
    },
    /// Symmetric coordinates (rad) and their momenta (kg m²/s).
    Momenta {
        /// Coordinates.
        coordinates: &'a [T],
        /// Their momenta.
        momenta: &'a [T],
    },
}

impl<T> Given<'_, T> {
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
    /// A tree of these links under this gravity (m/s², negative for one that stands, whose
    /// angles are from the upward vertical), whose copies are equal.
    ///
    /// None where a link does not stand behind its parent, or the sectors have not one
    /// coordinate for each link.
    pub fn new<S: Scalar + Into<Double>>(
        links: &[RigidLink<S>],
        gravity: S,
        sectors: &[Sector],
    ) -> Option<Self> {
        Self::with_unequal_copies(links, gravity, sectors, &[])
    }

    /// A tree of links some of which are copies that differ: of each node of such copies all
    /// links.
    ///
    /// None as [`new`](Self::new), and for links that there are not.
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
        let is_braked = |link: &RigidLink<Double>| {
            let [coulomb, quadratic, _, drag, _] = link.laws;
            [coulomb, quadratic, drag] != [zero; 3]
        };
        let viscous = links.iter();
        let viscous = viscous.map(|link| [link.friction, link.drag].map(rounded));
        let laws = links.iter().map(|link| link.laws.map(rounded));
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
    /// None for those of another number of links, and for springs that couple sectors, which have
    /// no energies by themselves then. Springs between links of one sector couple none, and the same
    /// spring between every two copies of a node under one link does not either. A spring that is
    /// not at rest where its links have one angle has to be between means alone.
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
    /// Other straight springs couple these in general.
    ///
    /// None for links that are not all copies of a node under one link, or named twice.
    #[must_use]
    pub fn with_straight_springs(mut self, springs: &[ChordSpring<Double>]) -> Option<Self> {
        self.chords = Chords::of(&self.shape, springs)?;
        Some(self)
    }

    /// Returns the tree as one that stands, or not, whatever its gravity: y of the drive is
    /// upwards in both.
    #[must_use]
    pub fn standing(mut self, stands: bool) -> Self {
        self.passive.stands = stands;
        self
    }

    /// Returns the tree on other scalars: `convert` should change the type of its constants and
    /// not their value.
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

    /// Number of links.
    #[must_use]
    pub fn links(&self) -> usize {
        self.shape.links()
    }

    /// Returns true if copies differ.
    #[must_use]
    pub fn has_unequal_copies(&self) -> bool {
        self.mean.is_some()
    }

    /// Returns the number of the sector with that name.
    #[must_use]
    pub fn sector(&self, name: &str) -> Option<usize> {
        let mut sectors = self.sectors().iter();
        sectors.position(|sector| sector.name() == name)
    }

    /// Moment of inertia M_ii (kg m²) of a link about its pivot, with all that hangs from it as
    /// points at their pivots; NaN for no link.
    #[must_use]
    pub fn inertia(&self, link: usize) -> T {
        at(&self.whole.inertia, link)
    }

    /// G and F (N m) of a link's share G (1 − cos θ) + F sin θ in the potential energy; NaN for no
    /// link.
    #[must_use]
    pub fn gravity(&self, link: usize) -> [T; 2] {
        let lateral = self.whole.lateral_gravity.get(link);
        let lateral = lateral.copied().unwrap_or(T::from_f64(0.0));
        [at(&self.whole.gravity, link), lateral]
    }

    /// μ and ν (kg m²) of the entry μ cos (θ_i − θ_j) + ν sin (θ_i − θ_j) of the mass matrix
    /// between a link i and one above it; zero between others.
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

    /// The constants that energies of sectors are formed with.
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
