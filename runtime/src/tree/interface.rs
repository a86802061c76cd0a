//! Values that blocks hand over to each other.

use super::generation::Generation;
use super::memory::{Sizes, line, odd_lines};
use super::shared::Shared;
use super::sweep::Sweep;

/// Numbers of the links of a generation in which blocks start: their responses, on the
/// way down the accelerations of their pivots.
///
/// Several threads have it at one time, each with the links of its own blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface<'a, T> {
    columns: Shared<'a, T>,
    stride: usize,
}

/// Accelerations of pivots.
const PIVOTS: usize = 2;

impl<'a, T: Copy> Interface<'a, T> {
    /// In this slice, for a generation of so many links.
    pub(super) fn new(slice: &'a mut [T], count: usize) -> Self {
        Self {
            columns: Shared::new(slice),
            stride: odd_lines(line::<T>(), count),
        }
    }

    /// Stores the responses of the first generation of a block.
    pub(super) fn store_responses(self, sweep: &mut Sweep<'_, T, T>) {
        let (first, columns) = (sweep.block.generations.first(), Self::responses(sweep));
        self.each(sweep, first, columns, |own, at, numbers| {
            own.write(at, numbers)
        });
    }

    /// Loads the responses of the children of a block, which are not computed there.
    pub(super) fn load_responses(self, sweep: &mut Sweep<'_, T, T>) {
        let (last, columns) = (sweep.block.generations.last(), Self::responses(sweep));
        self.each(sweep, last, columns, |own, at, numbers| {
            own.read(at, numbers)
        });
    }

    /// Stores the accelerations of the pivots of these children.
    pub(super) fn store_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let last = sweep.block.generations.last();
        self.each(sweep, last, PIVOTS, |own, at, numbers| {
            own.write(at, numbers)
        });
    }

    /// Loads the accelerations of the pivots in which a block starts.
    pub(super) fn load_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let first = sweep.block.generations.first();
        self.each(sweep, first, PIVOTS, |own, at, numbers| {
            own.read(at, numbers)
        });
    }

    /// Number of columns of responses.
    fn responses(sweep: &Sweep<'_, T, T>) -> usize {
        sweep.storage.sizes.responses
    }

    /// Hands over the neighbours of a block's generation in so many columns, strip by strip,
    /// from the place where they start here.
    fn each(
        self,
        sweep: &mut Sweep<'_, T, T>,
        generation: Option<&Generation>,
        columns: usize,
        hand: impl Fn(Shared<'a, T>, usize, &mut [T]),
    ) {
        let Some(generation) = generation else { return };
        for strip in 0..generation.strips {
            let place = sweep.block.place(generation, strip);
            let at = place.whole - generation.whole;
            for column in 0..columns {
                let numbers = sweep
                    .storage
                    .responses_mut(column, place.slot, generation.length);
                hand(self.columns, column * self.stride + at, numbers);
            }
        }
    }
}

impl<T> Interface<'_, T> {
    /// How many numbers there are for a generation of so many links.
    pub(super) fn room(count: usize, sizes: Sizes) -> usize {
        sizes.responses * odd_lines(line::<T>(), count)
    }
}
