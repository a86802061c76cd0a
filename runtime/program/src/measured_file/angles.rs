//! Conversion of a table to angles of a tree's links, measured from the direction of gravity while
//! they move.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use branched_pendulum_data::{
    AngleColumns, AngleZero, Basis, Clock, Finding, LinkMarkers, Markers, ReadError, Recording,
    Repeated, Sample, Table, TableOptions, read_angles,
};
use branched_pendulum_measure::identification::AngleRecord;

use super::stretches;
use super::{Counts, MeasuredFile, Zero};
use crate::Failure;
use crate::subject::Subject;

/// Difference (rad) below which equilibrium angles count as equal; a search leaves smaller
/// differences.
const SAME_PLACE: f64 = 1e-6;

/// Links of a tree whose angles are read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredLinks {
    names: Vec<String>,
    parents: Vec<Option<usize>>,
    /// Angles at which the tree hangs at rest, in rad; unused unless the file has a part at rest.
    rest: Vec<f64>,
    /// Known offsets of the links' angles, in rad; `None` if no offset is known.
    offsets: Option<Vec<f64>>,
}

/// Angles of links that were read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredAngles {
    /// Angles measured from the direction of gravity, while the tree moves.
    pub recording: Recording,
    /// Measured angles (rad) of links whose true angle is 0; they are subtracted.
    pub offsets: Vec<f64>,
    /// Time (s) at which the links were released, if they were held before.
    pub release: Option<f64>,
}

impl MeasuredAngles {
    /// If long gaps divide the record, keeps the part with the most rows.
    pub fn keep_longest_stretch(&mut self) {
        stretches::keep_longest(&mut self.recording);
    }
}

impl MeasuredLinks {
    /// Returns the links of a tree, with the known offsets of their angles.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if `--rest` needs the equilibrium of the tree and it is not found.
    pub fn new(
        subject: &Subject,
        offsets: &[(String, f64)],
        file: &MeasuredFile,
    ) -> Result<Self, Failure> {
        let names = subject.tree.names().to_vec();
        let zeros = vec![0.0; names.len()];
        let rest = match file.rest {
            None => zeros,
            Some(_) => subject.rest().map_err(|error| {
                let what = format!(
                    "found no rest position of `{}` ({error}): give the measured angles of the \
                     resting links by --tilt instead of --rest",
                    subject.name
                );
                Failure::Lacking { what }
            })?,
        };
        let offset = |name: &String| {
            let own = offsets.iter().find(|(own, _)| own == name);
            own.map_or(0.0, |(_, offset)| *offset)
        };
        Ok(Self {
            offsets: (!offsets.is_empty()).then(|| names.iter().map(offset).collect()),
            parents: subject.parents(),
            names,
            rest,
        })
    }
}

impl MeasuredLinks {
    /// Returns true if the tree of `other` hangs at rest at other angles.
    pub fn rests_elsewhere(&self, other: &Self) -> bool {
        let pairs = self.rest.iter().zip(&other.rest);
        pairs.into_iter().any(|(a, b)| (a - b).abs() > SAME_PLACE)
    }
}

impl MeasuredFile {
    /// Reads angles from `file`, interpreted by these options.
    ///
    /// # Errors
    /// [`Failure::Reading`], [`Failure::Links`] or [`Failure::Lacking`].
    pub fn read(&self, file: &Path, links: &MeasuredLinks) -> Result<MeasuredAngles, Failure> {
        self.angles(&self.table(file)?, links)
    }

    /// Reads the table in `file`.
    ///
    /// # Errors
    /// Errors of [`Table::read`].
    pub fn table(&self, file: &Path) -> Result<Table, ReadError> {
        let options = TableOptions {
            sheet: self.sheet.clone(),
            ..TableOptions::default()
        };
        Table::read(file, &options)
    }

    /// Extracts the angles of the links from a table.
    ///
    /// # Errors
    /// Errors of [`read`](Self::read).
    pub fn angles(&self, table: &Table, links: &MeasuredLinks) -> Result<MeasuredAngles, Failure> {
        let mut recording = self.recording(table, &links.parents)?;
        let found = recording.links.len();
        if found != links.parents.len() {
            return Err(Failure::Links {
                path: table.path().to_path_buf(),
                found,
                needed: links.parents.len(),
            });
        }
        if let Some(tilt) = self.tilt {
            // From columns it was subtracted before the vertical was detected.
            if self.takes_dots(table) {
                subtract_offsets(&mut recording, &vec![tilt.to_radians(); found]);
            }
            recording.findings.push(Finding {
                basis: Basis::Given,
                text: format!("angles less {tilt}°, at which a link hangs at rest"),
            });
        }
        let offsets = self.offsets(&recording, links)?;
        if let Some((offsets, finding)) = &offsets {
            subtract_offsets(&mut recording, offsets);
            recording.findings.push(finding.clone());
        }
        let release = self.cut(&mut recording, links)?;
        stretches::leave_fragments_out(&mut recording);
        recording.check_motion(table.path())?;
        stretches::check_memory(table.path(), &recording)?;
        Ok(MeasuredAngles {
            recording,
            offsets: offsets.map_or_else(|| vec![0.0; found], |(offsets, _)| offsets),
            release,
        })
    }

    fn recording(&self, table: &Table, parents: &[Option<usize>]) -> Result<Recording, Failure> {
        let clock = self.clock();
        let mut table = Cow::Borrowed(table);
        if let Some(number) = self.recording {
            table = Cow::Owned(table.into_owned().recording(&clock, number)?);
        }
        if let Some(counts) = self.drop_repeated {
            let counts = match counts {
                Counts::First => Repeated::First,
                Counts::Last => Repeated::Last,
            };
            table = Cow::Owned(table.into_owned().without_repeated_times(&clock, counts)?);
        }
        if !self.leave_out.is_empty() {
            table = Cow::Owned(table.into_owned().leaving_out(&clock, &self.leave_out)?);
        }
        let relative_to = self.relative.then(|| parents.to_vec());
        let columns = AngleColumns {
            clock: clock.clone(),
            columns: self.columns.clone(),
            unit: self.unit,
            zero: self.zero.map(|zero| match zero {
                Zero::Down => AngleZero::Down,
                Zero::Up => AngleZero::Up,
            }),
            tilt: self.tilt.unwrap_or(0.0).to_radians(),
            relative_to: relative_to.unwrap_or_default(),
            ..AngleColumns::default()
        };
        let dots = self.dots.iter().cloned();
        let markers = Markers {
            clock,
            links: dots
                .map(|(upper, lower)| LinkMarkers { upper, lower })
                .collect(),
            pivot: self.pivot,
            y_down: (self.y_down || self.y_up).then_some(self.y_down),
            ..Markers::default()
        };
        Ok(read_angles(&table, &columns, &markers)?)
    }

    /// Returns the times of all rows of a table, in s; `None` if a row has none, or if these options
    /// leave rows out.
    pub(crate) fn times(&self, table: &Table) -> Option<Vec<f64>> {
        if self.recording.is_some() || self.drop_repeated.is_some() {
            return None;
        }
        table.times(&self.clock()).ok()?.into_iter().collect()
    }

    fn clock(&self) -> Clock {
        match (&self.time, self.frame_rate) {
            (Some(column), _) => Clock::Column(column.clone()),
            (None, Some(rate)) => Clock::FrameRate(rate),
            (None, None) => Clock::Detect,
        }
    }

    /// Returns the measured angles of links whose true angle is 0, from a part of the record at
    /// rest or as given, with a statement about them; `None` if nothing is known.
    fn offsets(
        &self,
        recording: &Recording,
        links: &MeasuredLinks,
    ) -> Result<Option<(Vec<f64>, Finding)>, Failure> {
        let reported = |offsets: &[f64]| {
            let each = links.names.iter().zip(offsets);
            let each = each.map(|(name, offset)| format!("`{name}` {:.3}°", offset.to_degrees()));
            each.collect::<Vec<_>>().join(", ")
        };
        let (Some([from, to]), known) = (self.rest, &links.offsets) else {
            let known = links.offsets.clone();
            return Ok(known.map(|offsets| {
                let text = format!("angles less the offsets of links: {}", reported(&offsets));
                let basis = Basis::Given;
                (offsets, Finding { basis, text })
            }));
        };
        if known.is_some() {
            let what = "--rest and the offsets in the file of --parameters both tell where angles \
                        count from: leave out --rest, or the offsets in that file";
            return Err(Failure::Lacking {
                what: what.to_owned(),
            });
        }
        // Both ends belong to the stretch.
        let rest = record(recording, links).between(from, to.next_up());
        let means = rest.means_at_rest().map_err(|unrest| Failure::Lacking {
            what: format!(
                "during --rest {from}:{to} the links do not rest, {unrest}: give a time interval \
                 in which all links hang still"
            ),
        })?;
        let offsets = means.iter().zip(&links.rest);
        // Links may have turned before they rest.
        let offsets = offsets.map(|(mean, rest)| (mean - rest + PI).rem_euclid(TAU) - PI);
        let offsets: Vec<f64> = offsets.collect();
        let text = format!(
            "offsets of links by their rest from {from} s to {to} s: {}",
            reported(&offsets)
        );
        let basis = Basis::Detected;
        Ok(Some((offsets, Finding { basis, text })))
    }

    /// Removes the parts of the record before and after the motion. Returns the time of release, if
    /// it was found.
    fn cut(
        &self,
        recording: &mut Recording,
        links: &MeasuredLinks,
    ) -> Result<Option<f64>, Failure> {
        let all = [recording.times.first(), recording.times.last()].map(|time| time.copied());
        let to = self.to.unwrap_or(f64::INFINITY);
        keep(recording, [self.from.unwrap_or(f64::NEG_INFINITY), to]);
        if !self.leave_out.is_empty() {
            trim(recording);
        }
        let release = match self.from {
            None => record(recording, links).release(),
            Some(_) => None,
        };
        if let Some(release) = release {
            keep(recording, [release, to]);
            recording.findings.push(Finding {
                basis: Basis::Detected,
                text: format!(
                    "the links are held until {release} s: what comes before is left out (--from \
                     says otherwise)"
                ),
            });
        }
        match (recording.times.is_empty(), all) {
            (true, [Some(first), Some(last)]) => Err(Failure::Lacking {
                what: format!(
                    "no angles lie between --from and --to: the file has angles from {first} s \
                     to {last} s"
                ),
            }),
            _ => Ok(release),
        }
    }
}

/// Assumed standard deviation of neighbouring angles, rad; it is the same for all.
const DEVIATION: f64 = 1e-3;

/// Converts angles to a record in which parts at rest are searched for.
fn record(recording: &Recording, links: &MeasuredLinks) -> AngleRecord {
    let rows = 0..recording.times.len();
    let named = links.names.iter().zip(&recording.links);
    named.fold(
        AngleRecord::new(&recording.times),
        |record, (name, link)| {
            let angles: Vec<Option<f64>> = rows.clone().map(|row| link.angle(row)).collect();
            record.with_link(name, &angles, DEVIATION)
        },
    )
}

/// Subtracts from the angles of each link the angle (rad) that it shows when its true angle is 0.
fn subtract_offsets(recording: &mut Recording, offsets: &[f64]) {
    for (link, offset) in recording.links.iter_mut().zip(offsets) {
        for sample in &mut link.samples {
            match sample {
                Sample::Measured(angle) | Sample::Outlier(angle) | Sample::Unlikely(angle) => {
                    *angle -= offset;
                }
                _ => {}
            }
        }
    }
}

/// Removes times without any measured angle from both ends of a recording.
fn trim(recording: &mut Recording) {
    let is_measured = |row: &usize| {
        recording
            .links
            .iter()
            .any(|link| link.angle(*row).is_some())
    };
    let count = recording.times.len();
    let first = (0..count).find(is_measured).unwrap_or(count);
    let last = (0..count).rfind(is_measured).map_or(count, |last| last + 1);
    rows(recording, [first, last]);
}

/// Keeps the times between two given ones.
fn keep(recording: &mut Recording, [from, to]: [f64; 2]) {
    let first = recording.times.partition_point(|time| *time < from);
    let last = recording.times.partition_point(|time| *time <= to);
    rows(recording, [first, last.max(first)]);
}

fn rows(recording: &mut Recording, [first, last]: [usize; 2]) {
    recording.times.truncate(last);
    recording.times.drain(..first);
    for link in &mut recording.links {
        link.samples.truncate(last);
        link.samples.drain(..first);
    }
}
