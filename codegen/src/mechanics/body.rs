//! Energies, powers and positions of one link in a tree: what the functions of trees in loops
//! are formed of.
//!
//! Kinetic energy takes the velocity of the link's pivot, which the parent hands down. All else
//! is a sum of terms of single links, since weight and inertial forces act on all that a link
//! carries at a first moment that is a constant.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, NamedFormula, Role, SymbolId, Symbols};
use super::joint_forces::DerivedForces;
use super::laws::kinetic;
use super::link::{LinkSymbols, Plane, dot, plus, times};
use crate::functions::BodyFunction;

/// Symbols of a link as a body beside those of its balance.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySymbols {
    /// Gravity g.
    pub gravity: SymbolId,
    /// First moment of all that the link carries about its pivot, along and across.
    pub carried_moment: [SymbolId; 2],
    /// Weight of that times its lever, along and across.
    pub weight_moment: [SymbolId; 2],
    /// Velocity of the pivot.
    pub pivot_velocity: [SymbolId; 2],
    /// Acceleration of the root's pivot.
    pub root_acceleration: [SymbolId; 2],
    /// Torque of the drive, zero but on the root.
    pub root_torque: SymbolId,
    /// Torque from outside.
    pub outside_torque: SymbolId,
    /// Place of a point along and across the link.
    pub point: [SymbolId; 2],
    /// Force in that point.
    pub force: [SymbolId; 2],
}

/// Energies, powers and positions of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkBody {
    /// Symbols of the link.
    pub symbols: BodySymbols,
    /// The functions that the scene asks for.
    pub functions: Vec<BodyFunction>,
    /// Velocities of the centre of mass and of the children's pivot.
    pub velocity: [Expr; 4],
    /// Kinetic energy.
    pub kinetic_energy: Expr,
    /// Weight of what the link carries times its lever, along and across.
    pub weight_moment: [Expr; 2],
    /// Potential energy of that weight and of the spring.
    pub potential_energy: Expr,
    /// Power that friction and drag take.
    pub friction_loss: Expr,
    /// Torque of the inertial forces of a moving pivot.
    pub inertial: Expr,
    /// Power of the drive.
    pub drive_power: Expr,
    /// Power of the torque from outside.
    pub outside_power: Expr,
    /// A point, from the link's pivot.
    pub point: [Expr; 2],
    /// Velocity of the point against that pivot.
    pub point_velocity: [Expr; 2],
    /// Torque of a force there about that pivot.
    pub point_torque: Expr,
}

impl LinkBody {
    /// Results of a function.
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

    /// The formulas behind a function.
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
    /// A place on a link, along it and across.
    pub(super) fn place_on_link(&self, [along, across]: [SymbolId; 2]) -> Plane {
        let across = match self.scene.is_lateral() {
            true => Formula::symbol(across),
            false => Formula::zero(),
        };
        [Formula::symbol(along), across]
    }

    /// ∂/∂θ of a vector.
    pub(super) fn turned(&self, s: &LinkSymbols, vector: &Plane) -> Plane {
        vector
            .each_ref()
            .map(|component| self.partial(component, s.angle))
    }

    /// ∂r/∂θ of a point of the link.
    pub(super) fn link_lever(&self, s: &LinkSymbols, [along, lateral]: Plane) -> Plane {
        let position = self.point_at(&along, &lateral, s.angle);
        self.turned(s, &position)
    }

    /// Derives energies, powers and positions of a link.
    pub(super) fn link_body(&mut self, link: &LinkSymbols, forces: &DerivedForces) -> LinkBody {
        let s = BodySymbols::new(&mut self.symbols, link);
        let symbol = Formula::symbol;
        let pair = |ids: [SymbolId; 2]| ids.map(symbol);
        let (omega, [mass, inertia]) = (symbol(link.omega), pair(link.body));

        // Velocities of points are those of the pivot and ω times their levers.
        let pivot = pair(s.pivot_velocity);
        let [velocity, child_velocity] = [link.com, link.place].map(|ids| {
            let lever = self.link_lever(link, self.place_on_link(ids));
            plus(&pivot, &times(&omega, &lever))
        });
        let kinetic = kinetic([&mass, &inertia], &velocity, &omega);

        // All that the link carries rises as its first moment does, which stands at
        // (1 − cos θ, sin θ) above its place at θ = 0: kept so, it keeps its digits.
        let carried = self.place_on_link(s.carried_moment);
        let gravity = symbol(s.gravity);
        let weight_moment = carried.each_ref().map(|moment| &gravity * moment);
        let [cosine, sine] = pair(link.direction);
        let raised = [&Formula::integer(1) - &cosine, sine];
        let potential = &dot(&self.place_on_link(s.weight_moment), &raised) + &forces.stored;

        let lever = self.link_lever(link, carried);
        let inertial = -dot(&pair(s.root_acceleration), &lever);
        let drive = &(&symbol(s.root_torque) + &inertial) * &omega;
        let outside = &symbol(s.outside_torque) * &omega;

        let [along, across] = pair(s.point);
        let point = self.point_at(&along, &across, link.angle);
        let point_lever = self.turned(link, &point);
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
            function if function.is_of_point() => requests.positions,
            BodyFunction::FrictionLoss => requests.energies && brakes,
            BodyFunction::DrivePower => requests.energies && scene.drive.is_some(),
            BodyFunction::OutsidePower => requests.energies && requests.forces,
            _ => requests.energies,
        };
        BodyFunction::ALL.into_iter().filter(is_wanted).collect()
    }
}
