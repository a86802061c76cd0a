//! Constants of a chain, out of a file.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

use super::scenes::DoublePendulumParameters;
use crate::failure::Failure;

/// Those that the authors of the measured double pendulum fitted (K. Kaheman et al.,
/// arXiv:2205.06231; their repository's `ParameterEstimation/DoublePendulum`).
pub const FITTED: DoublePendulumParameters<f64> = DoublePendulumParameters {
    gravity: 9.80858023,
    upper_mass: 0.0938439748,
    upper_com: 0.108565215,
    upper_inertia: 4.37529430e-4,
    upper_joint: 0.172719204,
    upper_friction: 2.37142783e-4,
    lower_mass: 0.137595970,
    lower_com: 0.116779018,
    lower_inertia: 1.26882939e-3,
    lower_friction: 1.00000019e-5,
};

/// Reads constants; those that the file does not name are the [`FITTED`] ones.
///
/// # Errors
/// [`Failure::Parameters`]: a file that cannot be read, is no JSON object of numbers, or names
/// a constant that the chain does not have.
pub fn read(path: &Path) -> Result<DoublePendulumParameters<f64>, Failure> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| Failure::Parameters {
        path: path.to_path_buf(),
        source,
    };
    let text = fs::read(path).map_err(|error| failed(error.into()))?;
    let table: Map<String, Value> =
        serde_json::from_slice(&text).map_err(|error| failed(error.into()))?;
    let mut parameters = FITTED;
    for (name, value) in &table {
        let known = slot(&mut parameters, name);
        let slot = known.ok_or_else(|| {
            failed(
                format!(
                    "no constant is called `{name}`; there are: {}",
                    NAMES.join(", ")
                )
                .into(),
            )
        })?;
        *slot = value
            .as_f64()
            .ok_or_else(|| failed(format!("`{name}` is {value}, which is no number").into()))?;
    }
    Ok(parameters)
}

/// Names of the constants.
const NAMES: [&str; 10] = [
    "gravity",
    "upper_mass",
    "upper_com",
    "upper_inertia",
    "upper_joint",
    "upper_friction",
    "lower_mass",
    "lower_com",
    "lower_inertia",
    "lower_friction",
];

fn slot<'a>(parameters: &'a mut DoublePendulumParameters<f64>, name: &str) -> Option<&'a mut f64> {
    let DoublePendulumParameters {
        gravity,
        upper_mass,
        upper_com,
        upper_inertia,
        upper_joint,
        upper_friction,
        lower_mass,
        lower_com,
        lower_inertia,
        lower_friction,
    } = parameters;
    let slots = [
        gravity,
        upper_mass,
        upper_com,
        upper_inertia,
        upper_joint,
        upper_friction,
        lower_mass,
        lower_com,
        lower_inertia,
        lower_friction,
    ];
    let mut named = NAMES.iter().zip(slots);
    named.find_map(|(own, slot)| (*own == name).then_some(slot))
}

#[cfg(test)]
mod tests {
    use super::{FITTED, read};
    use crate::program::messages;

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
        let parameters = told(r#"{"upper_mass": 0.2, "lower_friction": 3e-5}"#).unwrap();
        assert_eq!(
            (parameters.upper_mass, parameters.lower_friction),
            (0.2, 3e-5)
        );
        assert_eq!(parameters.lower_mass, FITTED.lower_mass);
        for (text, part) in [
            (
                r#"{"uper_mass": 0.2}"#,
                "no constant is called `uper_mass`; there are: gravity,",
            ),
            (
                r#"{"upper_mass": "a"}"#,
                "`upper_mass` is \"a\", which is no number",
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
