//! The branch simulated by all models: errors, and costs per frame.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::approximate::{ForcedApproximation, Linear, LinearFrames, Switched};
use branched_pendulum::integrate::{Frames, InputError, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Computes, UnderTorques, functions};

use super::scene::{Branch, LINKS};
use super::weather::Weather;
use branched_pendulum_frame::Failure;

/// Factors by which wind and pull are multiplied in the compared runs.
pub const WINDS: [f64; 3] = [0.1, 0.4, 1.0];

/// Lengths of sub-steps, relative to the longest one that the model recommends.
const SUB_STEPS: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

/// Numbers of modes that truncated linear models keep.
const MODES: [usize; 3] = [4, 10, 20];

/// Error of the angles (rad) up to which the switching model uses the linear model.
pub const TOLERANCE: f64 = 0.01;

/// Number of runs of which the shortest counts; it is determined separately for each part of this
/// number of frames.
const RUNS: usize = 9;
const PART: usize = 30;

/// The branch in both precisions, with its linear model.
#[derive(Clone, Debug)]
pub struct Branches {
    /// In double precision.
    pub double: Branch,
    /// In single precision.
    pub single: Branch<f32>,
    /// About its equilibrium.
    pub linear: Linear,
    /// Longest sub-step, s.
    pub sub_step: f64,
}

impl Branches {
    /// Builds the branches and the linear model.
    ///
    /// # Errors
    /// [`Failure::Linear`].
    pub fn new() -> Result<Self, Failure> {
        let double = Branch::new();
        Ok(Self {
            single: Branch::default(),
            linear: Linear::about(&double, &[0.0; LINKS])?,
            sub_step: longest_sub_step(&double),
            double,
        })
    }
}

/// The exact motion, sampled frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Length of a frame, s.
    pub frame: f64,
    /// Full states of the branch; the first is at time 0.
    pub states: Vec<Vec<f64>>,
}

/// Integrates the branch from rest with high accuracy. During each frame, the torques are constant
/// and have their values at its beginning.
///
/// # Errors
/// [`Failure::Integration`].
pub fn reference(
    branches: &Branches,
    weather: &Weather,
    frame: f64,
    frames: usize,
) -> Result<Seen, Failure> {
    let start = State::at_rest(0.0, branches.linear.equilibrium());
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let failed = |error| Failure::integration(0.0, error);
    let held = UnderTorques::of(&branches.double, vec![0.0; LINKS]);
    let mut stepper = method.start(held, &start).map_err(failed)?;
    let mut states = vec![start.values];
    for number in 0..frames {
        let (time, last) = (number as f64 * frame, &states[number]);
        let torques = stepper.ode_mut().torques_mut();
        weather.torques(&branches.double, time, last, torques);
        let end = time + frame;
        while stepper.step_to(end).map_err(failed)?.is_some() {}
        states.push(stepper.state().to_vec());
    }
    Ok(Seen { frame, states })
}

/// A model that advances the branch frame by frame.
trait Mover<T> {
    fn advance(&mut self, torques: &[T]);
    fn state_into(&self, state: &mut [T]);
}

impl<T: Real, P: Computes<functions::AccelerationsUnderTorques, T>> Mover<T>
    for (Frames<UnderTorques<P, Vec<T>>, T>, T)
{
    fn advance(&mut self, torques: &[T]) {
        let (frames, frame) = self;
        frames.ode_mut().torques_mut().copy_from_slice(torques);
        frames.advance(*frame);
    }

    fn state_into(&self, state: &mut [T]) {
        state.copy_from_slice(self.0.state());
    }
}

impl<T: Real> Mover<T> for LinearFrames<T> {
    fn advance(&mut self, torques: &[T]) {
        self.advance_under(torques);
    }

    fn state_into(&self, state: &mut [T]) {
        LinearFrames::state_into(self, state);
    }
}

impl<T, P, A> Mover<T> for Switched<UnderTorques<P, Vec<T>>, A, T>
where
    T: Real,
    P: Computes<functions::AccelerationsUnderTorques, T>,
    A: ForcedApproximation<T>,
{
    fn advance(&mut self, torques: &[T]) {
        self.advance_under(torques);
    }

    fn state_into(&self, state: &mut [T]) {
        state.copy_from_slice(self.state());
    }
}

/// Error and cost of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Kind of the model, with the precision.
    pub kind: String,
    /// Setting that distinguishes the model from others of its kind.
    pub setting: String,
    /// Number of sub-steps per frame; 0 if the model has none.
    pub sub_steps: u32,
    /// Largest error of an angle, in rad.
    pub error: f64,
    /// Time of a frame, µs.
    pub microseconds: f64,
}

/// All models in one wind.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Share of wind and pull.
    pub share: f64,
    /// Largest deviation of an angle from the equilibrium, in rad.
    pub amplitude: f64,
    /// The models.
    pub models: Vec<Measured>,
}

/// Simulates the branch with all models in one wind.
///
/// # Errors
/// [`Failure`].
pub fn trial(
    branches: &Branches,
    weather: &Weather,
    share: f64,
    frame: f64,
    frames: usize,
) -> Result<Trial, Failure> {
    let seen = reference(branches, weather, frame, frames)?;
    let rest = branches.linear.equilibrium();
    let ways = seen.states.iter().map(|state| distance(state, rest));
    let mut models = Vec::new();
    let course = Course {
        branches,
        weather,
        seen: &seen,
    };
    course.models(&branches.double, "f64", &mut models)?;
    course.models(&branches.single, "f32", &mut models)?;
    Ok(Trial {
        share,
        amplitude: ways.fold(0.0, f64::max),
        models,
    })
}

/// Largest difference of an angle.
fn distance(state: &[f64], angles: &[f64]) -> f64 {
    let pairs = state.iter().zip(angles).take(LINKS);
    pairs.fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

/// The exact motion, with which all models are compared.
struct Course<'a> {
    branches: &'a Branches,
    weather: &'a Weather,
    seen: &'a Seen,
}

impl Course<'_> {
    fn models<T, P>(&self, branch: &P, scalar: &str, all: &mut Vec<Measured>) -> Result<(), Failure>
    where
        T: Real + Send + Sync + std::fmt::Debug + 'static,
        P: Positions<T> + Computes<functions::AccelerationsUnderTorques, T>,
    {
        let (linear, frame) = (&self.branches.linear, self.seen.frame);
        let start: Vec<T> = self.seen.states[0]
            .iter()
            .map(|&v| T::from_f64(v))
            .collect();
        let start = State::new(T::ZERO, start);
        let full = |share: f64| -> Result<_, InputError<T>> {
            let sub_step = T::from_f64(share * self.branches.sub_step);
            Frames::new(
                UnderTorques::of(branch, vec![T::ZERO; LINKS]),
                &start,
                sub_step,
            )
        };
        let failed = |error: InputError<T>| Failure::Frames(Box::new(error));
        for share in SUB_STEPS {
            let sub_steps = (frame / (share * self.branches.sub_step)).ceil() as u32;
            all.push(Measured {
                kind: format!("full, {scalar}"),
                setting: format!("{sub_steps} sub-steps"),
                sub_steps,
                ..self.measure(branch, (full(share).map_err(failed)?, T::from_f64(frame)))
            });
        }
        let linear_frames = || -> Result<LinearFrames<T>, Failure> {
            let mut frames = linear.frames(frame)?;
            frames.set_state(&start.values);
            Ok(frames)
        };
        all.push(Measured {
            kind: format!("linear, {scalar}"),
            setting: format!("{LINKS} modes"),
            ..self.measure(branch, linear_frames()?)
        });
        for modes in MODES {
            let slow = linear.truncate(linear.frequencies_hz()[modes - 1]);
            let mut slow = slow.frames(frame)?;
            slow.set_state(&start.values);
            all.push(Measured {
                kind: format!("truncated, {scalar}"),
                setting: format!("{modes} modes"),
                ..self.measure(branch, slow)
            });
        }
        let (tolerance, seconds) = (T::from_f64(TOLERANCE), T::from_f64(linear.fading_time()));
        let full = full(1.0).map_err(failed)?;
        all.push(Measured {
            kind: format!("switched, {scalar}"),
            setting: format!("to {TOLERANCE} rad"),
            ..self.measure(
                branch,
                Switched::new(full, linear_frames()?, tolerance, seconds),
            )
        });
        Ok(())
    }

    /// Measures a model in two runs: the first computes the torques from the model's own motion,
    /// and the second uses these torques and is timed.
    fn measure<T: Real, P: Positions<T>>(
        &self,
        branch: &P,
        mover: impl Mover<T> + Clone,
    ) -> Measured {
        let frames = self.seen.states.len() - 1;
        let mut state = vec![T::ZERO; 2 * LINKS];
        let mut torques = vec![T::ZERO; LINKS * frames];
        let mut own = mover.clone();
        let mut error = 0.0_f64;
        for (number, torques) in torques.chunks_exact_mut(LINKS).enumerate() {
            own.state_into(&mut state);
            self.weather
                .torques(branch, number as f64 * self.seen.frame, &state, torques);
            own.advance(torques);
            own.state_into(&mut state);
            let state: Vec<f64> = state.iter().map(|value| value.to_f64()).collect();
            error = error.max(distance(&state, &self.seen.states[number + 1]));
        }
        // Parts of runs, which are short enough that some run of each is not disturbed.
        let mut shortest = vec![f64::INFINITY; frames.div_ceil(PART)];
        for _ in 0..RUNS {
            let mut own = mover.clone();
            for (torques, shortest) in torques.chunks(PART * LINKS).zip(&mut shortest) {
                let begin = Instant::now();
                for torques in torques.chunks_exact(LINKS) {
                    own.advance(torques);
                }
                own.state_into(&mut state);
                black_box(&mut state);
                *shortest = shortest.min(begin.elapsed().as_secs_f64());
            }
        }
        Measured {
            kind: String::new(),
            setting: String::new(),
            sub_steps: 0,
            error,
            microseconds: 1e6 * shortest.iter().sum::<f64>() / frames as f64,
        }
    }
}
