//! Ingredients of the sectors' energies and transfers (physics §3, §5): the
//! constants of each orbit, once for all its copies.
//!
//! On a nested tree the formulas in symmetric coordinates would fill pages; the
//! program is formed from these constants by arithmetic on means and
//! differences instead.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::Expr;
use super::frame::DerivedFrame;
use super::friction::LawConstants;
use crate::scene::{Coordinate, LinkId, Offset, SectorVariables, sectors};

/// Constants of the links of one orbit; each is an expression in named
/// constants, parameters and numbers, zero where the scene has no such thing.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitConstants {
    /// Mass.
    pub mass: Expr,
    /// Moment of inertia about the centre of mass.
    pub inertia: Expr,
    /// Centre of mass from the link's pivot, along and across.
    pub com: [Expr; 2],
    /// The link's pivot from its parent's, along and across.
    pub pivot: [Expr; 2],
    /// Diagonal entry of the mass matrix.
    pub moment: Expr,
    /// G in G (1 − cos θ).
    pub gravity: Expr,
    /// F in F sin θ, of lateral offsets.
    pub lateral_gravity: Expr,
    /// Stiffness of the torsion spring in the pivot.
    pub spring: Expr,
    /// Relative angle at which the spring is at rest.
    pub rest: Expr,
    /// Viscous friction in the pivot.
    pub friction: Expr,
    /// Viscous drag against the ground.
    pub drag: Expr,
    /// Laws of friction in the pivot and against the ground, beside viscous ones.
    pub laws: [LawConstants; 2],
    /// Functions of time c, s, τ in the generalized force of the drive,
    /// Q = s cos θ − c sin θ + τ.
    pub drive: [Expr; 3],
}

/// Entry of the mass matrix between the links of an orbit and those of an
/// ancestor's: cosine · cos(θ_row − θ_column) + sine · sin(θ_row − θ_column).
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitCoupling {
    /// Orbit of the descendants.
    pub row: usize,
    /// Orbit of the ancestors.
    pub column: usize,
    /// Factor of the cosine.
    pub cosine: Expr,
    /// Factor of the sine.
    pub sine: Expr,
}

/// The mechanics of a scene by orbits.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitMechanics {
    /// Constants of each orbit of the scene, in its order.
    pub orbits: Vec<OrbitConstants>,
    /// Couplings of orbits to those above them, none of them zero.
    pub couplings: Vec<OrbitCoupling>,
    /// The sectors: the in-phase one, then the differences, outer branchings
    /// first.
    pub sectors: Vec<SectorVariables>,
}

impl Derivation<'_> {
    /// Reads the constants of each orbit out of the Lagrangian of the absolute
    /// angles; one link stands for all of its orbit.
    pub(super) fn sectors(
        &self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
    ) -> OrbitMechanics {
        let scene = self.scene;
        let mut orbits = Vec::new();
        let mut couplings = Vec::new();
        for (row, orbit) in scene.orbits.iter().enumerate() {
            let LinkId(index) = orbit.links[0];
            let link = &scene.links[index];
            let angle = frame.coordinates[index];
            let slope = |symbol| frame.potential.derivative(symbol).expand();
            let named = |letter: &str| match self.symbols.find(&format!("{letter}_{}", orbit.name))
            {
                Some(symbol) => Expr::Symbol(symbol),
                None => Expr::zero(),
            };
            let optional = |value: &Option<_>, letter| match value {
                Some(_) => named(letter),
                None => Expr::zero(),
            };
            let offset = |offset: &Offset| {
                [&offset.along, &offset.lateral]
                    .map(|component| self.quantity(component).expand().to_expr(&self.symbols))
            };
            let expr = |formula: Formula| formula.to_expr(&self.symbols);
            orbits.push(OrbitConstants {
                mass: expr(self.quantity(&link.mass)),
                inertia: expr(self.quantity(&link.inertia)),
                com: offset(&link.com),
                pivot: offset(&link.pivot),
                moment: expr(frame.mass.get(index, index)),
                gravity: expr(-slope(self.cos(angle))),
                lateral_gravity: expr(slope(self.sin(angle))),
                spring: optional(&link.spring, "κ"),
                rest: optional(&link.rest, "ρ"),
                friction: optional(&link.friction, "c"),
                drag: optional(&link.drag, "k"),
                laws: self.law_constants(&orbit.name),
                drive: [self.cos(angle), self.sin(angle), angle]
                    .map(|symbol| expr(frame.drive.derivative(symbol).expand())),
            });
            let mut above = link.parent;
            while let Some(LinkId(ancestor)) = above {
                let entry = frame.mass.get(index, ancestor);
                if !entry.is_zero() {
                    let (cos, sin) = self.known_between(angle, frame.coordinates[ancestor]);
                    couplings.push(OrbitCoupling {
                        row,
                        column: scene.links[ancestor].orbit.0,
                        cosine: expr(entry.derivative(cos)),
                        sine: expr(entry.derivative(sin)),
                    });
                }
                above = scene.links[ancestor].parent;
            }
        }
        OrbitMechanics {
            orbits,
            couplings,
            sectors: sectors(coordinates),
        }
    }
}
