//! Hand with which the user holds a link.

use branched_pendulum::system::{LinkPoint, Model, Positions};
use branched_pendulum_trees::PendulumTree;

/// Angular frequency of the whole tree on the hand's spring, in rad/s.
const FREQUENCY: f64 = 16.0;

/// Ratio of the damping of that oscillation to critical damping.
const DAMPING: f64 = 0.7;

/// A spring and a damper between a point of a link and the position of the hand.
#[derive(Clone, Debug)]
pub(crate) struct Hand {
    link: usize,
    /// Position of the held point between the link's pivot (0) and its end (1).
    part: f64,
    place: [f64; 2],
    /// N/m.
    stiffness: f64,
    /// N s/m.
    damping: f64,
}

/// Returns the point between two others at the fraction `part` of the distance.
fn between(from: [f64; 2], to: [f64; 2], part: f64) -> [f64; 2] {
    [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
}

impl Hand {
    /// Holds a link at its point nearest to the position x, y (m). Returns `None` if there is no
    /// such link.
    pub(crate) fn on(
        tree: &PendulumTree,
        theta: &[f64],
        link: usize,
        place: [f64; 2],
    ) -> Option<Self> {
        let [pivot, end] =
            [LinkPoint::Pivot, LinkPoint::End].map(|point| tree.points(point, theta));
        let (pivot, end) = (pivot.get(link)?, end.get(link)?);
        let (mut along, mut square) = (0.0, 0.0);
        for axis in [0, 1] {
            let side = end[axis] - pivot[axis];
            along += side * (place[axis] - pivot[axis]);
            square += side * side;
        }
        let part = if square > 0.0 { along / square } else { 0.0 };
        let masses = (0..tree.links()).filter_map(|link| tree.properties_of(link));
        let mass: f64 = masses.map(|link| link.mass).sum();
        Some(Self {
            link,
            part: part.clamp(0.0, 1.0),
            place,
            stiffness: mass * FREQUENCY * FREQUENCY,
            damping: 2.0 * DAMPING * mass * FREQUENCY,
        })
    }

    /// Moves the hand to the position x, y (m).
    pub(crate) fn move_to(&mut self, place: [f64; 2]) {
        self.place = place;
    }

    /// Returns the held point and the position of the hand, in m.
    pub(crate) fn ends(&self, tree: &PendulumTree, theta: &[f64]) -> Option<[[f64; 2]; 2]> {
        let of = |point| tree.points(point, theta).get(self.link).copied();
        let point = between(of(LinkPoint::Pivot)?, of(LinkPoint::End)?, self.part);
        Some([point, self.place])
    }

    /// Returns the torques (N m) of the hand's force on the links.
    ///
    /// A force on a point between pivot and end is replaced by forces on both, divided in inverse
    /// proportion to the distances.
    pub(crate) fn torques(&self, tree: &PendulumTree, theta: &[f64], omega: &[f64]) -> Vec<f64> {
        let nowhere = vec![f64::NAN; tree.links()];
        let Some([point, place]) = self.ends(tree, theta) else {
            return nowhere;
        };
        let of = |point| {
            let velocities = tree.point_velocities(point, theta, omega);
            velocities.get(self.link).copied()
        };
        let Some((pivot, end)) = of(LinkPoint::Pivot).zip(of(LinkPoint::End)) else {
            return nowhere;
        };
        let velocity = between(pivot, end, self.part);
        let force = [0, 1].map(|axis| {
            self.stiffness * (place[axis] - point[axis]) - self.damping * velocity[axis]
        });
        let share = |part: f64, point| {
            let mut forces = vec![[0.0; 2]; tree.links()];
            if let Some(own) = forces.get_mut(self.link) {
                *own = force.map(|component| part * component);
            }
            tree.point_torques(point, theta, &forces)
        };
        let on_pivot = share(1.0 - self.part, LinkPoint::Pivot);
        let on_end = share(self.part, LinkPoint::End);
        on_pivot.iter().zip(on_end).map(|(a, b)| a + b).collect()
    }
}
