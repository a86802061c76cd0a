//! Where the numbers of an evaluation stand.

use super::block::SubtreeBlock;
use super::columns::{Columns, Rows};
use super::equations::{LinkEquations, Row};
use crate::scalar::Scalar;

/// Numbers that a link takes in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sizes {
    /// Constants of a row.
    pub(super) constants: usize,
    /// Responses; on the way down, accelerations of pivots.
    pub(super) responses: usize,
    /// Sums of responses; on the way down, numbers that are handed to children. None
    /// where constants are a row a generation: there, children are found without.
    pub(super) sums: usize,
    /// Numbers of the elimination.
    pub(super) eliminations: usize,
    /// Equations read joint angles and rates.
    pub(super) joints: bool,
    /// Equations read torques from outside.
    pub(super) forced: bool,
    /// Equations read which links are held.
    pub(super) held: bool,
    /// Constants are a row a link.
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
            held: E::HELD,
            by_link,
        }
    }

    /// Returns the same for a tree of so many links, whose memory can be counted: what is
    /// computed with these sizes does not overflow.
    ///
    /// # Panics
    /// Of a tree whose memory could have no address, or whose links have no number.
    pub(super) const fn of_links(self, links: usize) -> Self {
        let numbers = self.motion() as u128
            + self.constants as u128
            + self.responses as u128
            + self.sums as u128
            + self.eliminations as u128;
        // With a wide margin: ends of columns are rounded up, and places of links with children,
        // which may be one a generation, to a register.
        let all = numbers
            .saturating_mul(64)
            .saturating_mul(links as u128 + 4096);
        assert!(
            all <= isize::MAX as u128 && links as u128 <= u32::MAX as u128,
            "a tree has more links than memory or numbers for them"
        );
        self
    }

    /// Numbers of a link's motion: sine, cosine, velocity, joint angle and rate, torque
    /// from outside, held or not.
    #[inline(always)]
    pub(super) const fn motion(&self) -> usize {
        3 + self.joint_motions() + self.outside()
    }

    #[inline(always)]
    const fn joint_motions(&self) -> usize {
        if self.joints { 2 } else { 0 }
    }

    /// Numbers that come from outside.
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
        if self.held { 1 } else { 0 }
    }
}

/// Columns start where cache lines do: a vector that crosses from one into the
/// next takes two accesses.
pub(super) const LINE: usize = 64;

/// Numbers of type `T` in a line.
pub(super) fn line<T>() -> usize {
    (LINE / size_of::<T>().max(1)).max(1)
}

/// An odd number of lines: columns whose distances are multiples of a power of two
/// compete for the same places of the cache.
pub(super) const fn odd_lines(line: usize, numbers: usize) -> usize {
    (numbers.div_ceil(line) | 1) * line
}

/// Sizes of the memory for a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Room {
    sizes: Sizes,
    /// Unused numbers before those of all links, so that their longest generation
    /// starts with a line.
    lead: usize,
    /// The length of columns of all links.
    links: usize,
    /// The length of columns of links with children.
    slots: usize,
    /// True if velocities are read where they are given: in a whole tree, whose links
    /// stand there as here, if registers do not reach beyond the last one's. In blocks
    /// they would compete for the same places of the cache, far as the strips are from
    /// each other.
    given: bool,
}

impl Room {
    /// For numbers of which so many are in a line.
    pub(super) fn new(block: &SubtreeBlock<'_>, sizes: Sizes, line: usize) -> Self {
        let last = block.own_generations().last().map_or(0, |last| last.own);
        let lead = last.next_multiple_of(line) - last;
        let beyond = block.has_leaves && block.strips.reach().own > block.links();
        // A register more: the last numbers are read with what is behind them.
        Self {
            given: block.widest > 1 && block.is_whole() && !beyond,
            sizes,
            lead,
            links: odd_lines(line, lead + block.links() + block.widest),
            slots: odd_lines(line, block.slots() + block.widest),
        }
    }

    /// How many numbers are read on the way down that were formed on the way up.
    pub(super) fn lasting(&self) -> usize {
        let given = if self.given { 1 } else { 0 };
        (self.sizes.motion() - given) * self.links + self.sizes.eliminations * self.slots
    }

    /// How many others there are.
    pub(super) fn passing(&self) -> usize {
        (self.sizes.responses + self.sizes.sums) * self.slots
    }

    /// The fronts of two buffers as memory for a block: in rows of the links, or in
    /// columns.
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
        let (sincos, velocities, joint_motions, torques, held);
        if in_rows {
            let width = sizes.motion();
            let rows = Rows::new(take(lasting, width * links), width);
            sincos = rows.columns(0);
            velocities = Some(rows.columns(2));
            joint_motions = rows.columns(3);
            torques = rows.columns(3 + sizes.joint_motions());
            held = rows.columns(3 + sizes.joint_motions() + sizes.torques());
        } else {
            sincos = Columns::new(take(lasting, 2 * links), links);
            velocities = match given {
                true => None,
                false => Some(Columns::new(take(lasting, links), links)),
            };
            // Empty where there are none.
            joint_motions = Columns::new(take(lasting, sizes.joint_motions() * links), links);
            torques = Columns::new(take(lasting, sizes.torques() * links), links);
            held = Columns::new(take(lasting, sizes.holds() * links), links);
        }
        Storage {
            sizes,
            in_rows,
            sincos,
            velocities,
            joint_motions,
            torques,
            held,
            lead,
            responses: take(&mut passing, sizes.responses * slots),
            sums: take(&mut passing, sizes.sums * slots),
            eliminations: take(lasting, sizes.eliminations * slots),
            slots,
        }
    }
}

/// Numbers of a block that are formed on the way up and read on the way down.
#[derive(Debug)]
pub(super) struct Storage<'a, T> {
    pub(super) sizes: Sizes,
    /// The numbers of a link stand side by side, and not those of neighbours.
    pub(super) in_rows: bool,
    /// Sine and cosine of each link's angle, from row `lead` on.
    pub(super) sincos: Columns<'a, T, 2>,
    /// Angular velocities in the same rows; none where they are read where they are given.
    pub(super) velocities: Option<Columns<'a, T, 1>>,
    /// Angles and velocities relative to the parents in the same rows; empty where nothing
    /// acts in joints.
    pub(super) joint_motions: Columns<'a, T, 2>,
    /// Torques from outside in the same rows; empty where equations read none.
    pub(super) torques: Columns<'a, T, 1>,
    /// 1 for held links and 0 for others in the same rows; empty where equations read none.
    pub(super) held: Columns<'a, T, 1>,
    pub(super) lead: usize,
    /// Columns of responses of links with children; on the way down the first two
    /// hold the accelerations of their pivots.
    pub(super) responses: &'a mut [T],
    /// Columns of sums of responses.
    pub(super) sums: &'a mut [T],
    /// Columns of eliminations.
    pub(super) eliminations: &'a mut [T],
    /// The length of these columns.
    pub(super) slots: usize,
}

impl<T> Storage<'_, T> {
    /// The first `count` responses of a link, of numbers in rows; none where there are
    /// fewer.
    #[inline(always)]
    pub(super) fn row_of_responses(&mut self, at: usize, count: usize) -> &mut [T] {
        let start = at * self.sizes.responses;
        self.responses
            .get_mut(start..start + count)
            .unwrap_or_default()
    }

    /// `length` numbers of a column of responses; none where there are fewer.
    pub(super) fn responses_mut(&mut self, column: usize, at: usize, length: usize) -> &mut [T] {
        let start = column * self.slots + at;
        self.responses
            .get_mut(start..start + length)
            .unwrap_or_default()
    }
}

/// Takes `length` numbers off the front.
pub(super) fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let whole = core::mem::take(buffer);
    let (front, rest) = whole.split_at_mut(length.min(whole.len()));
    *buffer = rest;
    front
}
