//! Sectors: what identical subtrees do in phase and against each other.
//!
//! At the in-phase motion, where all copies move alike, the mass matrix falls
//! into blocks: one for the means and one for each branching and difference. The
//! coordinates of a block are a sector. Emitted code lists them
//! ([`Sectors::sectors`]) and reports their energies and the transfers between
//! them ([`Budget`]). States come from absolute angles into symmetric coordinates
//! and back by the functions of [`Sectors`], in either [`Normalisation`].

mod normalisation;
mod scales;

pub use normalisation::Normalisation;
use normalisation::{StateKind, inward, outward, renormalise};
pub(crate) use scales::PowerKind;
pub use scales::{ScaleBudget, Scales, degrees_of_freedom};

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

use crate::scalar::Scalar;

/// A coordinate of a sector, in terms of the links: θ_link = Σ weight ·
/// coordinate over all coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorCoordinate {
    name: Cow<'static, str>,
    weights: Cow<'static, [(usize, f64)]>,
}

impl SectorCoordinate {
    /// A coordinate that is written down in code.
    #[must_use]
    pub const fn listed(name: &'static str, weights: &'static [(usize, f64)]) -> Self {
        Self {
            name: Cow::Borrowed(name),
            weights: Cow::Borrowed(weights),
        }
    }

    /// A coordinate with the index and the weight of each link in which it shows.
    #[must_use]
    pub const fn new(name: String, weights: Vec<(usize, f64)>) -> Self {
        Self {
            name: Cow::Owned(name),
            weights: Cow::Owned(weights),
        }
    }

    /// Name, as in [`COORDINATE_NAMES`](crate::SymmetricPendulum::COORDINATE_NAMES).
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Index and weight of each link in which it shows.
    #[must_use]
    pub fn weights(&self) -> &[(usize, f64)] {
        &self.weights
    }

    /// Σ weight²: the square of the factor that turns the coordinate into the
    /// orthonormal one. The orthonormal coordinate is √norm · coordinate, its
    /// momentum that of the coordinate divided by √norm; for the difference of
    /// two links the norm is 2. [`Sectors`] converts states;
    /// `analysis::sector_modes` says more.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.weights.iter().map(|(_, weight)| weight * weight).sum()
    }

    /// Mean or difference of the links' values: Σ weight · value / norm.
    /// Links that `values` lacks count as zero.
    #[must_use]
    pub fn of(&self, values: &[f64]) -> f64 {
        let weighted = self.weights.iter().filter_map(|&(link, weight)| {
            let value = values.get(link)?;
            Some(weight * value)
        });
        weighted.sum::<f64>() / self.norm()
    }
}

/// The coordinates of one block.
#[derive(Clone, Debug, PartialEq)]
pub struct Sector {
    name: Cow<'static, str>,
    coordinates: Cow<'static, [SectorCoordinate]>,
}

impl Sector {
    /// A sector that is written down in code.
    #[must_use]
    pub const fn listed(name: &'static str, coordinates: &'static [SectorCoordinate]) -> Self {
        Self {
            name: Cow::Borrowed(name),
            coordinates: Cow::Borrowed(coordinates),
        }
    }

    /// A sector of these coordinates.
    #[must_use]
    pub const fn new(name: String, coordinates: Vec<SectorCoordinate>) -> Self {
        Self {
            name: Cow::Owned(name),
            coordinates: Cow::Owned(coordinates),
        }
    }

    /// `in_phase` for the means, else the name of the uppermost difference.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Coordinates of the sector, from the root outwards.
    #[must_use]
    pub fn coordinates(&self) -> &[SectorCoordinate] {
        &self.coordinates
    }
}

/// A model whose sectors are known.
///
/// The functions transform states, for any scalar. All slices have one number
/// for each link; a slice of another length is answered with NaN. Effort: the
/// number of weights, O(n · depth · copies) for n links.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::sectors::{Normalisation, Sectors};
/// use branched_pendulum::branched_pendulum;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     emit(momenta, budget(canonical)),
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::<f64>::new();
/// let theta = [0.1, 0.5, 0.3];
/// let (mut plain, mut orthonormal) = ([0.0_f64; 3], [0.0_f64; 3]);
/// model.symmetric_from_absolute(Normalisation::Plain, &theta, &mut plain);
/// model.symmetric_from_absolute(Normalisation::Orthonormal, &theta, &mut orthonormal);
/// // The paper's θ_m = (θ_2 + θ_3)/2 and θ_d = (θ_2 − θ_3)/2 ...
/// assert!((plain[1] - 0.4).abs() < 1e-15 && (plain[2] - 0.1).abs() < 1e-15);
/// // ... and a rotation of the angles.
/// assert!((orthonormal[2] - (0.5 - 0.3) / 2.0_f64.sqrt()).abs() < 1e-15);
/// let square = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
/// assert!((square(&orthonormal) - square(&theta)).abs() < 1e-15);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know its sectors",
    note = "a tree with identical siblings knows them with `emit(budget)` in its attribute"
)]
pub trait Sectors {
    /// The sectors: the means, then the differences, those of a branching before
    /// those of the branchings below it.
    /// Together they have as many coordinates as there are links; one after the
    /// other they are the symmetric coordinates, in the order of
    /// [`COORDINATE_NAMES`](crate::SymmetricPendulum::COORDINATE_NAMES). Compiled models have them
    /// as the constant `SECTORS` besides.
    fn sectors(&self) -> &[Sector];

    /// Symmetric coordinates from absolute angles, or their rates from angular
    /// velocities.
    fn symmetric_from_absolute<T: Scalar>(
        &self,
        normalisation: Normalisation,
        absolute: &[T],
        symmetric: &mut [T],
    ) {
        let kind = StateKind::Coordinates;
        inward(self.sectors(), kind, normalisation, absolute, symmetric);
    }

    /// Absolute angles from symmetric coordinates, or angular velocities from
    /// their rates.
    fn absolute_from_symmetric<T: Scalar>(
        &self,
        normalisation: Normalisation,
        symmetric: &[T],
        absolute: &mut [T],
    ) {
        let kind = StateKind::Coordinates;
        outward(self.sectors(), kind, normalisation, symmetric, absolute);
    }

    /// Momenta of symmetric coordinates from those of the absolute angles: p_j =
    /// Σ p_i ∂θ_i/∂q_j.
    fn symmetric_momenta_from_absolute<T: Scalar>(
        &self,
        normalisation: Normalisation,
        absolute: &[T],
        symmetric: &mut [T],
    ) {
        let kind = StateKind::Momenta;
        inward(self.sectors(), kind, normalisation, absolute, symmetric);
    }

    /// Momenta of the absolute angles from those of symmetric coordinates.
    fn absolute_momenta_from_symmetric<T: Scalar>(
        &self,
        normalisation: Normalisation,
        symmetric: &[T],
        absolute: &mut [T],
    ) {
        let kind = StateKind::Momenta;
        outward(self.sectors(), kind, normalisation, symmetric, absolute);
    }

    /// Symmetric coordinates or their rates, from one normalisation to another
    /// in place.
    fn renormalise<T: Scalar>(&self, from: Normalisation, to: Normalisation, values: &mut [T]) {
        renormalise(self.sectors(), StateKind::Coordinates, [from, to], values);
    }

    /// Momenta of symmetric coordinates, from one normalisation to another in
    /// place.
    fn renormalise_momenta<T: Scalar>(
        &self,
        from: Normalisation,
        to: Normalisation,
        values: &mut [T],
    ) {
        renormalise(self.sectors(), StateKind::Momenta, [from, to], values);
    }
}

impl<M: Sectors> Sectors for &M {
    fn sectors(&self) -> &[Sector] {
        (**self).sectors()
    }
}

/// Energies of `S` sectors and what changes them: dE/dt = transfer + power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget<T, const S: usize> {
    /// E_s, in joules.
    pub energies: [T; S],
    /// W_s, what other sectors give, in watts.
    pub transfers: [T; S],
    /// P_s, what friction and drive give, in watts; negative where they take.
    pub powers: [T; S],
}

#[cfg(test)]
mod tests {
    use super::SectorCoordinate;

    #[test]
    fn norm_and_value_of_a_second_difference() {
        let difference = SectorCoordinate::listed("theta_d2", &[(1, 1.0), (2, 1.0), (3, -2.0)]);
        assert_eq!(difference.norm(), 6.0);
        assert_eq!(difference.of(&[9.0, 1.0, 1.0, 1.0]), 0.0);
        assert_eq!(difference.of(&[0.0, 1.0, 1.0, -2.0]), 1.0);
    }
}
