//! Descriptions and their parameters.

use branched_pendulum_trees::{PendulumTree, TreeDescription};
use wasm_bindgen::prelude::wasm_bindgen;

/// A parameter of a description.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the parameter.
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// Use of the parameter in words, with the unit after the last comma.
    #[wasm_bindgen(readonly)]
    pub meaning: String,
}

/// Returns the parameters of a description, in the order of the text.
///
/// # Errors
/// Lists all mistakes in the text, each marked in its line.
#[wasm_bindgen]
pub fn parameters(text: &str) -> Result<Vec<Parameter>, String> {
    let description = TreeDescription::parse(text).map_err(|error| error.to_string())?;
    let names = description.parameters();
    let parameters = names.map(|name| Parameter {
        name: name.to_owned(),
        meaning: description
            .parameter_use(name)
            .unwrap_or_default()
            .to_owned(),
    });
    Ok(parameters.collect())
}

/// Creates the tree of a description with values for its parameters.
pub(crate) fn tree(text: &str, names: &[String], values: &[f64]) -> Result<PendulumTree, String> {
    let description = TreeDescription::parse(text).map_err(|error| error.to_string())?;
    let names = names.iter().map(String::as_str);
    let values: Vec<(&str, f64)> = names.zip(values.iter().copied()).collect();
    description.tree(&values).map_err(|error| error.to_string())
}
