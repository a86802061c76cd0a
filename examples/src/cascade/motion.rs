//! The motion of all starts, window by window.

use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::system::UnderTorques;
use serde::{Deserialize, Serialize};

use super::arguments::Arguments;
use super::budget::{Budgets, ScaleBudget};
use super::density::Density;
use super::motor::{Motor, Random};
use super::scene::RodTree;
use crate::failure::Failure;
use crate::program::{Checkpoint, Job};

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
    /// Steps of the integrator.
    pub steps: u64,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
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

/// Follows the starts `items`, each from its own random numbers, from the checkpoint of `job` if there is one.
///
/// # Errors
/// [`Failure`].
pub fn follow<P: RodTree>(
    arguments: &Arguments,
    job: &Job,
    items: &[usize],
) -> Result<Vec<Followed>, Failure> {
    let shape = arguments.shape();
    let tree = || P::of(&shape, arguments.friction, arguments.friction_ratio);
    let free = || P::of(&shape, 0.0, arguments.friction_ratio);
    let mut systems = Vec::new();
    let mut starts = Vec::new();
    for &item in items {
        let mut random = Random::of_start(arguments.seed, item);
        let angles: Vec<f64> = (0..shape.links())
            .map(|_| random.within(arguments.spread))
            .collect();
        let motor = Motor::new(arguments, &mut random);
        systems.push((tree()?, motor));
        starts.push(Followed {
            state: State::at_rest(0.0, &angles).values,
            windows: Vec::new(),
            densities: vec![Density::default(); shape.generations - 1],
            steps: 0,
            evaluations: 0,
        });
    }
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
    let method = Dop853::new(Options::with_tolerance(arguments.tolerance));
    let ensemble = NonZeroUsize::new(arguments.threads)
        .map_or_else(Ensemble::new, |threads| Ensemble::new().threads(threads));
    let samples = arguments.samples as usize;
    let time = |sample: usize| sample as f64 / (arguments.frequency * samples as f64);
    while reached.windows < windows {
        let first = reached.windows * samples;
        let times: Vec<f64> = (1..=samples).map(|sample| time(first + sample)).collect();
        let releases: Vec<_> = systems
            .iter()
            .zip(&reached.starts)
            .map(|((tree, motor), start)| {
                let state = State::new(time(first), start.state.clone());
                (UnderTorques::of(tree, motor.clone()), state)
            })
            .collect();
        let motions = ensemble.sample_models_in_lanes(&method, &releases, &times);
        let mut ended = Vec::new();
        for motion in motions {
            match &motion.end {
                Ok(end) => ended.push((end.state.values.clone(), end.report, motion)),
                Err(error) => return Err(Failure::integration(0.0, error.clone())),
            }
        }
        let is_late = 2 * reached.windows >= windows;
        let means = ensemble.map(&ended, |index, (_, _, motion)| {
            let (tree, free) = (tree().ok()?, free().ok()?);
            let mut budgets = Budgets::new(shape, tree, free);
            let motor = &systems.get(index)?.1;
            let mut window = Window::new(shape.generations);
            for (time, state) in times.iter().zip(motion.states()) {
                window.add(budgets.at(motor, *time, state), is_late);
            }
            Some(window)
        });
        for ((start, (state, report, _)), window) in reached.starts.iter_mut().zip(ended).zip(means)
        {
            start.state = state;
            start.steps += report.accepted;
            start.evaluations += report.evaluations;
            if let Some(window) = window {
                start.windows.extend(window.means());
                for (all, own) in start.densities.iter_mut().zip(&window.densities) {
                    all.add(own);
                }
            }
        }
        reached.windows += 1;
        progress.within(0, reached.windows as f64 / windows as f64);
        progress.tell(&format!(
            "{:.4} J",
            energy(&reached.starts, shape.generations)
        ));
        checkpoint.save(&reached)?;
    }
    Ok(reached.starts)
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
struct Window {
    sums: Vec<[f64; QUANTITIES]>,
    samples: f64,
    densities: Vec<Density>,
}

impl Window {
    fn new(scales: usize) -> Self {
        Self {
            sums: vec![[0.0; QUANTITIES]; scales],
            samples: 0.0,
            densities: vec![Density::default(); scales - 1],
        }
    }

    fn add(&mut self, budgets: &[ScaleBudget], counts: bool) {
        self.samples += 1.0;
        for (sums, budget) in self.sums.iter_mut().zip(budgets) {
            let ScaleBudget {
                energy,
                received,
                friction,
                drive,
            } = *budget;
            for (sum, value) in sums.iter_mut().zip([energy, received, friction, drive]) {
                *sum += value;
            }
        }
        if counts {
            let mut flux = 0.0;
            let densities = self.densities.iter_mut().rev();
            for (density, budget) in densities.zip(budgets.iter().rev()) {
                flux += budget.received;
                density.count(flux);
            }
        }
    }

    fn means(&self) -> impl Iterator<Item = f64> {
        self.sums.iter().flatten().map(|sum| sum / self.samples)
    }
}

/// The motion of a start from where it was left, by frames of the length `interval`, for the picture.
///
/// # Errors
/// [`Failure`].
pub fn film<P: RodTree>(
    arguments: &Arguments,
    start: &Followed,
    frames: usize,
    interval: f64,
) -> Result<Vec<Vec<f64>>, Failure> {
    let shape = arguments.shape();
    let tree = P::of(&shape, arguments.friction, arguments.friction_ratio)?;
    let mut random = Random::of_start(arguments.seed, 0);
    for _ in 0..shape.links() {
        random.within(arguments.spread);
    }
    let motor = Motor::new(arguments, &mut random);
    let from = arguments.windows() as f64 / arguments.frequency;
    let times: Vec<f64> = (0..frames)
        .map(|frame| from + interval * frame as f64)
        .collect();
    let method = Dop853::new(Options::with_tolerance(arguments.tolerance));
    let release = [(
        UnderTorques::of(&tree, motor),
        State::new(from, start.state.clone()),
    )];
    let motions = Ensemble::new().sample_models_in_lanes(&method, &release, &times);
    let mut states = Vec::new();
    for motion in motions {
        if let Err(error) = &motion.end {
            return Err(Failure::integration(0.0, error.clone()));
        }
        states.extend(motion.states().map(<[f64]>::to_vec));
    }
    Ok(states)
}
