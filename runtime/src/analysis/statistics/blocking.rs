//! Errors of averages by blocking.

use super::{StatisticsError, check, mean};

/// The standard error of a mean, computed as if blocks of this length were independent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockLevel {
    /// Number of samples in a block.
    pub length: usize,
    /// Number of blocks in all series together.
    pub blocks: usize,
    /// Standard error of the mean, computed from the spread of the block means.
    pub error: f64,
    /// Standard error of `error`.
    pub uncertainty: f64,
}

/// Errors of a mean by blocks of 1, 2, 4, … samples.
///
/// The error grows with the length of the blocks until they are independent: a plateau
/// (H. Flyvbjerg and H. G. Petersen, *Journal of Chemical Physics* 91, 461, 1989).
/// [`error`](Self::error) reads it by a stated rule.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::statistics::Blocking;
///
/// // Each sample is there four times.
/// let series: Vec<f64> = (0..4096_u32)
///     .map(|i| f64::from((i / 4).wrapping_mul(2_654_435_761) >> 16) / 65_536.0)
///     .collect();
/// let blocking = Blocking::of(&[&series])?;
/// let [alone, fours] = [blocking.levels[0], blocking.levels[2]];
/// assert!((fours.error / alone.error - 2.0).abs() < 0.01);
/// assert!(blocking.error()?.length >= 4);
/// # Ok::<(), branched_pendulum::analysis::statistics::StatisticsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Blocking {
    /// Mean of all samples.
    pub mean: f64,
    /// Number of samples.
    pub samples: usize,
    /// Errors for ascending lengths of the blocks; the first is for single samples.
    pub levels: Vec<BlockLevel>,
}

impl Blocking {
    /// Computes the errors by blocks for series of one quantity that were sampled at equal
    /// intervals in a steady state. Blocks do not extend over two series; samples that do not fill
    /// a block are left out.
    ///
    /// # Errors
    /// [`StatisticsError`].
    pub fn of<S: AsRef<[f64]>>(series: &[S]) -> Result<Self, StatisticsError> {
        let samples = check(series, 2)?;
        let mut blocks: Vec<Vec<f64>> = series.iter().map(|s| s.as_ref().to_vec()).collect();
        let mut levels = Vec::new();
        let mut length = 1;
        loop {
            let count = blocks.iter().map(Vec::len).sum();
            if count < 2 {
                break;
            }
            let mean = mean(&blocks, count);
            let squares = blocks.iter().flatten().map(|value| (value - mean).powi(2));
            let free = (count - 1) as f64;
            let error = (squares.sum::<f64>() / (free * count as f64)).sqrt();
            levels.push(BlockLevel {
                length,
                blocks: count,
                error,
                uncertainty: error / (2.0 * free).sqrt(),
            });
            for values in &mut blocks {
                let pairs = values.chunks_exact(2);
                *values = pairs.map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            }
            length *= 2;
        }
        Ok(Self {
            mean: mean(series, samples),
            samples,
            levels,
        })
    }

    /// Returns the error at the plateau, which is the error of the shortest blocks of length b with
    /// b³ > 2 n (e_b/e_1)⁴, at which the remaining error from correlations is smaller than that
    /// from the finite number of blocks (U. Wolff, *Computer Physics Communications* 156, 143,
    /// 2004; R. M. Lee et al., *Physical Review E* 83, 066706, 2011).
    ///
    /// # Errors
    /// [`StatisticsError::Correlated`] if no block is long enough.
    pub fn error(&self) -> Result<BlockLevel, StatisticsError> {
        let alone = self.levels.first().map_or(0.0, |level| level.error);
        let long = |level: &&BlockLevel| {
            let ratio = if alone > 0.0 {
                level.error / alone
            } else {
                1.0
            };
            (level.length as f64).powi(3) > 2.0 * self.samples as f64 * ratio.powi(4)
        };
        self.levels
            .iter()
            .find(long)
            .copied()
            .ok_or(StatisticsError::Correlated {
                samples: self.samples,
                lag: self.levels.last().map_or(0, |level| level.length),
            })
    }
}
