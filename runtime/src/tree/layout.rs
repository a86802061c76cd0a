//! The room of an evaluation.

use alloc::vec::Vec;

use core::ops::Range;

use super::interface::Interface;
use super::memory::{Room, Sizes, line, odd_lines};
use super::partition::Partition;
use super::plan::Plan;
use crate::simd::WIDEST;

/// The memory of an evaluation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EvaluationMemory {
    /// Of the tree or of what is above the blocks.
    pub(super) top: Room,
    /// Of a block of each partition.
    pub(super) blocks: Vec<Room>,
}

impl EvaluationMemory {
    pub(super) fn new<T>(plan: &Plan, sizes: Sizes) -> Self {
        let blocks = plan.partitions.iter();
        Self {
            top: Room::new(&plan.top(), sizes, line::<T>()),
            blocks: blocks
                .map(|partition| Room::new(&partition.largest(), sizes, line::<T>()))
                .collect(),
        }
    }

    /// How many numbers an evaluation needs room for, on so many threads.
    pub(super) fn room<T>(&self, plan: &Plan, sizes: Sizes, threads: usize) -> usize {
        let partitions = plan
            .partitions
            .iter()
            .zip(&self.blocks)
            .map(|(partition, block)| {
                Interface::<T>::room(partition.count, sizes)
                    + workers::<T>(partition, block, threads)
            });
        let permuted = match sizes.by_link {
            true => (3 + sizes.outside()) * odd_lines(line::<T>(), plan.links() + WIDEST),
            false => 0,
        };
        line::<T>() + permuted + self.top.lasting() + self.top.passing() + partitions.sum::<usize>()
    }
}

/// How many numbers all threads need for the blocks of a partition.
pub(super) fn workers<T>(partition: &Partition, block: &Room, threads: usize) -> usize {
    let jobs = partition.jobs(threads);
    jobs.map(|links| worker::<T>(partition, block, &links))
        .sum()
}

/// How many numbers one thread needs for the blocks of these links.
pub(super) fn worker<T>(partition: &Partition, block: &Room, links: &Range<usize>) -> usize {
    // Read on the way down: of all blocks, or of the one at hand.
    let lasting = if partition.keeps {
        partition.windows(links).len()
    } else {
        1
    };
    // A line more, so that two threads never write to one.
    block.passing() + lasting * block.lasting() + line::<T>()
}
