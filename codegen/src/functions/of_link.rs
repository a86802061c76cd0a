//! Functions of one link of a tree in loops.

use super::Argument;
use crate::named_members::named_members;

named_members! {
    /// Functions that the articulated recursion calls for each link of a tree in loops.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LinkFunction {
        Leaf = "leaf":
            "The response of a link without children: N and γ, and the torque of its joint on the parent where joints have torques.",
        Attach = "attach":
            "The response of a child about the pivot of its parent, whose motion is given: as it is where all children share one pivot.",
        Inner = "inner":
            "The response of a link with children, and b/J and κ/J, which `accelerate` takes.",
        Pivot = "pivot":
            "The apparent gravity at a child's pivot.",
        Accelerate = "accelerate":
            "The angular acceleration (in rad/s²) of a link with children, and what it hands them.",
        AccelerateLeaf = "accelerate_leaf":
            "The angular acceleration (in rad/s²) of a link without children.",
    }
}

impl LinkFunction {
    /// Returns the arguments of the function, except the constants and the motion of the link.
    pub(super) fn given(self) -> &'static [Argument] {
        match self {
            Self::Leaf => &[],
            Self::Attach => &[Argument::Response],
            Self::Inner => &[Argument::Sums],
            Self::Pivot => &[Argument::Carried],
            Self::Accelerate => &[Argument::Elimination, Argument::Pivot],
            Self::AccelerateLeaf => &[Argument::Pivot],
        }
    }
}

named_members! {
    /// Function of one link for energies by scale (by generation), in a tree whose code is loops.
    /// The function takes the constants and the motion of the link, and the numbers that
    /// [`given`](Self::given) names.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum ScaleFunction {
        Torques = "scale_torques":
            "Strain ε of the spring in the link's pivot, the torques κ ε and c (ω − ω_parent) of the joint on the parent, and k ω on the ground; with friction that is not viscous where there is any.",
        Velocity = "scale_velocity":
            "Velocity **V** of the centre of mass and **P**' of the children's pivot, given that of the link's own.",
        Moment = "scale_moment":
            "**B**, of which **B**·v is the moment of the momentum of all that the link carries, and that momentum, given the velocity of the centre of mass and the momentum **C** of what hangs from the link.",
        Energy = "scale_energy":
            "Energy of the parts of **V**, ω, 1 − cos θ, sin θ and ε in a scale; δ_s0 is 1 for the means, 0 for others.",
        Factor = "scale_factor":
            "Deficit N of the articulated inertia of the subtree, b/J and 1/J, given N of what hangs from the link: the factors of M u = ∂E/∂ω, which all scales share.",
        Eliminate = "scale_eliminate":
            "Response γ of the subtree to torques ∂E/∂ω of a scale at rest, and κ/J, given the factors, the parts of **B** and ω, and γ of what hangs from the link.",
        Flow = "scale_flow":
            "Angular velocity u along the flow of a scale's energy, M u = ∂E/∂ω; what is handed to the children; the changes **R** of velocities along the flow at constant ω, of the centre of mass and of the children's pivot.",
        Slope = "scale_slope":
            "z = ∂E/∂θ + **D**·v with the moment **D** of the changes **R**: {E_s, E_r} = Σ z_s u_r − u_s z_r.",
        Inertial = "scale_inertial":
            "Torque of the inertial forces under the acceleration **A** of the root's pivot.",
    }
}

impl ScaleFunction {
    /// Returns the names of the numbers that the function takes in addition to constants and
    /// motion.
    pub fn given(self) -> &'static [&'static str] {
        match self {
            Self::Torques => &[],
            Self::Velocity => &["pivot_velocity_x", "pivot_velocity_y"],
            Self::Moment => &["velocity_x", "velocity_y", "carried_x", "carried_y"],
            Self::Energy => &[
                "part_velocity_x",
                "part_velocity_y",
                "part_omega",
                "part_rise",
                "part_side",
                "part_strain",
                "means",
            ],
            Self::Factor => &["deficit_xx_below", "deficit_xy_below", "deficit_yy_below"],
            Self::Eliminate => &[
                "gain_x",
                "gain_y",
                "inverse_inertia",
                "part_moment_x",
                "part_moment_y",
                "part_omega",
                "bias_force_x_below",
                "bias_force_y_below",
            ],
            Self::Flow => &[
                "gain_x",
                "gain_y",
                "offset",
                "pivot_flow_x",
                "pivot_flow_y",
                "pivot_shift_x",
                "pivot_shift_y",
            ],
            Self::Slope => &[
                "part_moment_x",
                "part_moment_y",
                "part_rise",
                "part_side",
                "part_spring",
                "means",
                "shift_moment_x",
                "shift_moment_y",
            ],
            Self::Inertial => &["acceleration_x", "acceleration_y"],
        }
    }

    /// Returns the number of results.
    pub fn results(self) -> usize {
        match self {
            Self::Torques | Self::Velocity | Self::Moment => 4,
            Self::Energy | Self::Slope | Self::Inertial => 1,
            Self::Factor => 6,
            Self::Eliminate => 3,
            Self::Flow => 7,
        }
    }
}

named_members! {
    /// Function of one link for energies, powers or positions, in a tree whose code is loops. Its
    /// arguments are the link's constants for energies, its motion, and the numbers named by
    /// [`given`](Self::given).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum BodyFunction {
        PivotVelocity = "pivot_velocity":
            "Velocity **P**' of a child's pivot, given the motion of the parent and the velocity of the parent's pivot.",
        KineticEnergy = "kinetic_energy":
            "Kinetic energy, given the velocity of the link's pivot.",
        PotentialEnergy = "potential_energy":
            "Potential energy of the weight that the link carries and of the spring in its pivot, zero where all angles are zero and springs at rest.",
        FrictionLoss = "friction_loss":
            "Power that friction in the link's pivot and drag take, as torques times rates.",
        DrivePower = "drive_power":
            "Power of the torque τ_0 on the link, and of the inertial forces under the acceleration **A** of the root's pivot on all that the link carries.",
        OutsidePower = "outside_power":
            "Power of the torque from outside.",
        Point = "point":
            "Place of a point of the link, from the link's pivot, given how far along and across the link it is.",
        PointVelocity = "point_velocity":
            "Velocity of that point against the link's pivot.",
        PointTorque = "point_torque":
            "Torque about the link's pivot of a force in that point.",
    }
}

impl BodyFunction {
    /// Returns the names of the numbers that the function takes in addition to constants and
    /// motion.
    pub fn given(self) -> &'static [&'static str] {
        match self {
            Self::PivotVelocity | Self::KineticEnergy => &["pivot_velocity_x", "pivot_velocity_y"],
            Self::PotentialEnergy | Self::FrictionLoss | Self::OutsidePower => &[],
            Self::DrivePower => &["acceleration_x", "acceleration_y", "root_torque"],
            Self::Point | Self::PointVelocity => &["place_along", "place_across"],
            Self::PointTorque => &["place_along", "place_across", "force_x", "force_y"],
        }
    }

    /// Returns the number of results.
    pub fn results(self) -> usize {
        match self {
            Self::PivotVelocity | Self::Point | Self::PointVelocity => 2,
            Self::KineticEnergy
            | Self::PotentialEnergy
            | Self::FrictionLoss
            | Self::DrivePower
            | Self::OutsidePower
            | Self::PointTorque => 1,
        }
    }

    /// Returns true if the function is about a point of a link; it then reads no constants of the
    /// link.
    pub fn is_of_point(self) -> bool {
        matches!(self, Self::Point | Self::PointVelocity | Self::PointTorque)
    }
}
