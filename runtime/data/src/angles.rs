//! Angles that stand in columns.

use std::f64::consts::PI;

use super::angle_unit;
use super::circle;
use super::clock::{Clock, TimeColumns};
use super::error::{ReadError, ReadErrorKind};
use super::exchange::{self, Angle};
use super::finding::{Basis, Finding};
use super::names::{Meaning, quoted};
use super::outliers::resolution;
use super::recording::{LinkSeries, Recording, check_memory, check_motion, check_width};
use super::sample::Sample;
use super::table::Table;
use super::timing::Times;
use super::units::AngleUnit;

/// Direction of a link at angle 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleZero {
    /// Hanging.
    Down,
    /// Standing.
    Up,
}

/// Form of the angles in the columns of a table; `None` is detected or assumed.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleColumns {
    /// Source of the times.
    pub clock: Clock,
    /// Columns of the links, by name, in the order of the model. If empty, all columns are used,
    /// except columns with times, frame numbers, text or units other than angles.
    pub columns: Vec<String>,
    /// Unit of the angles. `None`: the unit of the header or of the cells, or radians, reported as
    /// doubtful, if all values are within a turn.
    pub unit: Option<AngleUnit>,
    /// Direction of angle 0. `None`: upwards if the links are on average nearer to half a turn,
    /// else downwards.
    pub zero: Option<AngleZero>,
    /// Measured angle of a hanging link, in rad; it is subtracted before the direction of angle 0
    /// is detected. 0 if camera or encoder are plumb.
    pub tilt: f64,
    /// For each link, the index of the link relative to which its angle is measured, or `None` for
    /// the vertical; empty if all are measured from the vertical. A link must come after the one it
    /// refers to.
    pub relative_to: Vec<Option<usize>>,
    /// True if positive angles turn in the direction opposite to the model's.
    pub mirrored: bool,
    /// Deviation from the neighbours, relative to the usual one, above which samples are marked as
    /// outliers; `None` marks no sample.
    pub outliers: Option<f64>,
}

impl Default for AngleColumns {
    fn default() -> Self {
        Self {
            clock: Clock::Detect,
            columns: Vec::new(),
            unit: None,
            zero: None,
            tilt: 0.0,
            relative_to: Vec::new(),
            mirrored: false,
            outliers: Some(25.0),
        }
    }
}

impl AngleColumns {
    /// Reads the angles from the columns of a table.
    ///
    /// # Errors
    /// [`ReadError`]: columns that do not exist, are named twice or contain something else,
    /// times that do not ascend, frames without a rate, a unit that cannot be determined.
    pub fn read(&self, table: &Table) -> Result<Recording, ReadError> {
        let times = Times::read(table, &self.clock)?;
        let mut findings = Vec::new();
        let columns = self.find_columns(table, &times.columns, &mut findings)?;
        self.check_parents(table, columns.len())?;
        check_memory(table, columns.len())?;
        let values: Vec<&[Option<f64>]> = columns
            .iter()
            .map(|&column| table.values(column))
            .collect::<Result<_, _>>()?;
        let unit = angle_unit::read(self.unit, table, &columns, &mut findings)?.radians();
        let sample = |value: &Option<f64>| match value {
            Some(value) => Sample::Measured(unit * value),
            None => Sample::Missing,
        };
        let mut links: Vec<LinkSeries> = columns
            .iter()
            .zip(values)
            .map(|(&column, values)| LinkSeries {
                name: table.columns()[column].name.clone(),
                samples: values.iter().map(sample).collect(),
                marker_distance: None,
            })
            .collect();
        // Before angles are added: a dead encoder on a link that moves.
        check_motion(table, &links)?;
        let resolutions = links.iter().map(|link| {
            let values = 0..link.samples.len();
            resolution(values.filter_map(|index| link.angle(index)))
        });
        let resolutions: Vec<f64> = resolutions.collect();
        if self.outliers.is_some() {
            mend_exchanges(&times, &resolutions, &mut links, &mut findings);
        }
        self.to_downward_vertical(&mut links, &mut findings);
        Recording::new(table, times, links, &resolutions, self.outliers, findings)
    }

    fn check_parents(&self, table: &Table, links: usize) -> Result<(), ReadError> {
        let count = self.relative_to.len();
        let what = if count != 0 && count != links {
            format!("{count} links to measure from for {links} angles")
        } else {
            let later = self.relative_to.iter().enumerate();
            let mut later = later.filter(|(link, parent)| parent.is_some_and(|p| p >= *link));
            match later.next() {
                Some((link, _)) => {
                    format!("link {link} is measured from one that is not before it")
                }
                None => return Ok(()),
            }
        };
        Err(table.refused(ReadErrorKind::Option { what }))
    }

    fn find_columns(
        &self,
        table: &Table,
        time: &TimeColumns,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<usize>, ReadError> {
        if !self.columns.is_empty() {
            return self.named_columns(table, time);
        }
        let all = table.columns();
        let (mut columns, mut aside) = (Vec::new(), Vec::new());
        for (index, column) in all.iter().enumerate() {
            match Meaning::of(column, all) {
                Meaning::Time | Meaning::Frame => {}
                _ if time.contain(index) => {}
                Meaning::OtherUnit => aside.push(index),
                _ if !table.has_numbers(index) => aside.push(index),
                Meaning::OtherName(quantity) => {
                    let name = column.name.clone();
                    return Err(table.refused(ReadErrorKind::NotAngle { name, quantity }));
                }
                Meaning::Angle | Meaning::Unsaid => columns.push(index),
            }
        }
        if columns.is_empty() {
            return Err(
                match aside.iter().find(|&&index| table.has_numbers(index)) {
                    Some(&index) => angle_unit::refused(table, index),
                    None => {
                        let what = "no columns are left for angles".to_owned();
                        table.refused(ReadErrorKind::Nothing { what })
                    }
                },
            );
        }
        check_width(table, columns.len(), "columns")?;
        self.refuse_points(table, &columns)?;
        let names = |columns: &[usize]| {
            let names: Vec<&str> = columns.iter().map(|&c| all[c].name.as_str()).collect();
            quoted(&names)
        };
        if !aside.is_empty() {
            let text = format!("no angles, by units or as text: {}", names(&aside));
            findings.push(Finding::new(Basis::Detected, text));
        }
        let text = format!("angles of the links, in this order: {}", names(&columns));
        findings.push(Finding::new(Basis::Assumed, text));
        Ok(columns)
    }

    /// Returns an error if pairs of columns lie on circles, as coordinates of points do.
    fn refuse_points(&self, table: &Table, columns: &[usize]) -> Result<(), ReadError> {
        let all = table.columns();
        let is_unsaid = |column: &usize| {
            self.unit.is_none() && Meaning::of(&all[*column], all) == Meaning::Unsaid
        };
        let pairs = columns.windows(2);
        for pair in pairs.filter(|pair| pair.iter().all(is_unsaid)) {
            let [x, y] = [table.values(pair[0])?, table.values(pair[1])?];
            if let Some(radius) = circle::radius(x, y) {
                let what = format!(
                    "columns `{}` and `{}` lie on a circle of radius {radius:.4}, as the \
                     coordinates of a point do; name the columns of the angles, or the points",
                    all[pair[0]].name, all[pair[1]].name
                );
                return Err(table.refused(ReadErrorKind::Option { what }));
            }
        }
        Ok(())
    }

    fn named_columns(&self, table: &Table, time: &TimeColumns) -> Result<Vec<usize>, ReadError> {
        let mut columns = Vec::with_capacity(self.columns.len());
        for name in &self.columns {
            let column = table.column(name)?;
            let what = if columns.contains(&column) {
                format!("column `{name}` is named twice; each link has one of its own")
            } else if time.contain(column) {
                format!("column `{name}` is the time; name the columns of the angles")
            } else if table.values(column)?.iter().all(Option::is_none) {
                format!("column `{name}` holds no number")
            } else {
                columns.push(column);
                continue;
            };
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        Ok(columns)
    }

    /// Converts angles to ones measured from the downward vertical, in the model's direction of
    /// rotation.
    fn to_downward_vertical(&self, links: &mut [LinkSeries], findings: &mut Vec<Finding>) {
        if self.mirrored {
            findings.push(Finding::new(
                Basis::Given,
                "positive angles turn the other way",
            ));
            for link in &mut *links {
                each(&mut link.samples, |value| -value);
            }
        }
        let is_relative = self.relative_to.iter().any(Option::is_some);
        let roots = || (0..links.len()).filter(|&link| self.parent(link).is_none());
        if self.tilt != 0.0 {
            for link in roots().collect::<Vec<_>>() {
                each(&mut links[link].samples, |value| value - self.tilt);
            }
        }
        let roots = || (0..links.len()).filter(|&link| self.parent(link).is_none());
        let (basis, zero) = match self.zero {
            Some(zero) => (Basis::Given, zero),
            None => match roots().all(|link| is_nearer_up(&links[link].samples)) {
                true => (Basis::Detected, AngleZero::Up),
                false => (Basis::Assumed, AngleZero::Down),
            },
        };
        if self.zero.is_none() && zero == AngleZero::Up {
            let text = "angles are nearer to half a turn than to none, and were taken as counted from \
                        the upward vertical; if they count from the downward one, say so (zero: down)";
            findings.push(Finding::new(Basis::Doubtful, text));
        }
        let (word, offset) = match zero {
            AngleZero::Down => ("downward", 0.0),
            AngleZero::Up => ("upward", PI),
        };
        findings.push(Finding::new(
            basis,
            format!("angles from the {word} vertical"),
        ));
        for link in roots().collect::<Vec<_>>() {
            each(&mut links[link].samples, |value| value - offset);
        }
        let (basis, text) = match (is_relative, self.relative_to.is_empty()) {
            (true, _) => (Basis::Given, "angles from other links"),
            (false, false) => (Basis::Given, "angles of all links from the vertical"),
            (false, true) => (Basis::Assumed, "angles of all links from the vertical"),
        };
        findings.push(Finding::new(basis, text));
        for link in 0..links.len() {
            if let Some(parent) = self.parent(link) {
                let (before, rest) = links.split_at_mut(link);
                add(&mut rest[0].samples, &before[parent].samples);
            }
        }
    }

    /// Returns true if an option is set that applies to columns of angles only.
    pub(crate) fn is_asked_for(&self) -> bool {
        let Self {
            columns,
            unit,
            zero,
            relative_to,
            ..
        } = self;
        !columns.is_empty() || unit.is_some() || zero.is_some() || !relative_to.is_empty()
    }

    fn parent(&self, link: usize) -> Option<usize> {
        self.relative_to.get(link).copied().flatten()
    }
}

/// Exchanges the angles of links back in rows in which they have changed places.
fn mend_exchanges(
    times: &Times,
    resolutions: &[f64],
    links: &mut [LinkSeries],
    findings: &mut Vec<Finding>,
) {
    let interval = times.timing.interval;
    let angles = |link: &LinkSeries| {
        (0..link.samples.len())
            .map(|index| link.angle(index))
            .collect()
    };
    let mut series: Vec<Vec<Option<f64>>> = links.iter().map(angles).collect();
    let exchanges = exchange::mend(&times.seconds, interval, resolutions, &mut series, Angle);
    if exchanges.is_empty() {
        return;
    }
    let names: Vec<&str> = links.iter().map(|link| link.name.as_str()).collect();
    findings.extend(exchange::exchange_findings(
        &exchanges,
        &names,
        &times.seconds,
        interval,
    ));
    for (link, angles) in links.iter_mut().zip(series) {
        let samples = angles
            .into_iter()
            .map(|angle| angle.map_or(Sample::Missing, Sample::Measured));
        link.samples = samples.collect();
    }
}

fn each(samples: &mut [Sample], change: impl Fn(f64) -> f64) {
    for sample in samples {
        if let Sample::Measured(value) = sample {
            *value = change(*value);
        }
    }
}

fn add(samples: &mut [Sample], parent: &[Sample]) {
    for (sample, parent) in samples.iter_mut().zip(parent) {
        *sample = match (*sample, *parent) {
            (Sample::Measured(own), Sample::Measured(parent)) => Sample::Measured(own + parent),
            _ => Sample::Missing,
        };
    }
}

/// Returns true if the angles of a link, assumed to be hanging, are nearer to half a turn than to
/// zero: their mean cosine is negative.
fn is_nearer_up(samples: &[Sample]) -> bool {
    let cosines = samples.iter().filter_map(|sample| match sample {
        Sample::Measured(value) => Some(value.cos()),
        _ => None,
    });
    cosines.sum::<f64>() < 0.0
}
