//! Transfers between scales and powers on them: sums of products over all links.

use super::columns::{DRAG, DRIVE, FLOW, FRICTION, OUTSIDE};
use super::energies::in_all_lanes;
use super::parts::at;
use super::{ByScale, ScaleEquations, Wanted};
use crate::scalar::Scalar;
use crate::sectors::PowerKind;
use crate::simd::Simd;

/// Links whose flows and slopes stay in the first cache while all pairs are taken.
const TOGETHER: usize = 128;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// {E_s, E_r} = Σ z_s u_r − u_s z_r of all pairs.
    #[inline(always)]
    pub(super) fn transfers<V: Simd<T>>(&mut self) {
        let length = self.columns.length;
        let Wanted::Budget(budget) = &mut self.wanted else {
            return;
        };
        let mut start = 0;
        while start < length {
            let end = (start + TOGETHER).min(length);
            for to in 1..self.shape.count() {
                for from in 0..to {
                    let [u_s, z_s] = [0, 1].map(|part| FLOW + 2 * to + part);
                    let [u_r, z_r] = [0, 1].map(|part| FLOW + 2 * from + part);
                    let columns = [u_s, z_s, u_r, z_r].map(|number| self.columns.column(number));
                    let part = bracket::<T, V>(columns, start, end);
                    budget.set_transfer(from, to, budget.transfer(from, to) + part);
                }
            }
            start = end;
        }
    }

    /// Σ u_s Q of all torques Q.
    #[inline(always)]
    pub(super) fn powers<V: Simd<T>>(&mut self) {
        let columns = [
            (PowerKind::Friction, FRICTION, E::FRICTION),
            (PowerKind::Drag, DRAG, E::DRAG),
            (PowerKind::Drive, DRIVE, self.drive.is_some() && E::MOVED),
            (PowerKind::Outside, OUTSIDE, !self.torques.is_empty()),
        ];
        for (kind, column, acts) in columns {
            if !acts {
                continue;
            }
            self.columns.clear_beyond(column, &self.shape);
            for scale in 0..self.shape.count() {
                let flow = self.columns.column(FLOW + 2 * scale);
                let power = product::<T, V>(flow, self.columns.column(column));
                if let Wanted::Budget(budget) = &mut self.wanted {
                    budget.set_power(kind, scale, power);
                }
            }
        }
        // A torque on the root alone.
        let (Some([.., torque]), false) = (self.drive, E::MOVED) else {
            return;
        };
        for scale in 0..self.shape.count() {
            let [flow]: [T; 1] = self.columns.read(FLOW + 2 * scale, 0);
            if let Wanted::Budget(budget) = &mut self.wanted {
                budget.set_power(PowerKind::Drive, scale, flow * torque);
            }
        }
    }
}

#[inline(always)]
fn bracket<T: Scalar, V: Simd<T>>([u_s, z_s, u_r, z_r]: [&[T]; 4], start: usize, end: usize) -> T {
    let mut sum = V::from_f64(0.0);
    let mut place = start;
    while place < end {
        let (u_s, z_s): (V, V) = (at(u_s, place), at(z_s, place));
        let (u_r, z_r): (V, V) = (at(u_r, place), at(z_r, place));
        sum = sum.plus_product(z_s, u_r).minus_product(u_s, z_r);
        place += V::LANES;
    }
    in_all_lanes::<T, V>(sum)
}

#[inline(always)]
fn product<T: Scalar, V: Simd<T>>(flow: &[T], torques: &[T]) -> T {
    let (mut sum, mut start) = (T::from_f64(0.0), 0);
    while start < flow.len() {
        let end = (start + TOGETHER).min(flow.len());
        let (mut part, mut place) = (V::from_f64(0.0), start);
        while place < end {
            part = part.plus_product(at(flow, place), at(torques, place));
            place += V::LANES;
        }
        sum = sum + in_all_lanes::<T, V>(part);
        start = end;
    }
    sum
}
