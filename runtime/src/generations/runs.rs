//! Which neighbours are computed together, and where their numbers stand.

use alloc::vec::Vec;

use super::part::{Place, SLOTS, Stage};

/// Neighbours of one generation, and their children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Run {
    /// Their generation.
    pub(super) generation: usize,
    /// How many they are.
    pub(super) length: usize,
    /// Where the first one stands.
    pub(super) first: Place,
    /// Where the first copy of its children stands, how many copies there are, and
    /// how far it is from one to the next ...
    pub(super) child: Place,
    pub(super) copies: usize,
    /// ... in the part's own arrays, and in arrays of the whole tree.
    pub(super) apart: usize,
    pub(super) whole_apart: usize,
    /// Whether the children are leaves.
    pub(super) leaves: bool,
    /// A register with at least so many lanes holds all children, one by one behind
    /// each other, and the next run is theirs.
    pub(super) lanes: usize,
}

/// The links with children of a part, run by run from its first generation on.
///
/// They are the same for all parts of a cut, but for where these start in arrays of
/// the whole tree. What has seen once that [`reach`](Self::reach) numbers are there
/// needs no other question: runs are made here alone, and none goes beyond.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Runs {
    list: Vec<Run>,
    reach: Reach,
    branching: usize,
}

/// How many numbers there have to be, registers of any width behind the last ones
/// included but for arrays of the whole tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Reach {
    /// In a part's arrays of all links.
    pub(super) own: usize,
    /// In its arrays of links with children.
    pub(super) slot: usize,
    /// In arrays of the whole tree from the part's start on.
    pub(super) whole: usize,
}

impl Runs {
    /// Of stages from the generation `first` on, `inner` of which are computed and
    /// have children: leaves below the last of them, or links of other parts.
    pub(super) fn new(stages: &[Stage], first: usize, inner: usize, has_leaves: bool) -> Self {
        let mut list = Vec::new();
        let mut reach = Reach::default();
        let computed = inner.min(stages.len().saturating_sub(1));
        for (number, pair) in stages.windows(2).take(computed).enumerate() {
            let [stage, below] = pair else { continue };
            let last = number + 1 == computed;
            let leaves = last && has_leaves;
            let lanes = match last || below.runs > 1 {
                true => usize::MAX,
                false => below.count,
            };
            for number_of_run in 0..stage.runs {
                let own = number_of_run * stage.length;
                let run = Run {
                    generation: first + number,
                    length: stage.length,
                    first: Place {
                        own: stage.own + own,
                        slot: stage.slot + own,
                        whole: stage.whole + number_of_run * stage.stride,
                    },
                    child: Place {
                        own: below.own + own,
                        slot: below.slot + own,
                        whole: below.whole + number_of_run * stage.stride,
                    },
                    copies: below.copies,
                    apart: stage.count,
                    whole_apart: stage.whole_count,
                    leaves,
                    lanes,
                };
                reach.take(&run);
                list.push(run);
            }
        }
        let copies = list.first().map_or(0, |run| run.copies);
        let branching = match list.iter().all(|run| run.copies == copies) {
            true => copies,
            false => 0,
        };
        Self {
            list,
            reach,
            branching,
        }
    }

    #[inline(always)]
    pub(super) fn list(&self) -> &[Run] {
        &self.list
    }

    /// How many copies of children there are, if they are as many for all runs;
    /// otherwise 0.
    #[inline(always)]
    pub(super) fn branching(&self) -> usize {
        self.branching
    }

    /// For all of them.
    #[inline(always)]
    pub(super) fn reach(&self) -> Reach {
        self.reach
    }
}

impl Reach {
    /// Those of a run as well.
    fn take(&mut self, run: &Run) {
        let others = run.copies.saturating_sub(1);
        let in_register = run.length.max(SLOTS);
        let (child, last) = (run.child, others * run.apart + in_register);
        self.own = self.own.max(run.first.own + in_register);
        self.slot = self.slot.max(run.first.slot + in_register);
        self.whole = self.whole.max(run.first.whole + run.length);
        if run.leaves {
            self.own = self.own.max(child.own + last);
            let last = others * run.whole_apart + run.length;
            self.whole = self.whole.max(child.whole + last);
        } else {
            self.slot = self.slot.max(child.slot + last);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generations::part::stages;

    /// Goes over the last place of every width in every copy, one number after the other.
    fn all_places_are_within_reach(copies: &[usize], first: usize, width: usize) {
        let (mut counts, mut starts, mut links) = (Vec::new(), Vec::new(), 0);
        for &copies in copies {
            let count = counts.last().map_or(1, |count| count * copies);
            counts.push(count);
            starts.push(links);
            links += count;
        }
        let stages: Vec<Stage> = stages(copies, &starts, &counts, first, width).collect();
        let inner = stages.len() - 1;
        for has_leaves in [false, true] {
            let runs = Runs::new(&stages, first, inner, has_leaves);
            let reach = runs.reach();
            let neighbours: usize = stages[..inner].iter().map(|stage| stage.count).sum();
            let listed: usize = runs.list().iter().map(|run| run.length).sum();
            assert_eq!(listed, neighbours, "{copies:?}");
            let mut ends = Reach::default();
            for run in runs.list() {
                for lanes in [1, 2, 4, 8, SLOTS] {
                    let last = run.length.saturating_sub(lanes);
                    ends.own = ends.own.max(run.first.own + last + lanes);
                    ends.slot = ends.slot.max(run.first.slot + last + lanes);
                    ends.whole = ends.whole.max(run.first.whole + run.length);
                    for copy in 0..run.copies {
                        let (own, whole) = (copy * run.apart, copy * run.whole_apart);
                        if run.leaves {
                            ends.own = ends.own.max(run.child.own + own + last + lanes);
                            ends.whole = ends.whole.max(run.child.whole + whole + run.length);
                        } else {
                            ends.slot = ends.slot.max(run.child.slot + own + last + lanes);
                        }
                    }
                }
            }
            assert!(
                ends.own <= reach.own && ends.slot <= reach.slot && ends.whole == reach.whole,
                "{copies:?}: {ends:?} {reach:?}"
            );
            // The last part starts `width` links before the end of its generation.
            let last = counts[first] - width;
            assert!(last + reach.whole <= links, "{copies:?}: {reach:?}");
        }
    }

    #[test]
    fn no_run_goes_beyond_what_is_asked_for() {
        all_places_are_within_reach(&[1, 2], 0, 1);
        all_places_are_within_reach(&[1, 5, 1, 2], 0, 1);
        all_places_are_within_reach(&[1, 2, 2, 2, 2, 2, 2, 2], 0, 1);
        all_places_are_within_reach(&[1, 17, 3, 2], 1, 17);
        all_places_are_within_reach(&[1, 600, 14, 11, 4], 1, 256);
        all_places_are_within_reach(&[1, 600, 14, 11, 4], 3, 271);
    }
}
