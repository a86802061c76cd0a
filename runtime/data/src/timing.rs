//! Times of samples.

use std::ops::Range;

use super::clock::{Clock, TimeColumns};
use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, listed, moment, rounded};
use super::succession::{check_joined, disorder, rounding};
use super::table::Table;

/// How evenly spaced the times of samples are.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// Usual interval between two samples, in s: the mean without gaps or, for uneven times, the
    /// median.
    pub interval: f64,
    /// Root mean square deviation of the intervals from the usual one, without gaps, in s.
    pub jitter: f64,
    /// Gaps where samples are missing; for uneven times, intervals that are far longer than their
    /// neighbours.
    pub gaps: Vec<Gap>,
}

/// A gap in which rows are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Time of the last sample before the gap, in s.
    pub start: f64,
    /// Time of the first sample after the gap, in s.
    pub end: f64,
}

/// Length of an interval, relative to the usual one, from which on it counts as a gap.
const GAP: f64 = 1.5;
/// For uneven times, length of an interval relative to both of its neighbours from which on it
/// counts as a gap.
const GAP_OF_UNEVEN: f64 = 10.0;
/// Times with at most this fraction of gaps among their intervals can still count as evenly spaced.
const GAPS: f64 = 0.05;

impl Timing {
    fn of(times: &[f64]) -> Self {
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = median(steps.clone());
        let is_uneven = are_uneven(&steps, middle);
        let is_gap = |index: &usize| {
            let beside = index.saturating_sub(2)..(index + 3).min(steps.len());
            let beside = beside.filter(|other| other != index);
            let longest = beside.map(|other| steps[other]).fold(0.0, f64::max);
            steps[*index] > GAP * middle
                && (!is_uneven || steps[*index] > GAP_OF_UNEVEN * longest.max(middle))
        };
        let (gaps, usual): (Vec<usize>, Vec<usize>) = (0..steps.len()).partition(is_gap);
        let count = usual.len().max(1) as f64;
        let interval = match is_uneven {
            true => middle,
            false => usual.iter().map(|&index| steps[index]).sum::<f64>() / count,
        };
        let square = |&index: &usize| (steps[index] - interval).powi(2);
        Self {
            interval,
            jitter: (usual.iter().map(square).sum::<f64>() / count).sqrt(),
            gaps: gaps
                .iter()
                .map(|&index| Gap {
                    start: times[index],
                    end: times[index + 1],
                })
                .collect(),
        }
    }

    /// Returns the ranges of rows between long gaps, across which a motion cannot be continued:
    /// more than 2 s and more than 20 usual intervals.
    pub fn stretches(times: &[f64]) -> Vec<Range<usize>> {
        const LONG: f64 = 2.0;
        const INTERVALS: f64 = 20.0;
        let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
        let longest = LONG.max(INTERVALS * median(steps.collect()));
        let mut stretches = Vec::new();
        let mut start = 0;
        for index in 1..times.len() {
            if times[index] - times[index - 1] > longest {
                stretches.push(start..index);
                start = index;
            }
        }
        if start < times.len() {
            stretches.push(start..times.len());
        }
        stretches
    }

    /// Returns true if rows are missing between two successive times.
    pub(crate) fn has_gap(&self, from: f64, to: f64) -> bool {
        let next = self.gaps.partition_point(|gap| gap.start < from);
        self.gaps.get(next).is_some_and(|gap| gap.end <= to)
    }

    /// Returns findings about the sampling rate or the unevenness of the times, about gaps and
    /// about rounding.
    fn findings(&self, times: &[f64]) -> [Option<Finding>; 4] {
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let text = if are_uneven(&steps, self.interval) {
            let shortest = steps.iter().copied().fold(f64::INFINITY, f64::min);
            let longest = steps.iter().copied().fold(0.0, f64::max);
            let [shortest, longest, usual] =
                [shortest, longest, self.interval].map(|step| rounded(step, 3));
            format!(
                "uneven times, {shortest} s to {longest} s apart, half of them less than {usual} s"
            )
        } else {
            let rate = rounded(1.0 / self.interval, 6);
            let percent = 100.0 * self.jitter / self.interval;
            format!("{rate} samples a second, intervals even to {percent:.2} % (rms)")
        };
        let gaps = self.gaps.iter().map(|Gap { start, end }| {
            let [start, end] = [*start, *end].map(|time| moment(time, self.interval));
            format!("{start} and {end}")
        });
        let gaps = (gaps.len() > 0).then(|| format!("no rows between {}", listed(gaps)));
        let [text, gaps] =
            [Some(text), gaps].map(|text| Some(Finding::new(Basis::Detected, text?)));
        [self.jump(times), rounding(times), text, gaps]
    }

    /// Returns a finding about a gap that is longer than the rest of the record, which means that
    /// the clock is wrong.
    fn jump(&self, times: &[f64]) -> Option<Finding> {
        const SHORTEST: f64 = 60.0;
        let length = |gap: &Gap| gap.end - gap.start;
        let longest = self
            .gaps
            .iter()
            .max_by(|a, b| f64::total_cmp(&length(a), &length(b)))?;
        let rest = times.last()? - times.first()? - length(longest);
        (length(longest) > rest.max(SHORTEST)).then(|| {
            let [start, end] = [longest.start, longest.end].map(|time| moment(time, self.interval));
            let text = format!(
                "the clock jumps from {start} to {end}, by more than the length of all the rest; \
                 check the times of the rows before and behind"
            );
            Finding::new(Basis::Doubtful, text)
        })
    }
}

/// Returns true if times are uneven: too many intervals are long, and few of these are multiples of
/// the usual one, as they are if single rows are lost.
fn are_uneven(steps: &[f64], usual: f64) -> bool {
    let long = || {
        steps
            .iter()
            .map(|step| step / usual)
            .filter(|&part| part > GAP)
    };
    let lost = long().filter(|part| (part - part.round()).abs() < 0.1);
    let (long, lost) = (long().count(), lost.count());
    long as f64 > GAPS * steps.len() as f64 && 2 * lost < long
}

/// Returns the median of some values; 0 if there are none.
pub(crate) fn median(values: Vec<f64>) -> f64 {
    quantile(values, 0.5)
}

/// Returns the quantile of the values below which the fraction `part` of them lies; 0 if there are
/// none.
pub(crate) fn quantile(mut values: Vec<f64>, part: f64) -> f64 {
    let place = (part * values.len() as f64) as usize;
    if place >= values.len() {
        return 0.0;
    }
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Times of a table's rows, the columns that contain them, and what was found about them.
pub(crate) struct Times {
    pub(crate) seconds: Vec<f64>,
    pub(crate) columns: TimeColumns,
    pub(crate) timing: Timing,
    pub(crate) findings: Vec<Finding>,
}

/// Smallest number of rows that a motion needs.
const ROWS: usize = 3;

impl Times {
    pub(crate) fn read(table: &Table, clock: &Clock) -> Result<Self, ReadError> {
        if table.rows() < ROWS {
            // A quotation mark that is not closed takes rows in.
            for column in 0..table.columns().len() {
                table.values(column)?;
            }
            let (found, needed) = (table.rows(), ROWS);
            return Err(table.refused(ReadErrorKind::TooFewRows { found, needed }));
        }
        let mut findings = Vec::new();
        let columns = TimeColumns::find(table, clock, &mut findings)?;
        if matches!(clock, Clock::FrameRate(_)) {
            check_joined(table, &columns)?;
        }
        let times = columns.seconds(table)?;
        let mut seconds: Vec<f64> = Vec::with_capacity(table.rows());
        for (row, time) in times.iter().enumerate() {
            let time = time
                .ok_or_else(|| table.refused_at(ReadErrorKind::TimeMissing, row, columns.column))?;
            if let Some(&previous) = seconds.last()
                && !(time > previous && time.is_finite())
            {
                return Err(disorder(table, &columns, &times, row));
            }
            seconds.push(time);
        }
        let timing = Timing::of(&seconds);
        findings.extend(timing.findings(&seconds).into_iter().flatten());
        Ok(Self {
            seconds,
            columns,
            timing,
            findings,
        })
    }
}
