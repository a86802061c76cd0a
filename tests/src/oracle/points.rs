//! Points of links by the sum of all vectors from the root, and the torques of forces
//! there by Jacobians written out.

use super::{Tree, Vector, dot, perpendicular, turned};

/// A point of one link, at `place` along and across it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The link.
    pub link: usize,
    /// Along and across it, from its pivot, m.
    pub place: [f64; 2],
}

impl Tree {
    /// The vectors that lead from the root's pivot to a point: the links that each one
    /// is fixed to, and the vector.
    fn vectors(&self, point: Place, theta: &[f64]) -> Vec<(usize, Vector)> {
        let lineage = self.lineage(point.link);
        let mut vectors = vec![(point.link, turned(point.place, theta[point.link]))];
        for pair in lineage.windows(2) {
            let (link, parent) = (pair[0], pair[1]);
            let pivot = self.links[link].pivot;
            vectors.push((parent, turned(pivot, theta[parent])));
        }
        vectors
    }

    /// Position of a point, m.
    pub fn position(&self, point: Place, theta: &[f64]) -> Vector {
        let vectors = self.vectors(point, theta).into_iter();
        vectors.fold([0.0; 2], |sum, (_, v)| [sum[0] + v[0], sum[1] + v[1]])
    }

    /// Velocity of a point, m/s.
    pub fn velocity(&self, point: Place, theta: &[f64], omega: &[f64]) -> Vector {
        let vectors = self.vectors(point, theta).into_iter();
        vectors.fold([0.0; 2], |sum, (link, v)| {
            let [x, y] = perpendicular(v);
            [sum[0] + omega[link] * x, sum[1] + omega[link] * y]
        })
    }

    /// Generalized torques of a force on a point, N m.
    pub fn torques(&self, point: Place, theta: &[f64], force: Vector) -> Vec<f64> {
        let mut torques = vec![0.0; self.links.len()];
        for (link, vector) in self.vectors(point, theta) {
            torques[link] += dot(perpendicular(vector), force);
        }
        torques
    }
}
