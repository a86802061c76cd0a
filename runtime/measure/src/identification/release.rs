//! Detection of links at rest: before they are released, and in a part of the record in which they
//! hang still.

use super::record::{AngleRecord, MeasuredLink};

/// Error: a link does not rest in a part of the record in which it should.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unrest {
    /// Too few angles.
    #[error(
        "`{link}` has {found} angles in that time; at least {FEW} are needed to find its angle at rest"
    )]
    TooFew {
        /// Name of the link.
        link: String,
        /// Number of its angles.
        found: usize,
    },
    /// The link moves.
    #[error(
        "`{link}` moves by {deviation:.1e} rad (rms) in that time, but its noise is {noise:.1e} rad"
    )]
    Moves {
        /// Name of the link.
        link: String,
        /// Standard deviation of its angles from their mean, in rad.
        deviation: f64,
        /// Deviation of their noise, rad.
        noise: f64,
    },
}

/// Smallest number of samples from which the start of a record is judged.
const FEW: usize = 5;
/// Deviation from the mean of the start, in standard deviations, at which a link has left it, and
/// at which it is far away; and the number of successive samples that must have left.
const LEFT: f64 = 6.0;
const FAR: f64 = 100.0;
const ROW: usize = 3;
/// Largest standard deviation of angles at rest, relative to that of their noise.
const QUIET: f64 = 3.0;
/// Number of samples of a window in which held links are searched for; the motion of a hand that
/// holds a link, relative to the whole motion; and the fraction of the record that must come after
/// the window.
const WINDOW: usize = 10;
const TREMOR: f64 = 3e-3;
const AFTER: f64 = 0.3;

impl AngleRecord {
    /// Returns the time at which the links are released, if they are held before: the end of the
    /// last part in which all of them are held. Before that they may have rested and been lifted.
    ///
    /// The motion of a link that is released at rest soon exceeds its noise, and after three times
    /// that time it exceeds a hundred standard deviations. A link that rests for longer than that
    /// is held.
    #[must_use]
    pub fn release(&self) -> Option<f64> {
        self.last_release().or_else(|| self.first_release())
    }

    /// Returns the end of the last part in which all links are held, if enough of the record comes
    /// after it. Links that hang still at the end of a record and are taken away were not released
    /// then.
    fn last_release(&self) -> Option<f64> {
        let times = self.times();
        let (first, last) = (*times.first()?, *times.last()?);
        let quiet = self.quiet_windows();
        let mut end = times.len();
        while let Some(last_window) = quiet.get(..end)?.iter().rposition(|quiet| *quiet) {
            let before = quiet[..last_window].iter().rposition(|quiet| !*quiet);
            let start = before.map_or(0, |before| before + 1);
            let is_early = |release: &f64| last - release >= AFTER * (last - first);
            // The end of the lift may look as quiet as the hold: later beginnings leave it out.
            let later = std::iter::successors(Some(WINDOW), |offset| Some(2 * offset));
            let beginnings = std::iter::once(0).chain(later).map(|offset| start + offset);
            let mut beginnings = beginnings.take_while(|sample| *sample <= last_window);
            let release = beginnings.find_map(|sample| {
                let release = self.starting_at(sample).first_release();
                release.filter(is_early)
            });
            if release.is_some() {
                return release;
            }
            end = start;
        }
        None
    }

    /// Returns, for each sample, true if all links are still in the window that begins there.
    fn quiet_windows(&self) -> Vec<bool> {
        let count = self.times().len();
        let mut quiet = vec![!self.links.is_empty(); count];
        for link in &self.links {
            let all = link.angles.iter().flatten();
            let [least, largest] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| {
                [a.min(x), b.max(x)]
            });
            let tremor = TREMOR * (largest - least);
            for (sample, quiet) in quiet.iter_mut().enumerate() {
                let window = link.angles.get(sample..sample + WINDOW);
                let window = window.map(|window| window.iter().flatten().copied().enumerate());
                let window: Vec<(usize, f64)> = window.into_iter().flatten().collect();
                *quiet &= window.len() >= FEW && {
                    let rest = Rest::of(&window);
                    rest.is_quiet() || rest.deviation <= tremor
                };
            }
        }
        quiet
    }

    /// Returns the part of the record from a sample on.
    fn starting_at(&self, first: usize) -> Self {
        let link = |link: &MeasuredLink| MeasuredLink {
            angles: link.angles.get(first..).unwrap_or_default().to_vec(),
            ..link.clone()
        };
        let mut part = Self::new(self.times().get(first..).unwrap_or_default());
        part.links = self.links.iter().map(link).collect();
        part
    }

    /// Returns the time at which the links begin to move, if they are held from the start of the
    /// record.
    fn first_release(&self) -> Option<f64> {
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

    /// Returns the mean angle of each link (rad) over the record, after checking that all of them
    /// rest.
    ///
    /// # Errors
    /// [`Unrest`] if a link moves by more than its noise.
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

/// Returns the sample at which a link finally leaves its initial angle.
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

/// Angles of a link that may be at rest.
struct Rest {
    mean: f64,
    deviation: f64,
    /// Standard deviation of the noise, estimated from second differences.
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

    /// Returns true if the angles vary by noise only.
    fn is_quiet(&self) -> bool {
        self.deviation <= QUIET * self.noise.max(self.floor)
    }
}

/// Returns the standard deviation of the noise, estimated from the typical second difference, so
/// that a single leap does not change it.
fn usual_noise(data: &[(usize, f64)]) -> f64 {
    /// Magnitude, in standard deviations, below which half of all normal random numbers are.
    const HALF: f64 = 0.674_489_75;
    let bends = data
        .windows(3)
        .map(|three| three[0].1 - 2.0 * three[1].1 + three[2].1);
    let mut bends: Vec<f64> = bends.map(f64::abs).collect();
    bends.sort_by(f64::total_cmp);
    bends[bends.len() / 2] / (HALF * 6.0_f64.sqrt())
}

/// Returns the sum, over second differences, of the variance of white noise that would cause them:
/// a sixth of their squares.
pub(super) fn bends(data: &[f64]) -> f64 {
    let bends = data
        .windows(3)
        .map(|three| three[0] - 2.0 * three[1] + three[2]);
    bends.map(|bend| bend * bend / 6.0).sum()
}

/// Returns the standard deviation of the rounding of data with this many digits.
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
