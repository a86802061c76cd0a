//! Right-hand sides of the systems of equations in the lanes.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec::Vec;
use core::convert::Infallible;

use super::models::Models;
use crate::integrate::registers::{Numbers, check_finite, numbers, numbers_in};
use crate::integrate::right_hand_side::{MOST_STAGES, RightHandSide};
use crate::scalar::Lane;
use crate::simd::{Part, Simd, outlined};
use crate::system::{CastOde, Workspace};

/// The systems in the lanes, with a record of the stages at which rates were finite.
pub struct LaneSystems<O: CastOde<T>, T: Lane, R: Simd<T>> {
    pub(crate) models: Models<O, T, R>,
    workspace: Workspace<R>,
    /// For each lane, zero after each stage with finite rates; NaN from the first stage on whose
    /// rates are not finite.
    checks: [R; MOST_STAGES],
}

/// Evaluates the rates in a separate function that all stages call, because equations of large
/// trees are long.
impl<'a, O: CastOde<T>, T: Lane, R: Simd<T>> Part<0, RatesArguments<'a, R>> for Models<O, T, R> {
    type Output = ();

    #[inline(always)]
    fn part(&self, (workspace, time, state, rates): RatesArguments<'a, R>) {
        O::rates_of(&self.registers, workspace, time, state, rates);
    }
}

/// Workspace, time, state, and the rates to write.
type RatesArguments<'a, R> = (&'a mut Workspace<R>, R, &'a [R], &'a mut [R]);

impl<O: CastOde<T>, T: Lane, R: Simd<T>> LaneSystems<O, T, R> {
    /// Creates the systems with the same system in every lane.
    pub(crate) fn splat(system: &O) -> Self {
        Self {
            models: Models::splat(system),
            workspace: Workspace::new(),
            checks: [R::from_f64(0.0); MOST_STAGES],
        }
    }

    /// Returns, for each lane, a finite number if the rates of the stages from the second to this
    /// one are finite.
    #[inline(always)]
    pub(crate) fn check(&self, stage: usize) -> Numbers<T> {
        numbers(self.checks[stage - 1])
    }

    /// Returns the first stage, from `first` to `last`, at which the rates of a lane are not
    /// finite.
    #[cold]
    pub(crate) fn failed_stage(&self, lane: usize, first: usize, last: usize) -> usize {
        let failed = |stage: &usize| !self.check(*stage)[lane].is_finite();
        (first..last).find(failed).unwrap_or(last)
    }
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> RightHandSide<R> for LaneSystems<O, T, R> {
    type Failure = Infallible;

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.models.dimension()
    }

    #[inline(always)]
    fn write(&mut self, time: R, state: &[R], rates: &mut [R]) {
        let workspace = &mut self.workspace;
        outlined::<0, R, _, _>(&self.models, (workspace, time, state, rates));
    }

    #[inline(always)]
    fn evaluate(
        &mut self,
        stage: usize,
        time: R,
        state: &[R],
        rates: &mut [R],
    ) -> Result<(), Infallible> {
        self.write(time, state, rates);
        let before = if stage > 2 {
            self.checks[stage - 2]
        } else {
            R::from_f64(0.0)
        };
        self.checks[stage - 1] = check_finite(before, rates);
        Ok(())
    }
}

/// Systems that repeat a step in order to record the time and the state of one stage in one lane.
pub(crate) struct StageOfLane<'a, O: CastOde<T>, T: Lane, R: Simd<T>> {
    pub(crate) systems: &'a mut LaneSystems<O, T, R>,
    pub(crate) lane: usize,
    pub(crate) stage: usize,
    /// Time and state of that stage, once it has been evaluated.
    pub(crate) place: (T, Vec<T>),
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> RightHandSide<R> for StageOfLane<'_, O, T, R> {
    type Failure = Infallible;

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.systems.dimension()
    }

    fn write(&mut self, time: R, state: &[R], rates: &mut [R]) {
        self.systems.write(time, state, rates);
    }

    fn evaluate(
        &mut self,
        stage: usize,
        time: R,
        state: &[R],
        rates: &mut [R],
    ) -> Result<(), Infallible> {
        if stage == self.stage {
            self.place = (numbers(time)[self.lane], numbers_in(state, self.lane));
        }
        self.systems.evaluate(stage, time, state, rates)
    }
}
