//! The tree that is assumed, with its constants, and the tree that a simulated camera records.

use branched_pendulum_trees::TreeError;

use crate::Failure;
use crate::subject::{Described, Subject};

/// Builds the tree from the known constants. If they are not physical, returns the tree together with
/// the reason, because a fit may have found them.
///
/// # Errors
/// [`Failure::Tree`].
pub fn assumed(described: &Described) -> Result<(Subject, Option<TreeError>), Failure> {
    let values = described.known();
    match described.description.tree(&values) {
        Ok(tree) => Ok((described.with_tree(tree), None)),
        Err(impossible @ TreeError::Value { .. }) => {
            let order = described.description.parameters();
            let value = |name: &str| {
                let own = values.iter().find(|(own, _)| *own == name);
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

/// Returns the tree that the simulated camera records: the assumed tree, except for the given
/// values.
///
/// # Errors
/// [`Failure::Tree`], also for values that are not physical.
pub fn real(described: &Described, real: &[(String, f64)]) -> Result<Subject, Failure> {
    let is_real = |name: &str| real.iter().any(|(own, _)| own == name);
    let mut values = described.known();
    values.retain(|(name, _)| !is_real(name));
    values.extend(real.iter().map(|(name, value)| (name.as_str(), *value)));
    described.subject(&values)
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
        let reported = |text: &str| {
            std::fs::write(&path, text).unwrap();
            let line = format!(
                "--tree double-pendulum --parameters {} --set com_2=0.12",
                path.display()
            );
            let arguments: Arguments = parse_line(&line).unwrap();
            let described = arguments.tree.described();
            described
                .and_then(|described| assumed(&described))
                .map_err(|failure| messages(&failure).join(": "))
        };
        let (subject, impossible) =
            reported(r#"{"mass_1": 0.2, "coulomb_2": 3e-5, "com_2": 0.1}"#).unwrap();
        assert_eq!(impossible, None);
        let value = |name: &str| subject.tree.value(name).unwrap();
        assert_eq!((value("mass_1"), value("coulomb_2")), (0.2, 3e-5));
        assert_eq!((value("com_2"), value("mass_2")), (0.12, 0.137595970));
        // What a fit has found is taken as it is.
        let (subject, impossible) = reported(r#"{"viscous_2": -1e-5}"#).unwrap();
        assert_eq!(subject.tree.value("viscous_2"), Some(-1e-5));
        assert!(impossible.unwrap().to_string().contains("friction"));
        for (text, part) in [
            (
                r#"{"mas_1": 0.2}"#,
                "no constant is called `mas_1`; there are: gravity,",
            ),
            (
                r#"{"mass_1": "a"}"#,
                "`mass_1` is \"a\", which is not a number",
            ),
            ("[1, 2]", "is not a table of names and values"),
        ] {
            let message = reported(text).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
        std::fs::remove_file(&path).unwrap();
    }
}
