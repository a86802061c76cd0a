//! Steps of a given length in the lanes of vector registers.

// One index into all lanes at once.
#![allow(clippy::needless_range_loop)]

mod gauss;
mod rk4;

use super::place::{Grid, GridPlace, PlannedStep};
use crate::integrate::lanes::{Flags, Runs};
use crate::integrate::registers::WIDEST;
use crate::integrate::steps::Failure;
use crate::scalar::Lane;

/// The grids of times of all lanes.
struct LaneGrids<T> {
    /// How far each lane has come.
    places: [GridPlace<T>; WIDEST],
    /// The step that is tried.
    planned: [Option<PlannedStep<T>>; WIDEST],
}

impl<T: Lane> LaneGrids<T> {
    fn new(grid: Grid<T>) -> Self {
        Self {
            places: [GridPlace::new(grid); WIDEST],
            planned: [None; WIDEST],
        }
    }

    /// Plans the steps of the lanes that have a trajectory. Returns those whose step may not
    /// be tried.
    #[inline(always)]
    fn plan(&mut self, runs: &mut Runs<T>, lanes: usize) -> Flags {
        let mut stuck = [false; WIDEST];
        let active = runs.active;
        for lane in (0..lanes).filter(|&lane| active[lane]) {
            let (time, goal) = (runs.time[lane], runs.goal(lane));
            let planned = self.places[lane].plan(time, goal);
            runs.end_time[lane] = planned.end_time;
            runs.length[lane] = goal.direction * planned.length;
            runs.last[lane] = planned.end_time == runs.end[lane];
            self.planned[lane] = Some(planned);
            stuck[lane] = self.why_stuck(runs, lane).is_some();
        }
        stuck
    }

    /// Why the step of a lane may not be tried.
    #[inline(always)]
    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        let place = &self.places[lane];
        let check = |planned| place.check(planned, runs.time[lane], &runs.report(lane), 0);
        check(self.planned[lane]?).err()
    }

    /// Moves a lane to the end of its step.
    #[inline(always)]
    fn reach(&mut self, lane: usize) {
        if let Some(planned) = self.planned[lane] {
            self.places[lane].reach(planned);
        }
    }

    /// Takes the trajectory out of a lane.
    fn leave(&mut self, lane: usize) {
        self.places[lane].leave();
    }

    /// Begins a trajectory whose rates have been evaluated once.
    ///
    /// # Errors
    /// Steps are lost in the rounding of the time.
    fn begin(&mut self, runs: &mut Runs<T>, lane: usize) -> Result<(), Failure<T>> {
        let (time, place) = (runs.time[lane], &mut self.places[lane]);
        runs.next_step[lane] = place.grid().step;
        place.check_start(time, runs.goal(lane))?;
        runs.evaluations[lane] += 1;
        place.count_from(time);
        Ok(())
    }

    /// Halves the step of a lane that was not solved. Returns false if it may not be.
    fn halve(&mut self, lane: usize) -> bool {
        self.planned[lane].is_some_and(|planned| self.places[lane].halve(planned))
    }
}
