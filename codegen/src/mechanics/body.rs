//! Energies, powers and positions of one link, from which the functions of trees in loops are
//! computed.
//!
//! The kinetic energy uses the velocity of the link's pivot, which the parent passes on. Every
//! other quantity is a sum over single links, because weight and inertial forces act on the
//! constant first moment of everything that a link carries.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, NamedFormula, Role, SymbolId, Symbols};
use super::joint_forces::DerivedForces;
use super::laws::kinetic;
use super::link::{LinkSymbols, Plane, dot, plus, times};
use crate::functions::BodyFunction;

/// Symbols of a link as a rigid body, in addition to those of its balance of force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySymbols {
    /// Gravitational acceleration g.
    pub gravity: SymbolId,
    /// First moment, about the link's pivot, of all that the link carries, along and across the
    /// link.
    pub carried_moment: [SymbolId; 2],
    /// Weight of all that the link carries times its lever, along and across the link.
    pub weight_moment: [SymbolId; 2],
    /// Velocity of the link's pivot.
    pub pivot_velocity: [SymbolId; 2],
    /// Acceleration of the root's pivot.
    pub root_acceleration: [SymbolId; 2],
    /// Torque of the drive; zero except on the root.
    pub root_torque: SymbolId,
    /// External torque.
    pub outside_torque: SymbolId,
    /// Position of a point along and across the link.
    pub point: [SymbolId; 2],
    /// Force at that point.
    pub force: [SymbolId; 2],
}

/// Energies, powers and positions of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkBody {
    /// Symbols of the link as a rigid body.
    pub symbols: BodySymbols,
    /// Requested functions.
    pub functions: Vec<BodyFunction>,
    /// Velocities of the centre of mass and of the pivot of the children, two components each.
    pub velocity: [Expr; 4],
    /// Kinetic energy.
    pub kinetic_energy: Expr,
    /// Weight of all that the link carries times its lever, along and across the link.
    pub weight_moment: [Expr; 2],
    /// Potential energy of that weight and of the spring.
    pub potential_energy: Expr,
    /// Power dissipated by friction and drag.
    pub friction_loss: Expr,
    /// Torque of the inertial forces caused by a moving pivot.
    pub inertial: Expr,
    /// Power of the drive.
    pub drive_power: Expr,
    /// Power of the external torque.
    pub outside_power: Expr,
    /// Position of a point, relative to the link's pivot.
    pub point: [Expr; 2],
    /// Velocity of that point relative to the pivot.
    pub point_velocity: [Expr; 2],
    /// Torque about the pivot of a force at that point.
    pub point_torque: Expr,
}

impl LinkBody {
    /// Returns the results of a function.
    pub fn results(&self, function: BodyFunction) -> &[Expr] {
        let one = std::slice::from_ref;
        match function {
            BodyFunction::PivotVelocity => &self.velocity[2..],
            BodyFunction::KineticEnergy => one(&self.kinetic_energy),
            BodyFunction::PotentialEnergy => one(&self.potential_energy),
            BodyFunction::FrictionLoss => one(&self.friction_loss),
            BodyFunction::DrivePower => one(&self.drive_power),
            BodyFunction::OutsidePower => one(&self.outside_power),
            BodyFunction::Point => &self.point,
            BodyFunction::PointVelocity => &self.point_velocity,
            BodyFunction::PointTorque => one(&self.point_torque),
        }
    }

    /// Returns the formulas from which a function is computed.
    pub fn formulas(&self, symbols: &Symbols, function: BodyFunction) -> Vec<NamedFormula> {
        let names: &[(&str, &str)] = match function {
            BodyFunction::PivotVelocity => &[("P'_x", "P'_x"), ("P'_y", "P'_y")],
            BodyFunction::KineticEnergy => &[("K", "K")],
            BodyFunction::PotentialEnergy => &[("U", "U")],
            BodyFunction::FrictionLoss | BodyFunction::DrivePower | BodyFunction::OutsidePower => {
                &[("P", "P")]
            }
            BodyFunction::Point => &[("x", "x"), ("y", "y")],
            BodyFunction::PointVelocity => &[("ẋ", "\\dot x"), ("ẏ", "\\dot y")],
            BodyFunction::PointTorque => &[("Q", "Q")],
        };
        let named = names.iter().zip(self.results(function));
        let mut formulas: Vec<NamedFormula> = named
            .map(|(&(left, latex), right)| NamedFormula::new(left, latex, right))
            .collect();
        if function == BodyFunction::PotentialEnergy {
            let moments = self.symbols.weight_moment.iter().zip(&self.weight_moment);
            let moments = moments.filter(|(_, expr)| !expr.is_zero());
            formulas.extend(moments.map(|(&id, expr)| NamedFormula::of_symbol(symbols, id, expr)));
        }
        formulas
    }
}

impl BodySymbols {
    fn new(symbols: &mut Symbols, link: &LinkSymbols) -> Self {
        let mut letter =
            |role: Role, text: &str, latex: &str| symbols.intern(role, text, text, latex);
        let mut constant = |text: &str, latex: &str| letter(Role::Constant, text, latex);
        let gravity = constant("g_0", "g");
        let carried_moment = [constant("H", "H"), constant("H_⊥", "H_{\\perp}")];
        let weight_moment = [constant("G", "G"), constant("G_⊥", "G_{\\perp}")];
        let point = [constant("p", "p"), constant("p_⊥", "p_{\\perp}")];
        let mut pair = |text: &str| {
            ["x", "y"].map(|axis| {
                let name = format!("{text}_{axis}");
                letter(Role::Derived, &name, &name)
            })
        };
        let [pivot_velocity, root_acceleration, force] = ["P", "A", "F"].map(&mut pair);
        Self {
            gravity,
            carried_moment,
            weight_moment,
            pivot_velocity,
            root_acceleration,
            root_torque: letter(Role::Derived, "τ_0", "\\tau_0"),
            outside_torque: link.torque,
            point,
            force,
        }
    }
}

impl Derivation<'_> {
    /// Returns a point of a link, given along and across it, as a vector in the link's frame.
    pub(super) fn point_on_link(&self, [along, across]: [SymbolId; 2]) -> Plane {
        let across = match self.scene.is_lateral() {
            true => Formula::symbol(across),
            false => Formula::zero(),
        };
        [Formula::symbol(along), across]
    }

    /// Returns the derivative ∂/∂θ of a vector by the link's angle.
    pub(super) fn angle_derivative(&self, s: &LinkSymbols, vector: &Plane) -> Plane {
        vector
            .each_ref()
            .map(|component| self.partial(component, s.angle))
    }

    /// Returns the lever ∂r/∂θ of a point of the link.
    pub(super) fn link_lever(&self, s: &LinkSymbols, [along, lateral]: Plane) -> Plane {
        let position = self.point_at(&along, &lateral, s.angle);
        self.angle_derivative(s, &position)
    }

    /// Derives energies, powers and positions of a link.
    pub(super) fn link_body(&mut self, link: &LinkSymbols, forces: &DerivedForces) -> LinkBody {
        let s = BodySymbols::new(&mut self.symbols, link);
        let symbol = Formula::symbol;
        let pair = |ids: [SymbolId; 2]| ids.map(symbol);
        let (omega, [mass, inertia]) = (symbol(link.omega), pair(link.body));

        // Velocity of a point = velocity of the pivot + ω times the point's lever.
        let pivot = pair(s.pivot_velocity);
        let [velocity, child_velocity] = [link.com, link.place].map(|ids| {
            let lever = self.link_lever(link, self.point_on_link(ids));
            plus(&pivot, &times(&omega, &lever))
        });
        let kinetic = kinetic([&mass, &inertia], &velocity, &omega);

        // Height of all that the link carries above its position at θ = 0: its first moment times
        // (1 − cos θ, sin θ). This form does not lose digits at small θ.
        let carried = self.point_on_link(s.carried_moment);
        let gravity = symbol(s.gravity);
        let weight_moment = carried.each_ref().map(|moment| &gravity * moment);
        let [cosine, sine] = pair(link.direction);
        let raised = [&Formula::integer(1) - &cosine, sine];
        let potential = &dot(&self.point_on_link(s.weight_moment), &raised) + &forces.stored;

        let lever = self.link_lever(link, carried);
        let inertial = -dot(&pair(s.root_acceleration), &lever);
        let drive = &(&symbol(s.root_torque) + &inertial) * &omega;
        let outside = &symbol(s.outside_torque) * &omega;

        let [along, across] = pair(s.point);
        let point = self.point_at(&along, &across, link.angle);
        let point_lever = self.angle_derivative(link, &point);
        let point_torque = dot(&point_lever, &pair(s.force));
        let point_velocity = times(&omega, &point_lever);

        let expr = |formula: &Formula| self.expr(formula);
        let two = |pair: &Plane| pair.each_ref().map(expr);
        let expanded = |formula: &Formula| self.expr(&formula.expand());
        let [v, w] = [&velocity, &child_velocity].map(|pair| pair.each_ref().map(expanded));
        let ([v_x, v_y], [w_x, w_y]) = (v, w);
        LinkBody {
            velocity: [v_x, v_y, w_x, w_y],
            kinetic_energy: expr(&kinetic),
            weight_moment: two(&weight_moment),
            potential_energy: expr(&potential),
            friction_loss: expr(&forces.loss),
            inertial: expanded(&inertial),
            drive_power: expr(&drive),
            outside_power: expr(&outside),
            point: two(&point),
            point_velocity: two(&point_velocity),
            point_torque: expr(&point_torque),
            functions: self.body_functions(),
            symbols: s,
        }
    }

    fn body_functions(&self) -> Vec<BodyFunction> {
        let (scene, requests) = (self.scene, &self.scene.requests);
        let mut links = scene.links.iter();
        let brakes = links.any(|link| link.passive.has_friction() || link.passive.has_drag());
        let is_wanted = |function: &BodyFunction| match function {
            BodyFunction::Point | BodyFunction::PointVelocity | BodyFunction::PointTorque => {
                requests.positions
            }
            BodyFunction::FrictionLoss => requests.energies && brakes,
            BodyFunction::DrivePower => requests.energies && scene.drive.is_some(),
            BodyFunction::OutsidePower => requests.energies && requests.forces,
            BodyFunction::PivotVelocity
            | BodyFunction::KineticEnergy
            | BodyFunction::PotentialEnergy => requests.energies,
        };
        BodyFunction::ALL.into_iter().filter(is_wanted).collect()
    }
}
