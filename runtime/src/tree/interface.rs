//! Values that the blocks of a tree pass to each other.

use super::generation::Generation;
use super::memory::{Sizes, line, odd_lines};
use super::shared::Shared;
use super::sweep::Sweep;

/// Values of the links of a generation in which blocks start: in the upward pass their responses,
/// in the downward pass the accelerations of their pivots.
///
/// Several threads use it at the same time, each for the links of its own blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface<'a, T> {
    columns: Shared<'a, T>,
    stride: usize,
}

/// Number of values in a pivot's acceleration: x and y.
const PIVOTS: usize = 2;

impl<'a, T: Copy> Interface<'a, T> {
    /// Creates the interface in the memory of `slice`, for a generation of `count` links.
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

    /// Loads the responses of the links below a block, which are computed in other blocks.
    pub(super) fn load_responses(self, sweep: &mut Sweep<'_, T, T>) {
        let (last, columns) = (sweep.block.generations.last(), Self::responses(sweep));
        self.each(sweep, last, columns, |own, at, numbers| {
            own.read(at, numbers)
        });
    }

    /// Stores the accelerations of the pivots of the links below a block.
    pub(super) fn store_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let last = sweep.block.generations.last();
        self.each(sweep, last, PIVOTS, |own, at, numbers| {
            own.write(at, numbers)
        });
    }

    /// Loads the accelerations of the pivots of a block's first links.
    pub(super) fn load_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let first = sweep.block.generations.first();
        self.each(sweep, first, PIVOTS, |own, at, numbers| {
            own.read(at, numbers)
        });
    }

    /// Returns the number of columns that a response has.
    fn responses(sweep: &Sweep<'_, T, T>) -> usize {
        sweep.storage.sizes.responses
    }

    /// Calls `hand` for each column and each strip of a block's generation, with the start index of
    /// the strip in this interface and the block's numbers.
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
    /// Returns the number of values that the interface of a generation of `count` links stores.
    pub(super) fn workspace_len(count: usize, sizes: Sizes) -> usize {
        sizes.responses * odd_lines(line::<T>(), count)
    }
}
