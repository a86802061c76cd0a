//! The scene: a description checked and written out link by link.
//!
//! [`resolve()`] turns a [`Description`](crate::description::Description) into a
//! [`Scene`]. Later stages read nothing else and may rely on what is said here:
//!
//! - exactly one root; `links` holds every parent before its children, depth
//!   first, with the copies of a subtree one after the other;
//! - names of links, orbits, groups and parameters are snake-case Rust
//!   identifiers, no keywords, and mean one thing each;
//! - every literal mass and inertia is non-negative, and no choice of angles
//!   makes the mass matrix singular as far as literals can tell; what only
//!   parameters decide is listed in [`Scene::requirements`];
//! - what `requests` asks for can be derived for this tree.

mod bodies;
mod chords;
pub mod coordinates;
mod drive;
mod expand;
mod layout;
mod line_potential;
mod line_properties;
mod link_pairs;
mod link_properties;
mod magnitude;
mod names;
mod notation;
mod observables;
mod observed;
mod outputs;
mod passive;
mod prescribed;
mod probe;
mod properties;
mod quantity;
mod rational_expression;
mod reduced_body;
mod reduction;
mod requests;
mod resolve;
mod rule;
mod run_time;
mod sectors;
mod shape_names;
mod singular;
mod small_sectors;
mod spring_dampers;
mod symbols;
mod template;
mod text;
mod translational;
mod transverse;
mod tree_reader;
mod unequal;
mod values;

pub use chords::DescribedChordSpring;
pub use coordinates::{Coordinate, CoordinateKind};
pub use drive::{Drive, Signal, SignalAtom, TimeFunction};
pub use layout::Layout;
pub use line_potential::{DescribedLinePotential, LARGEST_EXPONENT, strength_unit};
pub use link_pairs::{LinkPair, PairRun, SpringDamperEnds};
pub use magnitude::{Magnitudes, NEGLIGIBLE};
pub use names::is_keyword;
pub use observed::{
    CoordinateIndex, Function, Observable, Observed, ObservedAtom, Variable, VariableKind,
};
pub use outputs::{BudgetRequest, Requests, Solve, TransferRequest};
pub use passive::{FrictionLaw, FrictionPlace, PassiveTorques};
pub use quantity::{Quantity, QuantityAtom};
pub use rational_expression::RationalExpression;
pub use resolve::resolve;
pub use run_time::resolve_at_run_time;
pub use sectors::{SectorVariables, sectors};
pub use spring_dampers::DescribedSpringDamper;
pub use translational::{DescribedTranslationalSpringDamper, LineEnds, SpringLine, SpringLineRun};
pub use transverse::TransverseCopies;
pub use unequal::UnequalNode;

use crate::description::CratePath;
use crate::exact::Rational;

/// Index of a link in [`Scene::links`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkId(pub usize);

/// Index of an orbit in [`Scene::orbits`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OrbitId(pub usize);

/// Index of a parameter in [`Scene::parameters`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParameterId(pub usize);

/// A validated tree of links and what is asked for about it. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name of the struct that carries the attribute.
    pub name: String,
    /// Path of the runtime crate, as in `::branched_pendulum`.
    pub crate_path: CratePath,
    /// Gravitational acceleration, m/s²: towards where links of angle 0 point, so that the
    /// tree [stands](Scene::stands) where it is negative.
    pub gravity: Quantity,
    /// All links, parent before child.
    pub links: Vec<Link>,
    /// Links that are copies of one node of the description, in the order of
    /// their first link.
    pub orbits: Vec<Orbit>,
    /// Sibling subtrees that are copies, in the order of their first link.
    pub groups: Vec<Group>,
    /// The drive, if the tree has one.
    pub drive: Option<Drive>,
    /// Named values that the model is given at run time, in the order of their
    /// declaration, or where there is none: gravity's first, then link by link in the
    /// order in which the description names them, then the drive's.
    pub parameters: Vec<Parameter>,
    /// Conditions on values that depend on parameters, to be checked when the
    /// model is built.
    pub requirements: Vec<Requirement>,
    /// Outputs beside the accelerations.
    pub requests: Requests,
    /// Quantities of the user's own. One that is written in symmetric
    /// coordinates comes with `requests.symmetric`.
    pub observables: Vec<Observable>,
    /// Links whose motion the caller states, those of each set together. The sets come with
    /// `requests.forces`.
    pub prescribed: Vec<PrescribedSet>,
    /// Springs and friction between links that are not parent and child.
    pub spring_dampers: Vec<DescribedSpringDamper>,
    /// Straight springs and dampers between points of links, and guys.
    pub translational: Vec<DescribedTranslationalSpringDamper>,
    /// How the links stand for those of the whole tree, where the description makes it
    /// smaller.
    pub reduction: Option<Reduction>,
    /// How the code takes the equations through the tree. Over generations, `links`
    /// holds one link of each, below each other, and there are no groups.
    pub layout: Layout,
}

impl Scene {
    /// Returns true if the code is loops, over generations or links.
    pub fn in_loops(&self) -> bool {
        self.layout != Layout::Unrolled
    }

    /// Returns true if gravity is written as negative: the tree stands up, and angles are
    /// those from the upward vertical. What users give and see of y is upwards, whereas the
    /// equations have it against the direction of links of angle 0, whichever that is.
    pub fn stands(&self) -> bool {
        self.gravity.is_written_negative()
    }

    /// The direction of links of angle 0, in words.
    pub fn vertical(&self) -> &'static str {
        match self.stands() {
            true => "upward vertical",
            false => "downward vertical",
        }
    }

    /// Returns true if any centre of mass or pivot is beside a link's axis.
    pub fn is_lateral(&self) -> bool {
        let beside = |offset: &Offset| !offset.lateral.is_zero();
        let mut links = self.links.iter();
        links.any(|link| beside(&link.com) || beside(&link.pivot))
    }
}

/// A rigid link, whose angle is absolute, from the [vertical](Scene::vertical).
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Snake-case name, unique in the scene.
    pub name: String,
    /// The link that it hangs from; `None` for the root.
    pub parent: Option<LinkId>,
    /// The orbit it belongs to.
    pub orbit: OrbitId,
    /// Mass, kg.
    pub mass: Quantity,
    /// Moment of inertia about the centre of mass, kg m².
    pub inertia: Quantity,
    /// The centre of mass, from the link's own pivot.
    pub com: Offset,
    /// The link's pivot on its parent, from the parent's pivot and in the
    /// parent's directions; zero for the root.
    pub pivot: Offset,
    /// The link's end, from its own pivot: where links hang from it unless they say
    /// where, or where they would; the centre of mass of a link that has no such
    /// place.
    pub end: Offset,
    /// Friction and spring in its pivot, and drag against the ground.
    pub passive: PassiveTorques,
}

/// A point of a link, from the link's pivot, m.
///
/// At angle 0 `along` points down, or up in a tree that [stands](Scene::stands), and
/// `lateral` in the direction in which positive angles move the link's end.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// Component along the link.
    pub along: Quantity,
    /// Component across the link.
    pub lateral: Quantity,
}

/// The links that are equal copies of one node of the description. Copies that differ
/// are of several orbits.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Name of the node, or of the first link where copies of the node differ.
    pub name: String,
    /// Name of the node: `child`, or `name_2` for a generation of a rule.
    pub node: String,
    /// Number of links between these and the ground, without themselves; 0 for
    /// the root.
    pub depth: usize,
    /// The copies, in the order of [`Scene::links`].
    pub links: Vec<LinkId>,
}

/// Sibling subtrees that are copies of one node, from a multiplicity or a generation rule
/// and never guessed from equal numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Name of the node of the copies, with the numbers of the copy it hangs
    /// in: `hand_1` for the two hands of `arm_1`.
    pub name: String,
    /// The link that the copies hang from. Always present today, since a scene
    /// has one root.
    pub parent: Option<LinkId>,
    /// The roots of the copies, two or more.
    pub copies: Vec<LinkId>,
}

/// Links whose motion is handed over together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrescribedSet {
    /// Their names, joined: part of the name of their function.
    pub name: String,
    /// The names, in the order written.
    pub members: Vec<String>,
    /// The links in that order; where the code is loops over generations, by their index
    /// in the whole tree.
    pub links: Vec<LinkId>,
}

/// Whole tree of a description whose scene is smaller than it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// Order in which the links of the whole tree stand.
    pub order: WholeOrder,
    /// Number of links of the whole tree.
    pub links: usize,
    /// The nodes of the whole tree, parents before children, depth first.
    pub orbits: Vec<WholeNode>,
}

/// Order of the links of a whole tree: that of a scene without reductions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WholeOrder {
    /// Each link before what hangs from it, and that before the next copy.
    DepthFirst,
    /// Generation by generation.
    Generations,
}

/// Links of a whole tree that are copies of one node of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeNode {
    /// Name of the node: `child`, or `name_2` for a generation of a rule.
    pub name: String,
    /// Copies under each copy of the parent.
    pub copies: usize,
    /// True if the copies under one parent move alike.
    pub in_phase: bool,
    /// Index behind the last node of the subtree.
    pub end: usize,
    /// Motion of the copies.
    pub motion: NodeMotion,
}

/// Motion of a link of a whole tree in terms of the scene's links.
#[derive(Debug, Clone, PartialEq)]
pub enum NodeMotion {
    /// As a link of the scene: the first copy as the one `offset` places behind the link
    /// that it hangs from, each further one that moves by itself `stride` places later.
    Moving {
        /// Places between the first copy and the link that it hangs from.
        offset: usize,
        /// Places from one copy to the next.
        stride: usize,
    },
    /// As the link that it hangs from.
    Locked {
        /// Angle to that link, rad.
        angle: Rational,
    },
}

/// A value that the description names instead of stating.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Snake-case name.
    pub name: String,
    /// Uses of the parameter, in words, with the unit where it stands alone.
    pub doc: String,
    /// The strictest condition among its direct uses.
    pub sign: Sign,
}

/// A condition on the sign of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// Any finite number.
    Any,
    /// Zero or above: gravity of a tree that hangs.
    Hanging,
    /// Zero or below: gravity of a tree that [stands](Scene::stands).
    Standing,
    /// Zero or above.
    NonNegative,
    /// Above zero.
    Positive,
}

/// A condition on a value that depends on parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// The value in words, as in "mass of `child`".
    pub what: String,
    /// The value.
    pub quantity: Quantity,
    /// The condition on its sign.
    pub sign: Sign,
    /// The condition on its magnitude.
    pub magnitudes: Magnitudes,
}

impl Requirement {
    /// The value in words with the parameters that it is formed of.
    pub fn what_of(&self, parameters: &[Parameter]) -> String {
        let mut names: Vec<String> = Vec::new();
        for atom in self.quantity.atoms() {
            if let QuantityAtom::Parameter(ParameterId(index)) = atom
                && let Some(Parameter { name, .. }) = parameters.get(*index)
                && !names.contains(&format!("`{name}`"))
            {
                names.push(format!("`{name}`"));
            }
        }
        let word = match names.as_slice() {
            [_] => "parameter",
            _ => "parameters",
        };
        format!("{} ({word} {})", self.what, names.join(", "))
    }
}
