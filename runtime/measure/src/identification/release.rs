//! Where a record begins before the links are let go.

use super::record::AngleRecord;

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
        let rests: Vec<(f64, f64)> = links
            .iter()
            .map(|data| rest(&data[..data.partition_point(|(sample, _)| *sample < left)]))
            .collect::<Option<_>>()?;
        let far = |(data, &(mean, deviation)): (&Vec<(usize, f64)>, &(f64, f64))| {
            let is_far = |&&(sample, angle): &&(usize, f64)| {
                sample > left && (angle - mean).abs() > FAR * deviation
            };
            data.iter().find(is_far).map(|(sample, _)| *sample)
        };
        let far = links.iter().zip(&rests).filter_map(far).min()?;
        (times[left] - times[0] > times[far] - times[left]).then_some(times[left])
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

/// Mean and deviation of angles at rest; none where more than their noise moves them.
fn rest(data: &[(usize, f64)]) -> Option<(f64, f64)> {
    let angles = || data.iter().map(|(_, angle)| *angle);
    let number = data.len() as f64;
    let mean = angles().sum::<f64>() / number;
    let squares: f64 = angles().map(|angle| (angle - mean).powi(2)).sum();
    let deviation = (squares / (number - 1.0)).sqrt();
    let angles: Vec<f64> = angles().collect();
    let noise = (bends(&angles) / (number - 2.0)).sqrt();
    let floor = resolution(angles.iter().copied());
    let is_quiet = data.len() >= FEW && deviation <= QUIET * noise.max(floor);
    is_quiet.then_some((mean, deviation.max(floor)))
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
