//! Entry points for positions and velocities of the links' points, and for the torques of forces at
//! these points.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::Environment;
use super::pair::Pair;
use crate::functions::{Argument, LINK_PROPERTIES, PointKind, Purpose};
use crate::mechanics::expression::Expr;
use crate::mechanics::{LinkPositions, Mechanics, RelativePosition};
use crate::scene::{LinkId, Scene};

/// Names and units of the properties of a link, in order.
const PROPERTIES: [(&str, &str); LINK_PROPERTIES.len()] = [
    ("mass", "kg"),
    ("inertia_about_centre", "kg m²"),
    ("along_centre", "m"),
    ("across_centre", "m"),
    ("along_pivot", "m"),
    ("across_pivot", "m"),
    ("along_end", "m"),
    ("across_end", "m"),
];

/// The tree, the positions of its links, and a kind of points.
#[derive(Clone, Copy)]
struct Points<'a> {
    scene: &'a Scene,
    links: &'a [LinkPositions],
    kind: PointKind,
}

impl Points<'_> {
    /// Returns the point of a link relative to the link's pivot; `None` for the pivot itself.
    fn of(&self, link: usize) -> Option<&RelativePosition> {
        match self.kind {
            PointKind::Pivot => None,
            PointKind::Centre => Some(&self.links[link].centre),
            PointKind::End => Some(&self.links[link].end),
        }
    }

    /// Returns the parent and the position of a link's pivot relative to the parent's pivot.
    fn pivot(&self, link: usize) -> Option<(usize, &RelativePosition)> {
        let LinkId(parent) = self.scene.links[link].parent?;
        Some((parent, self.links[link].pivot.as_ref()?))
    }

    fn name(&self, link: usize) -> &str {
        &self.scene.links[link].name
    }
}

impl EntryList<'_, '_> {
    pub(super) fn positions(
        &mut self,
        scene: &Scene,
        mechanics: &Mechanics,
        links: &[LinkPositions],
    ) {
        use Argument::{Omega, Theta};
        let frame = &mechanics.absolute;
        let mut environment = Environment::new(frame, Theta, Some(Omega), None);
        for kind in PointKind::ALL {
            let points = Points { scene, links, kind };
            let positions = self.along_tree(&mut environment, points, "pivot", |of| &of.position);
            self.push(Purpose::Positions(kind), positions);
            let velocities =
                self.along_tree(&mut environment, points, "velocity", |of| &of.velocity);
            self.push(Purpose::PointVelocities(kind), velocities);
            let torques = self.torques(&mut environment, points);
            self.push(Purpose::PointTorques(kind), torques);
        }
        let mut properties = Vec::new();
        for (link, positions) in scene.links.iter().zip(links) {
            for ((kind, unit), value) in PROPERTIES.iter().zip(&positions.properties) {
                let value = self.lowering.property(value, unit);
                let name = format!("{kind}_{}", link.name);
                properties.push(self.lowering.builder.name(value, &name));
            }
        }
        self.push(Purpose::LinkProperties, properties);
    }

    fn pair(&mut self, environment: &mut Environment<'_>, exprs: &[Expr; 2]) -> Pair {
        let [x, y] = exprs;
        [x, y].map(|expr| self.lowering.expr(environment, expr))
    }

    /// Adds a vector along the path from the root to each link's point.
    fn along_tree(
        &mut self,
        environment: &mut Environment<'_>,
        points: Points<'_>,
        what: &str,
        part: fn(&RelativePosition) -> &[Expr; 2],
    ) -> Vec<ValueId> {
        let zero = self.lowering.builder.zero_pair();
        let mut pivots: Vec<Pair> = Vec::with_capacity(points.links.len());
        let mut sums = Vec::with_capacity(2 * points.links.len());
        for link in 0..points.links.len() {
            let name = points.name(link);
            let pivot = match points.pivot(link) {
                Some((parent, step)) => {
                    let step = self.pair(environment, part(step));
                    let builder = &mut self.lowering.builder;
                    let pivot = builder.add_pairs(pivots[parent], step);
                    builder.name_pair(pivot, &format!("{what}@_{name}"))
                }
                None => zero,
            };
            pivots.push(pivot);
            let point = match points.of(link) {
                Some(step) => {
                    let step = self.pair(environment, part(step));
                    self.lowering.builder.add_pairs(pivot, step)
                }
                None => pivot,
            };
            sums.extend(point);
        }
        sums
    }

    /// Computes the torques Q_i = ∂r_i/∂θ_i · F_i + Σ ∂r_c/∂θ_i · S_c of forces F at points r. r_c
    /// are the pivots of the children c, S the sum of all forces on a subtree.
    fn torques(&mut self, environment: &mut Environment<'_>, points: Points<'_>) -> Vec<ValueId> {
        let count = points.links.len();
        let zero = self.lowering.builder.integer(0);
        let mut torques = vec![zero; count];
        // For each link, the levers of pivots on it and the forces there; copies share a pivot.
        let mut hanging: Vec<Vec<(Pair, Pair)>> = vec![Vec::new(); count];
        for link in (0..count).rev() {
            let mut sum = [0, 1].map(|axis| {
                let element = 2 * link + axis;
                self.lowering.builder.input(Argument::Forces, element)
            });
            let mut torque = zero;
            if let Some(relative) = points.of(link) {
                let lever = self.pair(environment, &relative.lever);
                torque = self.lowering.builder.dot(lever, sum);
            }
            let builder = &mut self.lowering.builder;
            for (lever, force) in std::mem::take(&mut hanging[link]) {
                let moment = builder.dot(lever, force);
                torque = builder.add(torque, moment);
                sum = builder.add_pairs(sum, force);
            }
            torques[link] = torque;
            let Some((parent, pivot)) = points.pivot(link) else {
                continue;
            };
            builder.name_pair(sum, &format!("force@_from_{}", points.name(link)));
            let lever = self.pair(environment, &pivot.lever);
            let builder = &mut self.lowering.builder;
            match hanging[parent]
                .iter_mut()
                .find(|(known, _)| *known == lever)
            {
                Some((_, force)) => *force = builder.add_pairs(*force, sum),
                None => hanging[parent].push((lever, sum)),
            }
        }
        torques
    }
}
