//! The room of an evaluation.

use alloc::vec::Vec;

use core::ops::Range;

use super::boundary::Boundary;
use super::cut::Cut;
use super::memory::{Extent, Sizes, line};
use super::plan::Plan;

/// The memory of an evaluation.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Of the tree or of what is above the parts.
    pub(super) top: Extent,
    /// Of a part of each cut.
    pub(super) parts: Vec<Extent>,
    pub(super) sizes: Sizes,
}

impl Layout {
    pub(super) fn new<T>(plan: &Plan, sizes: Sizes) -> Self {
        let parts = plan.cuts.iter();
        Self {
            top: Extent::new::<T>(&plan.top(), sizes),
            parts: parts
                .map(|cut| Extent::new::<T>(&cut.largest(), sizes))
                .collect(),
            sizes,
        }
    }

    /// That of the same tree in numbers of another size.
    pub(super) fn cast<T>(&self, plan: &Plan) -> Self {
        Self::new::<T>(plan, self.sizes)
    }

    /// How many numbers an evaluation needs room for, on so many threads.
    pub(super) fn room<T>(&self, plan: &Plan, threads: usize) -> usize {
        let cuts = plan.cuts.iter().zip(&self.parts).map(|(cut, part)| {
            Boundary::<T>::room(cut.count, self.sizes) + workers::<T>(cut, part, threads)
        });
        line::<T>() + self.top.lasting() + self.top.passing() + cuts.sum::<usize>()
    }
}

/// How many numbers all threads need for the parts of a cut.
pub(super) fn workers<T>(cut: &Cut, part: &Extent, threads: usize) -> usize {
    let jobs = cut.jobs(threads);
    jobs.map(|links| worker::<T>(cut, part, &links)).sum()
}

/// How many numbers one thread needs for the parts of these links.
pub(super) fn worker<T>(cut: &Cut, part: &Extent, links: &Range<usize>) -> usize {
    // Read on the way down: of all parts, or of the one at hand.
    let lasting = if cut.keeps {
        cut.windows(links).len()
    } else {
        1
    };
    // A line more, so that two threads never write to one.
    part.passing() + lasting * part.lasting() + line::<T>()
}
