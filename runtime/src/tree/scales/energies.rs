//! Energies of all scales, computed generation by generation.

use super::{ByScale, ScaleEquations, ScaleOutput, field};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::sum::Sum;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    #[inline(always)]
    pub(super) fn energies<V: Simd<T>>(&mut self) {
        for generation in 0..self.shape.count() {
            let count = self.shape.at(generation).count;
            for scale in 0..=generation {
                let values = self.shape.values(scale);
                let start = Some(self.shape.part(scale, generation));
                let mut sum = Sum::<V>::new();
                let mut place = 0;
                while place < values {
                    let energy = self.energy::<V>(scale, generation, start, place);
                    let left = values - place;
                    sum.add(energy.in_first_lanes(left, V::from_f64(0.0)));
                    place += V::LANES;
                }
                let each = T::from_f64((count / values) as f64);
                let energy = each * in_all_lanes::<T, V>(sum.total());
                if let ScaleOutput::Energies(budget) | ScaleOutput::Budget(budget) =
                    &mut self.wanted
                {
                    budget.set_energy(scale, generation, energy);
                }
            }
        }
    }

    /// Returns the energies, in one scale, of a register of links; `start` is the index of their
    /// parts in that scale.
    #[inline(always)]
    fn energy<V: Simd<T>>(
        &self,
        scale: usize,
        generation: usize,
        start: Option<usize>,
        place: usize,
    ) -> V {
        let [x, y, omega, rise, side, strain] = self.part(field::VELOCITY, start, place);
        let parts = [x, y, omega, rise, side, strain];
        self.energy_of_parts(scale, generation, parts)
    }

    /// Returns the energies of a register of links, computed from their parts in one scale.
    #[inline(always)]
    pub(super) fn energy_of_parts<V: Simd<T>>(
        &self,
        scale: usize,
        generation: usize,
        [x, y, omega, rise, side, strain]: [V; 6],
    ) -> V {
        let constants = self.constants::<V>(generation);
        let means = V::from_f64(if scale == 0 { 1.0 } else { 0.0 });
        let given = [x, y, omega, rise, side, strain, means];
        let [energy] = E::scale_energy(&constants, self.columns.motion(0), given);
        energy
    }
}

/// Returns the sum of the numbers in all lanes.
#[inline(always)]
pub(super) fn in_all_lanes<T: Scalar, V: Simd<T>>(value: V) -> T {
    let mut sum = value.first();
    for lane in 1..V::LANES {
        sum = sum + value.rotate_lanes(lane).first();
    }
    sum
}
