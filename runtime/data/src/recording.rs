//! Angles against time, in the form that the rest of the project uses.

use std::path::Path;

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed, moment, moments, rounded};
use super::leaps;
use super::outliers::{self, Marked};
use super::sample::Sample;
use super::table::Table;
use super::timing::{Times, Timing};
use super::turns::{self, Turns};

/// Angles of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSeries {
    /// Name of the link, taken from its column or its markers.
    pub name: String,
    /// One sample a time.
    pub samples: Vec<Sample>,
    /// Mean distance of its two markers and its root mean square deviation, in the units of the
    /// file; `None` for angles that were measured directly. For a rigid link the distance is
    /// constant, and the deviation is that of the tracking.
    pub marker_distance: Option<[f64; 2]>,
}

impl LinkSeries {
    /// Returns the angle (rad) to be used at a time; `None` if it is missing or marked.
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
    /// The links, each with one sample per time.
    pub links: Vec<LinkSeries>,
    /// How even the times are.
    pub timing: Timing,
    /// Statements about the file: doubtful ones first, then detected, assumed and marked facts,
    /// those about the table before others.
    pub findings: Vec<Finding>,
}

impl Recording {
    /// Checks that every link moves in the rows of the recording.
    ///
    /// # Errors
    /// [`ReadErrorKind::Still`] if all angles of a link are equal.
    pub fn check_motion(&self, path: &Path) -> Result<(), ReadError> {
        match still(&self.links) {
            Some(still) => Err(still.at(path, None)),
            None => Ok(()),
        }
    }

    /// Creates a recording from angles as they were read: removes jumps of whole turns and marks
    /// outliers. `resolutions` (rad) are the steps to which the angles of each link are rounded.
    pub(crate) fn new(
        table: &Table,
        times: Times,
        mut links: Vec<LinkSeries>,
        resolutions: &[f64],
        outliers: Option<f64>,
        of_angles: Vec<Finding>,
    ) -> Result<Self, ReadError> {
        if let Some(threshold) = outliers.filter(|t| !(t.is_finite() && *t > 0.0)) {
            let what = format!("a threshold of outliers of {threshold}; it must be positive");
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        check(table, &links)?;
        check_motion(table, &links)?;
        let Times {
            seconds,
            timing,
            findings: of_times,
            ..
        } = times;
        let mut findings = table.findings().to_vec();
        findings.extend(of_times.into_iter().chain(of_angles));
        findings.extend(flickering(&links, resolutions));
        let mut all = Vec::with_capacity(links.len());
        for (link, resolution) in links.iter_mut().zip(resolutions) {
            let turns = turns::count(&seconds, &mut link.samples, &timing);
            check_turns(table, &seconds, &timing, link, &turns)?;
            let marked = outliers.map(|threshold| {
                outliers::mark(&seconds, &mut link.samples, threshold, *resolution, &turns)
            });
            all.push((turns, marked));
        }
        let leaps = links.iter().zip(resolutions);
        let leaps = leaps.map(|(link, resolution)| match outliers {
            Some(_) => {
                let angle = |row| link.angle(row);
                leaps::leaps(&seconds, timing.interval, angle, *resolution)
            }
            None => Vec::new(),
        });
        let leaps: Vec<Vec<[usize; 2]>> = leaps.collect();
        let marks = Marks {
            times: &seconds,
            interval: timing.interval,
            links: &links,
            all: &all,
        };
        findings.extend(marks.findings(outliers));
        findings.extend(marks.leaps(&leaps));
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

/// Returns an error if a series jumps too often to be the angles of a link.
fn check_turns(
    table: &Table,
    times: &[f64],
    timing: &Timing,
    link: &LinkSeries,
    turns: &Turns,
) -> Result<(), ReadError> {
    let mut wild = [&turns.bends[..], &turns.strays].concat();
    wild.sort_unstable();
    wild.dedup();
    let is_measured = |sample: &&Sample| matches!(sample, Sample::Measured(_));
    let measured = link.samples.iter().filter(is_measured).count();
    if !outliers::are_many(wild.len(), measured, outliers::FEW) {
        return Ok(());
    }
    let kind = ReadErrorKind::Jumps {
        name: link.name.clone(),
        count: wild.len(),
        measured,
        first: moments(times, &wild, timing.interval),
    };
    Err(table.refused_at(kind, wild[0], None))
}

/// Marked samples and changes of the links' angles, from which findings are made.
struct Marks<'a> {
    times: &'a [f64],
    interval: f64,
    links: &'a [LinkSeries],
    all: &'a [(Turns, Option<Marked>)],
}

impl Marks<'_> {
    /// Returns a list of the links for which `of` has something to report; `None` if there are
    /// none.
    fn of_links(&self, of: impl Fn(&Turns, Option<&Marked>) -> Option<String>) -> Option<String> {
        let links = self.links.iter().zip(self.all);
        let reported = links.filter_map(|(link, (turns, marked))| {
            Some(format!("`{}`: {}", link.name, of(turns, marked.as_ref())?))
        });
        let reported: Vec<String> = reported.collect();
        (!reported.is_empty()).then(|| listed(reported.into_iter()))
    }

    fn at(&self, rows: &[usize], thing: &str) -> Option<String> {
        let places = || moments(self.times, rows, self.interval);
        (!rows.is_empty()).then(|| format!("{} ({})", counted(rows.len(), thing), places()))
    }

    /// Rows between which links leap.
    fn leaps(&self, leaps: &[Vec<[usize; 2]>]) -> Option<Finding> {
        let links = self.links.iter().zip(leaps);
        let links = links.filter(|(_, leaps)| !leaps.is_empty());
        let each = links.map(|(link, leaps)| {
            let places = leaps.iter().map(|[first, last]| {
                let [from, to] = [first, last].map(|&row| moment(self.times[row], self.interval));
                format!("{from} to {to}")
            });
            format!("`{}` {}", link.name, listed(places))
        });
        let each: Vec<String> = each.collect();
        (!each.is_empty()).then(|| {
            let text = format!(
                "angles leap, and go on smoothly before and behind: {}. There, or between two leaps, \
                 they may step, change their sign, be frozen or exchanged, or rows be lost",
                listed(each.into_iter())
            );
            Finding::new(Basis::Doubtful, text)
        })
    }

    fn findings(&self, threshold: Option<f64>) -> Vec<Finding> {
        let jumps = self.of_links(|turns, _| self.at(&turns.jumps, "jump"));
        let jumps = jumps.map(|reported| format!("jumps of a turn were taken out: {reported}"));
        let doubtful = self.of_links(|turns, _| self.at(&turns.doubtful, "place"));
        let doubtful = doubtful.map(|reported| {
            format!(
                "turns from there on are the nearest ones and may be others, behind gaps, sudden \
                 changes, or in a whirl of fewer than four samples a turn: {reported}"
            )
        });
        let marked = self.of_links(|_, marked| match marked? {
            Marked::Rows(rows) => self.at(rows, "outlier"),
            Marked::TooMany(_) => None,
        });
        let marked = marked.zip(threshold).map(|(reported, threshold)| {
            format!(
                "{reported}, beyond {threshold} times the usual deviation from their neighbours"
            )
        });
        let too_many = self.of_links(|_, marked| match marked? {
            Marked::Rows(_) => None,
            Marked::TooMany(count) => Some(format!("{count} samples")),
        });
        let too_many = too_many.map(|reported| {
            format!(
                "no samples are marked as outliers, because too many would be: {reported}; the motion is \
                 too fast for this rate, or the noise comes in spikes"
            )
        });
        let unlikely = self.links.iter().filter_map(|link| {
            let is_unlikely = |sample: &&Sample| matches!(sample, Sample::Unlikely(_));
            let count = link.samples.iter().filter(is_unlikely).count();
            (count > 0).then(|| format!("`{}`: {}", link.name, counted(count, "sample")))
        });
        let unlikely: Vec<String> = unlikely.collect();
        let unlikely = (!unlikely.is_empty())
            .then(|| format!("of small likelihood: {}", listed(unlikely.into_iter())));
        let all = [
            (Basis::Marked, jumps),
            (Basis::Doubtful, doubtful),
            (Basis::Marked, marked),
            (Basis::Marked, too_many),
            (Basis::Marked, unlikely),
        ];
        let reported = |(basis, text): (Basis, Option<String>)| Some(Finding::new(basis, text?));
        all.into_iter().filter_map(reported).collect()
    }
}

/// Largest number of links that are found in a file without being named.
const WIDEST: usize = 1024;

/// Returns an error if a table has more columns or tracks than a tree is expected to have links.
pub(crate) fn check_width(
    table: &Table,
    found: usize,
    things: &'static str,
) -> Result<(), ReadError> {
    match found > WIDEST {
        true => Err(table.refused(ReadErrorKind::TooWide {
            found,
            things,
            most: WIDEST,
        })),
        false => Ok(()),
    }
}

/// Returns an error if the angles of a table would not fit into memory while they are read.
pub(crate) fn check_memory(table: &Table, links: usize) -> Result<(), ReadError> {
    /// Approximate number of bytes that an angle needs while it is read.
    const BYTES: usize = 250;
    let rows = table.rows();
    let mut memory: Vec<u8> = Vec::new();
    let needed = rows.saturating_mul(links).saturating_mul(BYTES);
    memory.try_reserve_exact(needed).map_err(|_| {
        let columns = table.columns().len();
        table.refused(ReadErrorKind::Memory { rows, columns })
    })
}

/// Returns an error if the angles of a link are all equal.
pub(crate) fn check_motion(table: &Table, links: &[LinkSeries]) -> Result<(), ReadError> {
    match still(links) {
        Some(still) => Err(table.refused(still)),
        None => Ok(()),
    }
}

/// Returns the number of angles of a link, the smallest and the largest one.
fn range(link: &LinkSeries) -> (usize, [f64; 2]) {
    let all = 0..link.samples.len();
    let angles = all.filter_map(|index| link.angle(index));
    let none = (0, [f64::INFINITY, f64::NEG_INFINITY]);
    angles.fold(none, |(count, [least, most]), angle| {
        (count + 1, [least.min(angle), most.max(angle)])
    })
}

/// Returns the error for a link whose angles are all equal except for the rounding of `f64`, if
/// there is one.
fn still(links: &[LinkSeries]) -> Option<ReadErrorKind> {
    /// Smallest number of angles from which on a link must move.
    const FEWEST: usize = 5;
    /// Range of angles, relative to the largest one, that is caused by rounding.
    const ROUNDING: f64 = 1e-12;
    links.iter().find_map(|link| {
        let (count, [least, most]) = range(link);
        let is_still = most - least <= ROUNDING * most.abs().max(least.abs());
        (is_still && count >= FEWEST).then(|| ReadErrorKind::Still {
            name: link.name.clone(),
            count,
            value: least,
        })
    })
}

/// Returns a finding for each link whose angles change by at most two of the steps to which they
/// are rounded, as an encoder at rest flickers between neighbouring counts.
fn flickering(links: &[LinkSeries], resolutions: &[f64]) -> Vec<Finding> {
    const STEPS: f64 = 2.0 + 1e-6;
    let links = links.iter().zip(resolutions);
    let finding = |(link, step): (&LinkSeries, &f64)| {
        let (_, [least, most]) = range(link);
        (*step > 0.0 && most - least <= STEPS * step).then(|| {
            let [range, step] = [most - least, *step].map(|angle| rounded(angle, 2));
            let text = format!(
                "the angles of `{}` change by {range} rad and are rounded to {step} rad: they show \
                 no motion",
                link.name
            );
            Finding::new(Basis::Doubtful, text)
        })
    };
    links.filter_map(finding).collect()
}

/// Returns an error if angles have so many turns that a single turn is lost in their rounding.
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
