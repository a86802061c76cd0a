//! Angles against time, as the rest of the project takes them.

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding, counted, listed, moments};
use super::outliers::{self, Marked};
use super::sample::Sample;
use super::table::Table;
use super::timing::{Times, Timing};
use super::turns::{self, Turns};

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
    /// Doubts first, then facts detected, assumed and marked, those of the table before others.
    pub findings: Vec<Finding>,
}

impl Recording {
    /// Angles of links as they were read: takes jumps of a turn out and marks outliers.
    /// `resolutions` (rad) are the steps in which angles of the links were counted or written.
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
        let Times {
            seconds,
            timing,
            findings: of_times,
            ..
        } = times;
        let mut findings = table.findings().to_vec();
        findings.extend(of_times.into_iter().chain(of_angles));
        let mut all = Vec::with_capacity(links.len());
        for (link, resolution) in links.iter_mut().zip(resolutions) {
            let turns = turns::count(&seconds, &mut link.samples, &timing);
            check_turns(table, &seconds, &timing, link, &turns)?;
            let marked = outliers.map(|threshold| {
                outliers::mark(&seconds, &mut link.samples, threshold, *resolution, &turns)
            });
            all.push((turns, marked));
        }
        let marks = Marks {
            times: &seconds,
            interval: timing.interval,
            links: &links,
            all: &all,
        };
        findings.extend(marks.findings(outliers));
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

/// Refuses a series that jumps too often to be angles of a link.
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

/// What was done to the links, to be told by kinds.
struct Marks<'a> {
    times: &'a [f64],
    interval: f64,
    links: &'a [LinkSeries],
    all: &'a [(Turns, Option<Marked>)],
}

impl Marks<'_> {
    /// Lists the links for which there is something to tell; nothing if there is none.
    fn of_links(&self, of: impl Fn(&Turns, Option<&Marked>) -> Option<String>) -> Option<String> {
        let links = self.links.iter().zip(self.all);
        let told = links.filter_map(|(link, (turns, marked))| {
            Some(format!("`{}`: {}", link.name, of(turns, marked.as_ref())?))
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| listed(told.into_iter()))
    }

    fn at(&self, rows: &[usize], thing: &str) -> Option<String> {
        let places = || moments(self.times, rows, self.interval);
        (!rows.is_empty()).then(|| format!("{} ({})", counted(rows.len(), thing), places()))
    }

    fn findings(&self, threshold: Option<f64>) -> Vec<Finding> {
        let jumps = self.of_links(|turns, _| self.at(&turns.jumps, "jump"));
        let jumps = jumps.map(|told| format!("jumps of a turn were taken out: {told}"));
        let doubtful = self.of_links(|turns, _| self.at(&turns.doubtful, "place"));
        let doubtful = doubtful.map(|told| {
            format!(
                "turns from there on are the nearest ones and may be others, behind gaps, sudden \
                 changes, or in a whirl of fewer than four samples a turn: {told}"
            )
        });
        let marked = self.of_links(|_, marked| match marked? {
            Marked::Rows(rows) => self.at(rows, "outlier"),
            Marked::TooMany(_) => None,
        });
        let marked = marked.zip(threshold).map(|(told, threshold)| {
            format!("{told}, beyond {threshold} times the usual deviation from their neighbours")
        });
        let too_many = self.of_links(|_, marked| match marked? {
            Marked::Rows(_) => None,
            Marked::TooMany(count) => Some(format!("{count} samples")),
        });
        let too_many = too_many.map(|told| {
            format!(
                "no outliers, since so many would be: {told}; the motion is too fast for this rate, \
                 or the noise comes in spikes"
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
        let told = |(basis, text): (Basis, Option<String>)| Some(Finding::new(basis, text?));
        all.into_iter().filter_map(told).collect()
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
