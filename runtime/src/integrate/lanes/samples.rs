//! Samples of trajectories in lanes, at output times within a step.

use alloc::vec;
use alloc::vec::Vec;

use super::method::LaneSteps;
use super::runs::{Flags, Runs};
use crate::integrate::registers::{Numbers, WIDEST, copy_lane, numbers_in, register};
use crate::integrate::right_hand_side::StepSpan;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::State;

/// Workspace for one state in each lane, from which samples are taken.
pub(super) struct LaneSamples<T, R> {
    values: Vec<R>,
    one: Vec<T>,
}

impl<T: Lane, R: Simd<T>> LaneSamples<T, R> {
    pub(super) fn new(dimension: usize) -> Self {
        Self {
            values: vec![R::from_f64(0.0); dimension],
            one: vec![T::ZERO; dimension],
        }
    }

    /// Takes the samples within the accepted steps, at the output times that `times` returns for
    /// each trajectory. Takes one sample per lane at a time. A trajectory whose dense output is not
    /// finite ends there.
    #[inline(always)]
    pub(super) fn take<'a>(
        &mut self,
        steps: &mut impl LaneSteps<T, R>,
        runs: &mut Runs<T>,
        times: impl Fn(usize) -> &'a [T],
        accepted: &Flags,
        span: StepSpan<R>,
    ) {
        let (mut prepared, mut judged) = (false, [false; WIDEST]);
        loop {
            let mut fraction: Numbers<T> = [T::ZERO; WIDEST];
            let mut inside = [false; WIDEST];
            for lane in (0..R::LANES).filter(|&lane| accepted[lane]) {
                while runs.active[lane]
                    && let Some(time) = runs.next_sample(lane, &times)
                {
                    if time == runs.end_time[lane] {
                        copy_lane(steps.end(), lane, &mut self.one);
                        runs.sample(lane, &self.one);
                        continue;
                    }
                    if !prepared {
                        steps.prepare_dense(span);
                        prepared = true;
                    }
                    if !judged[lane] {
                        judged[lane] = true;
                        if let Err(place) = steps.judge_dense(runs, lane) {
                            let last = State {
                                time: runs.end_time[lane],
                                values: numbers_in(steps.end(), lane),
                            };
                            runs.non_finite(lane, place, last);
                            break;
                        }
                    }
                    let [start, end] = [runs.time[lane], runs.end_time[lane]];
                    fraction[lane] = (time - start) / (end - start);
                    inside[lane] = true;
                    break;
                }
            }
            if !inside.contains(&true) {
                return;
            }
            steps.value(register(&fraction), &mut self.values);
            for lane in (0..R::LANES).filter(|&lane| inside[lane]) {
                copy_lane(&self.values, lane, &mut self.one);
                runs.sample(lane, &self.one);
            }
        }
    }
}
