//! Measured angles against time.

use super::error::{IdentificationError, positive};
use crate::smoothing::misplaced;

/// Angles of some links, measured at common times. Times may be uneven, and data may be missing.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct AngleRecord {
    times: Vec<f64>,
    pub(super) links: Vec<MeasuredLink>,
}

/// The measured angles of one link.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MeasuredLink {
    pub(super) name: String,
    pub(super) angles: Vec<Option<f64>>,
    pub(super) deviation: f64,
}

impl MeasuredLink {
    /// Returns the data that are not missing, each after the index of its time.
    pub(super) fn data(&self) -> Vec<(usize, f64)> {
        let data = self.angles.iter().enumerate();
        data.filter_map(|(sample, angle)| Some((sample, (*angle)?)))
            .collect()
    }
}

impl AngleRecord {
    /// Creates a record at these times (s), without angles.
    #[must_use]
    pub fn new(times: &[f64]) -> Self {
        Self {
            times: times.to_vec(),
            links: Vec::new(),
        }
    }

    /// Adds the absolute angles (rad, from the downward vertical, without jumps of a turn) of the
    /// link with that name; `None` for missing ones. `deviation` (rad) is their standard deviation
    /// relative to other data; only the ratio matters.
    #[must_use]
    pub fn with_link(mut self, name: &str, angles: &[Option<f64>], deviation: f64) -> Self {
        self.links.push(MeasuredLink {
            name: name.to_owned(),
            angles: angles.to_vec(),
            deviation,
        });
        self
    }

    /// Returns the times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the angles of a measured link, rad; `None` for other links.
    #[must_use]
    pub fn angles(&self, link: &str) -> Option<&[Option<f64>]> {
        let own = self.links.iter().find(|own| own.name == link);
        own.map(|own| own.angles.as_slice())
    }

    /// Returns the part of the record from the time `from` (s) up to but excluding `until` (s).
    #[must_use]
    pub fn between(&self, from: f64, until: f64) -> Self {
        let first = self.times.partition_point(|&time| time < from);
        let last = self.times.partition_point(|&time| time < until).max(first);
        let part = |link: &MeasuredLink| MeasuredLink {
            angles: link.angles.get(first..last).unwrap_or_default().to_vec(),
            ..link.clone()
        };
        Self {
            times: self.times.get(first..last).unwrap_or_default().to_vec(),
            links: self.links.iter().map(part).collect(),
        }
    }

    /// Checks the record, and returns the index of each measured link among all links.
    pub(super) fn check(&self, links: &[String]) -> Result<Vec<usize>, IdentificationError> {
        if let Some((index, value)) = misplaced(&self.times) {
            return Err(IdentificationError::Time { index, value });
        }
        let mut indices: Vec<usize> = Vec::new();
        for measured in &self.links {
            let name = &measured.name;
            let index = links.iter().position(|link| link == name);
            let index = index.ok_or_else(|| IdentificationError::UnknownLink {
                name: name.clone(),
                links: links.to_vec(),
            })?;
            if indices.contains(&index) {
                return Err(IdentificationError::Twice { name: name.clone() });
            }
            indices.push(index);
            if measured.angles.len() != self.times.len() {
                return Err(IdentificationError::Length {
                    link: name.clone(),
                    times: self.times.len(),
                    angles: measured.angles.len(),
                });
            }
            positive(&format!("deviation of `{name}`"), measured.deviation)?;
            for (index, angle) in measured.angles.iter().enumerate() {
                if let Some(value) = angle.filter(|angle| !angle.is_finite()) {
                    return Err(IdentificationError::Datum {
                        link: name.clone(),
                        index,
                        value,
                    });
                }
            }
        }
        Ok(indices)
    }
}

/// Returns the error that no motion fits the record.
pub(super) fn no_motion(record: &AngleRecord) -> IdentificationError {
    let time = record.times().first().copied().unwrap_or(0.0);
    IdentificationError::NoMotion { time }
}
