//! Between absolute angles and symmetric coordinates, in either normalisation.

use super::{Sector, SectorCoordinate};
use crate::scalar::Scalar;

/// The size of symmetric coordinates. With J the matrix of the
/// [`weights`](SectorCoordinate::weights), whose columns are orthogonal, and
/// norm_j = (JᵀJ)_jj ([`SectorCoordinate::norm`]):
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// Means and, between two copies, half differences, as in the paper:
    /// θ = J q, p = Jᵀ p_θ.
    Plain,
    /// The image of the angles under a rotation, Helmert's or Haar's: x_j =
    /// √norm_j q_j with momenta p_j/√norm_j. Squares sum, Σ x_j² = Σ θ_i², and
    /// kinetic energies of different sectors compare.
    Orthonormal,
}

/// StateKind of the transformed quantity: momenta go the other way than coordinates.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum StateKind {
    Coordinates,
    Momenta,
}

impl StateKind {
    /// Σ weight · absolute times this is the symmetric value.
    fn inward<T: Scalar>(self, norm: f64, normalisation: Normalisation) -> T {
        let one = T::from_f64(1.0);
        match (normalisation, self) {
            (Normalisation::Orthonormal, _) => one / T::from_f64(norm).sqrt(),
            (Normalisation::Plain, Self::Coordinates) => one / T::from_f64(norm),
            (Normalisation::Plain, Self::Momenta) => one,
        }
    }

    /// Weight · symmetric value times this is its part of the absolute value.
    fn outward<T: Scalar>(self, norm: f64, normalisation: Normalisation) -> T {
        let one = T::from_f64(1.0);
        match (normalisation, self) {
            (Normalisation::Orthonormal, _) => one / T::from_f64(norm).sqrt(),
            (Normalisation::Plain, Self::Coordinates) => one,
            (Normalisation::Plain, Self::Momenta) => one / T::from_f64(norm),
        }
    }
}

pub(crate) fn coordinates(sectors: &[Sector]) -> impl Iterator<Item = &SectorCoordinate> {
    sectors.iter().flat_map(Sector::coordinates)
}

/// Returns true if slices have one number for each coordinate; else fills the
/// second with NaN.
fn fits<T: Scalar>(sectors: &[Sector], from: usize, to: &mut [T]) -> bool {
    let count = coordinates(sectors).count();
    let fits = from == count && to.len() == count;
    if !fits {
        to.fill(T::from_f64(f64::NAN));
    }
    fits
}

pub(super) fn inward<T: Scalar>(
    sectors: &[Sector],
    kind: StateKind,
    normalisation: Normalisation,
    absolute: &[T],
    symmetric: &mut [T],
) {
    if !fits(sectors, absolute.len(), symmetric) {
        return;
    }
    for (out, coordinate) in symmetric.iter_mut().zip(coordinates(sectors)) {
        let zero = T::from_f64(0.0);
        // Differences are taken from the first link: those of equal numbers are zero exactly,
        // where sums of many would round.
        let is_difference = coordinate.weights().iter().map(|own| own.1).sum::<f64>() == 0.0;
        let first = coordinate.weights().first().filter(|_| is_difference);
        let origin = first.and_then(|(link, _)| absolute.get(*link));
        let origin = origin.copied().unwrap_or(zero);
        let mut sum = zero;
        for &(link, weight) in coordinate.weights() {
            if let Some(&value) = absolute.get(link) {
                sum = sum + T::from_f64(weight) * (value - origin);
            }
        }
        *out = kind.inward::<T>(coordinate.norm(), normalisation) * sum;
    }
}

pub(super) fn outward<T: Scalar>(
    sectors: &[Sector],
    kind: StateKind,
    normalisation: Normalisation,
    symmetric: &[T],
    absolute: &mut [T],
) {
    if !fits(sectors, symmetric.len(), absolute) {
        return;
    }
    absolute.fill(T::from_f64(0.0));
    for (&value, coordinate) in symmetric.iter().zip(coordinates(sectors)) {
        let value = kind.outward::<T>(coordinate.norm(), normalisation) * value;
        for &(link, weight) in coordinate.weights() {
            if let Some(out) = absolute.get_mut(link) {
                *out = *out + T::from_f64(weight) * value;
            }
        }
    }
}

pub(super) fn renormalise<T: Scalar>(
    sectors: &[Sector],
    kind: StateKind,
    [from, to]: [Normalisation; 2],
    values: &mut [T],
) {
    if from == to || !fits(sectors, values.len(), values) {
        return;
    }
    for (value, coordinate) in values.iter_mut().zip(coordinates(sectors)) {
        let root = T::from_f64(coordinate.norm()).sqrt();
        let grows = (to == Normalisation::Orthonormal) == (kind == StateKind::Coordinates);
        *value = if grows { *value * root } else { *value / root };
    }
}
