//! A tree in loops as data: its strips (neighbouring links that share their constants), and the
//! constants that the functions of its links read.

use super::columns::Column;
use crate::functions::{Argument, LINK_PROPERTIES};
use crate::program::ConstantId;
use crate::scene::{FrictionLaw, LAW_CONSTANTS, PairRun};

/// Fields of the runtime's `LinkMotion`, in the order of the elements of an argument.
pub const LINK_MOTION: [&str; 7] = [
    "sine",
    "cosine",
    "omega",
    "joint_angle",
    "joint_rate",
    "outside_torque",
    "prescribed",
];

/// Constants of a strip: neighbouring links that share all constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StripConstants {
    /// Name of the generation or of the single link.
    pub name: String,
    /// True if the links of the strip have no children.
    pub is_leaf: bool,
    /// One constant per column that the equations of motion read.
    pub constants: Vec<ConstantId>,
    /// One constant per column that energies and powers read.
    pub body: Vec<ConstantId>,
    /// [Properties](crate::functions::LINK_PROPERTIES) of the links, if positions are requested.
    pub properties: Option<[ConstantId; LINK_PROPERTIES.len()]>,
}

impl StripConstants {
    /// Returns all constants of the strip.
    fn all_constants(&self) -> impl Iterator<Item = ConstantId> {
        let properties = self.properties.iter().flatten();
        let all = self.constants.iter().chain(&self.body);
        all.chain(properties).copied()
    }
}

/// A spring and friction between links that are not parent and child.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpringDamperConstants {
    /// Clause in words, as in `siblings(arm)`.
    pub what: String,
    /// Pairs of links that it connects, at least one.
    pub pairs: Vec<PairRun>,
    /// Stiffness, in N m.
    pub spring: ConstantId,
    /// Difference of the angles at which the spring is at rest, in rad.
    pub rest: ConstantId,
    /// Coefficient of viscous friction, in N m s.
    pub friction: ConstantId,
    /// Constants of the friction that is not viscous, if there is any.
    pub law: Option<[ConstantId; LAW_CONSTANTS]>,
}

impl SpringDamperConstants {
    /// Returns all constants, each with a word for it.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, ConstantId)> {
        let own = [
            ("spring", self.spring),
            ("rest", self.rest),
            ("friction", self.friction),
        ];
        let law = self.law.into_iter().flat_map(|law| {
            let names = FrictionLaw::NAMES.map(|constant| constant.member);
            names.into_constants().into_iter().zip(law)
        });
        own.into_iter().chain(law)
    }
}

/// Lines between points that share their constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineConstants {
    /// Clause in words, as in `siblings(arm)`.
    pub what: String,
    /// Runs of lines: the links of the first line's arms, and the number of lines. In each line all
    /// link indices are larger by one than in the line before.
    pub runs: Vec<(Vec<usize>, usize)>,
    /// Components of the arms along and across their links, in m.
    pub arms: Vec<[ConstantId; 2]>,
    /// Constant part of the line, which no angle rotates, in m.
    pub offset: [ConstantId; 2],
    /// Terms of the potential energy.
    pub potentials: Vec<LinePotentialConstants>,
    /// Coefficient of viscous friction, in N s/m, if there is a damper.
    pub friction: Option<ConstantId>,
}

/// A term of the potential energy of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinePotentialConstants {
    /// A spring.
    Spring {
        /// Stiffness, in N/m.
        stiffness: ConstantId,
        /// Rest length, in m, if it is not zero.
        rest: Option<ConstantId>,
    },
    /// A power law of the distance.
    InversePower {
        /// Strength A, in J mⁿ.
        strength: ConstantId,
        /// Exponent n of the energy A/ℓⁿ.
        exponent: u32,
    },
}

impl LineConstants {
    /// Returns true if two lines of one clause have the same constants.
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

    /// Returns all constants, each with a word for it.
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

/// Constants on which the virtual power of a tree depends, for derivatives of the accelerations in
/// reverse mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PowerConstants {
    /// Gravity, in m/s².
    pub gravity: ConstantId,
    /// Constants of each strip, in the order of
    /// [`passive_link_columns`](crate::program::passive_link_columns).
    pub rows: Vec<Vec<ConstantId>>,
    /// For each contact, true if some link has friction there that is not viscous.
    pub laws: [bool; 2],
    /// Derivatives of the constants by parameters, without those that are zero, sorted by place.
    pub slopes: Vec<ConstantSlope>,
}

/// Derivative of a constant by a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConstantSlope {
    /// Index of the group, of the constant in it, and of the parameter. The groups are gravity, the
    /// rows of the strips, then the runs of spring-dampers and of lines.
    pub place: [usize; 3],
    /// The derivative.
    pub slope: ConstantId,
}

impl PowerConstants {
    fn all_constants(&self) -> impl Iterator<Item = ConstantId> {
        let slopes = self.slopes.iter().map(|own| &own.slope);
        let all = self.rows.iter().flatten().chain(slopes);
        std::iter::once(&self.gravity).chain(all).copied()
    }
}

/// A tree in loops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoopTree {
    /// Columns of constants that the equations of motion read.
    pub columns: Vec<Column>,
    /// Columns of constants that energies and powers read.
    pub body_columns: Vec<Column>,
    /// Strips, from the root outwards.
    pub strips: Vec<StripConstants>,
    /// Springs and friction between links that are not parent and child.
    pub spring_dampers: Vec<SpringDamperConstants>,
    /// Forces along lines between points.
    pub lines: Vec<LineConstants>,
    /// Constants of the virtual power, if derivatives of the accelerations are requested.
    pub power: Option<PowerConstants>,
    /// True if children of one link hang at different points.
    pub has_several_places: bool,
    /// True if joints have torques.
    pub has_joint_torques: bool,
    /// True if links have torques other than those of their joints: external torques, or torques
    /// between links that are not parent and child, or along lines.
    pub has_outside_torques: bool,
    /// True if links may have prescribed accelerations.
    pub has_prescribed_links: bool,
    /// True if a torque acts on the root.
    pub has_drive_torque: bool,
}

impl LoopTree {
    /// Returns all constants of the tree.
    pub fn all_constants(&self) -> impl Iterator<Item = ConstantId> {
        let rows = self.strips.iter().flat_map(StripConstants::all_constants);
        let between = self.spring_dampers.iter();
        let between = between.flat_map(SpringDamperConstants::named);
        let between = between.chain(self.lines.iter().flat_map(LineConstants::named));
        let power = self.power.iter().flat_map(PowerConstants::all_constants);
        rows.chain(between.map(|(_, id)| id)).chain(power)
    }

    /// Returns true if forces act between links that are not parent and child, or along a line.
    pub fn is_coupled(&self) -> bool {
        !(self.spring_dampers.is_empty() && self.lines.is_empty())
    }

    /// Returns the number of elements of an argument of the link functions.
    pub fn length(&self, argument: Argument) -> usize {
        let torque = usize::from(self.has_joint_torques);
        match argument {
            Argument::Constants => self.columns.len(),
            Argument::Body => self.body_columns.len(),
            Argument::Motion => {
                5 + usize::from(self.has_outside_torques) + usize::from(self.has_prescribed_links)
            }
            Argument::Response => 5 + torque,
            Argument::Sums if self.has_several_places => 9 + torque,
            Argument::Sums => 5 + torque,
            Argument::Elimination => 3,
            Argument::Carried if self.has_several_places => 4,
            Argument::Carried | Argument::Pivot => 2,
            Argument::Given(names) => names.len(),
            Argument::Time
            | Argument::Theta
            | Argument::Omega
            | Argument::AbsoluteMomenta
            | Argument::Coordinates
            | Argument::Rates
            | Argument::Momenta
            | Argument::Forces
            | Argument::Alpha
            | Argument::Weights
            | Argument::Actions
            | Argument::Difference(_)
            | Argument::DifferenceRate(_)
            | Argument::SmallDifferences
            | Argument::SmallRates
            | Argument::Torques
            | Argument::SmallTorques
            | Argument::Prescribed(_)
            | Argument::Absolute
            | Argument::Symmetric => {
                unreachable!(
                    "`{}` is not an argument of one link's functions",
                    argument.name()
                )
            }
        }
    }

    /// Returns the name of an element.
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
            Argument::Carried | Argument::Pivot => &["gravity_x", "gravity_y", "end_x", "end_y"],
            Argument::Time
            | Argument::Theta
            | Argument::Omega
            | Argument::AbsoluteMomenta
            | Argument::Coordinates
            | Argument::Rates
            | Argument::Momenta
            | Argument::Forces
            | Argument::Alpha
            | Argument::Weights
            | Argument::Actions
            | Argument::Difference(_)
            | Argument::DifferenceRate(_)
            | Argument::SmallDifferences
            | Argument::SmallRates
            | Argument::Torques
            | Argument::SmallTorques
            | Argument::Prescribed(_)
            | Argument::Absolute
            | Argument::Symmetric => {
                unreachable!(
                    "`{}` is not an argument of one link's functions",
                    argument.name()
                )
            }
        };
        names[index]
    }
}
