//! Example in the docs of a model that shows its use.

use super::Emission;
use super::tokens::count;
use crate::functions::{Argument, Purpose};

/// Largest number of links that the example names.
const MOST_NAMED: usize = 4;

impl Emission<'_> {
    /// Returns a few lines that create the model, call it and integrate its motion. Rustdoc does
    /// not run them, because the path of the model in the user's crate is unknown.
    pub(super) fn example(&self) -> Vec<String> {
        let (name, scene) = (&self.item.ident, self.scene);
        let runtime = self.runtime().to_string().replace(' ', "");
        let parameters: Vec<&str> = scene.parameters.iter().map(|p| p.name.as_str()).collect();
        let model = match parameters.is_empty() {
            true => format!("let model = {name}::new();"),
            false => format!(
                "let model = {name}::new({name}Parameters {{ {} }})?;",
                parameters.join(", ")
            ),
        };
        let mut lines = vec![
            format!("use {}::prelude::*;", runtime.trim_start_matches("::")),
            String::new(),
            model,
        ];
        if scene.links.len() <= MOST_NAMED {
            let names: Vec<&str> = scene.links.iter().map(|link| link.name.as_str()).collect();
            let names = names.join(", ");
            lines.push(format!("// Angles and angular velocities of {names}."));
        }
        lines.push(match &self.program.strips {
            Some(_) => format!("let theta = [0.1; {name}::<f64>::LINKS];"),
            None => {
                let links = count(scene.links.len());
                format!("let (theta, omega) = ([0.1; {links}], [0.0; {links}]);")
            }
        });
        let mut call = |purpose: Purpose, result: &str| {
            let entries = self.program.entries.iter();
            for entry in entries.filter(|entry| entry.purpose == purpose) {
                let arguments = entry.arguments.iter().map(|argument| match argument {
                    Argument::Time => "0.0".to_owned(),
                    other => format!("&{}", other.name()),
                });
                let arguments: Vec<String> = arguments.collect();
                let (function, arguments) = (&entry.name, arguments.join(", "));
                lines.push(format!("let {result} = model.{function}({arguments});"));
            }
        };
        call(Purpose::Accelerations, "alpha");
        call(Purpose::KineticEnergy, "kinetic");
        call(Purpose::PotentialEnergy, "potential");
        lines.extend([
            "// The motion from there, at 1 s and at 2 s.".to_owned(),
            "let start = State::at_rest(0.0, &theta);".to_owned(),
            "let method = Dop853::new(Options::with_tolerance(1e-12));".to_owned(),
            "let states = method.sample_to_vec(&AbsoluteAngles(&model), &start, &[1.0, 2.0])?;"
                .to_owned(),
        ]);
        let mut docs = vec![
            String::new(),
            "# Example".to_owned(),
            String::new(),
            "```ignore".to_owned(),
        ];
        docs.extend(lines);
        docs.push("```".to_owned());
        docs
    }
}
