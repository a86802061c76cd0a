//! The tree that is assumed, with its constants, and the real one before a simulated camera.

use std::fs;
use std::path::Path;

use branched_pendulum_trees::TreeError;
use serde_json::{Map, Value};

use super::arguments::Arguments;
use crate::Failure;
use crate::subject::{Described, Subject};

/// The tree with the constants of the arguments, and why no pendulum is such where none is: then
/// it is taken as it is, for a fit may have found such values.
///
/// # Errors
/// [`Failure::NoTree`], [`Failure::Tree`] and [`Failure::Parameters`].
pub fn assumed(arguments: &Arguments) -> Result<(Subject, Option<TreeError>), Failure> {
    let described = arguments.tree.described()?;
    let values = values(arguments, &described, &[])?;
    let named: Vec<(&str, f64)> = named(&values);
    match described.description.tree(&named) {
        Ok(tree) => Ok((described.with_tree(tree), None)),
        Err(impossible @ TreeError::Value { .. }) => {
            let order = described.description.parameters();
            let value = |name: &str| {
                let own = values.iter().rfind(|(own, _)| own == name);
                own.map_or(f64::NAN, |(_, value)| *value)
            };
            let values: Vec<f64> = order.map(value).collect();
            let tree = described.description.tree_as_given(&values);
            let tree = tree.map_err(|source| described.refused(source))?;
            Ok((described.with_tree(tree), Some(impossible)))
        }
        Err(source) => Err(described.refused(source)),
    }
}

/// The tree before the simulated camera: the assumed one but for the values of `--real`.
///
/// # Errors
/// Those of [`assumed`], and [`Failure::Tree`] for values that no pendulum can have.
pub fn real(arguments: &Arguments) -> Result<Subject, Failure> {
    let described = arguments.tree.described()?;
    let values = values(arguments, &described, &arguments.real.concat())?;
    described.subject(&named(&values))
}

fn named(values: &[(String, f64)]) -> Vec<(&str, f64)> {
    let named = values.iter().map(|(name, value)| (name.as_str(), *value));
    named.collect()
}

/// Values of the tree, of the file of constants, of `--set` and `others`, of which later ones
/// replace earlier ones.
fn values(
    arguments: &Arguments,
    described: &Described,
    others: &[(String, f64)],
) -> Result<Vec<(String, f64)>, Failure> {
    let defaults = described.defaults.iter();
    let mut values: Vec<_> = defaults
        .map(|(name, value)| ((*name).to_owned(), *value))
        .collect();
    if let Some(path) = &arguments.parameters {
        values.extend(read(path, described)?);
    }
    values.extend(described.set.iter().chain(others).cloned());
    Ok(values)
}

/// Reads values of parameters from a table of names and values (JSON).
fn read(path: &Path, described: &Described) -> Result<Vec<(String, f64)>, Failure> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| Failure::Parameters {
        path: path.to_path_buf(),
        source,
    };
    let text = fs::read(path).map_err(|error| failed(error.into()))?;
    let table: Map<String, Value> =
        serde_json::from_slice(&text).map_err(|error| failed(error.into()))?;
    let known: Vec<&str> = described.description.parameters().collect();
    let value = |(name, value): (&String, &Value)| {
        if !known.contains(&name.as_str()) {
            let known = known.join(", ");
            return Err(failed(
                format!("no constant is called `{name}`; there are: {known}").into(),
            ));
        }
        match value.as_f64() {
            Some(value) => Ok((name.clone(), value)),
            None => Err(failed(
                format!("`{name}` is {value}, which is no number").into(),
            )),
        }
    };
    table.iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::super::arguments::Arguments;
    use super::assumed;
    use crate::frame::command_line::parse_line;
    use crate::frame::messages;

    #[test]
    fn constants_come_from_a_file() {
        let folder = std::env::temp_dir();
        let path = folder.join(format!(
            "branched-pendulum-constants-{}",
            std::process::id()
        ));
        let told = |text: &str| {
            std::fs::write(&path, text).unwrap();
            let line = format!(
                "--tree double-pendulum --parameters {} --set com_2=0.12",
                path.display()
            );
            let arguments: Arguments = parse_line(&line).unwrap();
            assumed(&arguments).map_err(|failure| messages(&failure).join(": "))
        };
        let (subject, impossible) =
            told(r#"{"mass_1": 0.2, "coulomb_2": 3e-5, "com_2": 0.1}"#).unwrap();
        assert_eq!(impossible, None);
        let value = |name: &str| subject.tree.value(name).unwrap();
        assert_eq!((value("mass_1"), value("coulomb_2")), (0.2, 3e-5));
        assert_eq!((value("com_2"), value("mass_2")), (0.12, 0.137595970));
        // What a fit has found is taken as it is.
        let (subject, impossible) = told(r#"{"viscous_2": -1e-5}"#).unwrap();
        assert_eq!(subject.tree.value("viscous_2"), Some(-1e-5));
        assert!(impossible.unwrap().to_string().contains("friction"));
        for (text, part) in [
            (
                r#"{"mas_1": 0.2}"#,
                "no constant is called `mas_1`; there are: gravity,",
            ),
            (
                r#"{"mass_1": "a"}"#,
                "`mass_1` is \"a\", which is no number",
            ),
            ("[1, 2]", "is no table of names and values"),
        ] {
            let message = told(text).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
        std::fs::remove_file(&path).unwrap();
    }
}
