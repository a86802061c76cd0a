//! Torques that depend on the motion of one joint: the spring and the friction in its pivot, and
//! the link's drag against the ground.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId};
use super::laws::{dissipated, stored};
use crate::scene::FrictionContact;

/// Symbols of the torques of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSymbols {
    /// Constants: stiffness κ and rest angle ρ of the spring, friction c in the pivot, drag k.
    pub constants: [SymbolId; 4],
    /// Angle and angular velocity relative to the parent.
    pub relative: [SymbolId; 2],
    /// Torques D of friction that is not viscous, in the pivot and against the ground.
    pub braking: [SymbolId; 2],
}

/// Torques of a link, and the strain of its spring.
#[derive(Clone, Debug, PartialEq)]
pub struct JointForces {
    /// Symbols of the torques.
    pub symbols: JointSymbols,
    /// Strain of the spring: relative angle minus rest angle.
    pub strain: Expr,
    /// Torque that the spring exerts on the parent.
    pub spring: Expr,
    /// Torque that friction exerts on the parent.
    pub friction: Expr,
    /// Torque that drag exerts on the ground.
    pub drag: Expr,
}

impl JointForces {
    /// Returns the strain and the torques.
    pub fn all(&self) -> [&Expr; 4] {
        [&self.strain, &self.spring, &self.friction, &self.drag]
    }
}

/// Torques of a link during the derivation.
pub(super) struct DerivedForces {
    pub(super) symbols: JointSymbols,
    strain: Formula,
    /// Energy of the spring; zero if no link has one.
    pub(super) stored: Formula,
    spring: Formula,
    friction: Formula,
    drag: Formula,
    /// Power dissipated by friction and drag.
    pub(super) loss: Formula,
}

impl Derivation<'_> {
    /// Derives the torques of a link with the angular velocity `omega`.
    pub(super) fn joint_forces(&mut self, omega: SymbolId) -> DerivedForces {
        let symbols = self.joint_symbols();
        let symbol = Formula::symbol;
        let [stiffness, rest, friction, drag] = symbols.constants.map(symbol);
        let [angle, rate] = symbols.relative;
        let rates = [rate, omega];
        let braking = FrictionContact::ALL.map(|place| {
            let mut links = self.scene.links.iter();
            match links.any(|link| !link.passive.law(place).is_none()) {
                true => symbol(symbols.braking[place as usize]),
                false => Formula::zero(),
            }
        });
        let strain = &symbol(angle) - &rest;
        let stored = stored(&stiffness, &strain);
        let [[friction, lost], [drag, dragged]] = [0, 1].map(|place| {
            let coefficient = [&friction, &drag][place];
            let viscous = dissipated(coefficient, &symbol(rates[place]));
            let torque = &viscous.derivative(rates[place]) + &braking[place];
            let loss = &torque * &symbol(rates[place]);
            [torque, loss]
        });
        let mut links = self.scene.links.iter();
        let has_spring = links.any(|link| !link.passive.spring.is_zero());
        DerivedForces {
            spring: stored.derivative(angle),
            strain,
            stored: match has_spring {
                true => stored,
                false => Formula::zero(),
            },
            friction,
            drag,
            loss: &lost + &dragged,
            symbols,
        }
    }

    fn joint_symbols(&mut self) -> JointSymbols {
        let mut letter =
            |role: Role, text: &str, latex: &str| self.symbols.intern(role, text, text, latex);
        let mut constant = |text: &str, latex: &str| letter(Role::Constant, text, latex);
        let constants = [
            constant("κ_i", "\\kappa_i"),
            constant("ρ", "\\rho"),
            constant("c", "c"),
            constant("k", "k"),
        ];
        let mut derived = |text: &str, latex: &str| letter(Role::Derived, text, latex);
        JointSymbols {
            constants,
            relative: [derived("φ", "\\varphi"), derived("φ̇", "\\dot\\varphi")],
            braking: [derived("D", "D"), derived("D⁰", "D^{0}")],
        }
    }

    /// Returns the torques as plain data.
    pub(super) fn plain_forces(&self, forces: &DerivedForces) -> JointForces {
        let DerivedForces {
            symbols,
            strain,
            stored: _,
            spring,
            friction,
            drag,
            loss: _,
        } = forces;
        JointForces {
            symbols: symbols.clone(),
            strain: self.expr(strain),
            spring: self.expr(spring),
            friction: self.expr(friction),
            drag: self.expr(drag),
        }
    }
}
