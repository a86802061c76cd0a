//! Where links rest: before they are let go, and in a stretch in which they hang still.

use super::record::{AngleRecord, MeasuredLink};

/// A link that does not rest in a stretch in which it should.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unrest {
    /// Too few angles to tell.
    #[error("`{link}` has {found} angles there, and a place of rest needs {FEW}")]
    TooFew {
        /// Name of the link.
        link: String,
        /// Number of its angles.
        found: usize,
    },
    /// The link moves.
    #[error(
        "`{link}` moves there by {deviation:.1e} rad (rms), where its noise is {noise:.1e} rad"
    )]
    Moves {
        /// Name of the link.
        link: String,
        /// Deviation of its angles from their mean, rad.
        deviation: f64,
        /// Deviation of their noise, rad.
        noise: f64,
    },
}

/// Samples without which nothing is said of a beginning.
const FEW: usize = 5;
/// Deviations from the mean of a beginning by which a link has left it, and by which it is far
/// away; samples in a row that have to have left.
const LEFT: f64 = 6.0;
const FAR: f64 = 100.0;
const ROW: usize = 3;
/// Deviation of angles at rest, in that of their noise, at most.
const QUIET: f64 = 3.0;

impl AngleRecord {
    /// Returns the time from which on the links move, where they are held before.
    ///
    /// A link that is released at rest is out of its noise soon, and three times as late a
    /// hundred deviations away. One that rests for longer than the way takes is held.
    #[must_use]
    pub fn release(&self) -> Option<f64> {
        let times = self.times();
        let links: Vec<Vec<(usize, f64)>> = self.links.iter().map(|link| link.data()).collect();
        let left = links.iter().filter_map(|data| departure(data)).min()?;
        let rests = links.iter().map(|data| {
            let before = &data[..data.partition_point(|(sample, _)| *sample < left)];
            let rest = (before.len() >= FEW).then(|| Rest::of(before));
            let rest = rest.filter(Rest::is_quiet)?;
            Some((rest.mean, rest.deviation.max(rest.floor)))
        });
        let rests: Vec<(f64, f64)> = rests.collect::<Option<_>>()?;
        let far = |(data, &(mean, deviation)): (&Vec<(usize, f64)>, &(f64, f64))| {
            let is_far = |&&(sample, angle): &&(usize, f64)| {
                sample > left && (angle - mean).abs() > FAR * deviation
            };
            data.iter().find(is_far).map(|(sample, _)| *sample)
        };
        let far = links.iter().zip(&rests).filter_map(far).min()?;
        (times[left] - times[0] > times[far] - times[left]).then_some(times[left])
    }

    /// Returns the mean angle of each link (rad) over the record, in which all of them rest.
    ///
    /// # Errors
    /// [`Unrest`] for a link that moves by more than its noise.
    pub fn means_at_rest(&self) -> Result<Vec<f64>, Unrest> {
        let mean = |link: &MeasuredLink| {
            let data = link.data();
            if data.len() < FEW {
                return Err(Unrest::TooFew {
                    link: link.name.clone(),
                    found: data.len(),
                });
            }
            let mut rest = Rest::of(&data);
            rest.noise = usual_noise(&data);
            match rest.is_quiet() {
                true => Ok(rest.mean),
                false => Err(Unrest::Moves {
                    link: link.name.clone(),
                    deviation: rest.deviation,
                    noise: rest.noise,
                }),
            }
        };
        self.links.iter().map(mean).collect()
    }
}

/// The sample at which a link leaves its beginning for good.
fn departure(data: &[(usize, f64)]) -> Option<usize> {
    let first = data.first()?.1;
    let floor = resolution(data.iter().map(|(_, angle)| *angle));
    let (mut sum, mut squares) = (0.0, 0.0);
    for (count, &(sample, angle)) in data.iter().enumerate() {
        let number = count as f64;
        if count >= FEW {
            let mean = sum / number;
            let variance = (squares - number * mean * mean) / (number - 1.0);
            let deviation = variance.max(0.0).sqrt().max(floor);
            let mut row = data[count..].iter().take(ROW);
            if row.all(|(_, angle)| (angle - first - mean).abs() > LEFT * deviation) {
                return Some(sample);
            }
        }
        sum += angle - first;
        squares += (angle - first) * (angle - first);
    }
    None
}

/// Angles that may be those of a link at rest.
struct Rest {
    mean: f64,
    deviation: f64,
    /// Deviation of the noise, by second differences.
    noise: f64,
    /// Deviation of the rounding.
    floor: f64,
}

impl Rest {
    fn of(data: &[(usize, f64)]) -> Self {
        let angles: Vec<f64> = data.iter().map(|(_, angle)| *angle).collect();
        let number = angles.len() as f64;
        let mean = angles.iter().sum::<f64>() / number;
        let squares: f64 = angles.iter().map(|angle| (angle - mean).powi(2)).sum();
        Self {
            mean,
            deviation: (squares / (number - 1.0)).sqrt(),
            noise: (bends(&angles) / (number - 2.0)).sqrt(),
            floor: resolution(angles.iter().copied()),
        }
    }

    /// Returns true if nothing but noise moves the link.
    fn is_quiet(&self) -> bool {
        self.deviation <= QUIET * self.noise.max(self.floor)
    }
}

/// Deviation of the noise by the usual second difference: one leap does not change it.
fn usual_noise(data: &[(usize, f64)]) -> f64 {
    /// Part of the deviation of normal numbers below which half of them are.
    const HALF: f64 = 0.674_489_75;
    let bends = data
        .windows(3)
        .map(|three| three[0].1 - 2.0 * three[1].1 + three[2].1);
    let mut bends: Vec<f64> = bends.map(f64::abs).collect();
    bends.sort_by(f64::total_cmp);
    bends[bends.len() / 2] / (HALF * 6.0_f64.sqrt())
}

/// Sum over second differences of the variance of white noise that has such: a sixth of their
/// squares.
pub(super) fn bends(data: &[f64]) -> f64 {
    let bends = data
        .windows(3)
        .map(|three| three[0] - 2.0 * three[1] + three[2]);
    bends.map(|bend| bend * bend / 6.0).sum()
}

/// Deviation of the rounding of data that have so many digits.
pub(super) fn resolution(data: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = data.collect();
    sorted.sort_by(f64::total_cmp);
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let least = steps
        .filter(|step| *step > 0.0)
        .fold(f64::INFINITY, f64::min);
    match least.is_finite() {
        true => least / 12.0_f64.sqrt(),
        false => 0.0,
    }
}
