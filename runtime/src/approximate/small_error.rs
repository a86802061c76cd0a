//! Estimated error of a model of small differences, compared with the full model.

use alloc::vec;
use alloc::vec::Vec;

use crate::scalar::{Real, Scalar};
use crate::system::{DifferencePatterns, SmallDifferences};

/// Constants of the growth of the error with x − 1: its exponent, and the largest x − 1 for which
/// it is known. x is the energy of the in-phase motion divided by the energy that lifts the links
/// of the copies to the horizontal.
const GROWTH: f64 = 6.0;
const MOST_BEYOND: f64 = 0.5;

/// Constants of a model from which the error of [`NearlyInPhase`](super::NearlyInPhase) is
/// estimated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SmallError<T> {
    /// Smallest and largest squared angular frequency Ω² (1/s²) of a difference.
    slowest: T,
    fastest: T,
    /// Squared angular frequency Ω² (1/s²) of each difference.
    squares: Vec<T>,
    /// Energy (J) that lifts all links of the lightest sector from hanging to the horizontal.
    lift: T,
    /// Energy (J) of the tree with all links hanging.
    rest: T,
    /// Largest [`DifferencePatterns::unevenness`] of a sector.
    unevenness: T,
}

impl<T: Real> SmallError<T> {
    pub(super) fn new<P: SmallDifferences<T>>(model: &P, patterns: &DifferencePatterns) -> Self {
        let hanging = vec![T::ZERO; model.links()];
        let (mut squares, mut lift) = (Vec::new(), T::from_f64(f64::INFINITY));
        for &number in P::SMALL {
            let sector = P::TRANSVERSE[number];
            let still = vec![T::ZERO; sector.links];
            let mut stiffness = T::ZERO;
            for link in 0..sector.links {
                let mut unit = still.clone();
                unit[link] = T::ONE;
                let held = model.transverse_energy_of(number, &hanging, &unit, &still);
                let moving = model.transverse_energy_of(number, &hanging, &still, &unit);
                stiffness = stiffness + held + held;
                // Uses Ω = 1/s where the stiffness is zero or negative, so that a rate counts as
                // the angle it covers in one second.
                squares.push(Real::max(held / moving, T::ONE));
            }
            lift = Real::min(lift, T::from_f64(sector.holders as f64) * stiffness);
        }
        let none = vec![T::ZERO; squares.len()];
        let sectors = 0..P::SMALL.len();
        let uneven = sectors.map(|sector| patterns.unevenness(sector));
        Self {
            slowest: squares
                .iter()
                .copied()
                .fold(T::from_f64(f64::INFINITY), Real::min),
            fastest: squares.iter().copied().fold(T::ONE, Real::max),
            squares,
            lift: Real::max(lift, T::ZERO),
            rest: model.small_energy_of(&hanging, &hanging, &none, &none),
            unevenness: T::from_f64(uneven.fold(0.0, f64::max)),
        }
    }

    /// Returns the estimated error of an angle over one second, and the largest amplitude of an
    /// angle, both in rad, for a state of the whole tree.
    pub(super) fn estimate<P: SmallDifferences<T>>(
        &self,
        model: &P,
        patterns: &DifferencePatterns,
        state: &[T],
    ) -> [T; 2] {
        let small = patterns.to_small(state);
        if small.is_empty() {
            return [T::NAN; 2];
        }
        let (angles, rates) = small.split_at(patterns.half());
        let (theta, difference) = angles.split_at(model.links());
        let (omega, difference_rate) = rates.split_at(model.links());
        let differences = difference.iter().zip(difference_rate).zip(&self.squares);
        let parts =
            differences.map(|((&angle, &rate), &square)| angle * angle + rate * rate / square);
        let parts: Vec<T> = parts.collect();
        let small_square = parts.iter().fold(T::ZERO, |sum, &part| sum + part);
        let swing_square = sum_of_squares(theta) + sum_of_squares(omega) / self.slowest;
        let pace = omega
            .iter()
            .fold(T::ZERO, |most, &rate| Real::max(most, rate * rate));
        let none = vec![T::ZERO; difference.len()];
        let energy = model.small_energy_of(theta, omega, &none, &none) - self.rest;
        let beyond = Real::max(energy / self.lift - T::ONE, T::ZERO);
        let rate = Scalar::sqrt(self.fastest + pace);
        let even = T::from_f64(0.25) * rate * Scalar::sqrt(small_square) * small_square;
        let swing = Real::min(Scalar::sqrt(swing_square), T::ONE);
        let uneven = self.unevenness * small_square + within_others::<T, P>(&parts);
        let dropped = self.dropped(patterns, state, &small);
        let own = even + uneven * swing;
        let error = if beyond <= T::from_f64(MOST_BEYOND) {
            own * T::from_f64(core::f64::consts::E).powf(T::from_f64(GROWTH) * beyond) + dropped
        } else if own + dropped == T::ZERO {
            T::ZERO
        } else {
            // Copies that turn over may multiply differences by an unknown factor.
            T::from_f64(f64::INFINITY)
        };
        [error, Scalar::sqrt(small_square + swing_square)]
    }

    /// Returns the largest amplitude (rad) of the part of a link's angle that the patterns cannot
    /// represent.
    fn dropped(&self, patterns: &DifferencePatterns, state: &[T], small: &[T]) -> T {
        let (angles, rates) = small.split_at(patterns.half());
        let (whole_angles, whole_rates) = state.split_at(state.len() / 2);
        let links = whole_angles.iter().zip(whole_rates).enumerate();
        let largest = links.fold(T::ZERO, |largest, (link, (&angle, &rate))| {
            let turned = T::from_f64(patterns.angle(link));
            let angle = angle - turned - patterns.of_link(link, angles);
            let rate = rate - patterns.of_link(link, rates);
            Real::max(largest, angle * angle + rate * rate / self.slowest)
        });
        // A remainder below the rounding of the means counts as zero.
        let size = Scalar::sqrt(sum_of_squares(state));
        let rounding = T::from_f64(8.0) * T::EPSILON * size;
        let left = Scalar::sqrt(largest);
        if left <= rounding { T::ZERO } else { left }
    }
}

/// Returns 2 Σ B_s B_t over pairs of sectors s, t for which copies of t are attached within copies
/// of s. B are the amplitudes of their differences, which together drive differences of t that vary
/// between the copies of s. `parts` are the squared amplitudes of all differences.
fn within_others<T: Real, P: SmallDifferences<T>>(mut parts: &[T]) -> T {
    let mut amplitudes = Vec::with_capacity(P::SMALL.len());
    for &number in P::SMALL {
        let sector = P::TRANSVERSE[number];
        let (own, others) = parts.split_at(sector.links);
        let square = own.iter().fold(T::ZERO, |sum, &part| sum + part);
        amplitudes.push((sector, Scalar::sqrt(square)));
        parts = others;
    }
    let mut sum = T::ZERO;
    for (outer, of_outer) in &amplitudes {
        for (inner, of_inner) in &amplitudes {
            if outer.first < inner.first && inner.first < outer.first + outer.links {
                sum += T::from_f64(2.0) * *of_outer * *of_inner;
            }
        }
    }
    sum
}

fn sum_of_squares<T: Real>(values: &[T]) -> T {
    values
        .iter()
        .fold(T::ZERO, |sum, &value| sum + value * value)
}
