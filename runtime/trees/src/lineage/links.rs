//! Kinematics and factors of the mass matrix of a lineage's links.

use branched_pendulum::scalar::Scalar;

use super::LineageScales;
use crate::numbers::LinkNumbers;

/// A link at an angle.
#[derive(Clone, Copy)]
pub(super) struct PlacedLink<T> {
    pub(super) sine: T,
    pub(super) cosine: T,
    /// Velocity of the centre of mass per unit of the link's own angular velocity, m.
    pub(super) centre: [T; 2],
    /// Velocity of the link's pivot per unit of the parent's angular velocity, m.
    pub(super) pivot: [T; 2],
    /// Coupling of the link's angular acceleration to the acceleration of its pivot, kg m.
    pub(super) gain: [T; 2],
    /// Inverse articulated inertia of the joint, 1/(kg m²).
    pub(super) inverse: T,
}

pub(super) fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the product of `a`, turned by a right angle, with `b`.
pub(super) fn cross<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn add<T: Scalar>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn times<T: Scalar>(factor: T, a: [T; 2]) -> [T; 2] {
    a.map(|own| factor * own)
}

impl<T: Scalar> LineageScales<T> {
    /// Places all links at their angles, without factors of the mass matrix.
    pub(super) fn placed(&self, theta: &[T]) -> Vec<PlacedLink<T>> {
        let zero = T::from_f64(0.0);
        let turned = |[along, across]: [T; 2], sine: T, cosine: T| {
            [
                along * cosine - across * sine,
                along * sine + across * cosine,
            ]
        };
        let mut placed: Vec<PlacedLink<T>> = Vec::with_capacity(self.links.len());
        for (link, &angle) in self.links.iter().zip(theta) {
            let (sine, cosine) = angle.sin_cos();
            let parent = link.numbers.parent.and_then(|parent| placed.get(parent));
            let pivot = parent.map_or([zero; 2], |above| {
                turned(link.numbers.pivot, above.sine, above.cosine)
            });
            placed.push(PlacedLink {
                sine,
                cosine,
                centre: turned(link.numbers.com, sine, cosine),
                pivot,
                gain: [zero; 2],
                inverse: zero,
            });
        }
        placed
    }

    /// Computes gains and articulated inertias, from the leaves to the root: a link's angular
    /// acceleration α under the torque κ is (κ − b·a)/J if its pivot has the acceleration a.
    pub(super) fn factor(&self, placed: &mut [PlacedLink<T>]) {
        let zero = T::from_f64(0.0);
        // Force of the subtree per acceleration of its pivot (xx, xy, yy), and the sums for b and J.
        let mut masses = vec![[zero; 3]; self.links.len()];
        let mut coupled = vec![([zero; 2], zero); self.links.len()];
        for (index, link) in self.links.iter().enumerate().rev() {
            let (own, LinkNumbers { mass, inertia, .. }) = (&mut placed[index], link.numbers);
            let ([xx, xy, yy], (gain, joint)) = (masses[index], coupled[index]);
            let gain = add(times(mass, own.centre), gain);
            let joint = inertia + mass * dot(own.centre, own.centre) + joint;
            let inverse = T::from_f64(1.0) / joint;
            (own.gain, own.inverse) = (gain, inverse);
            let Some(parent) = link.numbers.parent else {
                continue;
            };
            let [x, y] = gain;
            let [xx, xy, yy] = [
                mass + xx - x * x * inverse,
                xy - x * y * inverse,
                mass + yy - y * y * inverse,
            ];
            let [a, b] = own.pivot;
            let pushed = [xx * a + xy * b, xy * a + yy * b];
            let all = &mut masses[parent];
            *all = [all[0] + xx, all[1] + xy, all[2] + yy];
            let (gains, joints) = coupled[parent];
            coupled[parent] = (add(gains, pushed), joints + dot(own.pivot, pushed));
        }
    }

    /// Returns the velocities of the centres of mass.
    pub(super) fn velocities(&self, placed: &[PlacedLink<T>], omega: &[T]) -> Vec<[T; 2]> {
        let mut pivots: Vec<[T; 2]> = Vec::with_capacity(placed.len());
        let links = self.links.iter().zip(placed).zip(omega);
        let velocities = links.map(|((link, own), &rate)| {
            let pivot = match link.numbers.parent {
                Some(parent) => add(pivots[parent], times(omega[parent], own.pivot)),
                None => [T::from_f64(0.0); 2],
            };
            pivots.push(pivot);
            add(pivot, times(rate, own.centre))
        });
        velocities.collect()
    }

    pub(super) fn momenta(&self, velocities: &[[T; 2]]) -> Vec<[T; 2]> {
        let links = self.links.iter().zip(velocities);
        links
            .map(|(link, &velocity)| times(link.numbers.mass, velocity))
            .collect()
    }

    /// Returns for each link the sum of `product` of levers and `forces` on centres of mass, over
    /// the link and all that it carries.
    pub(super) fn levered(
        &self,
        placed: &[PlacedLink<T>],
        forces: &[[T; 2]],
        product: fn([T; 2], [T; 2]) -> T,
    ) -> Vec<T> {
        let mut below = forces.to_vec();
        let own = placed.iter().zip(forces);
        let mut sums: Vec<T> = own
            .map(|(own, &force)| product(own.centre, force))
            .collect();
        for (index, link) in self.links.iter().enumerate().rev() {
            if let Some(parent) = link.numbers.parent {
                let force = below[index];
                below[parent] = add(below[parent], force);
                sums[parent] = sums[parent] + product(placed[index].pivot, force);
            }
        }
        sums
    }

    /// Returns M⁻¹ times the torques, with the factors that [`factor`](Self::factor) has computed.
    pub(super) fn solve(&self, placed: &[PlacedLink<T>], mut torques: Vec<T>) -> Vec<T> {
        let zero = T::from_f64(0.0);
        let mut bias = vec![[zero; 2]; placed.len()];
        for (index, link) in self.links.iter().enumerate().rev() {
            if let Some(parent) = link.numbers.parent {
                let own = &placed[index];
                let force = add(bias[index], times(torques[index] * own.inverse, own.gain));
                bias[parent] = add(bias[parent], force);
                torques[parent] = torques[parent] - dot(own.pivot, force);
            }
        }
        let mut rates: Vec<T> = Vec::with_capacity(placed.len());
        let mut pivots: Vec<[T; 2]> = Vec::with_capacity(placed.len());
        for ((link, own), &torque) in self.links.iter().zip(placed).zip(&torques) {
            let pivot = match link.numbers.parent {
                Some(parent) => add(pivots[parent], times(rates[parent], own.pivot)),
                None => [zero; 2],
            };
            pivots.push(pivot);
            rates.push((torque - dot(own.gain, pivot)) * own.inverse);
        }
        rates
    }
}
