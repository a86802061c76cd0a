//! A design as text and as tables.

use std::fmt::Write;

use branched_pendulum_data::{Cell, Column};
use branched_pendulum_measure::design::{Design, Side};
use branched_pendulum_trees::{QuantityValue, TreeDesign};
use serde_json::{Map, Value, json};

use crate::Failure;
use crate::frame::Job;

/// A design with everything that its report contains.
pub(super) struct DesignReport<'a> {
    pub(super) name: &'a str,
    pub(super) design: &'a TreeDesign,
    pub(super) found: &'a Design,
    /// Values of the targets with their errors.
    pub(super) values: Vec<QuantityValue>,
}

impl DesignReport<'_> {
    /// Returns tables of the parameters and the targets, and sentences about the solution.
    pub(super) fn text(&self) -> String {
        let found = self.found;
        let variables = self.design.search().variables();
        let heading = match found.is_reached {
            true => "parameters that reach the targets",
            false => "parameters nearest to the targets, which they do not reach",
        };
        let mut text = format!(
            "{}: {heading}\n\n{:14}{:>14}{:>14}{:>12}{:>12}\n",
            self.name, "parameter", "value", "present", "from", "to"
        );
        for ((own, value), side) in variables.iter().zip(&found.parameters).zip(&found.bounds) {
            let side = match side {
                Some(Side::Lower) => "  at its lower bound",
                Some(Side::Upper) => "  at its upper bound",
                None => "",
            };
            let [from, to] = own.range;
            let [value, present] = [*value, own.present].map(significant);
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{:14}{value:>14}{present:>14}{from:>12}{to:>12}{side}",
                own.name
            );
        }
        let _ = write!(
            text,
            "\n{:14}{:>14}{:>10}{:>14}{:>12}",
            "target", "goal", "unit", "value", "error bar"
        );
        for own in variables {
            let _ = write!(text, "{:>16}", format!("by {}", own.name));
        }
        text.push('\n');
        for (index, target) in self.design.search().targets().iter().enumerate() {
            let own = self.values.get(index);
            let unit = self
                .design
                .quantities()
                .get(index)
                .map_or("", |own| own.unit());
            let error = own.and_then(|own| own.error);
            let _ = write!(
                text,
                "{:14}{:>14}{unit:>10}{:>14}{:>12}",
                target.name,
                target.goal.to_string(),
                own.map_or(String::new(), |own| significant(own.value)),
                error.map_or("-".to_owned(), |error| format!("{error:.2e}")),
            );
            for slope in found.sensitivities.get(index).into_iter().flatten() {
                let _ = write!(text, "{slope:>16.4e}");
            }
            text.push('\n');
        }
        text.push_str(&self.sentences());
        text
    }

    /// Describes how many solutions there are, or why there is none.
    fn sentences(&self) -> String {
        let found = self.found;
        let variables = self.design.search().variables();
        let assigned = |values: &[f64]| {
            let both = variables.iter().zip(values);
            let both = both.map(|(own, value)| format!("{} {value:+.4e}", own.name));
            both.collect::<Vec<_>>().join(", ")
        };
        let mut text = String::from("\n");
        let [starts, undefined] = found.starts;
        if let Some(cause) = found.cause(variables) {
            let _ = writeln!(text, "Not reached: {cause}.");
        } else if found.is_isolated() && found.others.is_empty() {
            text.push_str("The search found no other solution within the bounds.\n");
        } else if found.is_isolated() {
            text.push_str("This is the solution nearest to the present values. Others are\n");
            for own in &found.others {
                let _ = writeln!(text, "  {}", assigned(own));
            }
        } else {
            text.push_str(
                "More than one set of parameters reaches the targets; this is the one nearest to \
                 the present values, in widths of the ranges.\n",
            );
            for direction in &found.open_directions {
                let _ = writeln!(
                    text,
                    "These change together without an effect on the targets: {}",
                    assigned(direction)
                );
            }
        }
        let _ = write!(
            text,
            "Points within the bounds that were compared first: {starts}"
        );
        let _ = match undefined {
            0 => writeln!(text, "."),
            _ => writeln!(text, ", {undefined} of them without values of all targets."),
        };
        text
    }

    /// Writes the tables, and the record of the search.
    pub(super) fn write(&self, job: &Job) -> Result<(), Failure> {
        let found = self.found;
        let search = self.design.search();
        let names = || search.variables().iter().map(|own| own.name.as_str());
        let columns = ["parameter", "value", "present", "from", "to"];
        let columns = columns.map(|name| Column::new(name, ""));
        job.csv("parameters.csv", &columns, |csv| {
            let mut rows = search.variables().iter().zip(&found.parameters);
            rows.try_for_each(|(own, value)| {
                let [from, to] = own.range;
                let numbers = [*value, own.present, from, to].map(Cell::from);
                csv.row([Cell::from(own.name.as_str())].into_iter().chain(numbers))
            })
        })?;
        let columns = ["target", "unit", "goal", "value", "error bar"].map(str::to_owned);
        let slopes = names().map(|name| format!("derivative by {name}"));
        let columns = columns.into_iter().chain(slopes);
        let columns: Vec<Column> = columns.map(|name| Column::new(name, "")).collect();
        let goals: Vec<String> = search
            .targets()
            .iter()
            .map(|own| own.goal.to_string())
            .collect();
        job.csv("targets.csv", &columns, |csv| {
            for (index, target) in search.targets().iter().enumerate() {
                let own = self.values.get(index);
                let unit = self
                    .design
                    .quantities()
                    .get(index)
                    .map_or("", |own| own.unit());
                let value = own.map_or(f64::NAN, |own| own.value);
                let error = own.and_then(|own| own.error).unwrap_or(0.0);
                let words = [target.name.as_str(), unit, &goals[index]].map(Cell::from);
                let slopes = found.sensitivities.get(index).into_iter().flatten();
                let numbers = [value, error].into_iter().chain(slopes.copied());
                csv.row(words.into_iter().chain(numbers.map(Cell::from)))?;
            }
            Ok(())
        })?;
        let by_name = |values: &[f64]| {
            let both = names().zip(values);
            let both = both.map(|(name, value)| (name.to_owned(), json!(value)));
            Value::Object(both.collect::<Map<_, _>>())
        };
        let all = |rows: &[Vec<f64>]| rows.iter().map(|own| by_name(own)).collect::<Vec<_>>();
        let targets = search.targets().iter().enumerate().map(|(index, target)| {
            let own = self.values.get(index);
            json!({
                "name": target.name,
                "goal": target.goal.to_string(),
                "value": own.map(|own| own.value),
                "error": own.and_then(|own| own.error),
                "derivatives": found.sensitivities.get(index).map(|own| by_name(own)),
            })
        });
        let held = names().zip(&found.holds).filter(|(_, holds)| **holds);
        job.report("reached", found.is_reached);
        job.report("design", by_name(&found.parameters));
        job.report("targets", targets.collect::<Vec<_>>());
        job.report(
            "held_by_bounds",
            held.map(|(name, _)| name).collect::<Vec<_>>(),
        );
        job.report("open_directions", all(&found.open_directions));
        job.report("other_solutions", all(&found.others));
        Ok(())
    }
}

/// Formats a number with seven significant digits.
fn significant(value: f64) -> String {
    let digits = match value {
        0.0 => 0,
        value => 6 - value.abs().log10().floor() as i32,
    };
    match digits {
        0..=10 => format!("{value:.0$}", digits as usize),
        _ => format!("{value:.6e}"),
    }
}
