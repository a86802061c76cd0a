//! From a table to angles of the links of a tree, counted from gravity while they move.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use branched_pendulum_data::{
    AngleColumns, AngleZero, Basis, Clock, Finding, LinkMarkers, Markers, Recording, Repeated,
    Sample, Table, TableOptions, read_angles,
};
use branched_pendulum_measure::identification::AngleRecord;

use super::{Counts, MeasuredFile, Zero};
use crate::Failure;
use crate::subject::Subject;

/// Angles of rest that differ by less are one place, rad: what a search for it leaves.
const SAME_PLACE: f64 = 1e-6;

/// The links of a tree whose angles are read.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredLinks {
    names: Vec<String>,
    parents: Vec<Option<usize>>,
    /// Angles at which the tree hangs at rest, rad; of no use without a stretch at rest.
    rest: Vec<f64>,
    /// Offsets that are known, rad: none where none of them is.
    offsets: Option<Vec<f64>>,
}

/// Angles of links, as a file tells them.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredAngles {
    /// The angles from gravity, while the tree moves.
    pub recording: Recording,
    /// What the links show where they are at 0, rad, which is taken from the angles.
    pub offsets: Vec<f64>,
    /// The time until which the links were held, where they were, s.
    pub release: Option<f64>,
}

impl MeasuredLinks {
    /// Returns the links of a tree with the offsets of those that are known.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where the place of rest is asked for by `--rest` and is not found.
    pub fn new(
        subject: &Subject,
        offsets: &[(String, f64)],
        file: &MeasuredFile,
    ) -> Result<Self, Failure> {
        let names = subject.tree.names().to_vec();
        let zeros = vec![0.0; names.len()];
        let rest = match file.rest {
            None => zeros,
            Some(_) => subject.tree.equilibrium(&zeros).map_err(|error| {
                let what = format!(
                    "no place was found where `{}` rests ({error}): give what links show there by \
                     --tilt in place of --rest",
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
    /// Returns true if the tree of the other hangs at rest at other angles.
    pub fn rests_elsewhere(&self, other: &Self) -> bool {
        let pairs = self.rest.iter().zip(&other.rest);
        pairs.into_iter().any(|(a, b)| (a - b).abs() > SAME_PLACE)
    }
}

impl MeasuredFile {
    /// Reads `file` with what is known of it.
    ///
    /// # Errors
    /// [`Failure::Reading`], [`Failure::Links`] or [`Failure::Lacking`].
    pub fn read(&self, file: &Path, links: &MeasuredLinks) -> Result<MeasuredAngles, Failure> {
        self.angles(&Table::read(file, &TableOptions::default())?, links)
    }

    /// Takes the angles of links out of a table.
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
            turn_back(&mut recording, &vec![tilt.to_radians(); found]);
            recording.findings.push(Finding {
                basis: Basis::Given,
                text: format!("angles less {tilt}°, at which a link hangs at rest"),
            });
        }
        let offsets = self.offsets(&recording, links)?;
        if let Some((offsets, finding)) = &offsets {
            turn_back(&mut recording, offsets);
            recording.findings.push(finding.clone());
        }
        let release = self.cut(&mut recording, links)?;
        Ok(MeasuredAngles {
            recording,
            offsets: offsets.map_or_else(|| vec![0.0; found], |(offsets, _)| offsets),
            release,
        })
    }

    fn recording(&self, table: &Table, parents: &[Option<usize>]) -> Result<Recording, Failure> {
        let clock = self.clock();
        let mut table = Cow::Borrowed(table);
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

    fn clock(&self) -> Clock {
        match (&self.time, self.frame_rate) {
            (Some(column), _) => Clock::Column(column.clone()),
            (None, Some(rate)) => Clock::FrameRate(rate),
            (None, None) => Clock::Detect,
        }
    }

    /// What links show at 0, by a stretch at rest or as it is known, with words about it; none where
    /// nothing is known.
    fn offsets(
        &self,
        recording: &Recording,
        links: &MeasuredLinks,
    ) -> Result<Option<(Vec<f64>, Finding)>, Failure> {
        let told = |offsets: &[f64]| {
            let each = links.names.iter().zip(offsets);
            let each = each.map(|(name, offset)| format!("`{name}` {:.3}°", offset.to_degrees()));
            each.collect::<Vec<_>>().join(", ")
        };
        let (Some([from, to]), known) = (self.rest, &links.offsets) else {
            let known = links.offsets.clone();
            return Ok(known.map(|offsets| {
                let text = format!("angles less the offsets of links: {}", told(&offsets));
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
                "--rest {from}:{to} is no stretch at rest, {unrest}: name one in which all links \
                 hang still"
            ),
        })?;
        let offsets = means.iter().zip(&links.rest);
        // Links may have turned before they rest.
        let offsets = offsets.map(|(mean, rest)| (mean - rest + PI).rem_euclid(TAU) - PI);
        let offsets: Vec<f64> = offsets.collect();
        let text = format!(
            "offsets of links by their rest from {from} s to {to} s: {}",
            told(&offsets)
        );
        let basis = Basis::Detected;
        Ok(Some((offsets, Finding { basis, text })))
    }

    /// Leaves what comes before and after the motion out. Returns the time until which the links
    /// were held, where that was found.
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
                    "--from and --to leave nothing: the file has angles from {first} s to {last} s"
                ),
            }),
            _ => Ok(release),
        }
    }
}

/// Deviation of angles beside each other, rad: all are equally good.
const DEVIATION: f64 = 1e-3;

/// Angles as they are looked at for rest.
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

/// Counts the angles of each link from what it shows where it is at 0 (rad).
fn turn_back(recording: &mut Recording, offsets: &[f64]) {
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

/// Begins and ends a recording with a time at which something was measured.
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

/// Keeps the times from one on to another.
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
