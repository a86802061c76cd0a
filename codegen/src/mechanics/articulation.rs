//! Joints of the tree for the articulated-body recursion (physics §10). The constants of each orbit
//! (equal copies of one link) are derived from the positions.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::Expr;
use super::frame::DerivedFrame;
use super::lines::LineTorque;
use super::link_pairs::PairElement;
use crate::scene::{LinkId, PassiveTorques};

/// Constants of the links of one orbit; those that do not occur in the scene are zero. They are
/// expressions in named constants, parameters and numbers, or values of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint<V = Expr> {
    /// Diagonal entry M of the mass matrix, in kg m².
    pub inertia: V,
    /// First moment (h, e) of the mass that the link carries about the link's pivot, along and
    /// across the link, in kg m.
    pub moment: [V; 2],
    /// Position (ℓ, w) of the link's pivot relative to its parent's pivot, along and across the
    /// parent, in m.
    pub pivot: [V; 2],
    /// Friction and spring in the pivot, and drag against the ground.
    pub passive: PassiveTorques<V>,
}

impl<V> Joint<V> {
    /// Returns the joint with `formed` applied to every constant.
    pub fn map<W>(&self, mut formed: impl FnMut(&V) -> W) -> Joint<W> {
        Joint {
            inertia: formed(&self.inertia),
            moment: self.moment.each_ref().map(&mut formed),
            pivot: self.pivot.each_ref().map(&mut formed),
            passive: self.passive.map(formed),
        }
    }
}

/// Quantities that the articulated-body recursion uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Articulation {
    /// Gravitational acceleration, in m/s².
    pub gravity: Expr,
    /// Joints of each orbit, in the scene's order; one link represents its whole orbit.
    pub joints: Vec<Joint>,
    /// Springs and friction between two links that are not parent and child.
    pub pairs: Vec<PairElement>,
    /// Torques of straight springs and dampers.
    pub lines: Vec<LineTorque>,
}

impl Derivation<'_> {
    pub(super) fn articulation(&self, frame: &DerivedFrame) -> Articulation {
        let scene = self.scene;
        let expr = |formula: Formula| formula.to_expr(&self.symbols);
        // Σ m_l (height of l) = Σ e_i sin θ_i − h_i cos θ_i.
        let heights = self.heights(&frame.coordinates, |derivation, link| {
            derivation.quantity(&link.mass)
        });
        let joints = scene.orbits.iter().map(|orbit| {
            let LinkId(index) = orbit.links[0];
            let link = &scene.links[index];
            let angle = frame.coordinates[index];
            Joint {
                inertia: expr(frame.mass.get(index, index)),
                moment: [
                    expr((-heights.derivative(self.cos(angle))).expand()),
                    expr(heights.derivative(self.sin(angle)).expand()),
                ],
                pivot: [&link.pivot.along, &link.pivot.lateral]
                    .map(|component| expr(self.quantity(component).expand())),
                passive: self.passive_constants(&[&orbit.name]),
            }
        });
        Articulation {
            gravity: expr(self.quantity(&scene.gravity).expand()),
            joints: joints.collect(),
            pairs: self.plain_pairs(),
            lines: self.line_torques(),
        }
    }
}
