//! Conversion between absolute angles and symmetric coordinates, in either normalisation.

use super::{Sector, SectorCoordinate};
use crate::scalar::Scalar;

/// Normalisation of symmetric coordinates q. J is the matrix of their
/// [`weights`](SectorCoordinate::weights), whose columns are orthogonal, and norm_j = (JᵀJ)_jj is
/// [`SectorCoordinate::norm`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// Means, and half differences of two copies, as in the paper: angles θ = J q, momenta p = Jᵀ
    /// p_θ.
    Plain,
    /// Rotated angles, with Helmert's or Haar's basis: x_j = √norm_j q_j with momenta p_j/√norm_j.
    /// Squares are preserved, Σ x_j² = Σ θ_i², and kinetic energies of different sectors are
    /// comparable.
    Orthonormal,
}

/// Kind of the transformed quantity: coordinates or momenta, which transform with the inverse
/// factors.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum StateKind {
    Coordinates,
    Momenta,
}

impl StateKind {
    /// Returns the factor of Σ weight · absolute value in the symmetric value.
    fn inward<T: Scalar>(self, norm: f64, normalisation: Normalisation) -> T {
        let one = T::from_f64(1.0);
        match (normalisation, self) {
            (Normalisation::Orthonormal, _) => one / T::from_f64(norm).sqrt(),
            (Normalisation::Plain, Self::Coordinates) => one / T::from_f64(norm),
            (Normalisation::Plain, Self::Momenta) => one,
        }
    }

    /// Returns the factor of weight · symmetric value in the absolute value.
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

/// Returns true if both slices have one number per coordinate; otherwise fills `to` with NaN.
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
        // Differences are computed relative to the first link: those of equal numbers are then
        // exactly zero, whereas sums of many numbers would be rounded.
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
