//! Constants for energies and powers: the mass of each link, and the first moment, about the link's
//! pivot, of the link with its subtree.

use branched_pendulum::scalar::Double;
use branched_pendulum::tree::Bodies;

use crate::equations::{NonViscousBodyRow, NonViscousEquations};
use crate::numbers::LinkNumbers;

/// Links of a tree as rigid bodies, for energies and powers. The equations with all kinds of friction
/// serve every tree: the constants of missing torques are zero.
pub(crate) type LinkBodies<T> = Bodies<NonViscousEquations, T>;

/// Returns the constants for energies and powers, one row per link.
pub(crate) fn bodies(links: &[LinkNumbers], gravity: Double) -> Vec<NonViscousBodyRow<Double>> {
    let bodies = carried(links).into_iter().zip(links);
    bodies.map(|(own, link)| own.body(link, gravity)).collect()
}

/// Inertia of a link together with its subtree, relative to the link's pivot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    mass: Double,
    /// Moment of inertia about the pivot: the diagonal entry of the mass matrix, kg m².
    pub(crate) inertia: Double,
    /// First moment about the pivot, along the link and across it, kg m.
    pub(crate) moment: [Double; 2],
}

impl Carried {
    /// Returns the constants for energies and powers of a link.
    fn body(self, link: &LinkNumbers, gravity: Double) -> NonViscousBodyRow<Double> {
        let passive = &link.passive;
        let [joint, ground] = &passive.laws;
        NonViscousBodyRow {
            rest: passive.rest,
            friction_width: joint.width,
            drag_width: ground.width,
            body_mass: link.mass,
            body_inertia: link.inertia,
            com_along: link.com[0],
            com_across: link.com[1],
            pivot_along: link.pivot[0],
            pivot_across: link.pivot[1],
            carried_moment: self.moment[0],
            lateral_carried_moment: self.moment[1],
            weight_moment: gravity * self.moment[0],
            lateral_weight_moment: gravity * self.moment[1],
            stiffness: passive.spring,
            pivot_friction: passive.friction,
            ground_drag: passive.drag,
            stribeck_rate: joint.stribeck,
            pivot_coulomb: joint.coulomb,
            pivot_excess: joint.excess,
            pivot_quadratic: joint.quadratic,
            ground_quadratic: ground.quadratic,
        }
    }
}

/// Returns, for each link, the inertia of the link together with its subtree.
pub(crate) fn carried(links: &[LinkNumbers]) -> Vec<Carried> {
    let own = links.iter().map(|link| {
        let [along, across] = link.com;
        let moment = link.com.map(|place| link.mass * place);
        Carried {
            mass: link.mass,
            inertia: link.inertia + moment[0] * along + moment[1] * across,
            moment,
        }
    });
    let mut all: Vec<Carried> = own.collect();
    // Parents come before their children.
    for (number, link) in links.iter().enumerate().rev() {
        let mass = all.get(number).map(|own| own.mass);
        let parent = link.parent.and_then(|parent| all.get_mut(parent));
        if let (Some(mass), Some(parent)) = (mass, parent) {
            let first = link.pivot.map(|place| mass * place);
            parent.mass += mass;
            parent.inertia = parent.inertia + first[0] * link.pivot[0] + first[1] * link.pivot[1];
            for (moment, first) in parent.moment.iter_mut().zip(first) {
                *moment += first;
            }
        }
    }
    all
}
