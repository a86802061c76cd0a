//! Predictions as text and as a table.

use std::fmt::Write;

use branched_pendulum::analysis::normal_form::{ResonanceKind, Tongue};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::TreeNormalForm;

use crate::Failure;
use crate::commands::plane::MapPlane;
use crate::commands::predicted::PredictedLine;
use crate::frame::Job;

/// Predictions for one tree.
pub(super) struct TheoryCase<'a> {
    /// Value of the varied parameter.
    pub(super) value: Option<f64>,
    pub(super) form: TreeNormalForm,
    /// Decay of small differences by friction, 1/s.
    pub(super) decay: f64,
    pub(super) plane: &'a MapPlane<'a>,
    pub(super) lines: Vec<PredictedLine>,
}

/// Predictions along all lines.
pub(super) struct TheoryReport<'a> {
    pub(super) name: &'a str,
    /// Name of the varied parameter.
    pub(super) varied: Option<&'a str>,
    /// Smallest growth rate in addition to the decay, 1/s.
    pub(super) least: f64,
    pub(super) cases: &'a [TheoryCase<'a>],
}

impl TheoryReport<'_> {
    /// Returns the frequencies, the kept resonances, and the tongues on each line. If a parameter
    /// varies, returns the tongues for each of its values, line by line.
    pub(super) fn text(&self) -> String {
        let mut text = match (self.cases, self.varied) {
            ([], _) => String::new(),
            ([case, ..], None) => self.head(case),
            ([case, ..], Some(_)) => {
                let degree = case.form.form().options().degree;
                format!("{}: normal forms of degree {degree}\n", self.name)
            }
        };
        let _ = write!(
            text,
            "\ntongues with a growth rate above {} 1/s",
            self.least
        );
        if let ([case], None) = (self.cases, self.varied) {
            // No friction is −0.
            let _ = write!(text, "; friction takes {:.4} 1/s of it", case.decay + 0.0);
        }
        text.push('\n');
        let lines = self.cases.first().map_or(0, |case| case.lines.len());
        for place in 0..lines {
            let own = self
                .cases
                .iter()
                .filter_map(|case| Some((case, case.lines.get(place)?)));
            for (number, (case, line)) in own.enumerate() {
                if number == 0 {
                    let (name, words) = (case.plane.names()[1], case.plane.words(1, line.value));
                    let _ = writeln!(text, "\n{name} = {words}");
                }
                if let (Some(name), Some(value)) = (self.varied, case.value) {
                    let _ = writeln!(text, " {name} = {value}");
                }
                line.write(&mut text, case.plane, 0);
            }
        }
        text
    }

    /// Returns the frequencies and the kept resonances of a tree.
    fn head(&self, case: &TheoryCase<'_>) -> String {
        let form = case.form.form();
        let mut text = format!(
            "{}: normal form of degree {}\n\nfrequencies of small motions, Hz:",
            self.name,
            form.options().degree
        );
        let (in_phase, frequencies) = (form.in_phase(), form.linear_frequencies_hz());
        for (j, frequency) in frequencies.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = match j.checked_sub(in_phase) {
                None => write!(text, "  f_{} {frequency:.5}", j + 1),
                Some(own) => write!(text, "  d_{} {frequency:.5}", own + 1),
            };
        }
        text.push_str("\nkept resonances, with their mismatch in Hz:\n");
        for resonance in form.resonances() {
            let effect = match resonance.kind() {
                ResonanceKind::InPhase => "between modes in phase",
                ResonanceKind::Growth => "lets differences grow",
                ResonanceKind::Exchange => "between differences",
            };
            let mismatch = resonance.mismatch(&frequencies);
            let _ = writeln!(
                text,
                "  {:24} {mismatch:+.5}  {effect}",
                resonance.to_string()
            );
        }
        if form.resonances().is_empty() {
            text.push_str("  none: no small difference grows within this order\n");
        }
        text
    }

    /// Writes all tongues as a table.
    pub(super) fn write(&self, job: &Job) -> Result<(), Failure> {
        let Some(first) = self.cases.first() else {
            return Ok(());
        };
        let [x, at] = first.plane.columns();
        let Column { name, unit } = x;
        let column = |what: &str| Column::new(format!("{name} {what}"), unit.as_str());
        let columns = [
            at,
            column("lower edge"),
            column("lower edge by the degree before"),
            column("upper edge"),
            column("upper edge by the degree before"),
            column("at the largest rate"),
            Column::new("growth rate without friction", "1/s"),
            Column::new("growth rate by the degree before", "1/s"),
            Column::new("resonance", ""),
        ];
        let rows = |tongue: &Tongue| {
            let [from, to] = tongue.edges;
            let rate = tongue.largest.growth_rate;
            [
                from.value,
                from.before,
                to.value,
                to.before,
                tongue.at,
                rate.value,
                rate.before,
            ]
        };
        let varied = self.varied.map(|name| Column::new(name, ""));
        let columns: Vec<Column> = varied.into_iter().chain(columns).collect();
        job.csv("theory.csv", &columns, |csv| {
            let all = self.cases.iter();
            let all = all.flat_map(|case| case.lines.iter().map(move |line| (case.value, line)));
            let all = all.flat_map(|(value, line)| {
                let tongues = line.tongues.tongues.iter();
                tongues.map(move |own| (value.into_iter().chain([line.value]), own))
            });
            for (places, tongue) in all {
                let numbers = places.chain(rows(tongue));
                let resonance = tongue
                    .resonance()
                    .map_or(String::new(), ToString::to_string);
                let name = Cell::from(resonance.as_str());
                csv.row(numbers.map(Cell::from).chain([name]))?;
            }
            Ok(())
        })
    }
}
