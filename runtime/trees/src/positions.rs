//! Where the links are, and forces on them.

use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::{LinkPoint, LinkProperties};

use crate::tree::PendulumTree;

impl<T: Scalar> PendulumTree<T> {
    /// Returns the properties of a link.
    #[must_use]
    pub fn link_properties(&self, link: usize) -> Option<LinkProperties<T>> {
        self.properties.of(link)
    }

    /// Returns the positions x, y (m) of a point of each link, from the root's pivot: x to
    /// the side to which positive angles move a link's end, y upwards. Where gravity is written
    /// as negative, ends are above their pivots at angle 0.
    #[must_use]
    pub fn points(&self, point: LinkPoint, theta: &[T]) -> Vec<[T; 2]> {
        let mut points = self.pairs();
        self.properties.points_into(point, theta, &mut points);
        points
    }

    /// Returns the velocities (m/s) of a point of each link.
    #[must_use]
    pub fn point_velocities(&self, point: LinkPoint, theta: &[T], omega: &[T]) -> Vec<[T; 2]> {
        let mut velocities = self.pairs();
        self.properties
            .velocities_into(point, theta, omega, &mut velocities);
        velocities
    }

    /// Returns the generalized torques (N m) of forces (N) on a point of each link.
    #[must_use]
    pub fn point_torques(&self, point: LinkPoint, theta: &[T], forces: &[[T; 2]]) -> Vec<T> {
        let mut torques = vec![T::from_f64(0.0); self.links()];
        self.properties
            .torques_into(point, theta, forces, &mut torques);
        torques
    }

    fn pairs(&self) -> Vec<[T; 2]> {
        vec![[T::from_f64(0.0); 2]; self.links()]
    }
}
