//! Constants for the energies and transfers of sectors (sets of symmetric coordinates: all means,
//! or one difference between copies) (physics §3, §5), once per orbit (equal copies of one link).
//!
//! For nested copies the formulas in symmetric coordinates would fill pages. The program is built
//! from these constants instead and computes with means and differences.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::Expr;
use super::frame::DerivedFrame;
use crate::scene::{Coordinate, LinkId, SectorVariables, sectors};

/// Constants of the links of one orbit, in addition to those of their joint, see
/// [`Articulation`](super::Articulation). Each is an expression in named constants, parameters and
/// numbers; those that the scene lacks are zero.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitConstants {
    /// Mass m.
    pub mass: Expr,
    /// Moment of inertia I about the centre of mass.
    pub inertia: Expr,
    /// Centre of mass relative to the link's pivot, along and across the link.
    pub com: [Expr; 2],
    /// Constant G of the potential energy G (1 − cos θ).
    pub gravity: Expr,
    /// Constant F of the potential energy F sin θ, from lateral offsets.
    pub lateral_gravity: Expr,
    /// Functions of time c, s and τ that determine the generalized force of the drive on a link, Q
    /// = s cos θ − c sin θ + τ.
    pub drive: [Expr; 3],
}

/// Entry of the mass matrix between the links of an orbit and those of an ancestor orbit: cosine ·
/// cos(θ_row − θ_column) + sine · sin(θ_row − θ_column).
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitCoupling<V = Expr> {
    /// Index of the descendants' orbit.
    pub row: usize,
    /// Index of the ancestors' orbit.
    pub column: usize,
    /// Factor of the cosine of the angle between the two links.
    pub cosine: V,
    /// Factor of the sine of the angle between the two links.
    pub sine: V,
}

/// Straight springs between the copies of a group: the constant Γ that adds to gravity's G in the
/// sectors of their differences.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitChord<V = Expr> {
    /// Index of the group in the scene.
    pub group: usize,
    /// Index of the copies' orbit.
    pub orbit: usize,
    /// Constant Γ of the springs between copies, in J.
    pub weight: V,
}

/// Mechanics of a scene by orbits and sectors.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitMechanics {
    /// Constants of each orbit, in the scene's order.
    pub orbits: Vec<OrbitConstants>,
    /// Nonzero couplings between orbits and their ancestors.
    pub couplings: Vec<OrbitCoupling>,
    /// Straight springs between copies.
    pub chords: Vec<OrbitChord>,
    /// Sectors: first the in-phase one (means), then the differences, those of outer branchings
    /// first.
    pub sectors: Vec<SectorVariables>,
    /// True if springs between links couple sectors.
    pub springs_couple: bool,
}

impl OrbitMechanics {
    /// Returns the group and the number of the difference of each sector; `None` for the means.
    pub fn differences(&self) -> Vec<Option<(usize, usize)>> {
        let sectors = self.sectors.iter();
        sectors.map(|sector| sector.difference).collect()
    }
}

impl Derivation<'_> {
    /// Derives the constants of each orbit from the Lagrangian in absolute angles; one link
    /// represents its orbit.
    pub(super) fn sectors(
        &mut self,
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
            let expr = |formula: Formula| formula.to_expr(&self.symbols);
            orbits.push(OrbitConstants {
                mass: expr(self.quantity(&link.mass)),
                inertia: expr(self.quantity(&link.inertia)),
                com: [&link.com.along, &link.com.lateral]
                    .map(|component| expr(self.quantity(component).expand())),
                gravity: expr(-slope(self.cos(angle))),
                lateral_gravity: expr(slope(self.sin(angle))),
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
            springs_couple: scene.coupling_spring(coordinates).is_some(),
            orbits,
            couplings,
            chords: self.orbit_chords(),
            sectors: sectors(coordinates),
        }
    }
}
