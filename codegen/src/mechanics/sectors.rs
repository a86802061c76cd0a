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
use crate::scene::{Coordinate, LinkId, SectorVariables, sectors};

/// Constants of the links of one orbit beside those of their joint, see
/// [`Articulation`](super::Articulation); each is an expression in named constants, parameters
/// and numbers, zero where the scene has no such thing.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitConstants {
    /// Mass.
    pub mass: Expr,
    /// Moment of inertia about the centre of mass.
    pub inertia: Expr,
    /// Centre of mass from the link's pivot, along and across.
    pub com: [Expr; 2],
    /// G in G (1 − cos θ).
    pub gravity: Expr,
    /// F in F sin θ, of lateral offsets.
    pub lateral_gravity: Expr,
    /// Functions of time c, s, τ in the generalized force of the drive,
    /// Q = s cos θ − c sin θ + τ.
    pub drive: [Expr; 3],
}

/// Entry of the mass matrix between the links of an orbit and those of an
/// ancestor's: cosine · cos(θ_row − θ_column) + sine · sin(θ_row − θ_column).
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitCoupling<V = Expr> {
    /// Orbit of the descendants.
    pub row: usize,
    /// Orbit of the ancestors.
    pub column: usize,
    /// Factor of the cosine.
    pub cosine: V,
    /// Factor of the sine.
    pub sine: V,
}

/// Straight springs between the copies of a group: Γ beside G in the sectors of their differences.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitChord<V = Expr> {
    /// Index of the group in the scene.
    pub group: usize,
    /// Orbit of the copies.
    pub orbit: usize,
    /// Γ.
    pub weight: V,
}

/// The mechanics of a scene by orbits.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitMechanics {
    /// Constants of each orbit of the scene, in its order.
    pub orbits: Vec<OrbitConstants>,
    /// Couplings of orbits to those above them, none of them zero.
    pub couplings: Vec<OrbitCoupling>,
    /// Straight springs between copies.
    pub chords: Vec<OrbitChord>,
    /// The sectors: the in-phase one, then the differences, outer branchings
    /// first.
    pub sectors: Vec<SectorVariables>,
    /// True if springs between links couple sectors.
    pub springs_couple: bool,
}

impl OrbitMechanics {
    /// Group and number of the difference of each sector; `None` for the means.
    pub fn differences(&self) -> Vec<Option<(usize, usize)>> {
        let sectors = self.sectors.iter();
        sectors.map(|sector| sector.difference).collect()
    }
}

impl Derivation<'_> {
    /// Reads the constants of each orbit out of the Lagrangian of the absolute
    /// angles; one link stands for all of its orbit.
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
