//! From names to indices, with all that is wrong with a request.

use std::ops::Range;

use super::error::{IdentificationError, finite, number, positive};
use super::family::Family;
use super::problem::{Identification, Shooting, StartValue};
use super::record::AngleRecord;
use super::task::{FitTask, LinkData};

/// Change of an offset that matters, rad.
const OFFSET: f64 = 0.01;
/// Beginning of the names of offsets, before that of a link.
pub const OFFSET_OF: &str = "offset of ";
/// Offsets within a turn.
const TURN: [f64; 2] = [-core::f64::consts::PI, core::f64::consts::PI];

impl<F: Family> Identification<F> {
    /// The numerical problem, and its globals at the start.
    pub(super) fn task<'a>(
        &'a self,
        record: &'a AngleRecord,
    ) -> Result<(FitTask<'a>, Vec<f64>), IdentificationError> {
        let (parameters, links) = (self.family.parameters(), self.family.links());
        let measured = record.check(&links)?;
        let Shooting {
            first,
            longest,
            jump,
            tolerance,
            block,
        } = self.shooting;
        for (what, value) in [
            ("length of the first segments", first),
            ("length of the longest segments", longest),
            ("jump between segments", jump),
            ("tolerance", tolerance),
            ("length of blocks", block.unwrap_or(1.0)),
        ] {
            positive(what, value)?;
        }
        let mut values = vec![None; parameters.len()];
        let mut place = |name: &str, value: f64| {
            let index = parameters.iter().position(|parameter| parameter == name);
            let index = index.ok_or_else(|| IdentificationError::UnknownParameter {
                name: name.to_owned(),
                parameters: parameters.clone(),
            })?;
            finite(&format!("`{name}`"), value)?;
            match values[index].replace(value) {
                None => Ok(index),
                Some(_) => Err(IdentificationError::Twice {
                    name: name.to_owned(),
                }),
            }
        };
        for (name, value) in &self.known {
            place(name, *value)?;
        }
        let mut unknown = Vec::new();
        let mut scales = Vec::new();
        for StartValue { name, value, scale } in &self.unknown {
            unknown.push(place(name, *value)?);
            positive(&format!("scale of `{name}`"), *scale)?;
            scales.push(*scale);
        }
        let given = |(value, name): (Option<f64>, &String)| {
            value.ok_or_else(|| IdentificationError::Missing { name: name.clone() })
        };
        let values = values.into_iter().zip(&parameters).map(given);
        let values: Vec<f64> = values.collect::<Result<_, _>>()?;
        self.family
            .check(&values)
            .map_err(IdentificationError::Start)?;
        let mut globals: Vec<f64> = self.unknown.iter().map(|start| start.value).collect();
        let mut names: Vec<String> = self
            .unknown
            .iter()
            .map(|start| start.name.clone())
            .collect();
        let parameters = names.len();
        let data = record.links.iter().zip(measured).enumerate();
        let data = data.map(|(number, (link, component))| LinkData {
            component,
            angles: &link.angles,
            weight: 1.0 / link.deviation,
            offset: self.offsets.then_some(parameters + number),
        });
        let data = data.collect();
        let mut bounds = vec![[f64::NEG_INFINITY, f64::INFINITY]; parameters];
        for (name, least) in &self.least {
            let index = names.iter().position(|own| own == name);
            let index = index.ok_or_else(|| IdentificationError::UnknownParameter {
                name: name.clone(),
                parameters: names.clone(),
            })?;
            finite(&format!("least value of `{name}`"), *least)?;
            number(
                &format!("start of `{name}`, which is at least {least},"),
                globals[index],
                globals[index] >= *least,
            )?;
            bounds[index][0] = *least;
        }
        if self.offsets {
            for link in &record.links {
                names.push(format!("{OFFSET_OF}{}", link.name));
                scales.push(OFFSET);
                globals.push(0.0);
                bounds.push(TURN);
            }
        }
        let mut task = FitTask {
            family: &self.family,
            dimension: 2 * links.len(),
            values,
            unknown,
            names,
            scales,
            bounds,
            times: record.times(),
            links: data,
            frequencies: Vec::new(),
            tolerance,
        };
        task.frequencies = task.assigned(&self.frequencies, &globals)?;
        Ok((task, globals))
    }

    /// Refuses more unknowns than there are data.
    pub(super) fn check_unknowns(
        &self,
        task: &FitTask<'_>,
        segments: &[Range<usize>],
    ) -> Result<(), IdentificationError> {
        let angles: usize = segments.iter().map(|samples| task.count(samples)).sum();
        let found = angles + self.frequencies.len();
        let states = if segments.is_empty() {
            0
        } else {
            task.dimension
        };
        let needed = (task.names.len() + states).max(1);
        match found >= needed {
            true => Ok(()),
            false => Err(IdentificationError::TooFew { found, needed }),
        }
    }
}
