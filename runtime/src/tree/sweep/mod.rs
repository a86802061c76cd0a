//! Leaves to root, and back: the recursion over a block of the tree.

mod by_link;
mod passes;
mod strip;
mod view;

use super::block::SubtreeBlock;
use super::memory::Storage;
#[cfg(test)]
pub(super) use passes::SweepKernel;
pub(super) use passes::{Passes, Way, add, sweep};
pub(super) use strip::VectorPlaces;
pub(super) use view::View;

/// A block with its state.
#[derive(Debug)]
pub(super) struct Sweep<'a, N, T> {
    pub(super) block: SubtreeBlock<'a>,
    /// Rows of all generations, or columns of all links.
    pub(super) constants: &'a [N],
    /// Velocities, where they are read where they are given.
    pub(super) omega: &'a [T],
    pub(super) storage: Storage<'a, T>,
    /// Acceleration of the root's pivot, where the root is in the block.
    pub(super) root: Option<[T; 2]>,
    /// Torque on the root, where the root is in the block.
    pub(super) torque: Option<T>,
}
