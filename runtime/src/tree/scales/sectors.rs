//! Energies of single sectors, computed from parts of copies with Helmert's differences.

use super::{ByScale, ScaleEquations, ScaleOutput, field};
use crate::scalar::Scalar;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    pub(super) fn sectors(&mut self) {
        let mut first = 0;
        for scale in 0..self.shape.count() {
            let own = self.shape.at(scale);
            let parents = own.count / own.copies.max(1);
            let differences = match scale {
                0 => 1,
                _ => own.copies.saturating_sub(1),
            };
            for parent in 0..parents {
                for difference in 0..differences {
                    let energy = self.sector(scale, parent, difference + 1);
                    self.put(first + parent * differences + difference, energy);
                }
            }
            first += parents * differences;
        }
        if let ScaleOutput::Sectors(energies) = &mut self.wanted
            && energies.len() != first
        {
            energies.fill(T::from_f64(f64::NAN));
        }
    }

    fn put(&mut self, index: usize, energy: T) {
        if let ScaleOutput::Sectors(energies) = &mut self.wanted
            && let Some(place) = energies.get_mut(index)
        {
            *place = energy;
        }
    }

    /// Returns the energy of the sector of one difference between the copies under a parent, or of
    /// the means.
    fn sector(&self, scale: usize, parent: usize, difference: usize) -> T {
        let zero = T::from_f64(0.0);
        let (own, mut energy) = (self.shape.at(scale), zero);
        let parents = own.count / own.copies.max(1);
        // The weights are 1 for the first copies and −r for the next one.
        let next = T::from_f64(difference as f64);
        let norm = (next * (next + T::from_f64(1.0))).sqrt();
        for generation in scale..self.shape.count() {
            let start = Some(self.shape.part(scale, generation));
            let mut parts: [T; 6] = match scale {
                0 => self.part(field::VELOCITY, start, 0),
                _ => [zero; 6],
            };
            if scale > 0 {
                for copy in 0..=difference {
                    let of_copy: [T; 6] =
                        self.part(field::VELOCITY, start, copy * parents + parent);
                    for (sum, part) in parts.iter_mut().zip(of_copy) {
                        *sum = match copy < difference {
                            true => *sum + part,
                            false => (*sum - next * part) / norm,
                        };
                    }
                }
            }
            let each = (self.shape.at(generation).count / own.count) as f64;
            energy = energy + T::from_f64(each) * self.energy_of_parts(scale, generation, parts);
        }
        energy
    }
}
