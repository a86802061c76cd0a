//! The first steps of trajectories that come into lanes.

use alloc::vec::Vec;

use super::{LanePair, Lanes, limit};
use crate::integrate::control::FirstStep;
use crate::integrate::lanes::registers::{WIDEST, numbers, numbers_in, register};
use crate::integrate::lanes::{Flags, Runs};
use crate::scalar::register::Register;
use crate::scalar::{Real, Scalar};
use crate::system::Cast;

impl<M: LanePair, P: Cast<R::Lane>, R: Register> Lanes<'_, M, P, R> {
    /// The first stage and the first step of fresh trajectories. The other lanes
    /// go through it too, and keep what they have.
    pub(super) fn first_steps(&mut self, runs: &mut Runs<R::Lane>, fresh: &Flags) {
        let n = 2 * P::LINKS;
        let mut time = runs.time;
        let mut step = [R::Lane::ZERO; WIDEST];
        let memory = &mut self.memory;
        let others: Vec<R> = memory.rates[..n].to_vec();
        memory.stage.copy_from_slice(&memory.start);
        memory.evaluate(&self.models, register(&time), 1);
        let mask = R::mask(|lane| fresh[lane]);
        for (rate, other) in memory.rates.iter_mut().zip(others) {
            *rate = rate.choose(other, mask);
        }
        for lane in (0..R::LANES).filter(|&lane| fresh[lane]) {
            step[lane] = self.euler(runs, lane);
            time[lane] += step[lane];
        }
        let memory = &mut self.memory;
        let step = register::<R>(&step);
        for i in 0..n {
            memory.stage[i] = step.mul_add(memory.rates[i], memory.start[i]);
        }
        memory.evaluate(&self.models, register(&time), 2);
        for lane in (0..R::LANES).filter(|&lane| fresh[lane]) {
            if runs.active[lane] && self.options.initial_step.is_none() {
                self.first_step(runs, lane);
            }
        }
    }

    /// After the rates at the start: the length of the Euler step from which the
    /// first step is estimated, with its sign. Zero where that is given.
    fn euler(&self, runs: &mut Runs<R::Lane>, lane: usize) -> R::Lane {
        runs.evaluations[lane] += 1;
        if !numbers(self.memory.checks[0])[lane].is_finite() {
            let state = self.state(lane, runs.time[lane]);
            runs.non_finite(lane, (state.time, state.values.clone()), state);
            return R::Lane::ZERO;
        }
        if let Some(step) = self.options.initial_step {
            runs.step[lane] = limit(self.options, step);
            return R::Lane::ZERO;
        }
        runs.evaluations[lane] += 1;
        runs.step[lane] = self.first(runs, lane).euler();
        runs.direction[lane] * runs.step[lane]
    }

    /// After the rates at the end of the Euler step: chooses the first step.
    fn first_step(&self, runs: &mut Runs<R::Lane>, lane: usize) {
        let n = 2 * P::LINKS;
        if !numbers(self.memory.checks[1])[lane].is_finite() {
            let time = runs.time[lane] + runs.direction[lane] * runs.step[lane];
            let place = (time, numbers_in(&self.memory.stage, lane));
            runs.non_finite(lane, place, self.state(lane, runs.time[lane]));
            return;
        }
        let rates = numbers_in(&self.memory.rates[..n], lane);
        let mut change = numbers_in(&self.memory.rates[n..2 * n], lane);
        for (change, &rate) in change.iter_mut().zip(&rates) {
            *change = *change - rate;
        }
        let change = self.scaled_norm(lane, &change);
        let first = self.first(runs, lane);
        runs.step[lane] = first.refined(runs.step[lane], change, M::ORDER);
    }

    fn first(&self, runs: &Runs<R::Lane>, lane: usize) -> FirstStep<R::Lane> {
        let memory = &self.memory;
        let state = numbers_in(&memory.start, lane);
        let rates = numbers_in(&memory.rates[..2 * P::LINKS], lane);
        let left = (runs.end[lane] - runs.time[lane]).abs();
        FirstStep {
            state: self.scaled_norm(lane, &state),
            rates: self.scaled_norm(lane, &rates),
            longest: limit(self.options, left),
        }
    }

    /// Euclidean norm of what is divided by its tolerance at the start of the step.
    fn scaled_norm(&self, lane: usize, vector: &[R::Lane]) -> R::Lane {
        let memory = &self.memory;
        let mut sum = R::Lane::ZERO;
        for (i, &value) in vector.iter().enumerate() {
            let of = |registers: &[R]| numbers(registers[i])[lane];
            let scale = of(&memory.absolute) + of(&memory.relative) * of(&memory.start).abs();
            let ratio = value / scale;
            sum += ratio * ratio;
        }
        Scalar::sqrt(sum)
    }
}
