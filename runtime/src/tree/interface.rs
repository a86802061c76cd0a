//! Values that blocks hand over to each other.

use super::block::{Block, Generation};
use super::memory::{Sizes, line, odd_lines};
use super::shared::Shared;
use super::sweep::Sweep;

/// Numbers of the links of a generation in which blocks start: their responses, on the
/// way down the accelerations of their pivots.
///
/// Several threads have it at one time, each with the links of its own blocks.
#[derive(Debug)]
pub(super) struct Interface<'a, T> {
    columns: Shared<'a, T>,
    stride: usize,
}

impl<T> Clone for Interface<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Interface<'_, T> {}

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

    /// The responses of a block are stored here.
    pub(super) fn store_responses(self, sweep: &mut Sweep<'_, T, T>) {
        let block = sweep.block;
        let columns = sweep.storage.sizes.responses;
        self.each(
            block,
            block.generations.first(),
            columns,
            |column, own, at, length| {
                self.columns
                    .write(at, sweep.storage.responses_mut(column, own, length));
            },
        );
    }

    /// The responses of the children of a block, which are not computed there.
    pub(super) fn load_responses(self, sweep: &mut Sweep<'_, T, T>) {
        let block = sweep.block;
        let columns = sweep.storage.sizes.responses;
        self.each(
            block,
            block.generations.last(),
            columns,
            |column, own, at, length| {
                self.columns
                    .read(at, sweep.storage.responses_mut(column, own, length));
            },
        );
    }

    /// The accelerations of the pivots of these children.
    pub(super) fn store_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let block = sweep.block;
        self.each(
            block,
            block.generations.last(),
            PIVOTS,
            |column, own, at, length| {
                self.columns
                    .write(at, sweep.storage.responses_mut(column, own, length));
            },
        );
    }

    /// The accelerations of the pivots in which a block starts.
    pub(super) fn load_pivots(self, sweep: &mut Sweep<'_, T, T>) {
        let block = sweep.block;
        self.each(
            block,
            block.generations.first(),
            PIVOTS,
            |column, own, at, length| {
                self.columns
                    .read(at, sweep.storage.responses_mut(column, own, length));
            },
        );
    }

    /// All strips of neighbours of a block's generation in so many columns: where they start
    /// in the block's memory and in this, and how many they are.
    fn each(
        self,
        block: Block<'_>,
        generation: Option<&Generation>,
        columns: usize,
        mut work: impl FnMut(usize, usize, usize, usize),
    ) {
        let Some(generation) = generation else { return };
        for strip in 0..generation.strips {
            let place = block.place(generation, strip);
            let at = place.whole - generation.whole;
            for column in 0..columns {
                work(
                    column,
                    place.slot,
                    column * self.stride + at,
                    generation.length,
                );
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
