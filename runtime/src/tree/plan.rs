//! Plan of an evaluation: the division of a tree into partitions and blocks.

use alloc::vec::Vec;

use super::block::SubtreeBlock;
use super::generation::{Generation, generations};
use super::heights::Heights;
use super::partition::{Partition, Policy};
use super::strips::Strips;

/// Generations of a tree, and their division into partitions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Generations of the whole tree.
    generations: Vec<Generation>,
    /// Strips above the partitions.
    strips: Strips,
    /// Partitions, from the leaves to the root; empty if the tree is one block.
    pub(super) partitions: Vec<Partition>,
    widest: usize,
    /// For a tree of any shape: the index of the link at each position, and the position of its
    /// parent.
    pub(super) order: Vec<u32>,
    pub(super) parents: Vec<u32>,
}

impl Plan {
    /// Creates the plan of a tree whose generation k has `copies[k]` copies under each link of the
    /// generation before.
    pub(super) fn new(copies: &[usize], policy: Policy) -> Self {
        let (counts, starts, links) = numbers_of_links(copies);
        let mut partitions = Vec::new();
        let (mut end, mut above, mut fitting) = (copies.len(), links, policy.whole);
        while above > policy.whole {
            let has_leaves = end == copies.len();
            // The longest subtrees that fit into a block together with their neighbours.
            let inner = 1..end.saturating_sub(usize::from(has_leaves));
            let fits = |&generation: &usize| {
                let count = counts[generation].max(1);
                let each = (above - starts[generation]) / count;
                count >= policy.width && each.saturating_mul(policy.width) <= fitting
            };
            let partition = inner.clone().find(fits);
            let Some(first) = partition.or(inner.last().filter(|_| has_leaves)) else {
                break;
            };
            let links = above - starts[first];
            let taken = (end + 1).min(copies.len()) - first;
            partitions.push(Partition::new(
                first,
                [counts[first], links],
                has_leaves,
                policy,
                |width| {
                    let sizes = [width, policy.widest];
                    let below = generations(copies, &starts, &counts, first, sizes);
                    below.take(taken).collect()
                },
            ));
            (end, above, fitting) = (first, starts[first], policy.inner);
            if policy.once {
                break;
            }
        }
        let generations: Vec<Generation> =
            generations(copies, &starts, &counts, 0, [1, policy.widest]).collect();
        let inner = inner(&generations, &partitions);
        let strips = Strips::new(
            generations.get(..=inner).unwrap_or_default(),
            0,
            inner,
            partitions.is_empty(),
            policy.widest,
        );
        Self {
            generations,
            strips,
            partitions,
            widest: policy.widest,
            order: Vec::new(),
            parents: Vec::new(),
        }
    }

    /// Creates the plan of a tree of any shape, from the parents of all links, which come before
    /// their children. Links of one height (the distance to the deepest leaf below) form a strip;
    /// their children are in later strips, their parents in earlier ones. For states in lanes, the
    /// links of one height of a small subtree form a strip.
    pub(super) fn by_height(parents: &[u32], policy: Policy) -> Self {
        let mut heights = Heights::new(parents);
        if policy.once {
            heights = heights.in_subtrees(policy.whole);
        }
        Self {
            generations: alloc::vec![Generation::of_links(0..heights.order.len())],
            strips: Strips::by_height(&heights, policy.widest),
            partitions: Vec::new(),
            widest: policy.widest,
            order: heights.order,
            parents: heights.parents,
        }
    }

    /// Returns the number of links.
    pub(super) fn links(&self) -> usize {
        let last = self.generations.last();
        last.map_or(0, |last| last.whole + last.count)
    }

    /// Returns the generations above the partitions, or the whole tree, as a block.
    pub(super) fn top(&self) -> SubtreeBlock<'_> {
        let inner = inner(&self.generations, &self.partitions);
        let inner = inner.max(usize::from(!self.order.is_empty()));
        SubtreeBlock {
            generations: self.generations.get(..=inner).unwrap_or(&self.generations),
            inner,
            has_leaves: self.partitions.is_empty() && self.order.is_empty(),
            start: 0,
            width: 1,
            widest: self.widest,
            ends: true,
            strips: &self.strips,
        }
    }
}

/// Returns, for each generation, its number of links and the number of links before it; and the
/// total number of links.
fn numbers_of_links(copies: &[usize]) -> (Vec<usize>, Vec<usize>, usize) {
    let (mut counts, mut starts) = (Vec::new(), Vec::new());
    let (mut count, mut start) = (1, 0);
    for &copies in copies {
        count *= copies;
        counts.push(count);
        starts.push(start);
        start += count;
    }
    (counts, starts, start)
}

/// Returns the number of generations above the partitions that have children.
fn inner(generations: &[Generation], partitions: &[Partition]) -> usize {
    let leaf = generations.len().saturating_sub(1);
    partitions.last().map_or(leaf, |partition| partition.first)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Increases the counter in `found` for each link of a block.
    fn mark(block: SubtreeBlock<'_>, found: &mut [usize]) {
        for (_, whole, length) in block.spans() {
            for link in &mut found[whole..whole + length] {
                *link += 1;
            }
        }
    }

    fn every_link_is_in_one_part(copies: &[usize], partitions: &[usize]) {
        assert_eq!(links_in_one_part(copies), partitions);
    }

    /// Checks that no two blocks have a link in common, because threads write to one slice. Returns
    /// the first generations of the partitions.
    fn links_in_one_part(copies: &[usize]) -> Vec<usize> {
        let plan = Plan::new(copies, Policy::ONE_STATE);
        for threads in [1, 2, 3, usize::MAX] {
            let mut found = alloc::vec![0; plan.links()];
            mark(plan.top(), &mut found);
            for partition in &plan.partitions {
                for links in partition.jobs(threads) {
                    partition
                        .windows(&links)
                        .for_each(|block| mark(block, &mut found));
                }
            }
            assert!(found.iter().all(|&blocks| blocks == 1), "{copies:?}");
        }
        let firsts = plan.partitions.iter().map(|partition| partition.first);
        firsts.collect()
    }

    #[test]
    fn any_copies_are_cut_into_parts() {
        let mut number = 1_usize;
        let mut below = |end: usize| {
            number = number.wrapping_mul(48_271) % 0x7fff_ffff;
            number % end
        };
        let (mut trees, mut cut) = (0, 0);
        while trees < 400 {
            let mut copies = alloc::vec![1];
            for _ in 0..1 + below(12) {
                let most = [2, 3, 5, 40, 700][below(5)];
                copies.push(1 + below(most));
            }
            let links = copies.iter().scan(1_usize, |count, &copies| {
                *count = count.saturating_mul(copies);
                Some(*count)
            });
            if links.fold(0, usize::saturating_add) > 100_000 {
                continue;
            }
            trees += 1;
            cut += usize::from(!links_in_one_part(&copies).is_empty());
        }
        assert!(cut > 20, "{cut} of {trees} were large");
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
