//! How a tree is taken apart.

use alloc::vec::Vec;

use super::cut::{Cut, WIDTH};
use super::part::{Part, Stage, stages};
use super::runs::Runs;

/// Trees of up to so many links are computed in one piece, and so many links in a
/// part: their numbers fit into the second cache.
const WHOLE: usize = 8192;

/// So many links in a part if all of them have children: they take more numbers.
const INNER: usize = 4096;

/// The generations of a tree, and how it is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Of the whole tree.
    stages: Vec<Stage>,
    /// Above the cuts.
    runs: Runs,
    /// From the leaves up; none where the tree is one.
    pub(super) cuts: Vec<Cut>,
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
        let mut cuts = Vec::new();
        let (mut end, mut above, mut fitting) = (copies.len(), start, WHOLE);
        while above > WHOLE {
            let has_leaves = end == copies.len();
            // The longest subtrees that fit with their neighbours.
            let inner = 1..end.saturating_sub(usize::from(has_leaves));
            let fits = |&generation: &usize| {
                let count = counts[generation].max(1);
                let each = (above - starts[generation]) / count;
                count >= WIDTH && each.saturating_mul(WIDTH) <= fitting
            };
            let cut = inner.clone().find(fits);
            let Some(first) = cut.or(inner.last().filter(|_| has_leaves)) else {
                break;
            };
            let links = above - starts[first];
            let taken = (end + 1).min(copies.len()) - first;
            cuts.push(Cut::new(
                first,
                [counts[first], links],
                has_leaves,
                |width| {
                    let below = stages(copies, &starts, &counts, first, width);
                    below.take(taken).collect()
                },
            ));
            (end, above, fitting) = (first, starts[first], INNER);
        }
        let stages: Vec<Stage> = stages(copies, &starts, &counts, 0, 1).collect();
        let inner = inner(&stages, &cuts);
        let runs = Runs::new(
            stages.get(..=inner).unwrap_or_default(),
            0,
            inner,
            cuts.is_empty(),
        );
        Self { stages, runs, cuts }
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

    /// The generations above the cuts, or the whole tree.
    pub(super) fn top(&self) -> Part<'_> {
        let inner = inner(&self.stages, &self.cuts);
        Part {
            stages: self.stages.get(..=inner).unwrap_or_default(),
            inner,
            has_leaves: self.cuts.is_empty(),
            start: 0,
            width: 1,
            ends: true,
            runs: &self.runs,
        }
    }
}

/// How many generations above the cuts have children.
fn inner(stages: &[Stage], cuts: &[Cut]) -> usize {
    let leaf = stages.len().saturating_sub(1);
    cuts.last().map_or(leaf, |cut| cut.first)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Marks the links of a part.
    fn mark(part: Part<'_>, found: &mut [usize]) {
        for (_, whole, length) in part.spans() {
            for link in &mut found[whole..whole + length] {
                *link += 1;
            }
        }
    }

    fn every_link_is_in_one_part(copies: &[usize], cuts: &[usize]) {
        let plan = Plan::new(copies);
        let firsts: Vec<usize> = plan.cuts.iter().map(|cut| cut.first).collect();
        assert_eq!(firsts, cuts);
        for threads in [1, 2, 3] {
            let mut found = alloc::vec![0; plan.links()];
            mark(plan.top(), &mut found);
            for cut in &plan.cuts {
                for links in cut.jobs(threads) {
                    cut.windows(&links).for_each(|part| mark(part, &mut found));
                }
            }
            assert!(found.iter().all(|&parts| parts == 1), "{copies:?}");
        }
    }

    #[test]
    fn large_trees_are_cut_more_than_once() {
        let binary = |generations: usize| {
            let mut copies = alloc::vec![2; generations];
            copies[0] = 1;
            copies
        };
        every_link_is_in_one_part(&binary(13), &[]);
        every_link_is_in_one_part(&binary(17), &[12]);
        every_link_is_in_one_part(&binary(18), &[13]);
        every_link_is_in_one_part(&binary(20), &[15, 11]);
        every_link_is_in_one_part(&binary(23), &[18, 14, 10]);
        every_link_is_in_one_part(&[1, 600, 14, 11, 4], &[3, 1]);
        every_link_is_in_one_part(&[1, 20000], &[]);
        every_link_is_in_one_part(&[1, 1, 20000], &[1]);
    }
}
