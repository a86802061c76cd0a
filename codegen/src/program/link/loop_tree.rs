//! A tree in loops as data: its strips with their constants, and what the functions of its
//! links read.

use super::columns::Column;
use crate::functions::{Argument, LINK_PROPERTIES};
use crate::program::ConstantId;
use crate::scene::PairRun;

/// Fields of the runtime's `LinkMotion`, in the order of the elements of an argument.
pub const LINK_MOTION: [&str; 7] = [
    "sine",
    "cosine",
    "omega",
    "joint_angle",
    "joint_rate",
    "outside_torque",
    "held",
];

/// Neighbours that share their constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StripConstants {
    /// Name of the generation or link.
    pub name: String,
    /// True if nothing hangs from its links.
    pub is_leaf: bool,
    /// A constant for each of the columns that the equations read.
    pub constants: Vec<ConstantId>,
    /// A constant for each of the columns that energies and powers read.
    pub body: Vec<ConstantId>,
    /// [Properties](crate::functions::LINK_PROPERTIES) of the links, if positions are asked for.
    pub properties: Option<[ConstantId; LINK_PROPERTIES.len()]>,
}

impl StripConstants {
    /// All constants that it holds.
    fn all_constants(&self) -> impl Iterator<Item = ConstantId> {
        let properties = self.properties.iter().flatten();
        let all = self.constants.iter().chain(&self.body);
        all.chain(properties).copied()
    }
}

/// A spring and friction between links that are not parent and child.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpringDamperConstants {
    /// The clause in words, as in `siblings(arm)`.
    pub what: String,
    /// The pairs of links that it acts between, of which there are some.
    pub pairs: Vec<PairRun>,
    /// Stiffness.
    pub spring: ConstantId,
    /// Difference of the angles at which the spring is at rest.
    pub rest: ConstantId,
    /// Viscous friction.
    pub friction: ConstantId,
    /// Coulomb and quadratic friction and their width, if there is some.
    pub law: Option<[ConstantId; 3]>,
}

impl SpringDamperConstants {
    /// All constants that it holds, with words for them.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, ConstantId)> {
        let own = [
            ("spring", self.spring),
            ("rest", self.rest),
            ("friction", self.friction),
        ];
        let law = self.law.into_iter().flat_map(|law| {
            let names = ["coulomb", "quadratic", "width"];
            names.into_iter().zip(law)
        });
        own.into_iter().chain(law)
    }
}

/// Lines between points that have the same constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineConstants {
    /// The clause in words, as in `siblings(arm)`.
    pub what: String,
    /// Runs of lines: the links of the arms of the first line, and the number of lines, each with
    /// the links behind those of the one before.
    pub runs: Vec<(Vec<usize>, usize)>,
    /// Components of the arms along and across their links.
    pub arms: Vec<[ConstantId; 2]>,
    /// The part that no angle turns.
    pub offset: [ConstantId; 2],
    /// Terms of the energy.
    pub potentials: Vec<LinePotentialConstants>,
    /// Viscous friction, if there is some.
    pub friction: Option<ConstantId>,
}

/// A term of the energy that a line stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinePotentialConstants {
    /// A spring.
    Spring {
        /// Stiffness.
        stiffness: ConstantId,
        /// Length at rest, unless that is zero.
        rest: Option<ConstantId>,
    },
    /// A force by a power of the distance.
    InversePower {
        /// Strength.
        strength: ConstantId,
        /// Exponent.
        exponent: u32,
    },
}

impl LineConstants {
    /// Returns true if other lines of the same clause have the same constants.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let Self {
            what,
            runs: _,
            arms,
            offset,
            potentials,
            friction,
        } = self;
        (what, arms) == (&other.what, &other.arms)
            && (offset, potentials) == (&other.offset, &other.potentials)
            && *friction == other.friction
    }

    /// All constants that it holds, with words for them.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, ConstantId)> {
        let arms = self.arms.iter();
        let arms = arms.flat_map(|&[along, across]| [("along", along), ("across", across)]);
        let [x, y] = self.offset;
        let potentials = self.potentials.iter().flat_map(|own| match *own {
            LinePotentialConstants::Spring { stiffness, rest } => {
                [Some(("spring", stiffness)), rest.map(|rest| ("rest", rest))]
            }
            LinePotentialConstants::InversePower { strength, .. } => {
                [Some(("repulsion", strength)), None]
            }
        });
        let friction = self.friction.map(|friction| ("friction", friction));
        let own = potentials.flatten().chain(friction);
        arms.chain([("x", x), ("y", y)]).chain(own)
    }
}

/// A tree in loops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoopTree {
    /// The constants that the equations read, by strip.
    pub columns: Vec<Column>,
    /// The constants that energies and powers read, likewise.
    pub body_columns: Vec<Column>,
    /// From the root outwards.
    pub strips: Vec<StripConstants>,
    /// Springs and friction between links that are not parent and child.
    pub spring_dampers: Vec<SpringDamperConstants>,
    /// What acts along lines between points.
    pub lines: Vec<LineConstants>,
    /// True if children of one link hang at several places.
    pub has_several_places: bool,
    /// True if joints have torques.
    pub has_joint_torques: bool,
    /// True if torques act on the links that are not of their joints: from outside, between links
    /// that are not parent and child, or along lines.
    pub has_outside_torques: bool,
    /// True if links may be held, with accelerations that are given.
    pub has_held_links: bool,
    /// True if a torque acts on the root.
    pub has_drive_torque: bool,
}

impl LoopTree {
    /// All constants that its tables hold.
    pub fn all_constants(&self) -> impl Iterator<Item = ConstantId> {
        let rows = self.strips.iter().flat_map(StripConstants::all_constants);
        let between = self.spring_dampers.iter();
        let between = between.flat_map(SpringDamperConstants::named);
        let between = between.chain(self.lines.iter().flat_map(LineConstants::named));
        rows.chain(between.map(|(_, id)| id))
    }

    /// Returns true if something acts between links that are not parent and child, or along a line.
    pub fn is_coupled(&self) -> bool {
        !(self.spring_dampers.is_empty() && self.lines.is_empty())
    }

    /// Number of elements of an argument of the link functions.
    pub fn length(&self, argument: Argument) -> usize {
        let torque = usize::from(self.has_joint_torques);
        match argument {
            Argument::Constants => self.columns.len(),
            Argument::Body => self.body_columns.len(),
            Argument::Motion => {
                5 + usize::from(self.has_outside_torques) + usize::from(self.has_held_links)
            }
            Argument::Response => 5 + torque,
            Argument::Sums if self.has_several_places => 9 + torque,
            Argument::Sums => 5 + torque,
            Argument::Elimination => 3,
            Argument::Carried if self.has_several_places => 4,
            Argument::Given(names) => names.len(),
            _ => 2,
        }
    }

    /// Name of an element.
    pub fn element(&self, argument: Argument, index: usize) -> &'static str {
        const RESPONSE: [&str; 6] = [
            "deficit_xx_child",
            "deficit_xy_child",
            "deficit_yy_child",
            "bias_force_x_child",
            "bias_force_y_child",
            "joint_torque_child",
        ];
        const SUMS: [&str; 6] = [
            "deficit_xx_below",
            "deficit_xy_below",
            "deficit_yy_below",
            "bias_force_x_below",
            "bias_force_y_below",
            "joint_torque_below",
        ];
        const ATTACHED: [&str; 10] = [
            "deficit_xx_below",
            "deficit_xy_below",
            "deficit_yy_below",
            "moment_x_below",
            "moment_y_below",
            "inertia_below",
            "force_x_below",
            "force_y_below",
            "torque_below",
            "joint_torque_below",
        ];
        let names: &[&str] = match argument {
            Argument::Constants => return self.columns[index].name(),
            Argument::Body => return self.body_columns[index].name(),
            Argument::Motion => &LINK_MOTION,
            Argument::Response => &RESPONSE,
            Argument::Sums if self.has_several_places => &ATTACHED,
            Argument::Sums => &SUMS,
            Argument::Elimination => &["gain_x", "gain_y", "offset"],
            Argument::Given(names) => names,
            _ => &["gravity_x", "gravity_y", "end_x", "end_y"],
        };
        names[index]
    }
}
