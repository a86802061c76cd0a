//! Energies of the sectors of a tree along a motion, and the powers that change them.

use branched_pendulum::Transfer;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{EnergyDefinition, NonConservative, SectorBudget, StateInput};
use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, verbatim};
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
    /// Energy at each sample, in J; for a difference it is H_d.
    pub energies: Vec<f64>,
    /// Exact energy transfer W into the sector at each sample, in W.
    pub transfers: Vec<f64>,
    /// Growth and forcing, the two parts of W, in W; empty if all copies are identical.
    pub causes: Vec<[f64; 2]>,
    /// Power of friction and drive on the sector, in W.
    pub powers: Vec<f64>,
}

impl SectorSeries {
    /// Returns the integral of all powers over the motion (trapezoidal rule) and the increase of
    /// the energy, both in J.
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

/// Computes the energies of the sectors along a motion; `None` if the tree has no copies.
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
            causes: Vec::new(),
            powers: Vec::new(),
        })
        .collect();
    let (mut workspace, mut budget) = (Workspace::new(), SectorBudget::new());
    let [mut growth, mut forcing] = [(); 2].map(|()| vec![Transfer::default(); all.len()]);
    for (time, state) in samples.times.iter().zip(&samples.states) {
        let (theta, omega) = state.split_at_checked(symmetric.links())?;
        let mut acting = vec![NonConservative::Friction];
        acting.extend(tree.drive(*time).map(NonConservative::Drive));
        let given = StateInput::Absolute { theta, omega };
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
        if symmetric.has_unequal_copies() {
            symmetric.growth(&mut workspace, given, &mut growth);
            symmetric.forcing(&mut workspace, given, &mut forcing);
            for (own, (growth, forcing)) in all.iter_mut().zip(growth.iter().zip(&forcing)) {
                own.causes.push([growth.total(), forcing.total()]);
            }
        }
    }
    Some(all)
}

/// Writes the sectors as a table, and draws energies, W and powers of the differences: the rate of
/// change of an energy is the sum of W and the powers.
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
        if !sector.causes.is_empty() {
            columns.push(Column::new(format!("growth {name}"), "W"));
            columns.push(Column::new(format!("forcing {name}"), "W"));
        }
    }
    job.csv("sectors.csv", &columns, |csv| {
        for (row, time) in times.iter().enumerate() {
            let own = all.iter();
            let own = own.flat_map(|own| {
                let rates = [own.energies[row], own.transfers[row], own.powers[row]];
                let causes = own.causes.get(row).into_iter().flatten().copied();
                rates.into_iter().chain(causes)
            });
            csv.row(std::iter::once(*time).chain(own).map(Cell::from))?;
        }
        Ok(())
    })?;
    let end = times.last().copied().unwrap_or(0.0);
    let chart = Chart::new(
        format!("{}: differences between copies", verbatim(&subject.name)),
        Axis::linear("time (s)").range(0.0, end),
    );
    let differences = all.iter().filter(|own| own.name != "in_phase");
    let differences: Vec<&SectorSeries> = differences.take(MOST_LINES).collect();
    let panel = |label: &str, of: &dyn Fn(&SectorSeries) -> &[f64]| {
        let panel = Panel::new(Axis::linear(label)).zero_line();
        differences.iter().fold(panel, |panel, own| {
            // A single one has nothing to be told from.
            let name = match differences.len() {
                1 => String::new(),
                _ => verbatim(&own.name),
            };
            let line = Series::line(name, times, of(own));
            panel.series(match differences.len() {
                1 => line.color(Color::of_series(0)).dash(Dash::Solid),
                _ => line,
            })
        })
    };
    let chart = chart.panel(panel("H_d (J)", &|own| &own.energies));
    let chart = chart.panel(panel("W exact (W)", &|own| &own.transfers));
    let mut powers = differences.iter().flat_map(|own| &own.powers);
    let chart = match powers.any(|power| *power != 0.0) {
        true => {
            let panel = panel(power_label(subject), &|own| &own.powers);
            chart.panel(panel).size(900.0, 830.0)
        }
        false => chart.size(900.0, 620.0),
    };
    job.chart_over_time("sectors", &chart)
}

/// Returns the name of the forces whose power changes the energies of sectors in addition to W.
fn power_label(subject: &Subject) -> &'static str {
    match subject.tree.drive(0.0) {
        None => "power of friction (W)",
        Some(_) => "power of friction and drive (W)",
    }
}

/// Most sectors that are drawn.
const MOST_LINES: usize = 8;

#[cfg(test)]
mod tests {
    use super::along;
    use crate::motion::{MethodArguments, sample};
    use crate::subject::{Subject, TreeArguments};
    use branched_pendulum::integrate::MethodChoice;
    use branched_pendulum::prelude::*;
    use branched_pendulum::system::Workspace;
    use branched_pendulum::transfer::{
        EnergyDefinition, NonConservative, SectorBudget, StateInput,
    };
    use branched_pendulum_trees::PendulumTree;

    /// Trees with copies, driven by a torque or by a moving pivot, with or without friction.
    const DRIVEN: [&str; 4] = [
        "drive(torque = 0.02 * cos(7 * t)), gravity = 9.81,
         stem: rod(mass = 0.2, length = 0.3) [arm: rod(mass = 0.1, length = 0.2) * 2]",
        "drive(x = 0.01 * cos(9 * t)), gravity = 9.81,
         stem: rod(mass = 0.2, length = 0.3) [arm: rod(mass = 0.1, length = 0.2) * 3]",
        "drive(y = 0.02 * sin(20 * t)), gravity = 9.81,
         stem: rod(mass = 0.2, length = 0.3, friction = 1e-3) [
             arm: rod(mass = 0.1, length = 0.2, friction = 2e-3) * 2
         ]",
        "gravity = 9.81, stem: rod(mass = 0.2, length = 0.3, friction = 1e-3) [
             arm: rod(mass = 0.1, length = 0.2, friction = 2e-3) * 2
         ]",
    ];

    fn read(text: &str) -> Subject {
        let arguments = TreeArguments {
            tree: "test".to_owned(),
            set: Vec::new(),
            parameters: None,
        };
        let described = arguments.described_as(text.to_owned()).unwrap();
        described.read().unwrap()
    }

    /// Checks that each sector along a motion gains the energy that W, friction and drive supply.
    #[test]
    fn the_budget_of_a_driven_tree_closes() {
        for text in DRIVEN {
            let subject = read(text);
            let tree: &PendulumTree = &subject.tree;
            let links = tree.links();
            let theta: Vec<f64> = (0..links).map(|link| 0.6 - 0.3 * link as f64).collect();
            let times: Vec<f64> = (0..=4000).map(|step| f64::from(step) * 2.5e-4).collect();
            let method = MethodArguments {
                method: MethodChoice::Given(Method::Dop853),
                tolerance: Some(1e-12),
            };
            let start = State::at_rest(0.0, &theta);
            let samples = sample(&subject, &method, &start, times).unwrap();
            let all = along(&subject, &samples).unwrap();
            assert!(all.len() > 1);
            let mut moved = 0.0_f64;
            for own in &all {
                let [added, gained] = own.gains(&samples.times);
                moved = moved.max(gained.abs());
                // Errors of the trapezoidal rule.
                let error = (added - gained).abs();
                assert!(error < 1e-6, "{text}: {}: {added} {gained}", own.name);
            }
            assert!(moved > 1e-3, "{text}: {moved}");
        }
    }

    /// The energies by Parseval's identity add up to the energy of the tree, and their powers to that of
    /// friction and drive. Canonical ones do not: the power of a sector is p_sᵀ B_s⁻¹ Q_s, and its momenta
    /// p_s have parts of other sectors where copies have different angles.
    #[test]
    fn powers_by_parseval_add_up_to_those_of_the_tree() {
        for text in DRIVEN {
            let subject = read(text);
            let tree = &subject.tree;
            let symmetric = tree.symmetric().unwrap();
            let (mut workspace, mut budget) = (Workspace::new(), SectorBudget::new());
            let mut apart = 0.0_f64;
            for step in 0..20 {
                let time = 0.13 * f64::from(step);
                let links = 0..tree.links();
                let (theta, omega): (Vec<f64>, Vec<f64>) = links
                    .map(|link| time + 0.7 * link as f64)
                    .map(|phase| (0.9 * phase.sin(), 4.0 * phase.cos()))
                    .unzip();
                let mut acting = vec![NonConservative::Friction];
                acting.extend(tree.drive(time).map(NonConservative::Drive));
                let (theta, omega) = (&theta, &omega);
                let given = StateInput::Absolute { theta, omega };
                let expected =
                    tree.friction_power(theta, omega) + tree.drive_power(time, theta, omega);
                let mut powers = |definition| -> f64 {
                    symmetric.budget(&mut workspace, definition, &acting, given, &mut budget);
                    budget.powers.iter().sum()
                };
                let error = (powers(EnergyDefinition::Parseval) - expected).abs();
                assert!(error < 1e-13 + 1e-12 * expected.abs(), "{text}: {error}");
                let canonical = powers(EnergyDefinition::Canonical);
                apart = apart.max((canonical - expected).abs() / expected.abs());
            }
            assert!(apart > 1e-3, "{text}: {apart}");
        }
    }
}
