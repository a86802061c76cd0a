//! What parts tell each other.

use super::memory::{Sizes, odd_lines};
use super::part::{Part, Stage};
use super::shared::Shared;
use super::sweep::Sweep;

/// Numbers of the links of a generation in which parts start: their answers, on the
/// way down the accelerations of their pivots.
///
/// Several threads have it at one time, each with the links of its own parts.
#[derive(Debug)]
pub(super) struct Boundary<'a, T> {
    columns: Shared<'a, T>,
    stride: usize,
}

impl<T> Clone for Boundary<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Boundary<'_, T> {}

/// Accelerations of pivots.
const PIVOTS: usize = 2;

impl<'a, T: Copy> Boundary<'a, T> {
    /// In this slice, for a generation of so many links.
    pub(super) fn new(slice: &'a mut [T], count: usize) -> Self {
        Self {
            columns: Shared::new(slice),
            stride: odd_lines::<T>(count),
        }
    }

    /// The answers of a part are stored here.
    pub(super) fn store_answers(self, sweep: &mut Sweep<'_, T>) {
        let part = sweep.part;
        let columns = sweep.storage.sizes.answers;
        self.each(
            part,
            part.stages.first(),
            columns,
            |column, own, at, length| {
                self.columns
                    .write(at, sweep.storage.answers_mut(column, own, length));
            },
        );
    }

    /// The answers of the children of a part, which are not computed there.
    pub(super) fn load_answers(self, sweep: &mut Sweep<'_, T>) {
        let part = sweep.part;
        let columns = sweep.storage.sizes.answers;
        self.each(
            part,
            part.stages.last(),
            columns,
            |column, own, at, length| {
                self.columns
                    .read(at, sweep.storage.answers_mut(column, own, length));
            },
        );
    }

    /// The accelerations of the pivots of these children.
    pub(super) fn store_pivots(self, sweep: &mut Sweep<'_, T>) {
        let part = sweep.part;
        self.each(
            part,
            part.stages.last(),
            PIVOTS,
            |column, own, at, length| {
                self.columns
                    .write(at, sweep.storage.answers_mut(column, own, length));
            },
        );
    }

    /// The accelerations of the pivots in which a part starts.
    pub(super) fn load_pivots(self, sweep: &mut Sweep<'_, T>) {
        let part = sweep.part;
        self.each(
            part,
            part.stages.first(),
            PIVOTS,
            |column, own, at, length| {
                self.columns
                    .read(at, sweep.storage.answers_mut(column, own, length));
            },
        );
    }

    /// All runs of neighbours of a part's stage in so many columns: where they start
    /// in the part's memory and in this, and how many they are.
    fn each(
        self,
        part: Part<'_>,
        stage: Option<&Stage>,
        columns: usize,
        mut work: impl FnMut(usize, usize, usize, usize),
    ) {
        let Some(stage) = stage else { return };
        for run in 0..stage.runs {
            let place = part.place(stage, run);
            let at = place.whole - stage.whole;
            for column in 0..columns {
                work(column, place.slot, column * self.stride + at, stage.length);
            }
        }
    }
}

impl<T> Boundary<'_, T> {
    /// How many numbers there are for a generation of so many links.
    pub(super) fn room(count: usize, sizes: Sizes) -> usize {
        sizes.answers * odd_lines::<T>(count)
    }
}
