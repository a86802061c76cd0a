//! Energies of the sectors of a tree along a motion, and what changes them.

use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{EnergyDefinition, Given, NonConservative, SectorBudget};
use branched_pendulum_charts::{Axis, Chart, Panel, verbatim};
use branched_pendulum_data::{Cell, Column};

use crate::Failure;
use crate::frame::Job;
use crate::motion::SampledMotion;
use crate::subject::Subject;

/// A sector along a motion.
#[derive(Clone, Debug)]
pub struct SectorSeries {
    /// Name of the sector.
    pub name: String,
    /// Energy at each sample, J: of a difference H_d.
    pub energies: Vec<f64>,
    /// W into the sector, exact, W.
    pub transfers: Vec<f64>,
    /// Power of friction and drive, W.
    pub powers: Vec<f64>,
}

impl SectorSeries {
    /// Returns what the rates have added over the motion, by the trapezoidal rule, beside what
    /// the energy has gained, J.
    pub fn gains(&self, times: &[f64]) -> [f64; 2] {
        let rates: Vec<f64> = self
            .transfers
            .iter()
            .zip(&self.powers)
            .map(|(w, p)| w + p)
            .collect();
        let pieces = times.windows(2).zip(rates.windows(2));
        let added = pieces
            .map(|(time, rate)| 0.5 * (time[1] - time[0]) * (rate[0] + rate[1]))
            .sum();
        let gained = match (self.energies.first(), self.energies.last()) {
            (Some(first), Some(last)) => last - first,
            _ => f64::NAN,
        };
        [added, gained]
    }
}

/// Returns the sectors along a motion; none for a tree without copies.
pub fn along(subject: &Subject, samples: &SampledMotion) -> Option<Vec<SectorSeries>> {
    let tree = &subject.tree;
    let symmetric = tree.symmetric().ok()?;
    let mut all: Vec<SectorSeries> = symmetric
        .sectors()
        .iter()
        .map(|sector| SectorSeries {
            name: sector.name().to_owned(),
            energies: Vec::new(),
            transfers: Vec::new(),
            powers: Vec::new(),
        })
        .collect();
    let (mut workspace, mut budget) = (Workspace::new(), SectorBudget::new());
    for (time, state) in samples.times.iter().zip(&samples.states) {
        let (theta, omega) = state.split_at_checked(symmetric.links())?;
        let mut acting = vec![NonConservative::Friction];
        acting.extend(tree.drive(*time).map(NonConservative::Drive));
        let given = Given::Absolute { theta, omega };
        let definition = EnergyDefinition::Canonical;
        symmetric.budget(&mut workspace, definition, &acting, given, &mut budget);
        let values = budget
            .energies
            .iter()
            .zip(&budget.transfers)
            .zip(&budget.powers);
        for (own, ((energy, transfer), power)) in all.iter_mut().zip(values) {
            own.energies.push(*energy);
            own.transfers.push(*transfer);
            own.powers.push(*power);
        }
    }
    Some(all)
}

/// Writes the sectors as a table, and draws energies and W of the differences.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write(
    job: &Job,
    subject: &Subject,
    times: &[f64],
    all: &[SectorSeries],
) -> Result<(), Failure> {
    let mut columns = vec![Column::new("time", "s")];
    for sector in all {
        let name = &sector.name;
        columns.push(Column::new(format!("energy {name}"), "J"));
        columns.push(Column::new(format!("W {name}"), "W"));
        columns.push(Column::new(format!("power {name}"), "W"));
    }
    job.csv("sectors.csv", &columns, |csv| {
        for (row, time) in times.iter().enumerate() {
            let own = all.iter();
            let own = own.flat_map(|own| [own.energies[row], own.transfers[row], own.powers[row]]);
            csv.row(std::iter::once(*time).chain(own).map(Cell::from))?;
        }
        Ok(())
    })?;
    let end = times.last().copied().unwrap_or(0.0);
    let chart = Chart::new(
        format!("{}: differences between copies", verbatim(&subject.name)),
        Axis::linear("time (s)").range(0.0, end),
    );
    let panel = |label: &str, of: &dyn Fn(&SectorSeries) -> &[f64]| {
        let differences = all
            .iter()
            .filter(|own| own.name != "in_phase")
            .take(MOST_LINES);
        let panel = Panel::new(Axis::linear(label)).zero_line();
        differences.fold(panel, |panel, own| {
            panel.line(verbatim(&own.name), times, of(own))
        })
    };
    let chart = chart.panel(panel("H_d (J)", &|own| &own.energies));
    let chart = chart.panel(panel("W exact (W)", &|own| &own.transfers));
    job.chart_over_time("sectors", &chart.size(900.0, 620.0))
}

/// Most sectors that are drawn.
const MOST_LINES: usize = 8;
