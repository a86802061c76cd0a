//! Energies of sectors by Parseval's identity (physics (9.3), (9.6)): a sector's kinetic energy is
//! computed from its part of the centre-of-mass velocities, so that the energies of all sectors sum
//! to H.

use super::SymmetricTree;
use super::memory::FreeMemory;
use super::motion::TreeMotion;
use super::shape::BlockShape;
use crate::scalar::Scalar;

/// Velocities of the centres of mass of the links.
pub(super) struct Centres<'w, T> {
    x: &'w mut [T],
    y: &'w mut [T],
}

/// Workspace lengths, in numbers per link: for the centres of mass, for the results kept for a
/// sector, and for temporary values of a sector.
pub(super) const CENTRES: usize = 2;
pub(super) const KEPT: usize = 2;
pub(super) const FORMED: usize = 5;

/// Kinetic energy of one sector, with its derivatives by the angular velocities and by the angles
/// of the links.
pub(super) struct ParsevalShare<'w, T> {
    pub(super) kinetic: T,
    pub(super) by_omega: &'w mut [T],
    pub(super) by_theta: &'w mut [T],
}

impl<T: Scalar> SymmetricTree<T> {
    pub(super) fn centres<'w>(
        &self,
        motion: &TreeMotion<'_, T>,
        memory: &mut FreeMemory<'w, T>,
    ) -> Centres<'w, T> {
        let links = self.shape.links();
        let [x, y] = [(); 2].map(|()| memory.take(links));
        let mut own = memory.lend();
        let [pivot_x, pivot_y] = [(); 2].map(|()| own.take(links));
        for (link, body) in self.bodies.iter().enumerate() {
            let mut base = [T::from_f64(0.0); 2];
            if let Some(parent) = self.shape.parents[link] {
                let [along, across] = body.pivot;
                let turn = self.point_velocity([along, across], motion, parent);
                base = [pivot_x[parent] + turn[0], pivot_y[parent] + turn[1]];
            }
            [pivot_x[link], pivot_y[link]] = base;
            let turn = self.point_velocity(body.com, motion, link);
            [x[link], y[link]] = [base[0] + turn[0], base[1] + turn[1]];
        }
        Centres { x, y }
    }

    /// Returns the velocity (m/s) of a point of a link relative to the link's pivot.
    #[inline(always)]
    fn point_velocity(
        &self,
        [along, across]: [T; 2],
        motion: &TreeMotion<'_, T>,
        link: usize,
    ) -> [T; 2] {
        let (sine, cosine) = (motion.sines[link], motion.cosines[link]);
        let omega = motion.omega[link];
        [
            omega * (along * cosine - across * sine),
            omega * (along * sine + across * cosine),
        ]
    }

    /// Computes the part of the kinetic energy that belongs to a sector.
    pub(super) fn share<'w>(
        &self,
        block: &BlockShape,
        motion: &TreeMotion<'_, T>,
        centres: &Centres<'_, T>,
        memory: &mut FreeMemory<'w, T>,
    ) -> ParsevalShare<'w, T> {
        let (links, zero) = (self.shape.links(), T::from_f64(0.0));
        let [by_omega, by_theta] = [(); 2].map(|()| memory.take(links));
        let mut own = memory.lend();
        let [x, y, spin, carried_x, carried_y] = [(); 5].map(|()| own.take(links));
        for numbers in [&mut *x, &mut *y, &mut *spin] {
            numbers.fill(zero);
        }
        let mut twice = zero;
        for column in &block.columns {
            let Some(&(first, _)) = column.weights.first() else {
                continue;
            };
            let body = &self.bodies[first];
            let norm = T::from_f64(column.norm);
            let part = |values: &[T]| column.sum(|link| values[link]) / norm;
            let [u, v, w] = [part(centres.x), part(centres.y), part(motion.omega)];
            twice = twice + norm * (body.mass * (u * u + v * v) + body.inertia * (w * w));
            for (link, weight) in column.iter() {
                let weight: T = weight;
                x[link] = weight * body.mass * u;
                y[link] = weight * body.mass * v;
                spin[link] = weight * body.inertia * w;
            }
        }
        // From the leaves to the root: the moment, in the frame that rotates with the link, of the
        // momenta of the link and of all that hangs from it.
        for numbers in [&mut *by_omega, by_theta, carried_x, carried_y] {
            numbers.fill(zero);
        }
        for link in (0..links).rev() {
            let body = &self.bodies[link];
            let (sine, cosine) = (motion.sines[link], motion.cosines[link]);
            let [along, across] = moment(body.com, [x[link], y[link]]);
            let [along, across] = [by_omega[link] + along, by_theta[link] + across];
            by_omega[link] = along * cosine + across * sine + spin[link];
            by_theta[link] = motion.omega[link] * (across * cosine - along * sine);
            if let Some(parent) = self.shape.parents[link] {
                let whole = [x[link] + carried_x[link], y[link] + carried_y[link]];
                let [along, across] = moment(body.pivot, whole);
                by_omega[parent] = by_omega[parent] + along;
                by_theta[parent] = by_theta[parent] + across;
                carried_x[parent] = carried_x[parent] + whole[0];
                carried_y[parent] = carried_y[parent] + whole[1];
            }
        }
        ParsevalShare {
            kinetic: T::from_f64(0.5) * twice,
            by_omega,
            by_theta,
        }
    }
}

/// Computes conj(λ) · z, with the position λ and the momentum z as complex numbers.
#[inline(always)]
fn moment<T: Scalar>([along, across]: [T; 2], [x, y]: [T; 2]) -> [T; 2] {
    [along * x + across * y, along * y - across * x]
}
