//! Usual causes of a budget that does not close: a table that is to be read in another way.

mod unknowns;
mod words;

use std::fmt;

use branched_pendulum_data::{AngleUnit, FileKind, Table};

use super::arguments::Arguments;
use super::estimate::{Draws, Estimate, Measured};
use super::source::Source;
use super::subject::MeasuredTree;
use super::verdict::Verdict;
use super::wrong_pictures;
use crate::Failure;
use crate::frame::Progress;
use crate::measured_file::{MeasuredFile, MeasuredLinks, Zero};

/// Draws from which the closure of another reading follows; so many less where that is hopeless.
const DRAWS: usize = 40;
const FEW: usize = 6;

/// The kind of cause whose evidence are leaps in the record: without these pictures deviations may
/// be far larger.
const WRONG_PICTURES: &str = "wrong pictures";

/// The kind of cause that is no reading.
const FRICTION: &str = "friction";

/// Another reading of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// The kind, as it stands among those that were tried.
    kind: &'static str,
    /// What is so, in words.
    pub words: String,
    /// The option that reads the file so.
    pub option: String,
    reading: MeasuredFile,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.words, self.option)
    }
}

/// What became of a search for causes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CauseSearch {
    /// The causes that close the budget, the one that does it best first.
    pub closing: Vec<Cause>,
    /// Kinds that were tried.
    pub tried: Vec<&'static str>,
    /// Stretches of pictures that leap out of the motion, s.
    pub leaps: Vec<[f64; 2]>,
}

/// A record whose budget does not close.
pub struct Unclosed<'a> {
    /// The options by which it was read and estimated.
    pub arguments: &'a Arguments,
    /// The pendulum.
    pub subject: &'a MeasuredTree,
    /// The table.
    pub table: &'a Table,
    /// The links whose angles it holds.
    pub hung: &'a MeasuredLinks,
    /// What was read of it.
    pub source: &'a Source,
    /// The verdict.
    pub verdict: Verdict,
}

impl Unclosed<'_> {
    /// Tries the usual causes.
    ///
    /// # Errors
    /// [`Failure::Smoothing`] of the record as it was read.
    pub fn search(&self, progress: &Progress) -> Result<CauseSearch, Failure> {
        progress.begin("usual causes");
        let measured = Measured {
            subject: self.subject,
            record: self.source.record(),
        };
        let smooth = measured.by_smoothness(self.draws(DRAWS))?;
        let mut causes = match self.arguments.measured.is_of_dots(self.table) {
            true => self.of_dots(),
            false => self.of_columns(),
        };
        causes.extend(self.tilt(&measured, &smooth));
        let wrong = wrong_pictures::stretches(&measured);
        let mut search = CauseSearch {
            leaps: wrong.first().cloned().unwrap_or_default(),
            ..CauseSearch::default()
        };
        causes.extend(self.wrong_pictures(wrong));
        let mut closing = Vec::new();
        for (index, cause) in causes.iter().enumerate() {
            progress.tell(&format!(
                "{} ({} of {})",
                cause.kind,
                index + 1,
                causes.len()
            ));
            let Some(closes) = self.closes(cause) else {
                continue;
            };
            if !search.tried.contains(&cause.kind) {
                search.tried.push(cause.kind);
            }
            closing.extend(closes.map(|bars| (bars, cause.clone())));
        }
        if !self.arguments.model {
            // The equations of motion find friction with the motion.
            search.tried.push(FRICTION);
            closing.extend(self.friction(&measured, &smooth));
        }
        closing.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        search.closing = closing.into_iter().map(|(_, cause)| cause).collect();
        Ok(search)
    }

    fn draws(&self, count: usize) -> Draws {
        Draws {
            count,
            seed: self.arguments.seed,
        }
    }

    /// Reads the table in another way.
    fn read(&self, reading: &MeasuredFile) -> Option<Source> {
        let arguments = Arguments {
            measured: reading.clone(),
            ..self.arguments.clone()
        };
        Source::read(self.table, &arguments, self.hung).ok()
    }

    /// Estimates the motion as the record's own was, with the number of draws; by smoothness alone,
    /// and few draws, where these show already that the budget does not close.
    fn estimate(&self, source: &Source) -> Option<(Estimate, usize)> {
        let measured = Measured {
            subject: self.subject,
            record: source.record(),
        };
        let smooth = |draws| measured.by_smoothness(self.draws(draws)).ok();
        let closes = |found: &Estimate, draws| Verdict::of(&source.times, found, draws).closes();
        let few = smooth(FEW)?;
        if !closes(&few, FEW) {
            return Some((few, FEW));
        }
        let smooth = smooth(DRAWS)?;
        let found = match self.arguments.model && closes(&smooth, DRAWS) {
            true => measured.by_model(&smooth, self.draws(DRAWS)).ok()?,
            false => smooth,
        };
        Some((found, DRAWS))
    }

    /// Reads and estimates the table in another way: none where it cannot be read so or that is
    /// no other way, else whether the budget closes, by the largest closure in its deviations.
    fn closes(&self, cause: &Cause) -> Option<Option<f64>> {
        let source = self.read(&cause.reading)?;
        if source.angles == self.source.angles {
            return None;
        }
        let Some((estimate, draws)) = self.estimate(&source) else {
            return Some(None);
        };
        let found = Verdict::of(&source.times, &estimate, draws);
        let is_better = match cause.kind {
            WRONG_PICTURES => 2.0 * found.trust.closure < self.verdict.trust.closure,
            _ => self.would_be_told(&found),
        };
        Some((found.closes() && is_better).then_some(found.bars))
    }

    /// Returns true if a gap as large as that of the record would be told by the deviations of
    /// another reading, at most of the times at which it is told by its own.
    fn would_be_told(&self, other: &Verdict) -> bool {
        let own = &self.verdict;
        let pairs = own.closure.iter().zip(&other.closure).skip(1);
        let told = pairs.filter(|([gap, deviation], _)| gap.abs() > own.allowed * deviation);
        let by_other = told
            .clone()
            .filter(|([gap, _], [_, deviation])| gap.abs() > other.allowed * deviation);
        2 * by_other.count() > told.count()
    }

    fn cause(
        &self,
        kind: &'static str,
        words: impl Into<String>,
        option: impl Into<String>,
        read: impl FnOnce(&mut MeasuredFile),
    ) -> Cause {
        let mut reading = self.arguments.measured.clone();
        read(&mut reading);
        Cause {
            kind,
            words: words.into(),
            option: option.into(),
            reading,
        }
    }

    fn of_columns(&self) -> Vec<Cause> {
        let mut causes = Vec::new();
        for (unit, words, option) in [
            (AngleUnit::Degrees, "angles are degrees", "--unit deg"),
            (AngleUnit::Radians, "angles are radians", "--unit rad"),
        ] {
            causes.push(self.cause("unit", words, option, |file| file.unit = Some(unit)));
        }
        for (zero, words, option) in [
            (
                Zero::Up,
                "angles count from the upward vertical",
                "--zero up",
            ),
            (
                Zero::Down,
                "angles count from the downward vertical",
                "--zero down",
            ),
        ] {
            causes.push(self.cause("vertical", words, option, |file| file.zero = Some(zero)));
        }
        let names = &self.source.links;
        // A list cannot name what has a comma in it.
        let is_listed = names.iter().all(|name| !name.contains(','));
        for first in (1..names.len()).filter(|_| is_listed) {
            let mut columns = names.clone();
            let name = columns.remove(first);
            columns.insert(0, name);
            let words = format!(
                "`{}` is the first link, on which the rest hangs",
                columns[0]
            );
            let option = format!("--columns {}", shell(&columns.join(",")));
            causes.push(self.cause("order of links", words, option, |file| {
                file.columns = columns
            }));
        }
        let (words, option) = match self.arguments.measured.relative {
            false => (
                "later angles are counted from the links above",
                "--relative",
            ),
            true => ("all angles are counted from the vertical", "no --relative"),
        };
        let toggle = |file: &mut MeasuredFile| file.relative = !file.relative;
        causes.push(self.cause("relative angles", words, option, toggle));
        causes
    }

    fn of_dots(&self) -> Vec<Cause> {
        let measured = &self.arguments.measured;
        let y_down = measured.y_down || !measured.y_up && self.table.kind() == FileKind::DeepLabCut;
        let (words, option) = match y_down {
            true => (
                "y points upwards, or all links' dots are the other way round",
                "--y-up",
            ),
            false => (
                "y points downwards, or all links' dots are the other way round",
                "--y-down",
            ),
        };
        let mut causes = vec![self.cause("direction of y", words, option, |file| {
            (file.y_down, file.y_up) = (!y_down, y_down);
        })];
        let dots = measured.dots_of(self.table);
        let mut add = |kind, words: String, dots: Vec<(String, String)>| {
            let list = dots.iter().map(|(upper, lower)| format!("{upper}:{lower}"));
            let option = format!("--dots {}", shell(&list.collect::<Vec<_>>().join(",")));
            causes.push(self.cause(kind, words, option, |file| {
                (file.dots, file.pivot) = (dots, None);
            }));
        };
        for first in 1..dots.len() {
            let mut dots = dots.clone();
            let link = dots.remove(first);
            let (upper, lower) = &link;
            let words =
                format!("`{upper}` to `{lower}` is the first link, on which the rest hangs");
            dots.insert(0, link);
            add("order of links", words, dots);
        }
        for (index, (upper, lower)) in dots.iter().enumerate() {
            let words = format!("`{lower}` is the upper end of the link to `{upper}`");
            let mut dots = dots.clone();
            dots[index] = (lower.clone(), upper.clone());
            add("ends of links", words, dots);
        }
        let turned = || {
            dots.iter()
                .map(|(upper, lower)| (lower.clone(), upper.clone()))
        };
        let words = "the dots are listed from the free end to the pivot".to_owned();
        add("order of dots", words, turned().rev().collect());
        if let [(top, first), (middle, second)] = &dots[..]
            && first == middle
        {
            let words = format!("`{first}` is the free end, on `{second}`");
            let dots = [[top, second], [second, first]];
            let dots = dots.map(|[upper, lower]| (upper.clone(), lower.clone()));
            add("order of dots", words, dots.to_vec());
        }
        causes
    }

    fn wrong_pictures(&self, ways: Vec<Vec<[f64; 2]>>) -> Vec<Cause> {
        let causes = ways.into_iter().map(|stretches| {
            let told = stretches
                .iter()
                .map(|[from, to]| format!("from {from} s to {to} s"));
            let words = format!(
                "pictures with wrong or swapped markers are left out {}",
                told.collect::<Vec<_>>().join(", ")
            );
            let all = [&self.arguments.measured.leave_out[..], &stretches].concat();
            let list = all.iter().map(|[from, to]| format!("{from}:{to}"));
            let option = format!("--leave-out {}", list.collect::<Vec<_>>().join(","));
            self.cause(WRONG_PICTURES, words, option, |file| file.leave_out = all)
        });
        causes.collect()
    }
}

/// Stretches of time in words.
pub fn told(stretches: &[[f64; 2]]) -> String {
    let each = stretches
        .iter()
        .map(|[from, to]| format!("from {from} s to {to} s"));
    each.collect::<Vec<_>>().join(", ")
}

/// A value of an option as a shell takes it.
fn shell(value: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-.,:/".contains(c);
    match value.chars().all(is_plain) {
        true => value.to_owned(),
        false => format!("'{}'", value.replace('\'', r"'\''")),
    }
}
