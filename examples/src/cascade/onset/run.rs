//! One trajectory with the budgets of all sectors.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use branched_pendulum::Budget;
use branched_pendulum::integrate::{DenseError, Report};
use branched_pendulum::prelude::{
    DenseStep, Dop853, Integrator, Options, State, SymmetricCoordinates,
};

use super::Release;
use super::scene::{LINKS, SECTORS, Tree, TreeParameters};
use crate::quadrature::GAUSS;
use branched_pendulum_program::Failure;

/// Samples per second.
const RATE: f64 = 50.0;

/// The definitions of a sector's energy, in the order of [`Budgets::energies`].
pub const DEFINITIONS: [&str; 4] = ["rest", "canonical", "velocity", "parseval"];

/// Index of the definition by Parseval in [`DEFINITIONS`].
pub const PARSEVAL: usize = 3;

/// The budgets at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budgets {
    /// Time, s.
    pub time: f64,
    /// Energies of the sectors, J, by definition.
    pub energies: [[f64; SECTORS]; 4],
    /// Integrals of transfer and power since the release, J, by definition.
    pub flowed: [[f64; SECTORS]; 4],
    /// Part of `flowed` by Parseval that friction and drive gave, J.
    pub power: [f64; SECTORS],
    /// Integral of the transfer matrix since the release, J: row s, column r
    /// is what sector r gave sector s.
    pub transfers: [[f64; SECTORS]; SECTORS],
}

/// A run: samples at even times.
#[derive(Clone, Debug, PartialEq)]
pub struct Onset {
    /// The samples, the first at the release.
    pub samples: Vec<Budgets>,
    /// The integrator's account.
    pub account: Report<f64>,
}

impl Onset {
    /// Releases the tree from rest, all differences equal and small, and
    /// follows it. In symmetric coordinates, where small differences keep their
    /// digits.
    ///
    /// `progress` is called after every step with the part of the duration that
    /// is done.
    ///
    /// # Errors
    /// [`Failure::Parameter`] or [`Failure::Integration`].
    pub fn new(release: &Release, mut progress: impl FnMut(f64)) -> Result<Self, Failure> {
        let tree = Tree::new(TreeParameters {
            torque: release.torque,
            pace: TAU * release.frequency,
        })?;
        let start = State::at_rest(0.0, &at_release(release.difference));
        let mut recorder = Recorder::new(&tree, release.duration);
        recorder.sample(0.0, &start.values);
        let options = Options::with_tolerance(release.tolerance);
        let solution = Dop853::new(options)
            .try_integrate(
                &SymmetricCoordinates(&tree),
                &start,
                release.duration,
                |step| {
                    progress(step.end_time() / release.duration);
                    recorder.step(step)?;
                    Ok::<_, DenseError<f64>>(ControlFlow::Continue(()))
                },
            )
            .map_err(|error| Failure::integration(0.0, error))?;
        Ok(Self {
            samples: recorder.samples,
            account: solution.report,
        })
    }

    /// How well the budget of each sector closes, by definition: the largest
    /// |∫(W + P) dt − ΔE_s| at any sample over the largest energy of any sector.
    pub fn closure(&self, definition: usize) -> [f64; SECTORS] {
        let Some(first) = self.samples.first() else {
            return [f64::NAN; SECTORS];
        };
        let energies = |sample: &Budgets| sample.energies[definition];
        let largest = self.samples.iter().flat_map(energies).fold(0.0, f64::max);
        std::array::from_fn(|sector| {
            let start = energies(first)[sector];
            let gap = |sample: &Budgets| {
                let gained = energies(sample)[sector] - start;
                (sample.flowed[definition][sector] - gained).abs()
            };
            self.samples.iter().map(gap).fold(0.0, f64::max) / largest
        })
    }
}

/// Hanging, but for the differences. These alternate in sign and shrink from one
/// coordinate to the next, so that no two branches move alike by accident.
fn at_release(difference: f64) -> [f64; LINKS] {
    use branched_pendulum::SymmetricPendulum;
    let names = <Tree as SymmetricPendulum<f64>>::COORDINATE_NAMES;
    let mut coordinates = [0.0; LINKS];
    let differences = super::scene::sectors().iter().skip(1);
    for (number, coordinate) in differences.flat_map(|s| s.coordinates()).enumerate() {
        if let Some(index) = names.iter().position(|name| *name == coordinate.name()) {
            let sign = if number % 2 == 0 { 1.0 } else { -1.0 };
            coordinates[index] = sign * difference * 0.9_f64.powi(number as i32);
        }
    }
    coordinates
}

/// Everything that flows at one instant.
struct Flow {
    budgets: [Budget<f64, SECTORS>; 4],
    matrix: [[f64; SECTORS]; SECTORS],
}

/// Takes samples and integrates the flows between them, step by step.
struct Recorder<'a> {
    tree: &'a Tree,
    count: usize,
    samples: Vec<Budgets>,
    flowed: [[f64; SECTORS]; 4],
    power: [f64; SECTORS],
    transfers: [[f64; SECTORS]; SECTORS],
}

impl<'a> Recorder<'a> {
    fn new(tree: &'a Tree, duration: f64) -> Self {
        Self {
            tree,
            count: (duration * RATE).floor() as usize,
            samples: Vec::new(),
            flowed: [[0.0; SECTORS]; 4],
            power: [0.0; SECTORS],
            transfers: [[0.0; SECTORS]; SECTORS],
        }
    }

    fn budgets(&self, time: f64, values: &[f64]) -> [Budget<f64, SECTORS>; 4] {
        let (q, v) = halves(values);
        [
            self.tree.symmetric_budget_rest(time, &q, &v),
            self.tree.symmetric_budget_canonical(time, &q, &v),
            self.tree.symmetric_budget_velocity(time, &q, &v),
            self.tree.symmetric_budget_parseval(time, &q, &v),
        ]
    }

    fn flow(&self, time: f64, values: &[f64]) -> Flow {
        let (q, v) = halves(values);
        Flow {
            budgets: self.budgets(time, values),
            matrix: self.tree.symmetric_sector_transfer_matrix(&q, &v),
        }
    }

    fn step(&mut self, step: &mut DenseStep<'_, f64>) -> Result<(), DenseError<f64>> {
        let mut values = [0.0; 2 * LINKS];
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

    /// Adds what flows from `from` to `to`, both within the step.
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
        let mut values = [0.0; 2 * LINKS];
        for (node, weight) in GAUSS {
            let time = from + length * node;
            step.eval(time, &mut values)?;
            let flow = self.flow(time, &values);
            let weight = weight * length;
            for (sums, budget) in self.flowed.iter_mut().zip(&flow.budgets) {
                add(sums, weight, &budget.transfers);
                add(sums, weight, &budget.powers);
            }
            add(&mut self.power, weight, &flow.budgets[PARSEVAL].powers);
            for (sums, row) in self.transfers.iter_mut().zip(&flow.matrix) {
                add(sums, weight, row);
            }
        }
        Ok(())
    }

    fn sample(&mut self, time: f64, values: &[f64]) {
        let energies = self.budgets(time, values).map(|budget| budget.energies);
        self.samples.push(Budgets {
            time,
            energies,
            flowed: self.flowed,
            power: self.power,
            transfers: self.transfers,
        });
    }
}

fn add(sums: &mut [f64; SECTORS], weight: f64, values: &[f64; SECTORS]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

/// Coordinates and rates of a state.
fn halves(values: &[f64]) -> ([f64; LINKS], [f64; LINKS]) {
    let at = |index: usize| values.get(index).copied().unwrap_or(f64::NAN);
    (
        std::array::from_fn(at),
        std::array::from_fn(|index| at(index + LINKS)),
    )
}

#[cfg(test)]
mod tests {
    use super::{Onset, PARSEVAL};
    use crate::cascade::onset::Release;
    use crate::cascade::onset::scene::SECTORS;

    fn short() -> Onset {
        let release = Release {
            duration: 1.5,
            difference: 0.1,
            tolerance: 1e-11,
            ..Release::default()
        };
        Onset::new(&release, |_| ()).unwrap()
    }

    #[test]
    fn every_budget_closes_and_the_matrix_says_who_gave() {
        let run = short();
        assert_eq!(run.samples.len(), 76);
        for definition in 0..4 {
            for gap in run.closure(definition) {
                assert!(gap < 1e-9, "{definition}: {gap:e}");
            }
        }
        let last = run.samples.last().unwrap();
        for s in 0..SECTORS {
            // By Parseval: W_s is the row's sum.
            let given: f64 = last.transfers[s].iter().sum();
            let gained = last.flowed[PARSEVAL][s];
            assert!((given + last.power[s] - gained).abs() < 1e-13, "{s}");
            for r in 0..SECTORS {
                assert_eq!(last.transfers[s][r], -last.transfers[r][s]);
            }
        }
    }

    /// Motion in phase stays so, to the last bit.
    #[test]
    fn without_differences_nothing_leaves_the_means() {
        let release = Release {
            duration: 1.0,
            difference: 0.0,
            ..Release::default()
        };
        let run = Onset::new(&release, |_| ()).unwrap();
        let last = run.samples.last().unwrap();
        for energies in last.energies {
            assert!(energies[0] > 0.0);
            assert_eq!(energies[1..], [0.0; SECTORS - 1]);
        }
    }
}
