//! Names of what the functions of a link read: columns of constants, and elements of the
//! other arguments.

use super::strips::Strips;
use crate::program::Argument;

/// Fields of the runtime's `LinkMotion`, in the order of the elements of an argument.
pub const LINK_MOTION: [&str; 6] = [
    "sine",
    "cosine",
    "omega",
    "joint_angle",
    "joint_rate",
    "outside_torque",
];

/// A constant in the equations of one link, in reduced units: m and l are those of the
/// commonest leaf for the whole tree, L is the link's own unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Column {
    /// M/(L² m).
    Inertia,
    /// h/(L m).
    Moment,
    /// The lateral part of the first moment over L m.
    LateralMoment,
    /// The mass over m that parents do not count.
    Mass,
    /// L/l.
    Length,
    /// l/L.
    InverseLength,
    /// h L/M of a leaf.
    GainAlong,
    /// Lateral part of the first moment of a leaf, times L/M.
    GainAcross,
    /// L² m/M of a leaf.
    InverseInertia,
    /// Place of the children's pivot along the link over L; where children hang at
    /// several places, of the link on its parent.
    Along,
    /// Place across the link, over L.
    Across,
    /// Friction in the pivot over m l².
    Friction,
    /// Drag against the ground over m l².
    Drag,
    /// Stiffness of the torsion spring over m l².
    Spring,
    /// Angle at which the spring is at rest.
    Rest,
    /// Coulomb friction in the pivot over m l².
    Coulomb,
    /// Quadratic friction in the pivot over m l².
    QuadraticFriction,
    /// Width of friction in the pivot.
    FrictionWidth,
    /// Quadratic drag over m l².
    QuadraticDrag,
    /// Width of drag.
    DragWidth,
    /// 1/(m l²), by which torques from outside are multiplied.
    PerTorque,
    /// Mass, here and below in SI units: read by energies by scale alone.
    BodyMass,
    /// Moment of inertia about the centre of mass.
    BodyInertia,
    /// Place of the centre of mass along the link.
    ComAlong,
    /// Place of the centre of mass across the link.
    ComAcross,
    /// Place of the children's pivot along the link.
    PlaceAlong,
    /// Place of the children's pivot across the link.
    PlaceAcross,
    /// First moment of all that the link carries, along it.
    CarriedMoment,
    /// First moment of all that the link carries, across it.
    LateralCarriedMoment,
    /// Gravity.
    Gravity,
    /// Stiffness of the torsion spring.
    Stiffness,
    /// Friction in the pivot, N m s.
    PivotFriction,
    /// Drag against the ground, N m s.
    GroundDrag,
    /// Torque on the root over m l², stated by each evaluation; zero in the rows.
    DriveTorque,
}

impl Column {
    /// All columns, in their order.
    pub const ALL: [Self; 34] = [
        Self::Inertia,
        Self::Moment,
        Self::LateralMoment,
        Self::Mass,
        Self::Length,
        Self::InverseLength,
        Self::GainAlong,
        Self::GainAcross,
        Self::InverseInertia,
        Self::Along,
        Self::Across,
        Self::Friction,
        Self::Drag,
        Self::Spring,
        Self::Rest,
        Self::Coulomb,
        Self::QuadraticFriction,
        Self::FrictionWidth,
        Self::QuadraticDrag,
        Self::DragWidth,
        Self::PerTorque,
        Self::BodyMass,
        Self::BodyInertia,
        Self::ComAlong,
        Self::ComAcross,
        Self::PlaceAlong,
        Self::PlaceAcross,
        Self::CarriedMoment,
        Self::LateralCarriedMoment,
        Self::Gravity,
        Self::Stiffness,
        Self::PivotFriction,
        Self::GroundDrag,
        Self::DriveTorque,
    ];

    /// Its name in code.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inertia => "inertia",
            Self::Moment => "moment",
            Self::LateralMoment => "lateral_moment",
            Self::Mass => "mass",
            Self::Length => "length",
            Self::InverseLength => "inverse_length",
            Self::GainAlong => "gain_along",
            Self::GainAcross => "gain_across",
            Self::InverseInertia => "inverse_inertia",
            Self::Along => "along",
            Self::Across => "across",
            Self::Friction => "friction",
            Self::Drag => "drag",
            Self::Spring => "spring",
            Self::Rest => "rest",
            Self::Coulomb => "coulomb",
            Self::QuadraticFriction => "quadratic_friction",
            Self::FrictionWidth => "friction_width",
            Self::QuadraticDrag => "quadratic_drag",
            Self::DragWidth => "drag_width",
            Self::PerTorque => "per_torque",
            Self::BodyMass => "body_mass",
            Self::BodyInertia => "body_inertia",
            Self::ComAlong => "com_along",
            Self::ComAcross => "com_across",
            Self::PlaceAlong => "place_along",
            Self::PlaceAcross => "place_across",
            Self::CarriedMoment => "carried_moment",
            Self::LateralCarriedMoment => "lateral_carried_moment",
            Self::Gravity => "gravity",
            Self::Stiffness => "stiffness",
            Self::PivotFriction => "pivot_friction",
            Self::GroundDrag => "ground_drag",
            Self::DriveTorque => "drive_torque",
        }
    }

    /// Its meaning, with m and l as the tree's units, L as the link's own of length.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Inertia => "M/(L² m), moment of inertia about the pivot",
            Self::Moment => "h/(L m), first moment of mass about the pivot",
            Self::LateralMoment => "first moment across the link over L m",
            Self::Mass => "mass over m that is not in the constants of the parent",
            Self::Length => "L/l",
            Self::InverseLength => "l/L",
            Self::GainAlong => "h L/M of a leaf",
            Self::GainAcross => "first moment of a leaf across the link, times L/M",
            Self::InverseInertia => "L² m/M of a leaf",
            Self::Along => "place of the attachment along the link, over L",
            Self::Across => "place of the attachment across the link, over L",
            Self::Friction => "friction in the pivot over m l²",
            Self::Drag => "drag against the ground over m l²",
            Self::Spring => "stiffness of the torsion spring over m l²",
            Self::Rest => "angle at which the torsion spring is at rest",
            Self::Coulomb => "Coulomb friction in the pivot over m l²",
            Self::QuadraticFriction => "quadratic friction in the pivot over m l²",
            Self::FrictionWidth => "width of friction in the pivot, rad/s",
            Self::QuadraticDrag => "quadratic drag over m l²",
            Self::DragWidth => "width of drag, rad/s",
            Self::PerTorque => "1/(m l²), factor of torques from outside",
            Self::BodyMass => "mass (kg)",
            Self::BodyInertia => "moment of inertia about the centre of mass (kg m²)",
            Self::ComAlong => "place of the centre of mass along the link (m)",
            Self::ComAcross => "place of the centre of mass across the link (m)",
            Self::PlaceAlong => "place of the children's pivot along the link (m)",
            Self::PlaceAcross => "place of the children's pivot across the link (m)",
            Self::CarriedMoment => "first moment of all that the link carries (kg m)",
            Self::LateralCarriedMoment => "first moment of that across the link (kg m)",
            Self::Gravity => "gravity (m/s²)",
            Self::Stiffness => "stiffness of the torsion spring (N m)",
            Self::PivotFriction => "friction in the pivot (N m s)",
            Self::GroundDrag => "drag against the ground (N m s)",
            Self::DriveTorque => "torque on the root over m l², stated by each evaluation",
        }
    }
}

impl Strips {
    /// Number of elements of an argument of the link functions.
    pub fn length(&self, argument: Argument) -> usize {
        let torque = usize::from(self.has_joint_torques);
        match argument {
            Argument::Constants => self.columns.len(),
            Argument::Motion => 5 + usize::from(self.has_outside_torques),
            Argument::Response => 5 + torque,
            Argument::Sums if self.has_several_places => 9 + torque,
            Argument::Sums => 5 + torque,
            Argument::Elimination => 3,
            Argument::Carried if self.has_several_places => 4,
            Argument::Given(function) => function.given().len(),
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
            Argument::Motion => &LINK_MOTION,
            Argument::Response => &RESPONSE,
            Argument::Sums if self.has_several_places => &ATTACHED,
            Argument::Sums => &SUMS,
            Argument::Elimination => &["gain_x", "gain_y", "offset"],
            Argument::Given(function) => function.given(),
            _ => &["gravity_x", "gravity_y", "end_x", "end_y"],
        };
        names[index]
    }
}
