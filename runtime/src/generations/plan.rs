//! How a tree is taken apart.

use alloc::vec::Vec;

use core::ops::Range;

use super::part::{Part, SLOTS, Stage, stages};

/// Trees of up to so many links are computed in one piece: their numbers fit
/// into the second cache.
const WHOLE: usize = 8192;

/// Neighbours in a part of a larger tree: whole vectors, and runs that are long
/// enough to be fetched ahead.
pub(super) const WIDTH: usize = 256;

/// Of so many links, what is formed on the way up is kept for the way down: it fits
/// into the third cache.
const KEPT: usize = 1 << 18;

/// The generations of a tree, and where it is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Of the whole tree.
    stages: Vec<Stage>,
    /// The generation in which the parts start; none where the tree is one.
    pub(super) cut: Option<usize>,
    /// Whether parts keep what is formed on the way up.
    pub(super) keeps: bool,
    /// Those of a part, and of the last one, which has another width.
    part: Vec<Stage>,
    last: Vec<Stage>,
}

impl Plan {
    /// For a tree with so many copies of each generation under each link of the
    /// one before.
    pub(super) fn new(copies: &[usize]) -> Self {
        let (mut counts, mut starts) = (Vec::new(), Vec::new());
        let (mut count, mut start) = (1, 0);
        for &copies in copies {
            count *= copies;
            counts.push(count);
            starts.push(start);
            start += count;
        }
        let mut cut = None;
        if start > WHOLE {
            // The longest subtrees that fit with their neighbours.
            let inner = 1..copies.len().saturating_sub(1);
            let fits = |&generation: &usize| {
                let below: usize = counts.iter().skip(generation).sum();
                let count = counts[generation].max(1);
                count >= WIDTH && (below / count).saturating_mul(WIDTH) <= WHOLE
            };
            cut = inner.clone().find(fits).or(inner.last());
        }
        let stages = |first, width| stages(copies, &starts, &counts, first, width).collect();
        let parts = cut.map(|cut| (cut, counts[cut]));
        Self {
            stages: stages(0, 1),
            cut,
            keeps: start <= KEPT,
            part: parts.map_or_else(Vec::new, |(cut, count)| stages(cut, count.min(WIDTH))),
            last: parts.map_or_else(Vec::new, |(cut, count)| {
                let start = count.saturating_sub(SLOTS) / WIDTH * WIDTH;
                stages(cut, count - start)
            }),
        }
    }

    /// Of the whole tree.
    #[inline(always)]
    pub(super) fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// All of them.
    pub(super) fn links(&self) -> usize {
        self.start(self.generations())
    }

    pub(super) fn generations(&self) -> usize {
        self.stages.len()
    }

    pub(super) fn count(&self, generation: usize) -> usize {
        let stage = self.stages.get(generation);
        stage.map_or(0, |stage| stage.count)
    }

    /// The first link of a generation; of the one behind the last, the number of
    /// links.
    pub(super) fn start(&self, generation: usize) -> usize {
        match (self.stages.get(generation), self.stages.last()) {
            (Some(stage), _) => stage.whole,
            (None, Some(last)) => last.whole + last.count,
            (None, None) => 0,
        }
    }

    /// The generations above the cut, or the whole tree.
    pub(super) fn top(&self) -> Part<'_> {
        let leaf = self.stages.len().saturating_sub(1);
        let inner = self.cut.unwrap_or(leaf);
        Part {
            stages: self.stages.get(..=inner).unwrap_or_default(),
            first: 0,
            inner,
            has_leaves: self.cut.is_none(),
            start: 0,
            width: 1,
        }
    }

    /// How many links of the cut one of so many threads computes.
    pub(super) fn each(&self, cut: usize, threads: usize) -> usize {
        let parts = self.count(cut).div_ceil(WIDTH);
        parts.div_ceil(threads.max(1)).max(1) * WIDTH
    }

    /// The parts of the subtrees of these links of the cut.
    pub(super) fn windows(
        &self,
        cut: usize,
        links: Range<usize>,
    ) -> impl Iterator<Item = Part<'_>> {
        let mut start = links.start;
        core::iter::from_fn(move || {
            let part = (start < links.end).then(|| self.window(cut, start))?;
            start += part.width;
            Some(part)
        })
    }

    /// The one that starts with a link. The last one also takes links that would be
    /// too few for a register.
    fn window(&self, cut: usize, start: usize) -> Part<'_> {
        let rest = self.count(cut) - start;
        let (width, stages) = match rest < WIDTH + SLOTS {
            true => (rest, &self.last),
            false => (WIDTH, &self.part),
        };
        Part {
            stages,
            first: cut,
            inner: stages.len().saturating_sub(1),
            has_leaves: true,
            start,
            width,
        }
    }

    /// The largest part.
    pub(super) fn largest(&self, cut: usize) -> Part<'_> {
        let (first, last) = (self.window(cut, 0), self.count(cut));
        let last = self.window(cut, last.saturating_sub(SLOTS) / WIDTH * WIDTH);
        if first.width < last.width {
            last
        } else {
            first
        }
    }

    /// The links of the cut that each of so many threads computes.
    pub(super) fn jobs(&self, cut: usize, threads: usize) -> impl Iterator<Item = Range<usize>> {
        let (count, each) = (self.count(cut), self.each(cut, threads));
        let starts = (0..count.saturating_sub(SLOTS - 1).max(1)).step_by(each);
        starts.map(move |start| match count - start < each + SLOTS {
            true => start..count,
            false => start..start + each,
        })
    }
}
