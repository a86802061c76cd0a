//! Where the numbers of an evaluation stand.

use super::columns::Columns;
use super::part::{Part, SLOTS};

/// How many numbers a recursion takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sizes {
    /// Of an inner link's answers.
    pub(super) answers: usize,
    /// Of what is kept.
    pub(super) kept: usize,
    /// Whether it reads angles between links.
    pub(super) joints: bool,
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
pub(super) fn odd_lines<T>(numbers: usize) -> usize {
    (numbers.div_ceil(line::<T>()) | 1) * line::<T>()
}

/// What memory for a part takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    sizes: Sizes,
    /// Unused numbers before those of all links, so that their longest generation
    /// starts with a line.
    lead: usize,
    /// The length of columns of all links.
    links: usize,
    /// The length of columns of links with children.
    slots: usize,
    /// Whether velocities are read where they are given: in a whole tree, whose links
    /// stand there as here, if registers do not reach beyond the last one's. In parts
    /// they would compete for the same places of the cache, far as the runs are from
    /// each other.
    given: bool,
}

impl Extent {
    pub(super) fn new<T>(part: &Part<'_>, sizes: Sizes) -> Self {
        let last = part.own_stages().last().map_or(0, |last| last.own);
        let lead = last.next_multiple_of(line::<T>()) - last;
        let beyond = part.has_leaves && part.runs.reach().own > part.links();
        // A register more: the last numbers are read with what is behind them.
        Self {
            given: part.is_whole() && !beyond,
            sizes,
            lead,
            links: odd_lines::<T>(lead + part.links() + SLOTS),
            slots: odd_lines::<T>(part.slots() + SLOTS),
        }
    }

    /// How many numbers are read on the way down that were formed on the way up.
    pub(super) fn lasting(&self) -> usize {
        let bends = if self.sizes.joints { 2 } else { 0 };
        let turns = if self.given { 2 } else { 3 };
        (turns + bends) * self.links + self.sizes.kept * self.slots
    }

    /// How many others there are.
    pub(super) fn passing(&self) -> usize {
        self.sizes.answers * self.slots
    }

    /// The fronts of two buffers as memory for a part.
    pub(super) fn storage<'a, T: Copy>(
        &self,
        mut lasting: &'a mut [T],
        mut passing: &'a mut [T],
    ) -> Storage<'a, T> {
        let lasting = &mut lasting;
        let &Self {
            sizes,
            lead,
            links,
            slots,
            given,
        } = self;
        Storage {
            sizes,
            turns: Columns::new(take(lasting, 2 * links), links),
            velocities: match given {
                true => None,
                false => Some(Columns::new(take(lasting, links), links)),
            },
            bends: match sizes.joints {
                true => Columns::new(take(lasting, 2 * links), links),
                false => Columns::new(&mut [], 0),
            },
            lead,
            answers: take(&mut passing, sizes.answers * slots),
            kept: take(lasting, sizes.kept * slots),
            slots,
        }
    }
}

/// Numbers of a part that are formed on the way up and read on the way down.
#[derive(Debug)]
pub(super) struct Storage<'a, T> {
    pub(super) sizes: Sizes,
    /// Sine and cosine of each link's angle, from row `lead` on.
    pub(super) turns: Columns<'a, T, 2>,
    /// Likewise angular velocities; none where they are read where they are given.
    pub(super) velocities: Option<Columns<'a, T, 1>>,
    /// Likewise angles and velocities relative to the parents; empty where nothing
    /// acts in joints.
    pub(super) bends: Columns<'a, T, 2>,
    pub(super) lead: usize,
    /// Columns of answers of links with children; on the way down the first two
    /// hold the accelerations of their pivots.
    pub(super) answers: &'a mut [T],
    /// Columns of what is kept of them.
    pub(super) kept: &'a mut [T],
    /// The length of these columns.
    pub(super) slots: usize,
}

impl<T> Storage<'_, T> {
    /// `length` numbers of a column of answers; none where there are fewer.
    pub(super) fn answers_mut(&mut self, column: usize, at: usize, length: usize) -> &mut [T] {
        let start = column * self.slots + at;
        self.answers
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
