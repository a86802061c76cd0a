//! Growth rate of a small difference between copies, at every point of a map.

use std::collections::HashMap;
use std::sync::Arc;

use branched_pendulum::analysis::growth::{Grown, GrowthError};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum_charts::{Axis, Chart, Color, Dash, Series};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

use super::normal_modes::{self, NormalMode};
use super::tongues::{self, Tongue};
use crate::Failure;
use crate::commands::differences::{differences_of, start_apart};
use crate::commands::plane::{MapPlane, Point, Question, marks, shaded};
use crate::commands::predicted::{PredictedLine, Theory};
use crate::frame::Job;

/// Colours of lines that are visible on dark blue and on yellow.
const LINES: [Color; 2] = [Color::rgb(225, 70, 60), Color::rgb(70, 200, 245)];

/// Colour of predicted edges, visible on dark blue and on yellow.
const EDGES: Color = Color::rgb(255, 255, 255);

/// Range of growth rates (1/s) over which colours change.
const RATES: [f64; 2] = [0.01, 5.0];

/// Question of a map: how fast do differences between copies grow?
pub(super) struct Rates<'a> {
    pub(super) plane: &'a MapPlane<'a>,
    pub(super) copies: &'a Copies,
    /// Normal forms of the trees, if tongues are predicted.
    pub(super) theory: Option<Theory<'a>>,
    /// Predictions along lines, each with the axis along which its line runs.
    pub(super) predicted: Vec<(usize, PredictedLine)>,
    /// Time followed, s.
    pub(super) duration: f64,
    pub(super) tolerance: f64,
    /// Points that the map marks.
    pub(super) marked: &'a [Point],
    /// Lines on which tongues are searched for.
    pub(super) lines: Vec<Vec<Point>>,
    pub(super) with_modes: bool,
    pub(super) modes: Vec<NormalMode>,
    pub(super) tongues: Vec<Tongue>,
}

impl Rates<'_> {
    /// Returns the growth within a duration (s) at some points; `None` where the motion could not
    /// be integrated.
    pub(super) fn within(
        &self,
        duration: f64,
        points: &[Point],
    ) -> Result<Vec<Option<Grown>>, Failure> {
        let trees = self.plane.trees_at(points)?;
        // Points with the same parameters share a tree.
        let mut distinct: Vec<&PendulumTree> = Vec::new();
        let mut known: HashMap<*const PendulumTree, usize> = HashMap::new();
        let numbers = trees.iter().map(|tree| {
            *known.entry(Arc::as_ptr(tree)).or_insert_with(|| {
                distinct.push(tree);
                distinct.len() - 1
            })
        });
        let numbers: Vec<usize> = numbers.collect();
        let differences = Ensemble::new().map(&distinct, |_, tree| {
            differences_of(tree, self.copies, vec![duration], self.tolerance)
        });
        let differences: Vec<_> = differences.into_iter().collect::<Result<_, _>>()?;
        let each = points.iter().zip(numbers);
        let cases = each.map(|(point, number)| (&differences[number], self.plane.start_at(point)));
        let cases: Vec<_> = cases.collect();
        let grown = DifferenceGrowth::of_trees_in_lanes(&Ensemble::new(), &cases);
        let grown = grown.map_err(|_| start_apart())?.into_iter();
        grown
            .map(|found| match found {
                Ok(found) => Ok(Some(found)),
                Err(GrowthError::Integration(_)) => Ok(None),
                Err(error) => Err(error.into()),
            })
            .collect()
    }
}

/// Returns the axis along which a line runs.
fn axis_of(line: &[Point]) -> Option<usize> {
    let (first, last) = line.first().zip(line.last())?;
    (0..2).find(|axis| first[*axis] != last[*axis])
}

impl Rates<'_> {
    /// Describes the predicted tongues.
    fn predictions(&self) -> String {
        let mut text = String::new();
        for (axis, line) in &self.predicted {
            let other = 1 - axis;
            let name = self.plane.names()[other];
            text.push_str(&format!(
                "\nBy theory, {name} = {}\n",
                self.plane.words(other, line.value)
            ));
            line.write(&mut text, self.plane, *axis);
        }
        text
    }

    /// Returns the points of the plane at the edges of the predicted tongues.
    fn predicted_edges(&self) -> Vec<Point> {
        let edges = self.predicted.iter().flat_map(|(axis, line)| {
            let tongues = line.tongues.tongues.iter();
            let edges = tongues.flat_map(|tongue| tongue.edges);
            edges.map(move |edge| match axis {
                0 => [edge.value, line.value],
                _ => [line.value, edge.value],
            })
        });
        edges.collect()
    }
}

impl Question for Rates<'_> {
    type Answer = Grown;
    const BLOCK: usize = 2048;

    fn at(&self, points: &[Point]) -> Result<Vec<Option<Grown>>, Failure> {
        self.within(self.duration, points)
    }

    fn complete(&mut self, job: &Job) -> Result<(), Failure> {
        if self.with_modes && !job.is_interrupted() {
            self.modes = normal_modes::of(self.plane, self.copies)?;
        }
        for line in &self.lines {
            if !job.is_interrupted() {
                self.tongues.extend(tongues::along(self, line)?);
                if let (Some(theory), Some(axis)) = (&self.theory, axis_of(line)) {
                    let line = theory.along(self.plane, line, axis)?;
                    self.predicted.push((axis, line));
                }
            }
        }
        Ok(())
    }

    fn columns(&self) -> Vec<Column> {
        vec![
            Column::new("growth rate", "1/s"),
            Column::new("growth rate between tolerances", ""),
            Column::new("growth factor", ""),
            Column::new("frequency of the difference", "Hz"),
        ]
    }

    fn row(&self, grown: &Grown) -> Vec<Cell<'_>> {
        let factor = grown.factors.first();
        let factor = factor.map_or(f64::NAN, |factor| factor.value);
        let (rate, frequency) = (grown.rate, grown.frequency_hz.value);
        let row = [rate.value, rate.difference, factor, frequency];
        row.map(Cell::from).to_vec()
    }

    fn report(&self, found: &[(Point, Grown)], lost: usize) -> String {
        let share = |inside: &dyn Fn(f64) -> bool| {
            let some = found.iter().filter(|(_, grown)| inside(grown.rate.value));
            100.0 * some.count() as f64 / found.len().max(1) as f64
        };
        let open = found
            .iter()
            .filter(|(_, grown)| !grown.rate.is_determined());
        let lost = match lost {
            0 => String::new(),
            lost => format!("; {lost} could not be followed"),
        };
        format!(
            "{}: {} points, {:.1} % with a growth rate below {} 1/s, {:.1} % with one above 1 1/s.\n\
             At {} the two tolerances differ by more than 1 %{lost}.\n{}{}{}",
            self.plane.subject.name,
            found.len(),
            share(&|rate| rate < RATES[0]),
            RATES[0],
            share(&|rate| rate > 1.0),
            open.count(),
            normal_modes::text(&self.modes),
            tongues::text(self),
            self.predictions(),
        )
    }

    fn record(&self, _: &[(Point, Grown)]) -> Vec<(&'static str, usize)> {
        Vec::new()
    }

    fn chart(&self, found: &[(Point, Grown)]) -> Chart {
        let rates = found
            .iter()
            .map(|(point, grown)| (*point, grown.rate.value));
        let rates: Vec<(Point, f64)> = rates.collect();
        let title = "growth rate of a difference between copies";
        let colors = Axis::log("growth rate (1/s)").range(RATES[0], RATES[1]);
        let chart = self.plane.chart(title, |panel| {
            let panel = panel.series(shaded(&rates));
            let modes = self.modes.iter().zip(LINES).enumerate();
            let panel = modes.fold(panel, |panel, (number, (mode, color))| {
                let [x, y] = mode.curve();
                let label = format!("nonlinear normal mode f_{}", number + 1);
                panel.series(Series::line(label, &x, &y).color(color).dash(Dash::Solid))
            });
            let edges = self.predicted_edges();
            let [x, y] = [0, 1].map(|axis| edges.iter().map(|edge| edge[axis]).collect::<Vec<_>>());
            let panel = match edges.is_empty() {
                true => panel,
                false => panel.series(Series::points("edges by theory", &x, &y).color(EDGES)),
            };
            marks(panel, self.marked)
        });
        chart.colors(colors)
    }
}
