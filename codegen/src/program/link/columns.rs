//! Columns of constants that the functions of a link read; each link has a row.

use crate::named_members::named_members;
use crate::scene::{FrictionContact, FrictionLaw};

named_members! {
    /// A constant in the equations of one link, in reduced units. m and l are the mass and length
    /// of the commonest leaf, for the whole tree; L is the link's own unit of length.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Column {
        Inertia = "inertia": "M/(L² m), moment of inertia about the pivot",
        Moment = "moment": "h/(L m), first moment of mass about the pivot",
        LateralMoment = "lateral_moment": "first moment across the link over L m",
        Mass = "mass": "mass over m that is not in the constants of the parent",
        Length = "length": "L/l",
        InverseLength = "inverse_length": "l/L",
        GainAlong = "gain_along": "h L/M of a leaf",
        GainAcross = "gain_across": "first moment of a leaf across the link, times L/M",
        InverseInertia = "inverse_inertia": "L² m/M of a leaf",
        Along = "along": "place of the attachment along the link, over L",
        Across = "across": "place of the attachment across the link, over L",
        Friction = "friction": "friction in the pivot over m l²",
        Drag = "drag": "drag against the ground over m l²",
        Spring = "spring": "stiffness of the torsion spring over m l²",
        Rest = "rest": "angle at which the torsion spring is at rest",
        Coulomb = "coulomb": "Coulomb friction in the pivot over m l²",
        QuadraticFriction = "quadratic_friction": "quadratic friction in the pivot over m l²",
        StaticExcess = "static_excess": "excess of static over Coulomb friction over m l²",
        StribeckRate = "stribeck_rate": "Stribeck rate of friction in the pivot, rad/s",
        FrictionWidth = "friction_width": "width of friction in the pivot, rad/s",
        QuadraticDrag = "quadratic_drag": "quadratic drag over m l²",
        DragWidth = "drag_width": "width of drag, rad/s",
        PerTorque = "per_torque": "1/(m l²), factor of torques from outside",
        TorqueUnit = "torque_unit": "m l², unit of torques (N m)",
        BodyMass = "body_mass": "mass (kg)",
        BodyInertia = "body_inertia": "moment of inertia about the centre of mass (kg m²)",
        ComAlong = "com_along": "place of the centre of mass along the link (m)",
        ComAcross = "com_across": "place of the centre of mass across the link (m)",
        PlaceAlong = "place_along": "place of the children's pivot along the link (m)",
        PlaceAcross = "place_across": "place of the children's pivot across the link (m)",
        PivotAlong = "pivot_along": "place of the pivot along the parent (m)",
        PivotAcross = "pivot_across": "place of the pivot across the parent (m)",
        CarriedMoment = "carried_moment": "first moment of all that the link carries (kg m)",
        LateralCarriedMoment = "lateral_carried_moment": "first moment of that across the link (kg m)",
        WeightMoment = "weight_moment": "weight of all that the link carries times its lever along the link (J)",
        LateralWeightMoment = "lateral_weight_moment": "weight of that times its lever across the link (J)",
        Gravity = "gravity": "gravity (m/s²)",
        Stiffness = "stiffness": "stiffness of the torsion spring (N m)",
        PivotFriction = "pivot_friction": "friction in the pivot (N m s)",
        GroundDrag = "ground_drag": "drag against the ground (N m s)",
        PivotCoulomb = "pivot_coulomb": "Coulomb friction in the pivot (N m)",
        PivotExcess = "pivot_excess": "excess of static over Coulomb friction in the pivot (N m)",
        PivotQuadratic = "pivot_quadratic": "quadratic friction in the pivot (N m s²)",
        GroundQuadratic = "ground_quadratic": "quadratic drag against the ground (N m s²)",
        DriveTorque = "drive_torque": "torque on the root over m l², stated by each evaluation",
    }
}

impl Column {
    /// Returns true for constants of the equations of motion that are proportional to the torque of a
    /// spring, of friction or of drag.
    pub fn is_passive_torque(self) -> bool {
        let unit = TorqueUnit::Reduced;
        let laws = FrictionContact::ALL.map(|contact| unit.law(contact));
        let strengths = laws.iter().flat_map(FrictionLaw::strengths).flatten();
        unit.viscous()
            .iter()
            .chain(strengths)
            .any(|own| *own == self)
    }
}

/// Unit of torques.
#[derive(Clone, Copy)]
pub(super) enum TorqueUnit {
    /// m l² of the whole tree (reduced units).
    Reduced,
    /// Newton metre.
    NewtonMetre,
}

impl TorqueUnit {
    /// Returns the columns of the spring, viscous friction and drag.
    pub(super) fn viscous(self) -> [Column; 3] {
        match self {
            Self::Reduced => [Column::Spring, Column::Friction, Column::Drag],
            Self::NewtonMetre => [Column::Stiffness, Column::PivotFriction, Column::GroundDrag],
        }
    }

    /// Returns the columns of the friction law at a contact; `None` for constants that the law
    /// does not have there.
    pub(super) fn law(self, place: FrictionContact) -> FrictionLaw<Option<Column>> {
        let (coulomb, quadratic) = match (self, place) {
            (Self::Reduced, FrictionContact::Joint) => {
                (Some(Column::Coulomb), Column::QuadraticFriction)
            }
            (Self::Reduced, FrictionContact::Ground) => (None, Column::QuadraticDrag),
            (Self::NewtonMetre, FrictionContact::Joint) => {
                (Some(Column::PivotCoulomb), Column::PivotQuadratic)
            }
            (Self::NewtonMetre, FrictionContact::Ground) => (None, Column::GroundQuadratic),
        };
        let excess = match self {
            Self::Reduced => Column::StaticExcess,
            Self::NewtonMetre => Column::PivotExcess,
        };
        let (width, excess, stribeck) = match place {
            FrictionContact::Joint => (
                Column::FrictionWidth,
                Some(excess),
                Some(Column::StribeckRate),
            ),
            FrictionContact::Ground => (Column::DragWidth, None, None),
        };
        FrictionLaw {
            coulomb,
            quadratic: Some(quadratic),
            width: Some(width),
            excess,
            stribeck,
        }
    }
}
