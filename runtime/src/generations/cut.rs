//! Generations that are taken apart into parts.

use alloc::vec::Vec;

use core::ops::Range;

use super::part::{Part, SLOTS, Stage};
use super::runs::Runs;

/// Neighbours in a part: whole vectors, and runs that are long enough to be fetched
/// ahead.
pub(super) const WIDTH: usize = 256;

/// Of so many links, what is formed on the way up is kept for the way down: it fits
/// into the third cache.
const KEPT: usize = 1 << 18;

/// Of so many links without leaves or more, threads share the parts.
const THREADED: usize = 1 << 14;

/// Some consecutive generations, in parts that start with neighbours of the first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cut {
    /// The first generation, and how many links it has.
    pub(super) first: usize,
    pub(super) count: usize,
    /// How many links there are in all of these generations.
    links: usize,
    /// Whether parts keep what is formed on the way up.
    pub(super) keeps: bool,
    /// Whether the last generation of the tree is among them. If not, the stages of
    /// a part end with the generation behind.
    pub(super) has_leaves: bool,
    /// The generations of a part, and of the last one, which has another width.
    part: Stages,
    last: Stages,
}

/// The generations of a part.
#[derive(Clone, Debug, PartialEq)]
struct Stages {
    stages: Vec<Stage>,
    runs: Runs,
}

impl Stages {
    /// Of stages from the generation `first` on.
    fn new(stages: Vec<Stage>, first: usize, has_leaves: bool) -> Self {
        let inner = stages.len().saturating_sub(1);
        let runs = Runs::new(&stages, first, inner, has_leaves);
        Self { stages, runs }
    }
}

/// How many parts so many links are. The last one also takes links that would be too
/// few for a register.
fn parts(links: usize) -> usize {
    links.saturating_sub(SLOTS) / WIDTH + 1
}

impl Cut {
    /// From a generation on with `count` links, and `links` in all of them; of the
    /// stages of so many neighbours.
    pub(super) fn new(
        first: usize,
        [count, links]: [usize; 2],
        has_leaves: bool,
        stages: impl Fn(usize) -> Vec<Stage>,
    ) -> Self {
        let stages = |width| Stages::new(stages(width), first, has_leaves);
        Self {
            first,
            count,
            links,
            keeps: links <= KEPT,
            has_leaves,
            part: stages(WIDTH.min(count)),
            last: stages(count - (parts(count) - 1) * WIDTH),
        }
    }

    /// How many of so many threads are worth their while here.
    fn threads(&self, threads: usize) -> usize {
        match self.has_leaves || self.links >= THREADED {
            true => threads.max(1),
            false => 1,
        }
    }

    /// The links of the first generation that each of so many threads computes.
    pub(super) fn jobs(&self, threads: usize) -> impl Iterator<Item = Range<usize>> {
        let count = self.count;
        let share = count.div_ceil(WIDTH).div_ceil(self.threads(threads));
        let each = share.max(1) * WIDTH;
        let starts = (0..count.saturating_sub(SLOTS - 1).max(1)).step_by(each);
        starts.map(move |start| match count - start < each + SLOTS {
            true => start..count,
            false => start..start + each,
        })
    }

    /// The parts of the subtrees of these links of the first generation.
    pub(super) fn windows(
        &self,
        links: &Range<usize>,
    ) -> impl ExactSizeIterator<Item = Part<'_>> + use<'_> {
        let first = links.start;
        (0..parts(links.len())).map(move |part| self.window(first + part * WIDTH))
    }

    /// The part that starts with a link.
    fn window(&self, start: usize) -> Part<'_> {
        let rest = self.count - start;
        let (width, Stages { stages, runs }) = match rest < WIDTH + SLOTS {
            true => (rest, &self.last),
            false => (WIDTH, &self.part),
        };
        Part {
            stages,
            inner: stages.len().saturating_sub(1),
            has_leaves: self.has_leaves,
            start,
            width,
            ends: false,
            runs,
        }
    }

    /// The largest part.
    pub(super) fn largest(&self) -> Part<'_> {
        let (first, last) = (self.window(0), parts(self.count) - 1);
        let last = self.window(last * WIDTH);
        if first.width < last.width {
            last
        } else {
            first
        }
    }
}
