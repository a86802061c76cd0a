//! Differences of a whole tree, as a model of copies in phase counts them.

use alloc::vec;
use alloc::vec::Vec;

use super::{SmallDifferences, TransverseSector, WholeTree};
use crate::errors::errors;
use crate::scalar::{Real, Scalar};

/// The differences of a [`SmallDifferences`] model in the whole tree: which copy has which
/// weight e in θ + e δ.
///
/// Two copies have the weights ±1 where one link holds such copies, and where several
/// do and move alike ±1/√holders, the same under each. More copies, and holders that
/// do not do the same, take [`chosen`](Self::chosen).
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
    /// Link of the model as which each link of the whole tree moves, and its angle to it.
    places: Vec<(usize, f64)>,
    /// One over the number of links of the whole tree that move as each link.
    shares: Vec<f64>,
    patterns: Vec<Pattern>,
}

/// The differences of one sector.
#[derive(Clone, Debug, PartialEq)]
struct Pattern {
    sector: TransverseSector,
    /// Weight of each link of the whole tree, none without one.
    weights: Vec<f64>,
}

errors! {
    /// Reason for which weights are no pattern of differences.
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum PatternError {
        /// A sector that does not act back.
        Sector => "no sector of that name acts back",
        /// Another number of weights than the whole tree has such copies.
        Length {
            /// Number of copies under all holders.
            expected: usize,
            /// Number of weights.
            found: usize,
        } => "{found} weights for {expected} copies",
        /// Weights that are all zero, not finite, or do not add up to zero under a holder.
        Weights => "weights have to be finite, not all zero, and to add up to zero under each \
            holder",
        /// Copies of which there are more than two, so that weights have to be chosen.
        Choice {
            /// Name of the sector.
            sector: &'static str,
        } => "`{sector}` has more than two copies: choose their weights by `chosen`",
    }
}

impl core::error::Error for PatternError {}

impl DifferencePatterns {
    /// The patterns of pairs, of a model and the whole tree behind it.
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

    /// The patterns with these weights of copies of some sectors, by their names, in the
    /// order in which the whole tree has the copies: under the first holder, under the
    /// next. Patterns are made so large that their squares add up to the number of copies
    /// under one holder.
    ///
    /// # Errors
    ///
    /// [`PatternError`] for weights that are none, and for more than two copies without
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
                // Copies stand one after the other, each with as many links of a kind.
                let copy = met[link] * copies.len() / counts[link];
                met[link] += 1;
                copies[copy]
            };
            Ok(Pattern {
                sector,
                weights: places.iter().map(weight).collect(),
            })
        };
        let patterns: Result<Vec<Pattern>, PatternError> = sectors.iter().map(pattern).collect();
        Ok(Self {
            links,
            patterns: patterns?,
            shares: counts.iter().map(|&count| 1.0 / count as f64).collect(),
            places,
        })
    }

    /// Returns the state of the model, angles and differences and their rates, of a state
    /// of the whole tree, angles and their rates: means, and what of the differences
    /// follows the patterns. Empty for one of another length.
    #[must_use]
    pub fn to_small<T: Scalar>(&self, whole: &[T]) -> Vec<T> {
        let mut small = vec![T::from_f64(0.0); 2 * self.half()];
        match self.small_into(whole, &mut small) {
            true => small,
            false => Vec::new(),
        }
    }

    /// Returns the state of the whole tree of a state of the model. Empty for one of
    /// another length.
    #[must_use]
    pub fn to_whole<T: Scalar>(&self, small: &[T]) -> Vec<T> {
        let mut whole = vec![T::from_f64(0.0); 2 * self.places.len()];
        match self.whole_into(small, &mut whole) {
            true => whole,
            false => Vec::new(),
        }
    }

    /// Returns the generalized torques on the model of torques on the links of the whole
    /// tree, for the same work: their sums for the angles in phase and, behind them, the
    /// sums with the weights of the copies for the differences. Empty for another number.
    #[must_use]
    pub fn torques<T: Scalar>(&self, whole: &[T]) -> Vec<T> {
        let mut torques = vec![T::from_f64(0.0); self.half()];
        match self.torques_into(whole, &mut torques) {
            true => torques,
            false => Vec::new(),
        }
    }

    /// Writes generalized torques on the model; nothing for another length, which is told.
    pub(crate) fn torques_into<T: Scalar>(&self, whole: &[T], torques: &mut [T]) -> bool {
        if whole.len() != self.places.len() || torques.len() != self.half() {
            return false;
        }
        torques.fill(T::from_f64(0.0));
        for (index, (&(link, _), &torque)) in self.places.iter().zip(whole).enumerate() {
            torques[link] = torques[link] + torque;
            let mut offset = self.links;
            for Pattern { sector, weights } in &self.patterns {
                if weights[index] != 0.0 {
                    let place = offset + link - sector.first;
                    torques[place] = torques[place] + torque * T::from_f64(weights[index]);
                }
                offset += sector.links;
            }
        }
        true
    }

    /// Returns true if the model takes all of the torques on the whole tree's links: they
    /// differ between copies as the patterns do, but for rounding. `parts` is memory for
    /// [`half`](Self::half) numbers.
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

    /// Number of angles and differences.
    pub(crate) fn half(&self) -> usize {
        let differences = self.patterns.iter().map(|pattern| pattern.sector.links);
        self.links + differences.sum::<usize>()
    }

    /// Writes a state of the model; nothing for another length, which is told.
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

    /// Adds up means and differences of the values of the whole tree's links.
    fn project<T: Scalar>(&self, value: impl Fn(usize, f64) -> T, sums: &mut [T]) {
        for (whole, &(link, angle)) in self.places.iter().enumerate() {
            let value = value(whole, angle);
            sums[link] = sums[link] + value * T::from_f64(self.shares[link]);
            let mut offset = self.links;
            for Pattern { sector, weights } in &self.patterns {
                if weights[whole] != 0.0 {
                    let place = offset + link - sector.first;
                    // Squares of weights have the mean 1/holders.
                    let share = weights[whole] * sector.holders as f64 * self.shares[link];
                    sums[place] = sums[place] + value * T::from_f64(share);
                }
                offset += sector.links;
            }
        }
    }

    /// Writes a state of the whole tree; nothing for another length, which is told.
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

    /// Returns the value of one link of the whole tree: θ + Σ e δ.
    pub(crate) fn of_link<T: Scalar>(&self, whole: usize, small: &[T]) -> T {
        let (link, _) = self.places[whole];
        let (mut value, mut offset) = (small[link], self.links);
        for Pattern { sector, weights } in &self.patterns {
            if weights[whole] != 0.0 {
                let difference = small[offset + link - sector.first];
                value = value + difference * T::from_f64(weights[whole]);
            }
            offset += sector.links;
        }
        value
    }

    /// Angle of a link of the whole tree to the link of the model as which it moves.
    pub(crate) fn angle(&self, whole: usize) -> f64 {
        self.places[whole].1
    }

    /// By how much the squares of a sector's weights differ between copies, rms relative
    /// to their mean: zero where pairs do the same under all holders. What they differ by
    /// drives other differences at second order.
    pub(crate) fn unevenness(&self, sector: usize) -> f64 {
        let Pattern { sector, weights } = &self.patterns[sector];
        let of_copies = self.places.iter().zip(weights);
        let squares = of_copies
            .filter(|((link, _), _)| *link == sector.first)
            .map(|(_, weight)| weight * weight * sector.holders as f64 - 1.0)
            .map(|excess| excess * excess);
        let count = squares.clone().count() as f64;
        Scalar::sqrt(squares.sum::<f64>() / count)
    }
}

/// Checks weights of a sector's copies, and makes their squares add up to the number of
/// copies under one holder.
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
