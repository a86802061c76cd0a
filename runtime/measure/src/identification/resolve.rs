//! Conversion of names to indices, with all checks of a request.

use std::ops::Range;

use super::effort::Effort;
use super::error::{IdentificationError, finite, number, positive};
use super::family::Family;
use super::problem::{Identification, Shooting, StartValue};
use super::record::AngleRecord;
use super::task::{FitTask, LinkData};

/// Smallest significant change of an angle's offset, in rad.
const OFFSET: f64 = 0.01;
/// Prefix of the names of offsets, before the name of a link.
pub const OFFSET_OF: &str = "offset of ";
/// Offsets within a turn.
const TURN: [f64; 2] = [-core::f64::consts::PI, core::f64::consts::PI];

impl Shooting {
    fn check(&self) -> Result<(), IdentificationError> {
        let &Self {
            first,
            longest,
            jump,
            tolerance,
            block,
        } = self;
        for (what, value) in [
            ("length of the first segments", first),
            ("length of the longest segments", longest),
            ("jump between segments", jump),
            ("tolerance", tolerance),
            ("length of blocks", block.unwrap_or(1.0)),
        ] {
            positive(what, value)?;
        }
        Ok(())
    }
}

impl<F: Family> Identification<F> {
    /// Returns the numerical problem, and its globals at the start of the search.
    pub(super) fn task<'a>(
        &'a self,
        record: &'a AngleRecord,
        effort: &'a Effort<'a>,
    ) -> Result<(FitTask<'a>, Vec<f64>), IdentificationError> {
        let links = self.family.links();
        let measured = record.check(&links)?;
        self.shooting.check()?;
        let (values, unknown) = self.values()?;
        self.family
            .check(&values)
            .map_err(IdentificationError::Start)?;
        let starts = self.unknown.iter();
        let mut globals: Vec<f64> = starts.clone().map(|start| start.value).collect();
        let mut names: Vec<String> = starts.clone().map(|start| start.name.clone()).collect();
        let mut scales: Vec<f64> = starts.map(|start| start.scale).collect();
        let mut bounds = self.bounds(&names, &globals)?;
        let parameters = names.len();
        let data = record.links.iter().zip(measured).enumerate();
        let data = data.map(|(number, (link, component))| LinkData {
            component,
            angles: &link.angles,
            weight: 1.0 / link.deviation,
            offset: self.offsets.then_some(parameters + number),
        });
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
            links: data.collect(),
            frequencies: Vec::new(),
            tolerance: self.shooting.tolerance,
            effort,
        };
        task.frequencies = task.assigned(&self.frequencies, &globals)?;
        Ok((task, globals))
    }

    /// Returns the values of all parameters, known ones and start values, and the indices of the
    /// unknown ones.
    fn values(&self) -> Result<(Vec<f64>, Vec<usize>), IdentificationError> {
        let parameters = self.family.parameters();
        let mut values = vec![None; parameters.len()];
        let mut place = |name: &str, value: f64| {
            let index = index_of(name, &parameters)?;
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
        for StartValue { name, value, scale } in &self.unknown {
            unknown.push(place(name, *value)?);
            positive(&format!("scale of `{name}`"), *scale)?;
        }
        let given = |(value, name): (Option<f64>, &String)| {
            value.ok_or_else(|| IdentificationError::Missing { name: name.clone() })
        };
        let values = values.into_iter().zip(&parameters).map(given);
        Ok((values.collect::<Result<_, _>>()?, unknown))
    }

    /// Returns the smallest and the largest allowed value of each unknown parameter.
    fn bounds(
        &self,
        names: &[String],
        starts: &[f64],
    ) -> Result<Vec<[f64; 2]>, IdentificationError> {
        let mut bounds = vec![[f64::NEG_INFINITY, f64::INFINITY]; names.len()];
        for (name, least) in &self.least {
            let index = index_of(name, names)?;
            finite(&format!("least value of `{name}`"), *least)?;
            number(
                &format!("start of `{name}`, which is at least {least},"),
                starts[index],
                starts[index] >= *least,
            )?;
            bounds[index][0] = *least;
        }
        Ok(bounds)
    }

    /// Checks that there are no more unknowns than data.
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

/// Returns the index of a parameter in a list of names.
fn index_of(name: &str, parameters: &[String]) -> Result<usize, IdentificationError> {
    let index = parameters.iter().position(|parameter| parameter == name);
    index.ok_or_else(|| IdentificationError::UnknownParameter {
        name: name.to_owned(),
        parameters: parameters.to_vec(),
    })
}
