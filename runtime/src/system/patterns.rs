//! Patterns in which the copies of the whole tree differ, for models whose copies move in phase.

use alloc::vec;
use alloc::vec::Vec;

use super::{SmallDifferences, TransverseSector, WholeTree};
use crate::errors::errors;
use crate::scalar::{Real, Scalar};

/// Weights e with which the differences δ of a [`SmallDifferences`] model enter the angles θ + e δ
/// of the copies in the whole tree.
///
/// A *holder* is a link under which such copies hang. Two copies have the weights ±1 if there is
/// one holder, and ±1/√holders, the same under each, if several holders move in phase. Other
/// patterns, for more than two copies or for holders that differ, are given to
/// [`chosen`](Self::chosen).
///
/// ```
/// # #[cfg(feature = "macros")] {
/// use branched_pendulum::branched_pendulum;
/// use branched_pendulum::system::DifferencePatterns;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     stem: rod(mass = 0.2, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2],
///     in_phase(twig),
///     emit(small),
/// )]
/// struct Branch;
///
/// let patterns = DifferencePatterns::of::<f64, _>(&Branch::new(), Branch::WHOLE).unwrap();
/// // Angles and velocities of the whole tree; then mean angles, the difference, their rates.
/// let small = patterns.to_small(&[0.125, 0.5, 0.25, 0.0, 2.0, 1.0]);
/// assert_eq!(small, [0.125, 0.375, 0.125, 0.0, 1.5, 0.5]);
/// assert_eq!(patterns.to_whole(&small), [0.125, 0.5, 0.25, 0.0, 2.0, 1.0]);
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DifferencePatterns {
    links: usize,
    /// For each link of the whole tree: the index of the model's link whose angle it follows, and
    /// the constant angle (rad) between the two.
    places: Vec<(usize, f64)>,
    /// For each link of the model, 1 over the number of links of the whole tree that follow it.
    shares: Vec<f64>,
    patterns: Vec<CopyWeights>,
}

/// Weights of the copies in one sector's differences.
#[derive(Clone, Debug, PartialEq)]
struct CopyWeights {
    sector: TransverseSector,
    /// Weight of each link of the whole tree; zero for links that are not part of the sector.
    weights: Vec<f64>,
}

errors! {
    /// Reason why weights do not form a pattern of differences.
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum PatternError {
        /// The model has no sector of that name whose differences act back on the motion.
        Sector => "no sector with this name acts back on the in-phase motion",
        /// The number of weights is not the number of copies of the sector in the whole tree.
        Length {
            /// Number of copies under all holders together.
            expected: usize,
            /// Number of weights given.
            found: usize,
        } => "got {found} weights for {expected} copies: the numbers must be equal",
        /// The weights are all zero, not finite, or do not add up to zero under each holder.
        Weights => "weights must be finite, not all zero, and their sum under each parent link \
            must be zero",
        /// There are more than two copies, so that the caller must choose weights.
        Choice {
            /// Name of the sector.
            sector: &'static str,
        } => "sector `{sector}` has more than two copies: choose their weights by `chosen`",
    }
}

impl core::error::Error for PatternError {}

impl DifferencePatterns {
    /// Returns the patterns of a model whose sectors all have two copies, for its whole tree.
    ///
    /// # Errors
    ///
    /// [`PatternError::Choice`] for more than two copies.
    pub fn of<T: Scalar, P: SmallDifferences<T>>(
        model: &P,
        tree: WholeTree,
    ) -> Result<Self, PatternError> {
        Self::chosen(model, tree, &[])
    }

    /// Creates patterns with the given weights. Each entry is the name of a sector with the weights
    /// of its copies in the order of the whole tree: the copies under the first holder (the link
    /// that carries them), then those under the next. The weights are scaled so that their squares
    /// add up to the number of copies under one holder.
    ///
    /// # Errors
    ///
    /// [`PatternError`] for invalid weights, and for a sector of more than two copies without
    /// weights.
    pub fn chosen<T: Scalar, P: SmallDifferences<T>>(
        model: &P,
        tree: WholeTree,
        weights: &[(&str, &[f64])],
    ) -> Result<Self, PatternError> {
        let links = model.links();
        let mut places = Vec::with_capacity(tree.links());
        tree.for_each(|link, angle| places.push((link, angle)));
        let mut counts = vec![0; links];
        tree.counts(&mut counts);
        let sectors: Vec<TransverseSector> =
            P::SMALL.iter().map(|&index| P::TRANSVERSE[index]).collect();
        let unknown =
            |(name, _): &(&str, &[f64])| sectors.iter().all(|sector| sector.name != *name);
        if weights.iter().any(unknown) {
            return Err(PatternError::Sector);
        }
        let pattern = |&sector: &TransverseSector| {
            let given = weights.iter().find(|(name, _)| *name == sector.name);
            let copies = match given {
                Some((_, weights)) => normalised(&sector, weights.to_vec())?,
                None if sector.copies == 2 => {
                    let alike = [1.0, -1.0].into_iter().cycle();
                    normalised(&sector, alike.take(2 * sector.holders).collect())?
                }
                None => {
                    return Err(PatternError::Choice {
                        sector: sector.name,
                    });
                }
            };
            let mut met = vec![0; links];
            let weight = |&(link, _): &(usize, f64)| {
                if !(sector.first..sector.first + sector.links).contains(&link) {
                    return 0.0;
                }
                // Copies follow each other, each with the same number of links of a kind.
                let copy = met[link] * copies.len() / counts[link];
                met[link] += 1;
                copies[copy]
            };
            Ok(CopyWeights {
                sector,
                weights: places.iter().map(weight).collect(),
            })
        };
        let patterns: Result<Vec<CopyWeights>, PatternError> =
            sectors.iter().map(pattern).collect();
        Ok(Self {
            links,
            patterns: patterns?,
            shares: counts.iter().map(|&count| 1.0 / count as f64).collect(),
            places,
        })
    }

    /// Returns the state of the model (angles, differences, then their rates) for a state of the
    /// whole tree (angles, then their rates). The model's angles are means over the copies, and its
    /// differences are projections on the patterns. Empty if the state has a wrong length.
    #[must_use]
    pub fn to_small<T: Scalar>(&self, whole: &[T]) -> Vec<T> {
        let mut small = vec![T::from_f64(0.0); 2 * self.half()];
        match self.small_into(whole, &mut small) {
            true => small,
            false => Vec::new(),
        }
    }

    /// Converts a state of the model to a state of the whole tree. Empty if the state has a wrong
    /// length.
    #[must_use]
    pub fn to_whole<T: Scalar>(&self, small: &[T]) -> Vec<T> {
        let mut whole = vec![T::from_f64(0.0); 2 * self.places.len()];
        match self.whole_into(small, &mut whole) {
            true => whole,
            false => Vec::new(),
        }
    }

    /// Returns the generalized torques (N m) on the model that do the same work as the torques on
    /// the links of the whole tree: for each in-phase angle their sum, then for each difference
    /// their sum weighted by the pattern. Empty if the number of torques is wrong.
    #[must_use]
    pub fn torques<T: Scalar>(&self, whole: &[T]) -> Vec<T> {
        let mut torques = vec![T::from_f64(0.0); self.half()];
        match self.torques_into(whole, &mut torques) {
            true => torques,
            false => Vec::new(),
        }
    }

    /// Converts torques (N m) on the whole tree to generalized torques on the model. If a length is
    /// wrong, it writes nothing and returns false.
    pub(crate) fn torques_into<T: Scalar>(&self, whole: &[T], torques: &mut [T]) -> bool {
        if whole.len() != self.places.len() || torques.len() != self.half() {
            return false;
        }
        torques.fill(T::from_f64(0.0));
        for (index, (&(link, _), &torque)) in self.places.iter().zip(whole).enumerate() {
            torques[link] = torques[link] + torque;
            let mut offset = self.links;
            for CopyWeights { sector, weights } in &self.patterns {
                if weights[index] != 0.0 {
                    let place = offset + link - sector.first;
                    torques[place] = torques[place] + torque * T::from_f64(weights[index]);
                }
                offset += sector.links;
            }
        }
        true
    }

    /// Returns true if the torques on the whole tree's links can be represented in the model: up to
    /// rounding, they differ between copies only in proportion to the patterns. `parts` is a buffer
    /// of [`half`](Self::half) numbers.
    pub(crate) fn take_torques<T: Real>(&self, whole: &[T], parts: &mut [T]) -> bool {
        if whole.len() != self.places.len() || parts.len() != self.half() {
            return false;
        }
        parts.fill(T::ZERO);
        self.project(|link, _| whole[link], parts);
        let links = || whole.iter().enumerate();
        let size = links().fold(T::ZERO, |size, (_, torque)| Real::max(size, torque.abs()));
        let rounding = T::from_f64(8.0) * T::EPSILON * size;
        links().all(|(link, &torque)| (torque - self.of_link(link, parts)).abs() <= rounding)
    }

    /// Returns the number of the model's coordinates: angles and differences.
    pub(crate) fn half(&self) -> usize {
        let differences = self.patterns.iter().map(|pattern| pattern.sector.links);
        self.links + differences.sum::<usize>()
    }

    /// Converts a state of the whole tree to a state of the model. If a length is wrong, it writes
    /// nothing and returns false.
    pub(crate) fn small_into<T: Scalar>(&self, whole: &[T], small: &mut [T]) -> bool {
        let (links, half) = (self.places.len(), self.half());
        if whole.len() != 2 * links || small.len() != 2 * half {
            return false;
        }
        small.fill(T::from_f64(0.0));
        let (angles, rates) = whole.split_at(links);
        let (small_angles, small_rates) = small.split_at_mut(half);
        self.project(
            |link, angle| angles[link] - T::from_f64(angle),
            small_angles,
        );
        self.project(|link, _| rates[link], small_rates);
        true
    }

    /// Adds the means and the differences of the values of the whole tree's links to `sums`.
    fn project<T: Scalar>(&self, value: impl Fn(usize, f64) -> T, sums: &mut [T]) {
        for (whole, &(link, angle)) in self.places.iter().enumerate() {
            let value = value(whole, angle);
            sums[link] = sums[link] + value * T::from_f64(self.shares[link]);
            let mut offset = self.links;
            for CopyWeights { sector, weights } in &self.patterns {
                if weights[whole] != 0.0 {
                    let place = offset + link - sector.first;
                    // The squared weights have the mean 1/holders.
                    let share = weights[whole] * sector.holders as f64 * self.shares[link];
                    sums[place] = sums[place] + value * T::from_f64(share);
                }
                offset += sector.links;
            }
        }
    }

    /// Converts a state of the model to a state of the whole tree. If a length is wrong, it writes
    /// nothing and returns false.
    pub(crate) fn whole_into<T: Scalar>(&self, small: &[T], whole: &mut [T]) -> bool {
        let (links, half) = (self.places.len(), self.half());
        if whole.len() != 2 * links || small.len() != 2 * half {
            return false;
        }
        let (angles, rates) = whole.split_at_mut(links);
        let (small_angles, small_rates) = small.split_at(half);
        for (whole, &(_, angle)) in self.places.iter().enumerate() {
            let own = self.of_link(whole, small_angles);
            angles[whole] = match angle == 0.0 {
                true => own,
                false => own + T::from_f64(angle),
            };
            rates[whole] = self.of_link(whole, small_rates);
        }
        true
    }

    /// Returns the value θ + Σ e δ of one link of the whole tree, from the model's values θ and δ
    /// and the weights e.
    pub(crate) fn of_link<T: Scalar>(&self, whole: usize, small: &[T]) -> T {
        let (link, _) = self.places[whole];
        let (mut value, mut offset) = (small[link], self.links);
        for CopyWeights { sector, weights } in &self.patterns {
            if weights[whole] != 0.0 {
                let difference = small[offset + link - sector.first];
                value = value + difference * T::from_f64(weights[whole]);
            }
            offset += sector.links;
        }
        value
    }

    /// Returns the constant angle (rad) between a link of the whole tree and the model's link that
    /// it follows.
    pub(crate) fn angle(&self, whole: usize) -> f64 {
        self.places[whole].1
    }

    /// Returns the standard deviation of the squared weights of a sector's copies, relative to
    /// their mean: zero for pairs with the same weights under all holders. If it is not zero, the
    /// differences also drive other differences, at second order.
    pub(crate) fn unevenness(&self, sector: usize) -> f64 {
        let CopyWeights { sector, weights } = &self.patterns[sector];
        let of_copies = self.places.iter().zip(weights);
        let squares = of_copies
            .filter(|((link, _), _)| *link == sector.first)
            .map(|(_, weight)| weight * weight * sector.holders as f64 - 1.0)
            .map(|excess| excess * excess);
        let count = squares.clone().count() as f64;
        Scalar::sqrt(squares.sum::<f64>() / count)
    }
}

/// Checks the weights of a sector's copies, and scales them so that their squares add up to the
/// number of copies under one holder.
fn normalised(sector: &TransverseSector, mut weights: Vec<f64>) -> Result<Vec<f64>, PatternError> {
    let expected = sector.copies * sector.holders;
    if weights.len() != expected {
        return Err(PatternError::Length {
            expected,
            found: weights.len(),
        });
    }
    let size: f64 = weights.iter().map(|weight| weight * weight).sum();
    let even = |holder: &[f64]| {
        let sum: f64 = holder.iter().sum();
        sum * sum <= 1e-24 * size
    };
    if !(size.is_finite() && size > 0.0 && weights.chunks(sector.copies).all(even)) {
        return Err(PatternError::Weights);
    }
    let factor = Scalar::sqrt(sector.copies as f64 / size);
    weights.iter_mut().for_each(|weight| *weight *= factor);
    Ok(weights)
}
