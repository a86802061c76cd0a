//! Computation of the flow u of a scale's energy E, which is defined by M u = ∂E/∂ω, and of the
//! derivative z of the energy along the flow.

use super::blocks::Layers;
use super::columns::{BIAS, GAIN, OFFSET, PIVOT, SHIFT, ScaleColumns};
use super::{ByScale, ScaleEquations, field};
use crate::scalar::Scalar;
use crate::simd::Simd;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Makes an upward pass that computes bias forces and offsets.
    #[inline(always)]
    pub(super) fn eliminate<V: Simd<T>>(
        &self,
        piece: &Layers<'_>,
        columns: &mut ScaleColumns<'_, T>,
        scale: usize,
    ) {
        for generation in (0..piece.count).rev() {
            let constants = self.constants::<V>(piece.first + generation);
            let (own, below) = (piece.own.at(generation), piece.own.at(generation + 1));
            let (start, period) = self.part_start(scale, piece.first + generation);
            let mut places = piece.upwards(&self.shape, generation, period);
            while let Some(at) = places.next(V::LANES) {
                let slot = own.slot + at.number;
                let [x, y]: [V; 2] = columns.of_children(BIAS, at.number, own.count, below);
                let [gain_x, gain_y, inverse]: [V; 3] = self.columns.read(GAIN, at.slot);
                let [moment_x, moment_y]: [V; 2] = self.part(field::MOMENT, start, at.part);
                let [omega]: [V; 1] = self.part(field::OMEGA, start, at.part);
                let link = self.columns.motion(at.slot);
                let given = [gain_x, gain_y, inverse, moment_x, moment_y, omega, x, y];
                let [x, y, offset] = E::scale_eliminate(&constants, link, given);
                columns.write(BIAS, slot, [x, y, offset]);
            }
        }
    }

    /// Makes a downward pass that computes the flow u and the changes of velocities along it. The
    /// first generation of a block holds the numbers passed from above; the root's pivot does not
    /// move.
    #[inline(always)]
    pub(super) fn flow<V: Simd<T>>(
        &self,
        piece: &Layers<'_>,
        columns: &mut ScaleColumns<'_, T>,
        flows: &mut ScaleColumns<'_, T>,
        scale: usize,
    ) {
        let zero = V::from_f64(0.0);
        for generation in 0..piece.count {
            let constants = self.constants::<V>(piece.first + generation);
            let own = piece.own.at(generation);
            let above = piece.own.at(generation.saturating_sub(1));
            let mut places = piece.downwards(&self.shape, generation);
            while let Some(at) = places.next(V::LANES) {
                let slot = own.slot + at.number;
                let above = above.slot + at.parent;
                let ([x, y], [shift_x, shift_y]) = match piece.first + generation {
                    0 => ([zero; 2], [zero; 2]),
                    _ => (columns.read(PIVOT, above), columns.read(SHIFT + 2, above)),
                };
                let [gain_x, gain_y]: [V; 2] = self.columns.read(GAIN, at.slot);
                let [offset]: [V; 1] = columns.read(OFFSET, slot);
                let link = self.columns.motion(at.slot);
                let given = [gain_x, gain_y, offset, x, y, shift_x, shift_y];
                let [flow, x, y, shifts @ ..] = E::scale_flow(&constants, link, given);
                flows.write(2 * scale, slot, [flow]);
                columns.write(PIVOT, slot, [x, y]);
                columns.write::<V, 4>(SHIFT, slot, shifts);
            }
        }
    }

    /// Makes an upward pass that computes the derivatives z of the energy, including the changes of
    /// momenta along the flow.
    #[inline(always)]
    pub(super) fn slopes<V: Simd<T>>(
        &self,
        piece: &Layers<'_>,
        columns: &mut ScaleColumns<'_, T>,
        flows: &mut ScaleColumns<'_, T>,
        scale: usize,
    ) {
        let means = V::from_f64(if scale == 0 { 1.0 } else { 0.0 });
        for generation in (0..piece.count).rev() {
            let constants = self.constants::<V>(piece.first + generation);
            let (own, below) = (piece.own.at(generation), piece.own.at(generation + 1));
            let (start, period) = self.part_start(scale, piece.first + generation);
            let mut places = piece.upwards(&self.shape, generation, period);
            while let Some(at) = places.next(V::LANES) {
                let slot = own.slot + at.number;
                let [x, y]: [V; 2] = columns.read(SHIFT, slot);
                let [below_x, below_y]: [V; 2] =
                    columns.of_children(BIAS, at.number, own.count, below);
                let link = self.columns.motion(at.slot);
                let given = [x, y, below_x, below_y];
                let [shift_x, shift_y, x, y] = E::scale_moment(&constants, link, given);
                columns.write(BIAS, slot, [x, y]);
                let [moment_x, moment_y]: [V; 2] = self.part(field::MOMENT, start, at.part);
                let [rise, side]: [V; 2] = self.part(field::RISE, start, at.part);
                let [spring] = match E::SPRINGS {
                    true => self.part(field::SPRING, start, at.part),
                    false => [V::from_f64(0.0)],
                };
                let given = [
                    moment_x, moment_y, rise, side, spring, means, shift_x, shift_y,
                ];
                let slope = E::scale_slope(&constants, link, given);
                flows.write(2 * scale + 1, slot, slope);
            }
        }
    }
}
