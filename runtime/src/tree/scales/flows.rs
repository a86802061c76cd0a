//! The flow of one scale's energy, M u = ∂E/∂ω, and the slope z that it meets.

use super::columns::{CARRIED, FLOW, GAIN, OFFSET, PIVOT, SHIFT};
use super::{ByScale, ScaleEquations, field};
use crate::scalar::Scalar;
use crate::simd::Simd;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// From the leaves to the root: bias forces and offsets.
    #[inline(always)]
    pub(super) fn eliminate<V: Simd<T>>(&mut self, part: usize) {
        for generation in (0..self.end).rev() {
            let constants = self.constants::<V>(generation);
            let (own, below) = (self.shape.at(generation), self.shape.at(generation + 1));
            let (start, period) = self.part_start(part, generation);
            let (mut place, mut at) = (0, 0);
            while place < own.count {
                let slot = own.slot + place;
                let [x, y]: [V; 2] = self.columns.of_children(CARRIED, place, own.count, below);
                let [gain_x, gain_y, inverse]: [V; 3] = self.columns.read(GAIN, slot);
                let [moment_x, moment_y]: [V; 2] = self.part(field::MOMENT, start, at);
                let [omega]: [V; 1] = self.part(field::OMEGA, start, at);
                let link = self.columns.motion(slot);
                let given = [gain_x, gain_y, inverse, moment_x, moment_y, omega, x, y];
                let [x, y, offset] = E::scale_eliminate(&constants, link, given);
                self.columns.write(CARRIED, slot, [x, y]);
                self.columns.write(OFFSET, slot, [offset]);
                (place, at) = next::<T, V>(place, at, period);
            }
        }
    }

    /// From the root to the leaves: u, and what it changes in velocities. In the places
    /// of the first generation stands what is handed down from above.
    #[inline(always)]
    pub(super) fn flow<V: Simd<T>>(&mut self, scale: usize) {
        for generation in 0..self.end {
            let constants = self.constants::<V>(generation);
            let (own, above) = self.pair(generation);
            for copy in 0..own.count / above.count {
                let mut place = 0;
                while place < above.count {
                    let slot = own.slot + copy * above.count + place;
                    let above = above.slot + place;
                    let [x, y]: [V; 2] = self.columns.read(PIVOT, above);
                    let [shift_x, shift_y]: [V; 2] = self.columns.read(SHIFT + 2, above);
                    let [gain_x, gain_y]: [V; 2] = self.columns.read(GAIN, slot);
                    let [offset]: [V; 1] = self.columns.read(OFFSET, slot);
                    let link = self.columns.motion(slot);
                    let given = [gain_x, gain_y, offset, x, y, shift_x, shift_y];
                    let [flow, x, y, centre_x, centre_y, shift_x, shift_y] =
                        E::scale_flow(&constants, link, given);
                    self.columns.write(FLOW + 2 * scale, slot, [flow]);
                    self.columns.write(PIVOT, slot, [x, y]);
                    let shifts = [centre_x, centre_y, shift_x, shift_y];
                    self.columns.write(SHIFT, slot, shifts);
                    place += V::LANES;
                }
            }
        }
    }

    /// From the leaves to the root: slopes, with the momenta that the flow changes.
    #[inline(always)]
    pub(super) fn slopes<V: Simd<T>>(&mut self, part: usize, scale: usize) {
        let means = V::from_f64(if scale == 0 { 1.0 } else { 0.0 });
        for generation in (0..self.end).rev() {
            let constants = self.constants::<V>(generation);
            let (own, below) = (self.shape.at(generation), self.shape.at(generation + 1));
            let (start, period) = self.part_start(part, generation);
            let (mut place, mut at) = (0, 0);
            while place < own.count {
                let slot = own.slot + place;
                let [x, y]: [V; 2] = self.columns.read(SHIFT, slot);
                let [below_x, below_y]: [V; 2] =
                    self.columns.of_children(CARRIED, place, own.count, below);
                let link = self.columns.motion(slot);
                let given = [x, y, below_x, below_y];
                let [shift_x, shift_y, x, y] = E::scale_moment(&constants, link, given);
                self.columns.write(CARRIED, slot, [x, y]);
                let [moment_x, moment_y]: [V; 2] = self.part(field::MOMENT, start, at);
                let [rise, side]: [V; 2] = self.part(field::RISE, start, at);
                let [spring] = match E::SPRINGS {
                    true => self.part(field::SPRING, start, at),
                    false => [V::from_f64(0.0)],
                };
                let given = [
                    moment_x, moment_y, rise, side, spring, means, shift_x, shift_y,
                ];
                let slope = E::scale_slope(&constants, link, given);
                self.columns.write(FLOW + 2 * scale + 1, slot, slope);
                (place, at) = next::<T, V>(place, at, period);
            }
        }
    }
}

/// The next place, and the place of its part.
#[inline(always)]
fn next<T: Scalar, V: Simd<T>>(place: usize, part: usize, period: usize) -> (usize, usize) {
    let part = part + V::LANES;
    (
        place + V::LANES,
        if part >= period { part - period } else { part },
    )
}
