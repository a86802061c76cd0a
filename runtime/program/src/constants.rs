//! Values of a tree's constants and offsets of its links' angles, as programs pass them to each
//! other in files.

use std::fs;
use std::path::Path;

use branched_pendulum_measure::identification::OFFSET_OF;
use branched_pendulum_trees::TreeDescription;
use serde_json::{Map, Value};

use crate::Failure;
use crate::frame::Input;

/// Constants of a tree, read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnownConstants {
    /// Values of parameters, SI units.
    pub values: Vec<(String, f64)>,
    /// Measured angles of links whose true angle is 0, in rad.
    pub offsets: Vec<(String, f64)>,
}

impl KnownConstants {
    /// Reads a table of names and values (JSON), or the table of parameters in a `run.json`.
    ///
    /// # Errors
    /// [`Failure::Parameters`] if the file contains no such table, or a name that is not in the
    /// description.
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
                    format!("`{name}` is {value}, which is not a number").into(),
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

    /// Returns the values, which were read from `path`, as an input of a run: two files with the
    /// same values count as the same input.
    pub fn input(&self, path: &Path) -> Input {
        let table = Value::Object(self.table());
        Input::of_text(&path.display().to_string(), &format!("{table:#}\n"))
    }

    /// Returns the values as a table that [`read`](Self::read) accepts.
    pub fn table(&self) -> Map<String, Value> {
        let offsets = self.offsets.iter();
        let offsets = offsets.map(|(link, offset)| (format!("{OFFSET_OF}{link}"), *offset));
        let values = self.values.iter().cloned().chain(offsets);
        values.map(|(name, value)| (name, value.into())).collect()
    }
}
