//! Upward and downward pass of the recursion for accelerations through a block of the tree.

mod by_link;
mod passes;
mod strip;
mod view;

use super::block::SubtreeBlock;
use super::memory::Storage;
#[cfg(test)]
pub(super) use passes::SweepKernel;
pub(super) use passes::{PassSelection, Passes, add, sweep};
pub(super) use strip::VectorIndices;
pub(super) use view::View;

/// A block of a tree, with its state and its workspace.
#[derive(Debug)]
pub(super) struct Sweep<'a, N, T> {
    pub(super) block: SubtreeBlock<'a>,
    /// Constants: one row for each generation, or one column per constant for all links.
    pub(super) constants: &'a [N],
    /// Angular velocities, if they are read from the caller's slice.
    pub(super) omega: &'a [T],
    pub(super) storage: Storage<'a, T>,
    /// Acceleration of the root's pivot, if the root is in the block.
    pub(super) root: Option<[T; 2]>,
    /// Torque on the root, if the root is in the block.
    pub(super) torque: Option<T>,
}
