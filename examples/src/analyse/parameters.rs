//! Constants of a chain, out of a file.

use std::fs;
use std::path::Path;

use branched_pendulum::Parametric;
use serde_json::{Map, Value};

use super::scenes::Chain;
use branched_pendulum_program::Failure;

/// Values that the authors of the measured double pendulum fitted (K. Kaheman et al.,
/// arXiv:2205.06231; their repository's `ParameterEstimation/DoublePendulum`). Their friction
/// is viscous alone.
const FITTED: [(&str, f64); 10] = [
    ("gravity", 9.80858023),
    ("mass_1", 0.0938439748),
    ("com_1", 0.108565215),
    ("inertia_1", 4.37529430e-4),
    ("joint_1", 0.172719204),
    ("viscous_1", 2.37142783e-4),
    ("mass_2", 0.137595970),
    ("com_2", 0.116779018),
    ("inertia_2", 1.26882939e-3),
    ("viscous_2", 1.00000019e-5),
];

const NAMES: &[&str] = <Chain as Parametric<f64>>::PARAMETERS;

/// Values of the parameters of a [`Chain`] where no file has others.
pub fn fitted() -> Vec<f64> {
    let value = |name: &&str| {
        let own = FITTED.iter().find(|(own, _)| own == name);
        own.map_or(0.0, |(_, value)| *value)
    };
    NAMES.iter().map(value).collect()
}

/// Reads values of the parameters; those that the file does not name are the [`fitted`] ones.
///
/// # Errors
/// [`Failure::Parameters`]: a file that cannot be read, is no JSON object of numbers, or names
/// a constant that the chain does not have.
pub fn read(path: &Path) -> Result<Vec<f64>, Failure> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| Failure::Parameters {
        path: path.to_path_buf(),
        source,
    };
    let text = fs::read(path).map_err(|error| failed(error.into()))?;
    let table: Map<String, Value> =
        serde_json::from_slice(&text).map_err(|error| failed(error.into()))?;
    let mut values = fitted();
    for (name, value) in &table {
        let index = NAMES.iter().position(|own| own == name).ok_or_else(|| {
            let known = NAMES.join(", ");
            failed(format!("no constant is called `{name}`; there are: {known}").into())
        })?;
        values[index] = value
            .as_f64()
            .ok_or_else(|| failed(format!("`{name}` is {value}, which is no number").into()))?;
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::{NAMES, fitted, read};
    use branched_pendulum_program::frame::messages;

    #[test]
    fn constants_come_from_a_file() {
        let folder = std::env::temp_dir();
        let path = folder.join(format!(
            "branched-pendulum-constants-{}",
            std::process::id()
        ));
        let told = |text: &str| {
            std::fs::write(&path, text).unwrap();
            read(&path).map_err(|failure| messages(&failure).join(": "))
        };
        let place = |name: &str| NAMES.iter().position(|own| *own == name).unwrap();
        let values = told(r#"{"mass_1": 0.2, "coulomb_2": 3e-5}"#).unwrap();
        assert_eq!(
            (values[place("mass_1")], values[place("coulomb_2")]),
            (0.2, 3e-5)
        );
        assert_eq!(values[place("mass_2")], fitted()[place("mass_2")]);
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
        assert!(read(&path).is_err());
    }
}
