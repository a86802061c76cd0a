//! Angles against time, as the rest of the project takes them.

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding};
use super::outliers::{self, Marked};
use super::table::Table;
use super::timing::{Times, Timing};
use std::f64::consts::{PI, TAU};

/// The angle of a link at one time, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Sample {
    /// A measured angle.
    Measured(f64),
    /// One that does not fit its neighbours.
    Outlier(f64),
    /// One whose points were found with too small a likelihood.
    Unlikely(f64),
    /// None was measured.
    Missing,
}

/// Angles of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSeries {
    /// Name: that of its column, or of its markers.
    pub name: String,
    /// One sample a time.
    pub samples: Vec<Sample>,
    /// Mean distance of its two markers and its root mean square deviation, in the units of
    /// the file; none for angles that were measured as such. A rigid link has a constant
    /// one: the deviation is that of the tracking.
    pub marker_distance: Option<[f64; 2]>,
}

impl LinkSeries {
    /// Returns the angle (in rad) to be used at a time: none where it is missing or marked.
    pub fn angle(&self, index: usize) -> Option<f64> {
        match self.samples.get(index) {
            Some(Sample::Measured(angle)) => Some(*angle),
            _ => None,
        }
    }
}

/// Angles of links from the downward vertical against time, without jumps of a turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Times, s; ascending.
    pub times: Vec<f64>,
    /// The links, each with as many samples as there are times.
    pub links: Vec<LinkSeries>,
    /// How even the times are.
    pub timing: Timing,
    /// Facts detected, assumed and marked, the table's findings first.
    pub findings: Vec<Finding>,
}

impl Recording {
    /// Angles of links as they were read: takes jumps of a turn out and marks outliers.
    pub(crate) fn new(
        table: &Table,
        times: Times,
        mut links: Vec<LinkSeries>,
        outliers: Option<f64>,
        of_angles: Vec<Finding>,
    ) -> Result<Self, ReadError> {
        if let Some(threshold) = outliers.filter(|t| !(t.is_finite() && *t > 0.0)) {
            let what = format!("a threshold of outliers of {threshold}; it must be positive");
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        check(table, &links)?;
        let Times {
            seconds,
            timing,
            findings: of_times,
            ..
        } = times;
        let mut findings = table.findings().to_vec();
        findings.extend(of_times.into_iter().chain(of_angles));
        for link in &mut links {
            let Unwrapped { jumps, doubtful } =
                unwrap(&seconds, &mut link.samples, timing.interval);
            let name = &link.name;
            if jumps > 0 {
                let text = format!("`{name}`: {jumps} jumps of a turn were taken out");
                findings.push(Finding::new(Basis::Marked, text));
            }
            if doubtful > 0 {
                let text = format!("`{name}`: turns across {doubtful} gaps are the nearest ones");
                findings.push(Finding::new(Basis::Assumed, text));
            }
            if let Some(threshold) = outliers {
                let text = match outliers::mark(&seconds, &mut link.samples, threshold) {
                    Marked::Some(0) => None,
                    Marked::Some(count) => Some(format!(
                        "`{name}`: {count} outliers, beyond {threshold} times the usual \
                         deviation from their neighbours"
                    )),
                    Marked::TooMany(count) => Some(format!(
                        "`{name}`: no outliers, since {count} samples would be: the motion is \
                         too fast for this rate, or the noise comes in spikes"
                    )),
                };
                findings.extend(text.map(|text| Finding::new(Basis::Marked, text)));
            }
            let unlikely = link
                .samples
                .iter()
                .filter(|s| matches!(s, Sample::Unlikely(_)))
                .count();
            if unlikely > 0 {
                let text = format!("`{name}`: {unlikely} samples of small likelihood");
                findings.push(Finding::new(Basis::Marked, text));
            }
        }
        // Doubts come first.
        findings.sort_by_key(|finding| finding.basis != Basis::Doubtful);
        Ok(Self {
            times: seconds,
            links,
            timing,
            findings,
        })
    }
}

/// Refuses angles of so many turns that one more is lost in their rounding.
fn check(table: &Table, links: &[LinkSeries]) -> Result<(), ReadError> {
    const LARGEST: f64 = 1e6;
    for link in links {
        for (row, sample) in link.samples.iter().enumerate() {
            if let Sample::Measured(value) = *sample
                && (value.abs() > LARGEST || value.is_nan())
            {
                let name = link.name.clone();
                return Err(table.refused_at(ReadErrorKind::Angle { name, value }, row, None));
            }
        }
    }
    Ok(())
}

/// Changes to a series for the sake of its turns.
struct Unwrapped {
    jumps: usize,
    doubtful: usize,
}

/// Adds whole turns so that each angle is the one nearest to where the last two lead, or
/// to the last one behind a gap, which may hide turns.
fn unwrap(times: &[f64], samples: &mut [Sample], interval: f64) -> Unwrapped {
    const NEAR: f64 = 3.5;
    let mut done = Unwrapped {
        jumps: 0,
        doubtful: 0,
    };
    let mut turns = 0.0;
    let mut last: Option<(f64, f64, f64)> = None;
    for (&time, sample) in times.iter().zip(samples) {
        let (value, is_measured) = match sample {
            Sample::Measured(value) => (value, true),
            Sample::Outlier(value) | Sample::Unlikely(value) => (value, false),
            Sample::Missing => continue,
        };
        let Some((before, angle, rate)) = last else {
            if is_measured {
                last = Some((time, *value, 0.0));
            }
            continue;
        };
        let step = time - before;
        let near = step <= NEAR * interval;
        let ahead = rate * step;
        let expected = if near && ahead.is_finite() {
            angle + ahead
        } else {
            angle
        };
        let own = ((expected - *value) / TAU).round();
        *value += own * TAU;
        if is_measured {
            done.jumps += usize::from(own != turns);
            done.doubtful += usize::from(!near && ahead.abs() > PI);
            turns = own;
            let rate = (*value - angle) / step;
            last = Some((time, *value, rate));
        }
    }
    done
}
