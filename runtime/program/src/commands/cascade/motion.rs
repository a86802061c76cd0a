//! The motion of all starts, window by window.

use std::iter;
use std::num::NonZeroUsize;

use branched_pendulum::ScaleBudget;
use branched_pendulum::ensemble::Samples;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{UnderTorques, Workspace};
use branched_pendulum_trees::PendulumTree;
use serde::{Deserialize, Serialize};

use super::arguments::Arguments;
use super::density::Density;
use super::motor::{Motor, Random};
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::{Checkpoint, Job};

/// Quantities of each scale whose means over a window are kept.
pub const QUANTITIES: usize = 4;

/// One start, followed so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Angles and velocities at the end.
    pub state: Vec<f64>,
    /// Means over the windows, one after the other: for each scale energy (J), power
    /// received from the others, of the friction and of the motor (W).
    pub windows: Vec<f64>,
    /// For each scale but the first, how often what passes into it and all younger ones
    /// has which value, in the second half of the time.
    pub densities: Vec<Density>,
}

/// Some of the starts, at the end of a window.
#[derive(Debug, Serialize, Deserialize)]
struct Reached {
    /// Their numbers.
    items: Vec<usize>,
    /// Windows done.
    windows: usize,
    starts: Vec<Followed>,
}

/// Starts that one thread moves at a time: some registers full.
pub(super) const TOGETHER: usize = 16;

/// Follows the starts `items`, each from its own random numbers, from the checkpoint of
/// `job` if there is one.
///
/// # Errors
/// [`Failure`].
pub fn follow(
    arguments: &Arguments,
    driven: &DrivenTree,
    job: &Job,
    items: &[usize],
) -> Result<Vec<Followed>, Failure> {
    let middle = arguments.start(&driven.subject)?;
    let (starts, motors): (Vec<_>, Vec<_>) = items
        .iter()
        .map(|&item| Followed::new(arguments, driven, &middle, item))
        .unzip();
    let mut reached = Reached {
        items: items.to_vec(),
        windows: 0,
        starts,
    };
    let mut checkpoint = Checkpoint::new(job, arguments.checkpoint);
    if let Some(saved) = checkpoint.read::<Reached>()?
        && saved.items == items
    {
        reached = saved;
    }
    let windows = arguments.windows();
    let progress = job.progress(1);
    progress.begin("starts");
    let ensemble = NonZeroUsize::new(arguments.threads)
        .map_or_else(Ensemble::new, |threads| Ensemble::new().threads(threads));
    while reached.windows < windows {
        let motion = WindowMotion {
            arguments,
            driven,
            window: reached.windows,
            counts: 2 * reached.windows >= windows,
        };
        let groups = reached.starts.chunks(TOGETHER);
        let groups: Vec<_> = groups.zip(motors.chunks(TOGETHER)).collect();
        let moved = ensemble.map(&groups, |_, (starts, motors)| motion.follow(starts, motors));
        let moved = moved.into_iter().flatten().zip(items);
        for (start, (moved, &item)) in reached.starts.iter_mut().zip(moved) {
            let (state, window) = moved.map_err(|error| diverged(item, &error))?;
            start.state = state;
            start.windows.extend(window.means());
            for (all, own) in start.densities.iter_mut().zip(&window.densities) {
                all.add(own);
            }
        }
        reached.windows += 1;
        progress.within(0, reached.windows as f64 / windows as f64);
        progress.tell(&format!(
            "{:.4} J",
            energy(&reached.starts, driven.generations())
        ));
        checkpoint.save(&reached)?;
    }
    Ok(reached.starts)
}

/// One window of the motion.
struct WindowMotion<'a> {
    arguments: &'a Arguments,
    driven: &'a DrivenTree,
    /// Number of the window.
    window: usize,
    /// True if values of the fluxes are counted.
    counts: bool,
}

/// A state at the end of a window, and the sums over it.
type Moved = (Vec<f64>, WindowSums);

impl WindowMotion<'_> {
    /// Moves starts through the window, in lanes: their states at its end, and sums over it.
    fn follow(
        &self,
        starts: &[Followed],
        motors: &[Motor],
    ) -> Vec<Result<Moved, IntegrationError<f64>>> {
        let Arguments { steps, samples, .. } = *self.arguments;
        let first = u64::from(steps) * self.window as u64;
        let time = self.arguments.time(first);
        let releases: Vec<_> = starts
            .iter()
            .zip(motors)
            .map(|(start, motor)| {
                let system = UnderTorques::of(&self.driven.subject.tree, motor.clone());
                (system, State::new(time, start.state.clone()))
            })
            .collect();
        let times = self.arguments.times(first, steps / samples, samples);
        let method = Rk4::new(self.arguments.step());
        let alone = Ensemble::new().threads(NonZeroUsize::MIN);
        let moved = alone.sample_models_in_lanes(&method, &releases, &times);
        let mut budgets = StateBudgets::new(self);
        let sum = |(samples, motor): (Samples<f64>, &Motor)| {
            let mut sums = WindowSums::new(self.driven.generations());
            for (&time, state) in times.iter().zip(samples.states()) {
                sums.add(budgets.at(time, state, motor), self.counts);
            }
            Ok((samples.end?.state.values, sums))
        };
        moved.into_iter().zip(motors).map(sum).collect()
    }
}

/// Budgets of states of a tree, in memory that is kept.
struct StateBudgets<'a> {
    tree: &'a PendulumTree,
    workspace: Workspace<f64>,
    torques: Vec<f64>,
    budget: ScaleBudget<f64>,
}

impl<'a> StateBudgets<'a> {
    fn new(motion: &WindowMotion<'a>) -> Self {
        Self {
            tree: &motion.driven.subject.tree,
            workspace: Workspace::new(),
            torques: vec![0.0; motion.driven.links()],
            budget: ScaleBudget::new(),
        }
    }

    /// The budget of a state under its motor.
    fn at(&mut self, time: f64, state: &[f64], motor: &Motor) -> &ScaleBudget<f64> {
        let (theta, omega) = state.split_at(self.tree.links());
        self.torques[0] = motor.torque(time);
        let given = [theta, omega, &self.torques];
        self.tree
            .budget_by_scale_into(&mut self.workspace, time, given, &mut self.budget);
        &self.budget
    }
}

impl Followed {
    /// The start of the number `item`, at random about `middle`, and its motor.
    fn new(
        arguments: &Arguments,
        driven: &DrivenTree,
        middle: &State<f64>,
        item: usize,
    ) -> (Self, Motor) {
        let mut random = Random::of_start(arguments.seed, item);
        let spread = arguments.spread.to_radians();
        let mut state = middle.values.clone();
        for angle in state.iter_mut().take(driven.links()) {
            *angle += random.within(spread);
        }
        let torque = arguments.torque(&driven.subject);
        let motor = Motor::new(arguments, torque, &mut random);
        let start = Self {
            state,
            windows: Vec::new(),
            densities: vec![Density::default(); driven.generations() - 1],
        };
        (start, motor)
    }
}

/// Mean energy of the trees in the last window, J.
fn energy(starts: &[Followed], scales: usize) -> f64 {
    let row = QUANTITIES * scales;
    let last = starts
        .iter()
        .filter_map(|start| start.windows.rchunks(row).next());
    let energies = last.map(|last| last.iter().step_by(QUANTITIES).sum::<f64>());
    energies.sum::<f64>() / starts.len().max(1) as f64
}

/// Sums over one window of one start.
#[derive(Clone)]
struct WindowSums {
    sums: Vec<[f64; QUANTITIES]>,
    samples: f64,
    densities: Vec<Density>,
}

impl WindowSums {
    fn new(scales: usize) -> Self {
        Self {
            sums: vec![[0.0; QUANTITIES]; scales],
            samples: 0.0,
            densities: vec![Density::default(); scales - 1],
        }
    }

    fn add(&mut self, budget: &ScaleBudget<f64>, counts: bool) {
        self.samples += 1.0;
        for (scale, sums) in self.sums.iter_mut().enumerate() {
            let values = [
                budget.energy(scale),
                budget.received(scale),
                budget.friction_power(scale) + budget.drag_power(scale),
                budget.drive_power(scale) + budget.outside_power(scale),
            ];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += value;
            }
        }
        if counts {
            for (scale, density) in (1..).zip(&mut self.densities) {
                density.count(budget.flux(scale));
            }
        }
    }

    fn means(&self) -> impl Iterator<Item = f64> {
        self.sums.iter().flatten().map(|sum| sum / self.samples)
    }
}

/// The motion of the first start from where it was left, `frames` states that follow each other by about
/// `interval` seconds, and by how many they do.
///
/// # Errors
/// [`Failure`].
pub fn film(
    arguments: &Arguments,
    driven: &DrivenTree,
    start: &Followed,
    frames: usize,
    interval: f64,
) -> Result<(Vec<Vec<f64>>, f64), Failure> {
    let middle = arguments.start(&driven.subject)?;
    let (_, motor) = Followed::new(arguments, driven, &middle, 0);
    let stride = (interval / arguments.step()).round().max(1.0) as u32;
    let first = arguments.windows() as u64 * u64::from(arguments.steps);
    let release = State::new(arguments.time(first), start.state.clone());
    let times = arguments.times(first, stride, frames as u32 - 1);
    let moved = Rk4::new(arguments.step())
        .sample_to_vec(
            &UnderTorques::of(&driven.subject.tree, motor),
            &release,
            &times,
        )
        .map_err(|error| diverged(0, &error))?;
    let states = iter::once(release).chain(moved);
    let states = states.map(|state| state.values).collect();
    Ok((states, f64::from(stride) * arguments.step()))
}

/// The failure of a start.
pub(super) fn diverged(start: usize, error: &IntegrationError<f64>) -> Failure {
    let time = error.last_state().map_or(0.0, |last| last.time);
    Failure::Diverged { start, time }
}
