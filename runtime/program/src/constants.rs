//! Values of the constants of a tree and offsets of its links' angles, as programs hand them on.

use std::fs;
use std::path::Path;

use branched_pendulum_measure::identification::OFFSET_OF;
use branched_pendulum_trees::TreeDescription;
use serde_json::{Map, Value};

use crate::Failure;

/// What a file knows of a tree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnownConstants {
    /// Values of parameters, SI units.
    pub values: Vec<(String, f64)>,
    /// Angles that links show where they are at 0, rad.
    pub offsets: Vec<(String, f64)>,
}

impl KnownConstants {
    /// Reads a table of names and values (JSON), or that of the parameters in a `run.json`.
    ///
    /// # Errors
    /// [`Failure::Parameters`] for what is none, and for names that the description has not.
    pub fn read(path: &Path, description: &TreeDescription) -> Result<Self, Failure> {
        let failed = |source: Box<dyn std::error::Error + Send + Sync>| Failure::Parameters {
            path: path.to_path_buf(),
            source,
        };
        let text = fs::read(path).map_err(|error| failed(error.into()))?;
        let mut table: Map<String, Value> =
            serde_json::from_slice(&text).map_err(|error| failed(error.into()))?;
        if table.contains_key("program") {
            let recorded = table.get("report").map(|report| &report["parameters"]);
            table = match recorded.and_then(Value::as_object) {
                Some(recorded) => recorded.clone(),
                None => return Err(failed("the run has left no parameters".into())),
            };
        }
        let links = description.links();
        let mut known = Self::default();
        for (name, value) in table {
            let Some(number) = value.as_f64() else {
                return Err(failed(
                    format!("`{name}` is {value}, which is no number").into(),
                ));
            };
            let link = name.strip_prefix(OFFSET_OF).map(str::to_owned);
            match link {
                Some(link) if links.contains(&link) => known.offsets.push((link, number)),
                Some(link) => {
                    let links = links.join(", ");
                    let what = format!("no link is called `{link}`; there are: {links}");
                    return Err(failed(what.into()));
                }
                None if description.parameters().any(|own| own == name) => {
                    known.values.push((name, number));
                }
                None => {
                    let names: Vec<&str> = description.parameters().collect();
                    let names = names.join(", ");
                    let what = format!("no constant is called `{name}`; there are: {names}");
                    return Err(failed(what.into()));
                }
            }
        }
        Ok(known)
    }

    /// Returns the table that [`read`](Self::read) reads.
    pub fn table(&self) -> Map<String, Value> {
        let offsets = self.offsets.iter();
        let offsets = offsets.map(|(link, offset)| (format!("{OFFSET_OF}{link}"), *offset));
        let values = self.values.iter().cloned().chain(offsets);
        values.map(|(name, value)| (name, value.into())).collect()
    }
}
