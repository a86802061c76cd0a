//! Torques on the links of trees in loops, and the columns of constants that they
//! and lateral offsets ask for.

use super::offsets::{self, is_lateral};
use super::{Link, Quantity, Scene};

/// Which torques act on the links, in one generation at least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forces {
    /// Viscous friction in pivots.
    pub friction: bool,
    /// Viscous drag against the ground.
    pub drag: bool,
    /// Torsion springs in pivots.
    pub spring: bool,
    /// A torque on the root, which has the last column: zero here, and stated anew
    /// by every evaluation.
    pub root_torque: bool,
    /// No torque: whether offsets across the links have columns.
    pub lateral: bool,
}

impl Forces {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        let any = |force: fn(&Link) -> &Option<Quantity>| {
            scene.links.iter().any(|link| force(link).is_some())
        };
        Self {
            friction: any(|link| &link.friction),
            drag: any(|link| &link.drag),
            spring: any(|link| &link.spring),
            root_torque: scene
                .drive
                .as_ref()
                .is_some_and(|drive| drive.torque.is_some()),
            lateral: is_lateral(scene),
        }
    }

    /// Whether links pull at their parents by torques.
    pub fn in_joints(self) -> bool {
        self.friction || self.spring
    }

    /// Whether there are any but the torque on the root.
    pub fn any(self) -> bool {
        self.in_joints() || self.drag
    }

    /// The values of a link, in the order of the columns.
    pub(super) fn values(self, link: &Link) -> impl Iterator<Item = Quantity> {
        let values = [
            (self.friction, value(&link.friction)),
            (self.drag, value(&link.drag)),
            (self.spring, value(&link.spring)),
            (self.root_torque, Quantity::zero()),
        ];
        let there = values.into_iter().filter(|(there, _)| *there);
        there.map(|(_, value)| value)
    }

    /// The names of the columns.
    pub fn columns(self) -> Vec<&'static str> {
        let mut columns = vec!["rest", "inertia", "moment", "square", "ratio", "reach"];
        if self.lateral {
            columns.extend(offsets::COLUMNS);
        }
        let forces = [
            (self.friction, "friction"),
            (self.drag, "drag"),
            (self.spring, "spring"),
            (self.root_torque, "root_torque"),
        ];
        columns.extend(
            forces
                .into_iter()
                .filter(|(there, _)| *there)
                .map(|(_, name)| name),
        );
        columns
    }
}

pub(super) fn value(force: &Option<Quantity>) -> Quantity {
    force.clone().unwrap_or_else(Quantity::zero)
}
