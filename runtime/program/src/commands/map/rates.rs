//! Growth rate of a small difference between copies at every point.

use branched_pendulum::analysis::growth::{Grown, GrowthError};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum_charts::{Axis, Chart};
use branched_pendulum_data::{Cell, Column};

use super::plane::{MapPlane, Point, Question, shaded};
use crate::Failure;
use crate::commands::growth::Differences;

/// Growth rates between which colours change, 1/s.
const RATES: [f64; 2] = [0.01, 5.0];

/// How fast do differences between copies grow?
pub(super) struct Rates<'a> {
    pub(super) plane: &'a MapPlane<'a>,
    pub(super) copies: Copies,
    /// Time followed, s.
    pub(super) duration: f64,
    pub(super) tolerance: f64,
}

impl Rates<'_> {
    fn at_point(&self, point: &Point) -> Result<Option<Grown>, Failure> {
        let tree = self.plane.tree_at(point)?;
        let horizons = vec![self.duration];
        let differences = Differences::new(&tree, &self.copies, horizons, self.tolerance)?;
        match differences.along(&self.plane.start_at(point)) {
            Ok(grown) => Ok(Some(grown)),
            Err(Failure::Growth(GrowthError::Integration(_))) => Ok(None),
            Err(failure) => Err(failure),
        }
    }
}

impl Question for Rates<'_> {
    type Answer = Grown;
    const BLOCK: usize = 256;

    fn at(&self, points: &[Point]) -> Result<Vec<Option<Grown>>, Failure> {
        let grown = Ensemble::new().map(points, |_, point| self.at_point(point));
        grown.into_iter().collect()
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
             At {} the two tolerances differ by more than 1 %{lost}.\n",
            self.plane.subject.name,
            found.len(),
            share(&|rate| rate < RATES[0]),
            RATES[0],
            share(&|rate| rate > 1.0),
            open.count(),
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
        let chart = self
            .plane
            .chart(title, |panel| panel.series(shaded(&rates)));
        chart.colors(colors)
    }
}
