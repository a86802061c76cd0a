//! A state of a tree with copies, and the quantities computed from it.

use super::constants::MassConstants;
use super::memory::FreeMemory;
use super::pattern::{Entries, MatrixPattern, multiply, write_slopes};
use super::{StateInput, SymmetricTree};
use crate::scalar::{Scalar, at};
use crate::sectors::{Normalisation, Sectors};

/// Angles of the links, their sines and cosines, velocities and momenta.
pub(super) struct TreeMotion<'w, T> {
    pub(super) theta: &'w [T],
    pub(super) omega: &'w [T],
    pub(super) sines: &'w [T],
    pub(super) cosines: &'w [T],
    /// Momenta of the symmetric coordinates.
    pub(super) momenta: &'w [T],
    /// Entries of the mass matrix of the tree.
    pub(super) matrix: MassEntries<'w, T>,
}

/// Off-diagonal entries M_ij of a mass matrix, and their derivatives by the angle θ_i of their row.
#[derive(Clone, Copy)]
pub(super) struct MassEntries<'w, T> {
    pub(super) beside: &'w [T],
    pub(super) slopes: &'w [T],
}

/// Derivatives of the kinetic energy K (at fixed velocities) and of the potential energy U by the
/// angles of the links.
pub(super) struct SlopesOfEnergies<'w, T> {
    pub(super) kinetic: &'w [T],
    pub(super) potential: &'w [T],
}

/// Returns the length of the workspace, in numbers, for a state of `links` links whose mass matrix
/// has `entries` off-diagonal entries.
pub(super) fn workspace_len(links: usize, entries: usize) -> usize {
    6 * links + 2 * entries
}

/// Returns the length of the workspace, in numbers, for the factorisation of a mass matrix.
pub(super) fn factors(links: usize, entries: usize) -> usize {
    links + entries
}

impl<T: Scalar> SymmetricTree<T> {
    /// Computes angles, velocities, momenta and the mass matrix of a state; `None` if a slice does
    /// not have one number per link.
    #[inline]
    pub(super) fn motion<'w>(
        &self,
        given: StateInput<'_, T>,
        memory: &mut FreeMemory<'w, T>,
    ) -> Option<TreeMotion<'w, T>> {
        let (shape, plain) = (&*self.shape, Normalisation::Plain);
        let links = shape.links();
        if given.lengths() != [links; 2] {
            return None;
        }
        let [theta, omega, momenta] = [(); 3].map(|()| memory.take(links));
        match given {
            StateInput::Absolute { theta: own, .. } => theta.copy_from_slice(own),
            StateInput::Rates { coordinates, .. } | StateInput::Momenta { coordinates, .. } => {
                self.absolute_from_symmetric(plain, coordinates, theta);
            }
        }
        let [sines, cosines] = [(); 2].map(|()| memory.take(links));
        write_turns(theta, sines, cosines);
        let matrix = self.matrix(&self.whole, [sines, cosines], memory);
        let absolute = memory.take(links);
        match given {
            StateInput::Momenta { momenta: own, .. } => {
                momenta.copy_from_slice(own);
                self.absolute_momenta_from_symmetric(plain, own, omega);
                self.solve(&self.whole, matrix, omega, memory.lend());
            }
            StateInput::Absolute { omega: own, .. } => omega.copy_from_slice(own),
            StateInput::Rates { rates, .. } => self.absolute_from_symmetric(plain, rates, omega),
        }
        if !matches!(given, StateInput::Momenta { .. }) {
            let (pattern, inertia) = (&shape.pattern, &self.whole.inertia);
            multiply(pattern, inertia, matrix.beside, omega, absolute);
            self.symmetric_momenta_from_absolute(plain, absolute, momenta);
        }
        Some(TreeMotion {
            theta,
            omega,
            sines,
            cosines,
            momenta,
            matrix,
        })
    }

    /// Computes the off-diagonal entries of the mass matrix with these constants.
    #[inline]
    pub(super) fn matrix<'w>(
        &self,
        constants: &MassConstants<T>,
        [sines, cosines]: [&[T]; 2],
        memory: &mut FreeMemory<'w, T>,
    ) -> MassEntries<'w, T> {
        let pattern = &self.shape.pattern;
        let [beside, slopes] = [(); 2].map(|()| memory.take(pattern.entries()));
        for (place, row, column) in pattern.iter() {
            let cosine = cosines[row] * cosines[column] + sines[row] * sines[column];
            let sine = sines[row] * cosines[column] - cosines[row] * sines[column];
            let coupling = constants.coupling[place];
            let (mut entry, mut slope) = (coupling * cosine, -(coupling * sine));
            if let Some(&lateral) = constants.lateral_coupling.get(place) {
                (entry, slope) = (entry + lateral * sine, slope + lateral * cosine);
            }
            (beside[place], slopes[place]) = (entry, slope);
        }
        MassEntries { beside, slopes }
    }

    /// Solves a linear system with the mass matrix, in place: converts torques to accelerations, or
    /// momenta to velocities.
    #[inline]
    pub(super) fn solve(
        &self,
        constants: &MassConstants<T>,
        matrix: MassEntries<'_, T>,
        values: &mut [T],
        mut memory: FreeMemory<'_, T>,
    ) {
        let pattern = &self.shape.pattern;
        let mut factors = Entries {
            diagonal: memory.take(pattern.rows()),
            beside: memory.take(pattern.entries()),
        };
        factors.diagonal.copy_from_slice(&constants.inertia);
        factors.beside.copy_from_slice(matrix.beside);
        factors.factor(pattern);
        factors.solve(pattern, values);
    }

    /// Computes the derivatives of the kinetic and potential energies by the angles, for a tree
    /// with these constants.
    #[inline]
    pub(super) fn slopes<'w>(
        &self,
        constants: &MassConstants<T>,
        matrix: MassEntries<'_, T>,
        motion: &TreeMotion<'_, T>,
        memory: &mut FreeMemory<'w, T>,
    ) -> SlopesOfEnergies<'w, T> {
        let pattern = &self.shape.pattern;
        let [kinetic, potential] = [(); 2].map(|()| memory.take(pattern.rows()));
        write_kinetic_slopes(pattern, matrix.slopes, motion.omega, kinetic);
        self.write_potential_slopes(constants, motion, potential);
        SlopesOfEnergies { kinetic, potential }
    }

    /// Writes the derivatives ∂U/∂θ (N m) of the potential energy by the angles.
    fn write_potential_slopes(
        &self,
        constants: &MassConstants<T>,
        motion: &TreeMotion<'_, T>,
        slopes: &mut [T],
    ) {
        for (link, slope) in slopes.iter_mut().enumerate() {
            *slope = constants.gravity[link] * motion.sines[link];
            if let Some(&lateral) = constants.lateral_gravity.get(link) {
                *slope = *slope + lateral * motion.cosines[link];
            }
        }
        for (link, &spring) in constants.spring.iter().enumerate() {
            let torque = spring * self.strain(constants, motion.theta, link);
            slopes[link] = slopes[link] + torque;
            if let Some(parent) = self.shape.parents[link] {
                slopes[parent] = slopes[parent] - torque;
            }
        }
        if !self.springs.is_empty() {
            self.spring_dampers.add_spring_slopes(motion.theta, slopes);
        }
        let turns = [motion.sines, motion.cosines];
        self.chords.add_slopes(turns, slopes);
    }

    /// Writes the derivatives of the potential energy U minus the same derivatives for the mean
    /// tree. They are computed from the differences of the constants, without cancellation; a
    /// spring adds Δκ φ − κ̄ Δρ, with its strain φ.
    pub(super) fn write_potential_slope_mismatch(
        &self,
        [whole, mean, beyond]: [&MassConstants<T>; 3],
        motion: &TreeMotion<'_, T>,
        slopes: &mut [T],
    ) {
        for (link, slope) in slopes.iter_mut().enumerate() {
            *slope = beyond.gravity[link] * motion.sines[link];
            if let Some(&lateral) = beyond.lateral_gravity.get(link) {
                *slope = *slope + lateral * motion.cosines[link];
            }
        }
        for (link, &spring) in beyond.spring.iter().enumerate() {
            let strain = self.strain(whole, motion.theta, link);
            let torque = spring * strain - mean.spring[link] * beyond.rest[link];
            slopes[link] = slopes[link] + torque;
            if let Some(parent) = self.shape.parents[link] {
                slopes[parent] = slopes[parent] - torque;
            }
        }
    }

    /// Returns the strain θ − θ_parent − ρ (rad) of the spring in a link's pivot; ρ is its rest
    /// angle.
    #[inline(always)]
    fn strain(&self, constants: &MassConstants<T>, theta: &[T], link: usize) -> T {
        let own = match self.shape.parents[link] {
            Some(parent) => theta[link] - theta[parent],
            None => theta[link],
        };
        own - at(&constants.rest, link)
    }

    /// Computes the potential energy U.
    pub(super) fn potential_energy(&self, motion: &TreeMotion<'_, T>) -> T {
        let (constants, half) = (&self.whole, T::from_f64(0.5));
        let mut energy = T::from_f64(0.0);
        for (link, &gravity) in constants.gravity.iter().enumerate() {
            energy = energy + gravity * (T::from_f64(1.0) - motion.cosines[link]);
            if let Some(&lateral) = constants.lateral_gravity.get(link) {
                energy = energy + lateral * motion.sines[link];
            }
            if let Some(&spring) = constants.spring.get(link) {
                let strain = self.strain(constants, motion.theta, link);
                energy = energy + half * spring * strain * strain;
            }
        }
        if !self.springs.is_empty() {
            energy = energy + self.spring_dampers.energy(motion.theta);
        }
        energy + self.chords.energy([motion.sines, motion.cosines])
    }
}

/// Writes the sines and cosines of the angles, computed four at a time if possible.
#[inline(always)]
fn write_turns<T: Scalar>(theta: &[T], sines: &mut [T], cosines: &mut [T]) {
    let (fours, rest) = theta.as_chunks::<4>();
    let (four_sines, rest_sines) = sines.as_chunks_mut::<4>();
    let (four_cosines, rest_cosines) = cosines.as_chunks_mut::<4>();
    let all = fours.iter().zip(four_sines.iter_mut().zip(four_cosines));
    for (angles, (sines, cosines)) in all {
        (*sines, *cosines) = T::sin_cos_each(angles);
    }
    let one_by_one = |angles: &[T], sines: &mut [T], cosines: &mut [T]| {
        let all = angles.iter().zip(sines.iter_mut().zip(cosines));
        for (&angle, (sine, cosine)) in all {
            (*sine, *cosine) = angle.sin_cos();
        }
    };
    match (rest, rest_sines, rest_cosines) {
        (&[a, b, c], [s, t, u], [x, y, z]) => {
            ([*s, *t, *u], [*x, *y, *z]) = T::sin_cos_each(&[a, b, c]);
        }
        (angles, sines, cosines) => one_by_one(angles, sines, cosines),
    }
}

/// Writes ½ ωᵀ (∂M/∂θ_i) ω.
#[inline(always)]
pub(super) fn write_kinetic_slopes<T: Scalar>(
    pattern: &MatrixPattern,
    slopes: &[T],
    omega: &[T],
    result: &mut [T],
) {
    write_slopes(pattern, slopes, [omega, omega], result);
    let half = T::from_f64(0.5);
    for slope in result {
        *slope = half * *slope;
    }
}
