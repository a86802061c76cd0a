//! Integration of the motion of all starts, window by window.

use std::iter;
use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::system::UnderTorques;
use serde::{Deserialize, Serialize};

use super::arguments::Arguments;
use super::budgets::{QUANTITIES, StateBudgets, WindowSums};
use super::density::Density;
use super::motor::{Kicks, Motor, Random};
use super::structure::AmplitudeSums;
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::{Checkpoint, Job};

/// One start, followed so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Angles and velocities at the end of the last window.
    pub state: Vec<f64>,
    /// Means over the windows, one after the other. For each scale: energy (J), power received from
    /// other scales, power of friction, power of the motor (W).
    pub windows: Vec<f64>,
    /// Histograms over the second half of the time, one for each scale but the first: values of the
    /// power that passes into this scale and all younger ones.
    pub densities: Vec<Density>,
    /// Moments of the amplitude of each scale, in the second half of the time.
    pub amplitudes: Vec<AmplitudeSums>,
}

/// States reached from some of the starts at the end of a time window, as a checkpoint stores them.
#[derive(Debug, Serialize, Deserialize)]
struct Reached {
    /// Their numbers.
    items: Vec<usize>,
    /// Windows done.
    windows: usize,
    starts: Vec<Followed>,
}

/// Number of starts that one thread integrates at a time: they fill several registers.
pub(super) const TOGETHER: usize = 16;

/// Integrates the starts `items`, each with its own random numbers; continues from the checkpoint
/// of `job` if there is one.
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
        let groups = groups
            .zip(motors.chunks(TOGETHER))
            .zip(items.chunks(TOGETHER));
        let groups: Vec<_> = groups.collect();
        let moved = ensemble.map(&groups, |_, ((starts, motors), items)| {
            motion.follow(starts, motors, items)
        });
        let moved = moved.into_iter().flatten().zip(items);
        for (start, (moved, &item)) in reached.starts.iter_mut().zip(moved) {
            let (state, window) = moved.map_err(|error| diverged(item, &error))?;
            start.state = state;
            start.windows.extend(window.means());
            for (all, own) in start.densities.iter_mut().zip(&window.densities) {
                all.add(own);
            }
            for (all, own) in start.amplitudes.iter_mut().zip(&window.amplitudes) {
                all.add(own);
            }
        }
        reached.windows += 1;
        progress.within(0, reached.windows as f64 / windows as f64);
        progress.show_message(&format!(
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
    /// True if values of the fluxes are counted in histograms.
    counts: bool,
}

/// A state at the end of a window, and the sums over the window.
type EndAndSums = (Vec<f64>, WindowSums);

impl WindowMotion<'_> {
    /// Integrates starts through the window, in lanes. Returns their states at the end and the sums
    /// over the window. With noise, the integration starts again after each kick.
    fn follow(
        &self,
        starts: &[Followed],
        motors: &[Motor],
        items: &[usize],
    ) -> Vec<Result<EndAndSums, IntegrationError<f64>>> {
        let Arguments {
            steps,
            samples,
            noise,
            seed,
            ..
        } = *self.arguments;
        let first = u64::from(steps) * self.window as u64;
        let stride = steps / samples;
        let times = self.arguments.times(first, stride, samples);
        let sums = WindowSums::new(self.driven.generations());
        let states = starts
            .iter()
            .map(|start| Ok((start.state.clone(), sums.clone())));
        let mut moved: Vec<Result<EndAndSums, IntegrationError<f64>>> = states.collect();
        let mut budgets = StateBudgets::new(self.arguments, self.driven);
        let Some(noise) = noise else {
            self.advance(
                &mut moved,
                motors,
                (self.arguments.time(first), &times),
                &mut budgets,
            );
            return moved;
        };
        let interval = f64::from(stride) * self.arguments.step();
        let kicks = items
            .iter()
            .map(|&item| Kicks::new(seed, item, self.window));
        let mut kicks: Vec<Kicks> = kicks.collect();
        let mut start = self.arguments.time(first);
        for time in times {
            self.advance(&mut moved, motors, (start, &[time]), &mut budgets);
            for (own, kicks) in moved.iter_mut().zip(&mut kicks) {
                if let Ok((state, _)) = own {
                    budgets.kick(state, (noise * interval).sqrt() * kicks.draw());
                }
            }
            start = time;
        }
        moved
    }

    /// Moves all starts that have not diverged from a time through others, and adds the budgets
    /// there.
    fn advance(
        &self,
        moved: &mut [Result<EndAndSums, IntegrationError<f64>>],
        motors: &[Motor],
        (start, times): (f64, &[f64]),
        budgets: &mut StateBudgets<'_>,
    ) {
        let running = moved.iter().zip(motors);
        let releases = running.filter_map(|(own, motor)| {
            let (state, _) = own.as_ref().ok()?;
            let system = UnderTorques::of(&self.driven.subject.tree, motor.clone());
            Some((system, State::new(start, state.clone())))
        });
        let releases: Vec<_> = releases.collect();
        let method = Rk4::new(self.arguments.step());
        let alone = Ensemble::new().threads(NonZeroUsize::MIN);
        let ends = alone.sample_models_in_lanes(&method, &releases, times);
        let running = moved.iter_mut().zip(motors).filter(|(own, _)| own.is_ok());
        for ((own, motor), samples) in running.zip(ends) {
            let Ok((state, sums)) = own else { continue };
            for (&time, state) in times.iter().zip(samples.states()) {
                sums.add(budgets.at(time, state, motor), self.counts);
            }
            match samples.end {
                Ok(end) => *state = end.state.values,
                Err(error) => *own = Err(error),
            }
        }
    }
}

impl Followed {
    /// Creates start number `item`, at a random state near `middle`, and its motor.
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
            amplitudes: vec![AmplitudeSums::default(); driven.generations()],
        };
        (start, motor)
    }
}

/// Returns the mean energy of the trees in the last window, in J.
fn energy(starts: &[Followed], scales: usize) -> f64 {
    let row = QUANTITIES * scales;
    let last = starts
        .iter()
        .filter_map(|start| start.windows.rchunks(row).next());
    let energies = last.map(|last| last.iter().step_by(QUANTITIES).sum::<f64>());
    energies.sum::<f64>() / starts.len().max(1) as f64
}

/// Continues the motion of the first start for a film. Returns `frames` states that are about
/// `interval` seconds apart, and the exact interval.
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
