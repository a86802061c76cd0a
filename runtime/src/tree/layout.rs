//! Memory layout of the workspace of an evaluation.

use alloc::vec::Vec;

use core::ops::Range;

use super::interface::Interface;
use super::memory::{BlockMemory, Sizes, line, odd_lines};
use super::partition::Partition;
use super::plan::Plan;
use crate::simd::WIDEST;

/// Workspace sizes of an evaluation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EvaluationMemory {
    /// Workspace of the whole tree, or of the part above the blocks.
    pub(super) top: BlockMemory,
    /// Workspace of one block, for each partition of the tree.
    pub(super) blocks: Vec<BlockMemory>,
}

impl EvaluationMemory {
    pub(super) fn new<T>(plan: &Plan, sizes: Sizes) -> Self {
        let blocks = plan.partitions.iter();
        Self {
            top: BlockMemory::new(&plan.top(), sizes, line::<T>()),
            blocks: blocks
                .map(|partition| BlockMemory::new(&partition.largest(), sizes, line::<T>()))
                .collect(),
        }
    }

    /// Returns the length, in numbers, of the workspace of an evaluation on `threads` threads.
    pub(super) fn workspace_len<T>(&self, plan: &Plan, sizes: Sizes, threads: usize) -> usize {
        let partitions = plan
            .partitions
            .iter()
            .zip(&self.blocks)
            .map(|(partition, block)| {
                Interface::<T>::workspace_len(partition.count, sizes)
                    + workers::<T>(partition, block, threads)
            });
        let permuted = match sizes.by_link {
            true => (3 + sizes.outside()) * odd_lines(line::<T>(), plan.links() + WIDEST),
            false => 0,
        };
        line::<T>() + permuted + self.top.lasting() + self.top.passing() + partitions.sum::<usize>()
    }
}

/// Returns the workspace length, in numbers, that all threads together need for the blocks of a
/// partition.
pub(super) fn workers<T>(partition: &Partition, block: &BlockMemory, threads: usize) -> usize {
    let jobs = partition.jobs(threads);
    jobs.map(|links| worker::<T>(partition, block, &links))
        .sum()
}

/// Returns the workspace length, in numbers, that one thread needs for the blocks that start with
/// these links.
pub(super) fn worker<T>(partition: &Partition, block: &BlockMemory, links: &Range<usize>) -> usize {
    // Numbers read in the downward pass, of all blocks or of one block at a time.
    let lasting = if partition.keeps {
        partition.windows(links).len()
    } else {
        1
    };
    // One cache line more, so that two threads never write to the same line.
    block.passing() + lasting * block.lasting() + line::<T>()
}
