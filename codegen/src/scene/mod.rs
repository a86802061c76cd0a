//! The scene: a validated description, expanded link by link.
//!
//! [`resolve()`] converts a [`Description`](crate::description::Description) to a [`Scene`]. Later
//! stages read nothing else and may rely on these properties:
//!
//! - there is exactly one root; `links` holds every parent before its children, depth first, and
//!   the copies of a subtree follow each other;
//! - names of links, orbits, groups and parameters are snake-case Rust identifiers, no keywords,
//!   and each has one meaning;
//! - every literal mass and inertia is non-negative, and no choice of angles makes the mass matrix
//!   singular, as far as literals decide it; conditions on parameters are listed in
//!   [`Scene::requirements`];
//! - all outputs in `requests` can be derived for this tree.
//!
//! An *orbit* is the set of links that are equal copies of one node of the description. A *group*
//! is a set of sibling subtrees that are copies of each other. A *sector* is a set of symmetric
//! coordinates that belong together: all means, or one difference between copies with everything
//! that hangs below it.

mod bodies;
mod chords;
pub mod coordinates;
mod drive;
mod expand;
mod friction_law;
mod gradient;
mod layout;
mod line_potential;
mod line_properties;
mod lineage;
mod link_pairs;
mod link_properties;
mod magnitude;
mod names;
mod normal_form;
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
mod written_forms;

pub use chords::DescribedChordSpring;
pub use coordinates::{Coordinate, CoordinateKind};
pub use drive::{Drive, Signal, SignalAtom, TimeFunction};
pub use friction_law::{FrictionContact, FrictionLaw, LAW_CONSTANTS, LawConstant};
pub use layout::Layout;
pub use line_potential::{DescribedLinePotential, LARGEST_EXPONENT, strength_unit};
pub use lineage::Lineage;
pub use link_pairs::{LinkPair, PairRun, SpringDamperEnds};
pub use magnitude::{Magnitudes, NEGLIGIBLE};
pub use names::is_keyword;
pub use observed::{
    CoordinateIndex, Function, Observable, Observed, ObservedAtom, Variable, VariableKind,
};
pub use outputs::{BudgetRequest, GradientRequest, Requests, Solve, TransferRequest};
pub use passive::PassiveTorques;
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

/// A validated tree of links, with the requested outputs. All values are in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name of the struct that the attribute is attached to.
    pub name: String,
    /// Path of the runtime crate, as in `::branched_pendulum`.
    pub crate_path: CratePath,
    /// Gravitational acceleration, in m/s², in the direction in which links of angle 0 point. If it
    /// is negative, the tree [stands](Scene::stands) upright.
    pub gravity: Quantity,
    /// All links, each parent before its children.
    pub links: Vec<Link>,
    /// Orbits, in the order of their first link. An orbit is a set of links that are equal copies
    /// of one node of the description.
    pub orbits: Vec<Orbit>,
    /// Groups of sibling subtrees that are copies of each other, in the order of their first link.
    pub groups: Vec<Group>,
    /// The drive, if the tree has one.
    pub drive: Option<Drive>,
    /// Named values that the user passes at run time. They are in the order of their declaration
    /// or, if they are not declared, of their first use: gravity, then link by link in the order of
    /// the description, then the drive.
    pub parameters: Vec<Parameter>,
    /// Conditions on values that depend on parameters. They are checked when the model is built.
    pub requirements: Vec<Requirement>,
    /// Requested outputs, in addition to the accelerations.
    pub requests: Requests,
    /// Quantities that the user defines. A quantity in symmetric coordinates also sets
    /// `requests.symmetric`.
    pub observables: Vec<Observable>,
    /// Sets of links whose motion the caller prescribes. They also set `requests.forces`.
    pub prescribed: Vec<PrescribedSet>,
    /// Springs and friction between links that are not parent and child.
    pub spring_dampers: Vec<DescribedSpringDamper>,
    /// Straight springs and dampers between points of links, and guys (straight springs between a
    /// link and the ground).
    pub translational: Vec<DescribedTranslationalSpringDamper>,
    /// Relation of the links to those of the whole tree, if reductions (copies in phase, locked
    /// joints) make the tree smaller.
    pub reduction: Option<Reduction>,
    /// The lineage that the tree is, if a rule with one open branching per generation describes it.
    pub lineage: Option<Lineage>,
    /// Layout of the code. For loops over generations, `links` holds one link per generation, each
    /// the child of the one before, and there are no groups.
    pub layout: Layout,
}

impl Scene {
    /// Returns true if the code is loops, over generations or over links.
    pub fn in_loops(&self) -> bool {
        self.layout != Layout::Unrolled
    }

    /// Returns true if gravity is written as a negative value: the tree stands upright, and angles
    /// are measured from the upward vertical. For users y always points upwards; in the equations
    /// it points against the direction of links of angle 0.
    pub fn stands(&self) -> bool {
        self.gravity.is_written_negative()
    }

    /// Returns the direction of links of angle 0, in words.
    pub fn vertical(&self) -> &'static str {
        match self.stands() {
            true => "upward vertical",
            false => "downward vertical",
        }
    }

    /// Returns true if any centre of mass or pivot lies off its link's axis.
    pub fn is_lateral(&self) -> bool {
        let beside = |offset: &Offset| !offset.lateral.is_zero();
        let mut links = self.links.iter();
        links.any(|link| beside(&link.com) || beside(&link.pivot))
    }
}

/// A rigid link. Its angle is absolute, measured from the [vertical](Scene::vertical).
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Snake-case name, unique in the scene.
    pub name: String,
    /// Parent: the link from which it hangs; `None` for the root.
    pub parent: Option<LinkId>,
    /// Orbit (set of equal copies of one node) that the link belongs to.
    pub orbit: OrbitId,
    /// Mass, in kg.
    pub mass: Quantity,
    /// Moment of inertia about the centre of mass, in kg m².
    pub inertia: Quantity,
    /// Centre of mass, relative to the link's own pivot.
    pub com: Offset,
    /// The link's pivot, relative to the parent's pivot and in the parent's frame; zero for the
    /// root.
    pub pivot: Offset,
    /// End of the link, relative to its own pivot: the point from which children hang unless they
    /// specify another one. The centre of mass if the link has no such point.
    pub end: Offset,
    /// Friction and spring in the link's pivot, and drag against the ground.
    pub passive: PassiveTorques,
}

/// A point of a link, relative to the link's pivot, in m.
///
/// At angle 0 the component `along` points down, or up in a tree that [stands](Scene::stands);
/// `lateral` points in the direction in which positive angles move the link's end.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// Component along the link, in m.
    pub along: Quantity,
    /// Component across the link, in m.
    pub lateral: Quantity,
}

/// Set of links that are equal copies of one node of the description. Copies with different values
/// belong to different orbits.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Name of the node, or of the first link if copies of the node differ.
    pub name: String,
    /// Name of the node: `child`, or `name_2` for the second generation of a rule.
    pub node: String,
    /// Number of ancestors of these links; 0 for the root.
    pub depth: usize,
    /// The links, in the order of [`Scene::links`].
    pub links: Vec<LinkId>,
}

/// Sibling subtrees that are copies of one node, declared by a multiplicity or a generation rule.
/// Links that merely have equal values are not a group.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Name of the node, with the numbers of the copy that it hangs in: `hand_1` for the two hands
    /// of `arm_1`.
    pub name: String,
    /// Link from which the copies hang. It is always present, because the root of a scene has no
    /// copies.
    pub parent: Option<LinkId>,
    /// Uppermost links of the copies, two or more.
    pub copies: Vec<LinkId>,
}

/// A set of links whose motion the caller prescribes in one call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrescribedSet {
    /// Names of the links, joined; a part of the name of the emitted function.
    pub name: String,
    /// Names of the links, in the order written.
    pub members: Vec<String>,
    /// The links in the order of their names. If the code is loops over generations, these are
    /// indices in the whole tree.
    pub links: Vec<LinkId>,
}

/// Whole tree of a description that reductions (copies in phase, locked joints) have made smaller.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// Order of the links of the whole tree.
    pub order: WholeOrder,
    /// Number of links of the whole tree.
    pub links: usize,
    /// Nodes of the whole tree, depth first, each parent before its children.
    pub orbits: Vec<WholeNode>,
}

/// Order of the links of a whole tree, as in the scene without reductions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WholeOrder {
    /// Depth first: a link, then all that hangs from it, then the next copy.
    DepthFirst,
    /// Generation by generation, from the root on.
    Generations,
}

/// Set of links of a whole tree that are copies of one node of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeNode {
    /// Name of the node: `child`, or `name_2` for the second generation of a rule.
    pub name: String,
    /// Number of copies under each copy of the parent.
    pub copies: usize,
    /// True if the copies under one parent move in phase: their angles are equal.
    pub in_phase: bool,
    /// Index after the last node of the subtree.
    pub end: usize,
    /// Motion of the copies, given by the links of the scene.
    pub motion: NodeMotion,
}

/// Motion of a link of the whole tree, given by the links of the scene.
#[derive(Debug, Clone, PartialEq)]
pub enum NodeMotion {
    /// The link moves like a link of the scene. The first copy corresponds to the link `offset`
    /// positions after the parent; each further copy that moves independently is `stride` positions
    /// later.
    Moving {
        /// Index difference between the first copy and its parent.
        offset: usize,
        /// Index difference between consecutive copies.
        stride: usize,
    },
    /// The link is locked to its parent.
    Locked {
        /// Angle to the parent, in rad.
        angle: Rational,
    },
}

/// A parameter: a value that the description names but does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name of the parameter in snake case.
    pub name: String,
    /// Uses of the parameter, in words; with the unit if the parameter is a whole value.
    pub doc: String,
    /// Strictest condition on its sign, among the values that consist of this parameter alone.
    pub sign: Sign,
}

/// Condition on the sign of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// Any finite number.
    Any,
    /// At least zero: gravity of a tree that hangs.
    Hanging,
    /// At most zero: gravity of a tree that [stands](Scene::stands).
    Standing,
    /// At least zero.
    NonNegative,
    /// Greater than zero.
    Positive,
}

/// Condition on a value that depends on parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// Name of the value in messages, as in "mass of `child`".
    pub what: String,
    /// The value to check.
    pub quantity: Quantity,
    /// Condition on its sign.
    pub sign: Sign,
    /// Condition on its magnitude.
    pub magnitudes: Magnitudes,
}

impl Requirement {
    /// Returns the name of the value, followed by the parameters that it contains.
    pub fn describe_value(&self, parameters: &[Parameter]) -> String {
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
