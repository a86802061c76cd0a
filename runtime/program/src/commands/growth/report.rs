//! Windows of growth as text, as a table and as a chart.

use std::fmt::Write;

use branched_pendulum::analysis::growth::Grown;
use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, Symbol, verbatim};
use branched_pendulum_data::{Cell, Column};

use super::{Arguments, Scan};
use crate::Failure;
use crate::commands::predicted::write_tongues;
use crate::frame::Job;
use crate::frame::windows::{windows, words};

/// Largest number of windows that a line of text lists; the table has all of them.
const MOST_WINDOWS: usize = 12;

/// Range of growth factors that the chart shows; larger values are marked at its upper edge.
const SHOWN: [f64; 2] = [0.8, 1e6];

/// Colour of the marks at values that are not determined.
const GREY: Color = Color::rgb(110, 110, 110);

/// Sentences about all scans.
pub(super) struct GrowthReport<'a> {
    pub(super) arguments: &'a Arguments,
    /// Name of the tree.
    pub(super) name: &'a str,
    /// Name of the link whose initial angle is scanned.
    pub(super) link: &'a str,
    pub(super) scans: &'a [Scan],
}

impl GrowthReport<'_> {
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "{}: growth G(T) of a small difference between copies, released at {} angles\n\
             of {}; between them nothing was looked at\n",
            self.name,
            self.arguments.angles_deg.len(),
            self.link
        );
        for scan in self.scans {
            text.push_str(&self.windows_of(scan));
        }
        text.push_str(&self.marked());
        text
    }

    fn windows_of(&self, scan: &Scan) -> String {
        let mut text = format!(
            "\n{} (a small difference at rest: {:.4} Hz)\n",
            scan.label, scan.frequency_hz
        );
        let angles = &self.arguments.angles_deg;
        let listed = |found: Vec<[usize; 2]>| match found.len().checked_sub(MOST_WINDOWS) {
            None | Some(0) => words(&found, angles),
            Some(more) => format!("{}, and {more} more", words(&found[..MOST_WINDOWS], angles)),
        };
        for (number, horizon) in self.arguments.horizons.iter().enumerate() {
            let factor = |index: usize| scan.grown[index].factors[number];
            for level in &self.arguments.levels {
                let inside = windows(angles.len(), |index| factor(index).value >= *level);
                let from = format!("G({horizon} s) ≥ {level}");
                // Writing to a string cannot fail.
                let _ = writeln!(text, "  {from:20} {}", listed(inside));
            }
            let open = |index: usize| !factor(index).is_determined();
            let count = (0..scan.grown.len()).filter(|index| open(*index)).count();
            if count > 0 {
                let all = listed(windows(angles.len(), open));
                let _ = writeln!(
                    text,
                    "  G({horizon} s) is not determined at {count} angles: {all}"
                );
            }
        }
        if let Some(predicted) = &scan.predicted {
            text.push_str("  growth without end, by theory:\n");
            write_tongues(&mut text, predicted, scan.decay, &|angle| {
                format!("{angle}°")
            });
        }
        text
    }

    /// Lists the growth at the marked angles, and the scans in which a growth level lies between
    /// two of these angles.
    fn marked(&self) -> String {
        let Some(marks) = &self.arguments.mark else {
            return String::new();
        };
        let mut text = format!("\nG at the angles that are marked:\n{:32}", "");
        let places = || {
            (0..self.arguments.horizons.len()).flat_map(|n| (0..marks.len()).map(move |m| [n, m]))
        };
        for [horizon, mark] in places() {
            let (horizon, mark) = (self.arguments.horizons[horizon], marks[mark]);
            // Writing to a string cannot fail.
            let _ = write!(text, "{:>16}", format!("{mark}°, {horizon} s"));
        }
        for scan in self.scans {
            let _ = write!(text, "\n  {:30}", scan.label);
            for [horizon, mark] in places() {
                let factor = scan.marked[mark].factors[horizon];
                let value = match factor.is_determined() {
                    true => format!("{:.3e}", factor.value),
                    false => format!("~{:.0e}", factor.value),
                };
                let _ = write!(text, "{value:>16}");
            }
        }
        text.push_str("\n(~ not determined)\n");
        let neighbours = || (1..marks.len()).map(|mark| [mark - 1, mark]);
        for (level, [one, other]) in self
            .arguments
            .levels
            .iter()
            .flat_map(|level| neighbours().map(move |both| (level, both)))
        {
            let lies_between = |scan: &&Scan| {
                let both = scan.marked[one]
                    .factors
                    .iter()
                    .zip(&scan.marked[other].factors);
                both.into_iter()
                    .any(|(one, other)| (one.value >= *level) != (other.value >= *level))
            };
            let labels = self.scans.iter().filter(lies_between);
            let labels: Vec<&str> = labels.map(|scan| scan.label.as_str()).collect();
            let within = match labels.is_empty() {
                true => "none of these times".to_owned(),
                false => format!("one of these times of: {}", labels.join("; ")),
            };
            let _ = writeln!(
                text,
                "G = {level} lies between {}° and {}° within {within}",
                marks[one], marks[other]
            );
        }
        text
    }

    pub(super) fn write(&self, job: &Job) -> Result<(), Failure> {
        let mut columns = vec![
            Column::new("tree", ""),
            Column::new("angle", "degrees"),
            Column::new("growth rate", "1/s"),
            Column::new("frequency of the difference", "Hz"),
        ];
        for horizon in &self.arguments.horizons {
            let name = format!("growth factor within {horizon} s");
            columns.push(Column::new(name.as_str(), ""));
            columns.push(Column::new(format!("{name} between tolerances"), ""));
        }
        job.csv("growth.csv", &columns, |csv| {
            for scan in self.scans {
                for (angle, grown) in self.arguments.angles_deg.iter().zip(&scan.grown) {
                    let own = [*angle, grown.rate.value, grown.frequency_hz.value];
                    let factors = grown.factors.iter().flat_map(|f| [f.value, f.difference]);
                    let numbers = own.into_iter().chain(factors).map(Cell::from);
                    csv.row(std::iter::once(Cell::from(scan.label.as_str())).chain(numbers))?;
                }
            }
            Ok(())
        })
    }

    pub(super) fn chart(&self) -> Chart {
        let Arguments {
            angles_deg,
            horizons,
            mark,
            ..
        } = self.arguments;
        let ends = [0, angles_deg.len() - 1].map(|index| angles_deg[index]);
        let x = Axis::linear(format!(
            "angle of {} at the release (°)",
            verbatim(self.link)
        ));
        let title = format!(
            "{}: growth of a small difference between copies",
            verbatim(self.name)
        );
        let height = 90.0 + 210.0 * horizons.len() as f64;
        let chart = Chart::new(title, x.range(ends[0], ends[1])).size(900.0, height);
        horizons
            .iter()
            .enumerate()
            .fold(chart, |chart, (number, horizon)| {
                let axis = Axis::log(format!("G({horizon} s)")).range(SHOWN[0], SHOWN[1]);
                let panel = self.scans.iter().fold(Panel::new(axis), |panel, scan| {
                    let factors = scan.grown.iter().map(|grown| &grown.factors[number]);
                    let values: Vec<f64> = factors.clone().map(|own| own.value.min(1e99)).collect();
                    let label = verbatim(&scan.label);
                    let line = Series::line(label, angles_deg, &values).dash(Dash::Solid);
                    let panel = panel.series(line.mark_beyond());
                    let open = angles_deg.iter().zip(factors).zip(&values);
                    let open = open.filter(|((_, own), value)| {
                        !own.is_determined() && (SHOWN[0]..=SHOWN[1]).contains(*value)
                    });
                    let (angles, values): (Vec<f64>, Vec<f64>) =
                        open.map(|((angle, _), value)| (*angle, *value)).unzip();
                    match angles.is_empty() {
                        true => panel,
                        false => panel.series(
                            Series::points("not determined", &angles, &values)
                                .color(GREY)
                                .symbol(Symbol::Cross),
                        ),
                    }
                });
                let is_above = |grown: &Grown| grown.factors[number].value > SHOWN[1];
                let panel = match self
                    .scans
                    .iter()
                    .any(|scan| scan.grown.iter().any(is_above))
                {
                    true => panel.name("on the upper edge: above 10^{6}"),
                    false => panel,
                };
                let predicted = self.scans.iter().filter_map(|scan| scan.predicted.as_ref());
                let tongues = predicted.flat_map(|own| &own.tongues);
                let edges = tongues.flat_map(|tongue| tongue.edges);
                let panel = edges.fold(panel, |panel, edge| panel.vertical(edge.value, ""));
                let marks = mark.iter().flatten();
                chart.panel(marks.fold(panel, |panel, angle| {
                    let label = match number {
                        0 => format!("{angle}°"),
                        _ => String::new(),
                    };
                    panel.vertical(*angle, label)
                }))
            })
    }
}
