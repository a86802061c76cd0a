//! Integration of many trajectories by methods with steps of constant length, in the lanes of
//! vector registers.

// One index runs through the arrays of all lanes.
#![allow(clippy::needless_range_loop)]

mod gauss;
mod rk4;

use super::grid_position::{Grid, GridPosition, PlannedStep};
use crate::integrate::lanes::{Flags, Runs};
use crate::integrate::registers::WIDEST;
use crate::integrate::steps::Failure;
use crate::scalar::Lane;

/// Grid of times of each lane.
struct LaneGrids<T> {
    /// Position of each lane on its grid of times.
    places: [GridPosition<T>; WIDEST],
    /// The step that each lane tries next.
    planned: [Option<PlannedStep<T>>; WIDEST],
}

impl<T: Lane> LaneGrids<T> {
    fn new(grid: Grid<T>) -> Self {
        Self {
            places: [GridPosition::new(grid); WIDEST],
            planned: [None; WIDEST],
        }
    }

    /// Plans the next step of each lane that has a trajectory. Returns the lanes whose step is not
    /// allowed.
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

    /// Returns the reason why the planned step of a lane is not allowed; `None` if it is allowed.
    #[inline(always)]
    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        let place = &self.places[lane];
        let check = |planned| place.check(planned, runs.time[lane], &runs.report(lane), 0);
        check(self.planned[lane]?).err()
    }

    /// Moves the position of a lane to the end of its step.
    #[inline(always)]
    fn reach(&mut self, lane: usize) {
        if let Some(planned) = self.planned[lane] {
            self.places[lane].reach(planned);
        }
    }

    /// Clears the grid of a lane whose trajectory has ended.
    fn leave(&mut self, lane: usize) {
        self.places[lane].leave();
    }

    /// Starts the grid of a trajectory, whose rates have been evaluated once.
    ///
    /// # Errors
    /// If a step is so short that it does not change the rounded time.
    fn begin(&mut self, runs: &mut Runs<T>, lane: usize) -> Result<(), Failure<T>> {
        let (time, place) = (runs.time[lane], &mut self.places[lane]);
        runs.next_step[lane] = place.grid().step;
        place.check_start(time, runs.goal(lane))?;
        runs.evaluations[lane] += 1;
        place.count_from(time);
        Ok(())
    }

    /// Halves the step of a lane whose equations could not be solved. Returns false if no more
    /// halvings are allowed.
    fn halve(&mut self, lane: usize) -> bool {
        self.planned[lane].is_some_and(|planned| self.places[lane].halve(planned))
    }
}
