//! Transfers between scales and powers on them, computed as sums of products over all links.

use super::blocks::Layers;
use super::columns::{DRAG, DRIVE, FRICTION, OUTSIDE, ScaleColumns};
use super::energies::in_all_lanes;
use super::{ByScale, ScaleEquations, ScaleOutput};
use crate::scalar::Scalar;
use crate::sectors::PowerKind;
use crate::simd::Simd;

/// Number of scales whose transfers with one scale are computed at a time; their sums stay in
/// registers.
const TOGETHER: usize = 4;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Adds the contributions of the links of a piece to {E_s, E_r} = Σ z_s u_r − u_s z_r for all
    /// pairs of scales, and to the powers Σ u_s Q. u are the flows, z the derivatives of the
    /// energies, and Q the torques.
    #[inline(always)]
    pub(super) fn products<V: Simd<T>>(&mut self, piece: &Layers<'_>, flows: &ScaleColumns<'_, T>) {
        for to in 0..self.shape.count() {
            let mut from = 0;
            while from + TOGETHER <= to {
                self.transfers::<V, TOGETHER>(piece, flows, from, to);
                from += TOGETHER;
            }
            while from < to {
                self.transfers::<V, 1>(piece, flows, from, to);
                from += 1;
            }
            self.powers::<V>(piece, flows, to);
        }
    }

    /// Computes the energy transfers from `N` scales to one.
    #[inline(always)]
    fn transfers<V: Simd<T>, const N: usize>(
        &mut self,
        piece: &Layers<'_>,
        flows: &ScaleColumns<'_, T>,
        from: usize,
        to: usize,
    ) {
        let mut sums = [V::from_f64(0.0); N];
        for generation in 0..piece.count {
            let own = piece.own.at(generation);
            let mut place = 0;
            while place < own.count {
                let (slot, left) = (own.slot + place, own.count - place);
                let [u_s, z_s]: [V; 2] = flows.read_some(2 * to, slot, left);
                for (index, sum) in sums.iter_mut().enumerate() {
                    let [u_r, z_r]: [V; 2] = flows.read_some(2 * (from + index), slot, left);
                    *sum = sum.plus_product(z_s, u_r).minus_product(u_s, z_r);
                }
                place += V::LANES;
            }
        }
        let ScaleOutput::Budget(budget) = &mut self.wanted else {
            return;
        };
        for (index, sum) in sums.into_iter().enumerate() {
            let from = from + index;
            let transfer = budget.transfer(from, to) + in_all_lanes::<T, V>(sum);
            budget.set_transfer(from, to, transfer);
        }
    }

    /// Computes the powers of all forces on one scale.
    #[inline(always)]
    fn powers<V: Simd<T>>(
        &mut self,
        piece: &Layers<'_>,
        flows: &ScaleColumns<'_, T>,
        scale: usize,
    ) {
        let columns = [
            (PowerKind::Friction, FRICTION, E::FRICTION),
            (PowerKind::Drag, DRAG, E::DRAG),
            (PowerKind::Drive, DRIVE, self.drive.is_some() && E::DRIVEN),
            (PowerKind::Outside, OUTSIDE, !self.torques.is_empty()),
        ];
        for (kind, column, acts) in columns {
            if !acts {
                continue;
            }
            let mut sum = V::from_f64(0.0);
            for generation in 0..piece.count {
                let own = piece.own.at(generation);
                let mut places = piece.upwards(&self.shape, generation, 1);
                while let Some(at) = places.next(V::LANES) {
                    let slot = own.slot + at.number;
                    let [flow]: [V; 1] = flows.read_some(2 * scale, slot, at.left);
                    let [torque]: [V; 1] = self.columns.read_some(column, at.slot, at.left);
                    sum = sum.plus_product(flow, torque);
                }
            }
            self.add_power(kind, scale, in_all_lanes::<T, V>(sum));
        }
        // A torque on the root alone.
        if let (Some([.., torque]), false, 0) = (self.drive, E::DRIVEN, piece.first) {
            let [flow]: [T; 1] = flows.read(2 * scale, 0);
            self.add_power(PowerKind::Drive, scale, flow * torque);
        }
    }

    #[inline(always)]
    fn add_power(&mut self, kind: PowerKind, scale: usize, power: T) {
        if let ScaleOutput::Budget(budget) = &mut self.wanted {
            budget.add_power(kind, scale, power);
        }
    }
}
