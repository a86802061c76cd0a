//! One trajectory, with the energy budgets of all sectors.

use std::ops::ControlFlow;

use branched_pendulum::integrate::{DenseError, Report};
use branched_pendulum::prelude::{
    DenseStep, Dop853, Integrator, Options, State, SymmetricCoordinates,
};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::{Model, Workspace};
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, SectorBudget, StateInput, SymmetricTree,
};
use branched_pendulum_trees::PendulumTree;

use super::Release;
use crate::Failure;
use crate::frame::quadrature::GAUSS;
use crate::subject::Subject;

/// Samples per second.
const RATE: f64 = 50.0;

/// Definitions of a sector's energy, with their names.
pub const DEFINITIONS: [(EnergyDefinition, &str); 4] = [
    (EnergyDefinition::Rest, "rest"),
    (EnergyDefinition::Canonical, "canonical"),
    (EnergyDefinition::Velocity, "velocity"),
    (EnergyDefinition::Parseval, "parseval"),
];

/// Index in [`DEFINITIONS`] of the definition by Parseval's identity.
pub const PARSEVAL: usize = 3;

/// One number per sector, for each of the [`DEFINITIONS`] of a sector's energy.
pub type ByDefinition = [Vec<f64>; DEFINITIONS.len()];

/// Energy that has flowed since the release, in J.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flowed {
    /// Energy that each sector has received by transfer and power together, in J.
    pub given: ByDefinition,
    /// Energy received from friction and drive, by Parseval's definition, in J.
    pub power: Vec<f64>,
    /// Integral of the transfer matrix, in J, row by row: the entry of row s, column r is the
    /// energy that sector s received from sector r.
    pub transfers: Vec<f64>,
}

/// The budgets at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Budgets {
    /// Time, s.
    pub time: f64,
    /// Energies of the sectors, J.
    pub energies: ByDefinition,
    /// Energy that has flowed since the release, in J.
    pub flowed: Flowed,
}

/// Result of a run: samples at equally spaced times.
#[derive(Clone, Debug, PartialEq)]
pub struct Onset {
    /// The samples; the first one is at the release.
    pub samples: Vec<Budgets>,
    /// The integrator's account.
    pub account: Report<f64>,
}

impl Onset {
    /// Integrates the motion of the tree after a release with small differences. It uses symmetric
    /// coordinates, in which small differences keep their digits.
    ///
    /// `progress` is called after every step with the completed fraction of the duration.
    ///
    /// # Errors
    /// [`Failure::Tree`] if the tree has no copies, or [`Failure::Motion`].
    pub fn new(
        release: &Release,
        driven: &Subject,
        mut progress: impl FnMut(f64),
    ) -> Result<Self, Failure> {
        let tree = &driven.tree;
        let symmetric = tree
            .symmetric()
            .map_err(|source| Failure::tree(&driven.name, source))?;
        let start = at_release(release, tree);
        let mut recorder = Recorder::new(tree, symmetric, release.duration);
        recorder.sample(0.0, &start.values);
        let options = Options::with_tolerance(release.tolerance);
        let solution = Dop853::new(options)
            .try_integrate(
                &SymmetricCoordinates(tree),
                &start,
                release.duration,
                |step| {
                    progress(step.end_time() / release.duration);
                    recorder.step(step)?;
                    Ok::<_, DenseError<f64>>(ControlFlow::Continue(()))
                },
            )
            .map_err(|error| Failure::Motion(Box::new(error)))?;
        Ok(Self {
            samples: recorder.samples,
            account: solution.report,
        })
    }

    /// Returns the closure error of each sector's energy budget, for one definition of the energy:
    /// the largest absolute value of ∫(W + P) dt − ΔE_s at any sample, divided by the largest
    /// energy of any sector.
    pub fn closure(&self, definition: usize) -> Vec<f64> {
        let Some(first) = self.samples.first() else {
            return Vec::new();
        };
        let energies = |sample: &Budgets| sample.energies[definition].clone();
        let largest = self.samples.iter().flat_map(energies).fold(0.0, f64::max);
        let starts = first.energies[definition].iter().enumerate();
        let closure = |(sector, start): (usize, &f64)| {
            let gap = |sample: &Budgets| {
                let gained = sample.energies[definition][sector] - start;
                (sample.flowed.given[definition][sector] - gained).abs()
            };
            self.samples.iter().map(gap).fold(0.0, f64::max) / largest
        };
        starts.map(closure).collect()
    }
}

/// Returns the start in symmetric coordinates. Its differences alternate in sign and decrease from
/// one coordinate to the next, so that no two branches move identically by accident.
fn at_release(release: &Release, tree: &PendulumTree) -> State<f64> {
    let links = tree.links();
    let mut values = vec![0.0; 2 * links];
    let (coordinates, rates) = values.split_at_mut(links);
    let start = &release.start;
    for (absolute, symmetric) in [
        (start.positions(), &mut *coordinates),
        (start.velocities(), rates),
    ] {
        tree.symmetric_from_absolute(Normalisation::Plain, absolute, symmetric);
    }
    let means = tree.sectors().first();
    let means = means.map_or(0, |means| means.coordinates().len());
    for (number, coordinate) in coordinates.iter_mut().skip(means).enumerate() {
        let sign = if number % 2 == 0 { 1.0 } else { -1.0 };
        *coordinate += sign * release.difference * 0.9_f64.powi(number as i32);
    }
    State::new(start.time, values)
}

/// Takes samples of a motion, and integrates the energy flows between them, step by step.
struct Recorder<'a> {
    tree: &'a PendulumTree,
    symmetric: SymmetricTree<f64>,
    workspace: Workspace<f64>,
    budgets: [SectorBudget<f64>; DEFINITIONS.len()],
    matrix: Vec<f64>,
    count: usize,
    samples: Vec<Budgets>,
    flowed: Flowed,
}

impl<'a> Recorder<'a> {
    fn new(tree: &'a PendulumTree, symmetric: SymmetricTree<f64>, duration: f64) -> Self {
        let sectors = tree.sectors().len();
        let zeros = || vec![0.0; sectors];
        Self {
            tree,
            symmetric,
            workspace: Workspace::new(),
            budgets: Default::default(),
            matrix: vec![0.0; sectors * sectors],
            count: (duration * RATE).floor() as usize,
            samples: Vec::new(),
            flowed: Flowed {
                given: [zeros(), zeros(), zeros(), zeros()],
                power: zeros(),
                transfers: vec![0.0; sectors * sectors],
            },
        }
    }

    /// Computes the energy budgets at one time.
    fn budget(&mut self, time: f64, values: &[f64]) {
        let (coordinates, rates) = values.split_at(self.tree.links());
        let mut acting = vec![NonConservative::Friction];
        acting.extend(self.tree.drive(time).map(NonConservative::Drive));
        for (&(definition, _), budget) in DEFINITIONS.iter().zip(&mut self.budgets) {
            let given = StateInput::Rates { coordinates, rates };
            self.symmetric
                .budget(&mut self.workspace, definition, &acting, given, budget);
        }
    }

    fn step(&mut self, step: &mut DenseStep<'_, f64>) -> Result<(), DenseError<f64>> {
        let mut values = vec![0.0; 2 * self.tree.links()];
        let mut from = step.start_time();
        while self.samples.len() <= self.count {
            let time = self.samples.len() as f64 / RATE;
            if time > step.end_time() {
                break;
            }
            self.accumulate(step, from, time)?;
            step.eval(time, &mut values)?;
            self.sample(time, &values);
            from = time;
        }
        self.accumulate(step, from, step.end_time())
    }

    /// Adds the energy that flows between the times `from` and `to`, both within the step.
    fn accumulate(
        &mut self,
        step: &mut DenseStep<'_, f64>,
        from: f64,
        to: f64,
    ) -> Result<(), DenseError<f64>> {
        let length = to - from;
        if length == 0.0 {
            return Ok(());
        }
        let links = self.tree.links();
        let mut values = vec![0.0; 2 * links];
        for (node, weight) in GAUSS {
            let time = from + length * node;
            step.eval(time, &mut values)?;
            self.budget(time, &values);
            let (coordinates, rates) = values.split_at(links);
            let given = StateInput::Rates { coordinates, rates };
            self.symmetric
                .transfer_matrix(&mut self.workspace, given, &mut self.matrix);
            let weight = weight * length;
            for (sums, budget) in self.flowed.given.iter_mut().zip(&self.budgets) {
                add(sums, weight, &budget.transfers);
                add(sums, weight, &budget.powers);
            }
            add(
                &mut self.flowed.power,
                weight,
                &self.budgets[PARSEVAL].powers,
            );
            add(&mut self.flowed.transfers, weight, &self.matrix);
        }
        Ok(())
    }

    fn sample(&mut self, time: f64, values: &[f64]) {
        self.budget(time, values);
        self.samples.push(Budgets {
            time,
            energies: self
                .budgets
                .each_ref()
                .map(|budget| budget.energies.clone()),
            flowed: self.flowed.clone(),
        });
    }
}

fn add(sums: &mut [f64], weight: f64, values: &[f64]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::cascade::Arguments;
    use crate::frame::command_line::parse_line;

    const SECTORS: usize = 8;

    fn release(duration: f64, difference: f64) -> (Release, Subject) {
        let line = "--generations 4 --set friction=1e-4,friction_ratio=1";
        let arguments: Arguments = parse_line(line).unwrap();
        let subject = arguments.read().unwrap();
        let release = Release {
            duration,
            difference,
            tolerance: 1e-11,
            ..Release::new(arguments.start(&subject).unwrap())
        };
        let driven = release.driven(&subject).unwrap();
        (release, driven)
    }

    fn onset(duration: f64, difference: f64) -> Onset {
        let (release, driven) = release(duration, difference);
        Onset::new(&release, &driven, |_| ()).unwrap()
    }

    #[test]
    fn every_budget_closes_and_the_matrix_says_who_gave() {
        let run = onset(1.5, 0.1);
        assert_eq!(run.samples.len(), 76);
        for definition in 0..DEFINITIONS.len() {
            let closure = run.closure(definition);
            assert_eq!(closure.len(), SECTORS);
            for gap in closure {
                assert!(gap < 1e-9, "{definition}: {gap:e}");
            }
        }
        let flowed = &run.samples.last().unwrap().flowed;
        for s in 0..SECTORS {
            // By Parseval: W_s is the row's sum.
            let row = &flowed.transfers[s * SECTORS..][..SECTORS];
            let gained = flowed.given[PARSEVAL][s];
            let sum = row.iter().sum::<f64>() + flowed.power[s];
            assert!(gained != 0.0 && (sum - gained).abs() < 1e-13, "{s}");
            for (r, given) in row.iter().enumerate() {
                assert_eq!(*given, -flowed.transfers[r * SECTORS + s]);
            }
        }
    }

    /// Checks that a motion in phase stays in phase exactly, so that the means lose no energy.
    #[test]
    fn without_differences_nothing_leaves_the_means() {
        let (release, driven) = release(1.0, 0.0);
        let start = at_release(&release, &driven.tree);
        let method = Dop853::new(Options::with_tolerance(1e-11));
        let end = method.run(&SymmetricCoordinates(&driven.tree), &start, 1.0);
        let end = end.unwrap().state;
        for values in [end.positions(), end.velocities()] {
            assert!(values[..4].iter().all(|value| *value != 0.0));
            assert_eq!(values[4..], [0.0; 11]);
        }
        let run = onset(1.0, 0.0);
        for energies in &run.samples.last().unwrap().energies {
            assert!(energies[0] > 0.01);
            assert!(
                energies[1..].iter().all(|energy| *energy == 0.0),
                "{energies:?}"
            );
        }
    }
}
