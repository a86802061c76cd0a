//! Angles that stand in columns.

use std::f64::consts::PI;

use super::error::{ReadError, ReadErrorKind};
use super::exchange::{self, Angle};
use super::finding::{Basis, Finding};
use super::header::is_frame;
use super::outliers::resolution;
use super::recording::{LinkSeries, Recording, Sample};
use super::table::Table;
use super::timing::{Clock, Times};

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Radians.
    Radians,
    /// Degrees.
    Degrees,
}

/// Direction of a link at angle 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleZero {
    /// Hanging.
    Down,
    /// Standing.
    Up,
}

/// How angles stand in the columns of a table; what is `None` is detected or assumed.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleColumns {
    /// Where the times come from.
    pub clock: Clock,
    /// Columns of the links, by name, in the order of the model; empty for all columns but
    /// that of the time.
    pub columns: Vec<String>,
    /// Unit; without it that of the header, or radians where the values are a few turns at
    /// most.
    pub unit: Option<AngleUnit>,
    /// Direction of angle 0; without it up where the links are on the whole nearer to half a
    /// turn, else down.
    pub zero: Option<AngleZero>,
    /// For each link the index of the one that its angle is measured from, or none for the
    /// vertical; empty for all from the vertical. A link stands behind the one that it is
    /// measured from.
    pub relative_to: Vec<Option<usize>>,
    /// True if positive angles turn the other way than the model's.
    pub mirrored: bool,
    /// Deviations from neighbours, in usual ones, beyond which samples are marked as
    /// outliers; none marks no sample.
    pub outliers: Option<f64>,
}

impl Default for AngleColumns {
    fn default() -> Self {
        Self {
            clock: Clock::Detect,
            columns: Vec::new(),
            unit: None,
            zero: None,
            relative_to: Vec::new(),
            mirrored: false,
            outliers: Some(25.0),
        }
    }
}

impl AngleColumns {
    /// Takes the angles out of a table.
    ///
    /// # Errors
    /// [`ReadError`]: columns that do not exist, a time that does not ascend, frames without
    /// a rate, a unit that cannot be made out.
    pub fn read(&self, table: &Table) -> Result<Recording, ReadError> {
        let times = Times::read(table, &self.clock)?;
        let mut findings = Vec::new();
        let columns = self.find_columns(table, times.column, &mut findings)?;
        self.check_parents(table, columns.len())?;
        let unit = self.unit_of(table, &columns, &mut findings)?;
        let mut links: Vec<LinkSeries> = columns
            .iter()
            .map(|&column| LinkSeries {
                name: table.columns()[column].name.clone(),
                samples: table
                    .values(column)
                    .iter()
                    .map(|value| match value {
                        Some(value) => Sample::Measured(unit * value),
                        None => Sample::Missing,
                    })
                    .collect(),
                marker_distance: None,
            })
            .collect();
        let resolutions = links.iter().map(|link| {
            let values = 0..link.samples.len();
            resolution(values.filter_map(|index| link.angle(index)))
        });
        let resolutions: Vec<f64> = resolutions.collect();
        if self.outliers.is_some() {
            mend_exchanges(&times, &resolutions, &mut links, &mut findings);
        }
        self.turn(&mut links, &mut findings);
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
        time: Option<usize>,
        findings: &mut Vec<Finding>,
    ) -> Result<Vec<usize>, ReadError> {
        if !self.columns.is_empty() {
            return self.columns.iter().map(|name| table.column(name)).collect();
        }
        let others = table
            .columns()
            .iter()
            .enumerate()
            .filter(|(index, column)| Some(*index) != time && !is_frame(&column.name));
        let columns: Vec<usize> = others.map(|(index, _)| index).collect();
        if columns.is_empty() {
            let what = "no columns are left for angles".to_owned();
            return Err(table.refused(ReadErrorKind::Nothing { what }));
        }
        let names: Vec<String> = columns
            .iter()
            .map(|&c| format!("`{}`", table.columns()[c].name))
            .collect();
        let text = format!("angles of the links, in this order: {}", names.join(", "));
        findings.push(Finding::new(Basis::Assumed, text));
        Ok(columns)
    }

    /// Radians of one unit of the columns.
    fn unit_of(
        &self,
        table: &Table,
        columns: &[usize],
        findings: &mut Vec<Finding>,
    ) -> Result<f64, ReadError> {
        let (basis, unit) = match self.unit {
            Some(unit) => (Basis::Given, unit),
            None => self.find_unit(table, columns)?,
        };
        let (word, scale) = match unit {
            AngleUnit::Radians => ("radians", 1.0),
            AngleUnit::Degrees => ("degrees", PI / 180.0),
        };
        findings.push(Finding::new(basis, format!("angles in {word}")));
        Ok(scale)
    }

    fn find_unit(&self, table: &Table, columns: &[usize]) -> Result<(Basis, AngleUnit), ReadError> {
        let mut found = None;
        for &column in columns {
            let own = &table.columns()[column];
            let unit = match own.unit.as_str() {
                "" => continue,
                "rad" | "radians" => AngleUnit::Radians,
                "deg" | "degree" | "degrees" | "°" => AngleUnit::Degrees,
                _ => {
                    return Err(table.refused(ReadErrorKind::Unit {
                        name: own.name.clone(),
                        unit: own.unit.clone(),
                        quantity: "an angle",
                    }));
                }
            };
            if found.is_some_and(|other| other != unit) {
                let what = "columns of angles in degrees beside some in radians".to_owned();
                return Err(table.refused(ReadErrorKind::Option { what }));
            }
            found = Some(unit);
        }
        if let Some(unit) = found {
            return Ok((Basis::Detected, unit));
        }
        // Swings stay within some turns, and few are within two degrees.
        const TURNS_RAD: f64 = 4.0 * PI;
        let size = |column: usize| {
            let values = table.values(column).iter().flatten();
            values.fold(0.0_f64, |largest, value| largest.max(value.abs()))
        };
        let largest = columns.iter().map(|&column| (size(column), column));
        let (largest, column) = largest.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        if largest <= TURNS_RAD {
            return Ok((Basis::Assumed, AngleUnit::Radians));
        }
        let name = table.columns()[column].name.clone();
        Err(table.refused(ReadErrorKind::AngleUnit { name, largest }))
    }

    /// Angles from the downward vertical, in the model's sense.
    fn turn(&self, links: &mut [LinkSeries], findings: &mut Vec<Finding>) {
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

    fn parent(&self, link: usize) -> Option<usize> {
        self.relative_to.get(link).copied().flatten()
    }
}

/// Gives links whose angles changed places in some rows their own ones back.
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
    findings.extend(exchange::told(&exchanges, &names, &times.seconds, interval));
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

/// Returns true if a link that hangs would have its angles nearer to half a turn than to
/// none: the mean cosine is negative.
fn is_nearer_up(samples: &[Sample]) -> bool {
    let cosines = samples.iter().filter_map(|sample| match sample {
        Sample::Measured(value) => Some(value.cos()),
        _ => None,
    });
    cosines.sum::<f64>() < 0.0
}
