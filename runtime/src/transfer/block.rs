//! Block of the mass matrix and potential energy of a single sector.

use super::chords::Chords;
use super::constants::MassConstants;
use super::memory::FreeMemory;
use super::pattern::{Entries, MatrixPattern};
use super::shape::BlockShape;
use super::springs::SectorSprings;
use crate::scalar::{Scalar, at};

impl BlockShape {
    /// Writes the sector's block B_s = J_sᵀ M J_s of the mass matrix, where J_s contains the
    /// weights of the sector's coordinates.
    pub(super) fn write<T: Scalar>(
        &self,
        tree: &MatrixPattern,
        inertia: &[T],
        beside: &[T],
        block: &mut Entries<'_, T>,
    ) {
        let zero = T::from_f64(0.0);
        for (index, column) in self.columns.iter().enumerate() {
            let squares = column.iter();
            block.diagonal[index] = squares.fold(zero, |sum, (link, weight): (usize, T)| {
                sum + weight * weight * inertia[link]
            });
            for (step, (place, _)) in self.pattern.upwards(index).enumerate() {
                let squares = column.iter();
                // Within a sector, a link and its ancestors have the same weight.
                block.beside[place] = squares.fold(zero, |sum, (link, weight): (usize, T)| {
                    sum + weight * weight * beside[tree.entry_index(link, step)]
                });
            }
        }
    }

    /// Writes the angular velocities x = J_s B_s⁻¹ p_s that the sector's momenta p_s alone cause,
    /// for the sector's links; returns p_sᵀ B_s⁻¹ p_s.
    pub(super) fn write_velocities<T: Scalar>(
        &self,
        tree: &MatrixPattern,
        [inertia, beside]: [&[T]; 2],
        momenta: &[T],
        mut memory: FreeMemory<'_, T>,
        velocities: &mut [T],
    ) -> T {
        let rows = self.columns.len();
        let mut block = Entries {
            diagonal: memory.take(rows),
            beside: memory.take(self.pattern.entries()),
        };
        let solution = memory.take(rows);
        let own = &momenta[self.first..][..rows];
        self.write(tree, inertia, beside, &mut block);
        block.factor(&self.pattern);
        solution.copy_from_slice(own);
        block.solve(&self.pattern, solution);
        for (index, link, weight) in self.links() {
            let weight: T = weight;
            velocities[link] = weight * solution[index];
        }
        let pairs = own.iter().zip(&*solution);
        pairs.fold(T::from_f64(0.0), |sum, (&p, &u)| sum + p * u)
    }

    /// Writes the derivatives of the sector's potential energy V_s by the angles of its links
    /// (physics (9.3)); returns V_s.
    pub(super) fn write_potential_slopes<T: Scalar>(
        &self,
        constants: &MassConstants<T>,
        (springs, chords): (&SectorSprings<T>, &Chords<T>),
        parents: &[Option<usize>],
        theta: &[T],
        [sines, cosines]: [&[T]; 2],
        slopes: &mut [T],
    ) -> T {
        let (zero, half) = (T::from_f64(0.0), T::from_f64(0.5));
        for (_, link, _) in self.links::<T>() {
            slopes[link] = zero;
        }
        let mut energy = zero;
        for (coordinate, column) in (self.first..).zip(&self.columns) {
            let Some(&(first, _)) = column.weights.first() else {
                continue;
            };
            let share = T::from_f64(1.0) / T::from_f64(column.norm);
            let one = T::from_f64(if self.is_mean { 1.0 } else { 0.0 });
            let rise = column.sum(|link| one - cosines[link]);
            let sine = column.sum(|link| sines[link]);
            let weight = match chords.spring_term(coordinate) {
                Some(chord) => (constants.gravity[first] + chord) * share,
                None => constants.gravity[first] * share,
            };
            energy = energy + half * weight * (rise * rise + sine * sine);
            for (link, own) in column.iter() {
                let own: T = own;
                let slope = rise * sines[link] + sine * cosines[link];
                slopes[link] = slopes[link] + own * (weight * slope);
            }
            if self.is_mean
                && let Some(&lateral) = constants.lateral_gravity.get(first)
            {
                energy = energy + lateral * sine;
                for (link, own) in column.iter() {
                    let own: T = own;
                    slopes[link] = slopes[link] + own * (lateral * cosines[link]);
                }
            }
            let Some(&spring) = constants.spring.get(first) else {
                continue;
            };
            // Copies under one link differ only by their own angles.
            let above = |link: usize| match parents[link] {
                Some(parent) if column.is_below => theta[parent],
                _ => zero,
            };
            let rest = match self.is_mean {
                true => at(&constants.rest, first),
                false => zero,
            };
            let strain = column.sum(|link| theta[link] - above(link) - rest);
            let torque = spring * share * strain;
            energy = energy + half * torque * strain;
            for (link, own) in column.iter() {
                let own: T = own;
                slopes[link] = slopes[link] + own * torque;
                if let (true, Some(parent)) = (column.is_below, parents[link]) {
                    slopes[parent] = slopes[parent] - own * torque;
                }
            }
        }
        energy + springs.add_slopes(self, theta, slopes)
    }
}
