//! Positions, in memory, of the values that an evaluation computes.

use super::block::SubtreeBlock;
use super::columns::{Columns, Rows};
use super::equations::{LinkEquations, Row};
use crate::scalar::Scalar;

/// Numbers of values per link that an evaluation keeps in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sizes {
    /// Number of constants in a row.
    pub(super) constants: usize,
    /// Number of values of a response; in the downward pass, of a pivot's acceleration.
    pub(super) responses: usize,
    /// Number of values of a sum of responses; in the downward pass, of the values passed to
    /// children. Zero if constants have one row per generation, because children are then found by
    /// index.
    pub(super) sums: usize,
    /// Number of values that the upward pass keeps of a link with children for the downward pass.
    pub(super) eliminations: usize,
    /// True if the equations use joint angles and rates.
    pub(super) joints: bool,
    /// True if the equations use external torques.
    pub(super) forced: bool,
    /// True if the equations use the flags of prescribed links.
    pub(super) prescribed: bool,
    /// True if constants have one row per link instead of one per generation.
    pub(super) by_link: bool,
}

impl Sizes {
    #[inline(always)]
    pub(super) const fn of<E: LinkEquations, V: Scalar>() -> Self {
        let response = <E::Response<V> as Row<V>>::LENGTH;
        let sums = <E::Sums<V> as Row<V>>::LENGTH;
        let carried = <E::Carried<V> as Row<V>>::LENGTH;
        let by_link = E::COPIES.is_empty();
        Self {
            constants: <E::Constants<V> as Row<V>>::LENGTH,
            responses: if response < 2 { 2 } else { response },
            sums: match (by_link, sums < carried) {
                (false, _) => 0,
                (_, true) => carried,
                (_, false) => sums,
            },
            eliminations: <E::Elimination<V> as Row<V>>::LENGTH,
            joints: E::JOINTS,
            forced: E::FORCED,
            prescribed: E::PRESCRIBED,
            by_link,
        }
    }

    /// Returns the same sizes after checking that the memory size for a tree of `links` links does
    /// not overflow.
    ///
    /// # Panics
    /// If the memory of the tree exceeds the address space, or the number of links its index type.
    pub(super) const fn of_links(self, links: usize) -> Self {
        let numbers = self.motion() as u128
            + self.constants as u128
            + self.responses as u128
            + self.sums as u128
            + self.eliminations as u128;
        // With a wide margin: ends of columns are rounded up, and indices of links with children,
        // possibly one a generation, are rounded up to a register.
        let all = numbers
            .saturating_mul(64)
            .saturating_mul(links as u128 + 4096);
        assert!(
            all <= isize::MAX as u128 && links as u128 <= u32::MAX as u128,
            "a tree has more links than memory or numbers for them"
        );
        self
    }

    /// Returns the number of values of a link's motion: sine, cosine, velocity, joint angle and
    /// rate, external torque, flag of a prescribed link.
    #[inline(always)]
    pub(super) const fn motion(&self) -> usize {
        3 + self.joint_motions() + self.outside()
    }

    #[inline(always)]
    const fn joint_motions(&self) -> usize {
        if self.joints { 2 } else { 0 }
    }

    /// Returns the number of input values per link: external torque, and flag of a prescribed link.
    #[inline(always)]
    pub(super) const fn outside(&self) -> usize {
        self.torques() + self.holds()
    }

    #[inline(always)]
    const fn torques(&self) -> usize {
        if self.forced { 1 } else { 0 }
    }

    #[inline(always)]
    const fn holds(&self) -> usize {
        if self.prescribed { 1 } else { 0 }
    }
}

/// Size of a cache line, in bytes. Columns start at cache lines, because a vector that crosses
/// lines takes two accesses.
pub(super) const LINE: usize = 64;

/// Returns how many numbers of type `T` fit into a cache line.
pub(super) fn line<T>() -> usize {
    (LINE / size_of::<T>().max(1)).max(1)
}

/// Rounds a length, in numbers, up to an odd number of cache lines: columns whose distances are a
/// power of two compete for the same cache sets.
pub(super) const fn odd_lines(line: usize, numbers: usize) -> usize {
    (numbers.div_ceil(line) | 1) * line
}

/// Sizes of the workspace of one block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BlockMemory {
    sizes: Sizes,
    /// Number of unused numbers in front of each column, so that the longest generation starts at a
    /// cache line.
    lead: usize,
    /// Length of each column that has one number per link.
    links: usize,
    /// Length of each column that has one number per link with children.
    slots: usize,
    /// True if velocities are read from the caller's slice instead of being copied. This is
    /// possible if the block is the whole tree, so that the links have the same order, and if no
    /// register reads past the end. In smaller blocks, strips that are far apart would compete for
    /// the same cache sets.
    given: bool,
}

impl BlockMemory {
    /// Computes the sizes for a block, with `line` numbers in a cache line.
    pub(super) fn new(block: &SubtreeBlock<'_>, sizes: Sizes, line: usize) -> Self {
        let last = block.own_generations().last().map_or(0, |last| last.own);
        let lead = last.next_multiple_of(line) - last;
        let beyond = block.has_leaves && block.strips.reach().own > block.links();
        // One register more, because the last numbers are read together with those after them.
        Self {
            given: block.widest > 1 && block.is_whole() && !beyond,
            sizes,
            lead,
            links: odd_lines(line, lead + block.links() + block.widest),
            slots: odd_lines(line, block.slots() + block.widest),
        }
    }

    /// Returns how many numbers the upward pass leaves for the downward pass.
    pub(super) fn lasting(&self) -> usize {
        let given = if self.given { 1 } else { 0 };
        (self.sizes.motion() - given) * self.links + self.sizes.eliminations * self.slots
    }

    /// Returns how many numbers only the upward pass uses.
    pub(super) fn passing(&self) -> usize {
        (self.sizes.responses + self.sizes.sums) * self.slots
    }

    /// Takes the workspace of a block from the fronts of two buffers, stored in rows (one per link)
    /// or in columns.
    #[inline(always)]
    pub(super) fn storage<'a, T: Copy>(
        &self,
        sizes: Sizes,
        mut lasting: &'a mut [T],
        mut passing: &'a mut [T],
        in_rows: bool,
    ) -> Storage<'a, T> {
        let lasting = &mut lasting;
        let &Self {
            lead,
            links,
            slots,
            given,
            ..
        } = self;
        let (sincos, velocities, joint_motions, torques, prescribed);
        if in_rows {
            let width = sizes.motion();
            let rows = Rows::new(take(lasting, width * links), width);
            sincos = rows.columns(0);
            velocities = Some(rows.columns(2));
            joint_motions = rows.columns(3);
            torques = rows.columns(3 + sizes.joint_motions());
            prescribed = rows.columns(3 + sizes.joint_motions() + sizes.torques());
        } else {
            sincos = Columns::new(take(lasting, 2 * links), links);
            velocities = match given {
                true => None,
                false => Some(Columns::new(take(lasting, links), links)),
            };
            // Empty if nothing acts in joints.
            joint_motions = Columns::new(take(lasting, sizes.joint_motions() * links), links);
            torques = Columns::new(take(lasting, sizes.torques() * links), links);
            prescribed = Columns::new(take(lasting, sizes.holds() * links), links);
        }
        Storage {
            sizes,
            in_rows,
            sincos,
            velocities,
            joint_motions,
            torques,
            prescribed,
            lead,
            responses: take(&mut passing, sizes.responses * slots),
            sums: take(&mut passing, sizes.sums * slots),
            eliminations: take(lasting, sizes.eliminations * slots),
            slots,
        }
    }
}

/// Numbers of a block that the upward pass computes and the downward pass reads.
#[derive(Debug)]
pub(super) struct Storage<'a, T> {
    pub(super) sizes: Sizes,
    /// True if the numbers of one link are contiguous in memory (rows); false if the same number of
    /// neighbouring links is (columns).
    pub(super) in_rows: bool,
    /// Sines and cosines of the links' angles; the first link has index `lead`.
    pub(super) sincos: Columns<'a, T, 2>,
    /// Angular velocities; the first link has index `lead`. `None` if they are read from the
    /// caller's slice.
    pub(super) velocities: Option<Columns<'a, T, 1>>,
    /// Angles and velocities relative to the parents; the first link has index `lead`. Empty if no
    /// torques act in joints.
    pub(super) joint_motions: Columns<'a, T, 2>,
    /// External torques; the first link has index `lead`. Empty if the equations use none.
    pub(super) torques: Columns<'a, T, 1>,
    /// Flags: 1 for prescribed links and 0 for others; the first link has index `lead`. Empty if
    /// the equations use no flags.
    pub(super) prescribed: Columns<'a, T, 1>,
    pub(super) lead: usize,
    /// Columns of the responses of links with children; in the downward pass the first two hold the
    /// accelerations of the links' pivots.
    pub(super) responses: &'a mut [T],
    /// Columns of sums of responses.
    pub(super) sums: &'a mut [T],
    /// Columns of eliminations.
    pub(super) eliminations: &'a mut [T],
    /// Length of the columns that have one number per link with children.
    pub(super) slots: usize,
}

impl<T> Storage<'_, T> {
    /// Returns the first `count` values of the response of link `at`, if numbers are stored in
    /// rows; empty if there are fewer.
    #[inline(always)]
    pub(super) fn row_of_responses(&mut self, at: usize, count: usize) -> &mut [T] {
        let start = at * self.sizes.responses;
        self.responses
            .get_mut(start..start + count)
            .unwrap_or_default()
    }

    /// Returns `length` numbers of a column of responses from link `at` on; empty if there are
    /// fewer.
    pub(super) fn responses_mut(&mut self, column: usize, at: usize, length: usize) -> &mut [T] {
        let start = column * self.slots + at;
        self.responses
            .get_mut(start..start + length)
            .unwrap_or_default()
    }
}

/// Splits the first `length` numbers off a buffer.
pub(super) fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let whole = core::mem::take(buffer);
    let (front, rest) = whole.split_at_mut(length.min(whole.len()));
    *buffer = rest;
    front
}
