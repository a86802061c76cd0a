//! Sectors: sets of symmetric coordinates (means and differences of identical subtrees) that stay
//! zero if they start at zero.
//!
//! At an in-phase motion, in which all copies have equal angles, the mass matrix consists of
//! blocks: one for the means, and one for each branching and difference. The coordinates of a block
//! are a sector. Emitted code lists them ([`Sectors::sectors`]) and computes their energies and the
//! transfers between them ([`Budget`]). The functions of [`Sectors`] convert states between
//! absolute angles and symmetric coordinates, in either [`Normalisation`].

mod normalisation;
mod scales;

pub use normalisation::Normalisation;
use normalisation::{StateKind, inward, outward, renormalise};
pub use scales::{PowerKind, ScaleBudget, Scales, degrees_of_freedom};

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

use crate::scalar::Scalar;

/// A symmetric coordinate of a sector and its weights in the angles of the links: θ_link = Σ weight
/// · coordinate, summed over all coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorCoordinate {
    name: Cow<'static, str>,
    weights: Cow<'static, [(usize, f64)]>,
}

impl SectorCoordinate {
    /// Creates a coordinate from constant data, as in emitted code.
    #[must_use]
    pub const fn listed(name: &'static str, weights: &'static [(usize, f64)]) -> Self {
        Self {
            name: Cow::Borrowed(name),
            weights: Cow::Borrowed(weights),
        }
    }

    /// Creates a coordinate from the index and the weight of each link that it contributes to.
    #[must_use]
    pub const fn new(name: String, weights: Vec<(usize, f64)>) -> Self {
        Self {
            name: Cow::Owned(name),
            weights: Cow::Owned(weights),
        }
    }

    /// Returns the name, as in [`COORDINATE_NAMES`](crate::SymmetricPendulum::COORDINATE_NAMES).
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the index and the weight of each link that the coordinate contributes to.
    #[must_use]
    pub fn weights(&self) -> &[(usize, f64)] {
        &self.weights
    }

    /// Returns Σ weight², the square of the factor by which the orthonormal coordinate is larger
    /// than this one. The orthonormal coordinate is √norm · coordinate, and its momentum is that of
    /// the coordinate divided by √norm; for the difference of two links the norm is 2. [`Sectors`]
    /// converts states; see also `analysis::sector_modes`.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.weights.iter().map(|(_, weight)| weight * weight).sum()
    }

    /// Returns the mean or difference of the links' values: Σ weight · value / norm. Links that are
    /// missing in `values` count as zero.
    #[must_use]
    pub fn of(&self, values: &[f64]) -> f64 {
        let weighted = self.weights.iter().filter_map(|&(link, weight)| {
            let value = values.get(link)?;
            Some(weight * value)
        });
        weighted.sum::<f64>() / self.norm()
    }
}

/// A sector: the symmetric coordinates of one block of the mass matrix at an in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Sector {
    name: Cow<'static, str>,
    coordinates: Cow<'static, [SectorCoordinate]>,
}

impl Sector {
    /// Creates a sector from constant data, as in emitted code.
    #[must_use]
    pub const fn listed(name: &'static str, coordinates: &'static [SectorCoordinate]) -> Self {
        Self {
            name: Cow::Borrowed(name),
            coordinates: Cow::Borrowed(coordinates),
        }
    }

    /// Creates a sector with the given coordinates.
    #[must_use]
    pub const fn new(name: String, coordinates: Vec<SectorCoordinate>) -> Self {
        Self {
            name: Cow::Owned(name),
            coordinates: Cow::Owned(coordinates),
        }
    }

    /// Returns the name of the sector: `in_phase` for the means, else the name of its uppermost
    /// difference.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the coordinates of the sector, from the root outwards.
    #[must_use]
    pub fn coordinates(&self) -> &[SectorCoordinate] {
        &self.coordinates
    }
}

/// A model whose sectors are known.
///
/// The functions transform states, for any scalar. All slices have one number per link; for slices
/// of a wrong length the results are NaN. The cost is proportional to the number of weights, O(n ·
/// depth · copies) for n links.
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
    /// Returns the sectors: first the means, then the differences; the differences at a branching
    /// come before those at the branchings below it. Together they have as many coordinates as
    /// there are links. In sequence these are the symmetric coordinates in the order of
    /// [`COORDINATE_NAMES`](crate::SymmetricPendulum::COORDINATE_NAMES). Compiled models also have
    /// them as the constant `SECTORS`.
    fn sectors(&self) -> &[Sector];

    /// Computes symmetric coordinates from absolute angles, or their rates from angular velocities.
    fn symmetric_from_absolute<T: Scalar>(
        &self,
        normalisation: Normalisation,
        absolute: &[T],
        symmetric: &mut [T],
    ) {
        let kind = StateKind::Coordinates;
        inward(self.sectors(), kind, normalisation, absolute, symmetric);
    }

    /// Computes absolute angles from symmetric coordinates, or angular velocities from their rates.
    fn absolute_from_symmetric<T: Scalar>(
        &self,
        normalisation: Normalisation,
        symmetric: &[T],
        absolute: &mut [T],
    ) {
        let kind = StateKind::Coordinates;
        outward(self.sectors(), kind, normalisation, symmetric, absolute);
    }

    /// Computes the momenta p_j of the symmetric coordinates q_j from the momenta p_i of the
    /// absolute angles θ_i: p_j = Σ p_i ∂θ_i/∂q_j.
    fn symmetric_momenta_from_absolute<T: Scalar>(
        &self,
        normalisation: Normalisation,
        absolute: &[T],
        symmetric: &mut [T],
    ) {
        let kind = StateKind::Momenta;
        inward(self.sectors(), kind, normalisation, absolute, symmetric);
    }

    /// Computes the momenta of the absolute angles from the momenta of the symmetric coordinates.
    fn absolute_momenta_from_symmetric<T: Scalar>(
        &self,
        normalisation: Normalisation,
        symmetric: &[T],
        absolute: &mut [T],
    ) {
        let kind = StateKind::Momenta;
        outward(self.sectors(), kind, normalisation, symmetric, absolute);
    }

    /// Converts symmetric coordinates, or their rates, from one normalisation to another in place.
    fn renormalise<T: Scalar>(&self, from: Normalisation, to: Normalisation, values: &mut [T]) {
        renormalise(self.sectors(), StateKind::Coordinates, [from, to], values);
    }

    /// Converts momenta of symmetric coordinates from one normalisation to another in place.
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

/// Energies E of `S` sectors and their rates of change: dE/dt = transfer + power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget<T, const S: usize> {
    /// Energies E_s, in J.
    pub energies: [T; S],
    /// Energy transfers W_s from all other sectors into each sector, in W.
    pub transfers: [T; S],
    /// Powers P_s of friction and drive on each sector, in W; negative if they remove energy.
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
