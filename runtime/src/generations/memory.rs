//! Where the numbers of an evaluation stand.

use super::part::Part;

/// How many numbers a recursion takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// Of an inner link's answers.
    pub(super) answers: usize,
    /// Of what is kept.
    pub(super) kept: usize,
    /// Whether it reads angles between links.
    pub(super) joints: bool,
}

/// Arrays of one length.
#[derive(Debug)]
pub(super) struct Arrays<'a, T> {
    numbers: &'a mut [T],
    /// From one to the next.
    stride: usize,
    lead: usize,
    length: usize,
}

impl<T> Arrays<'_, T> {
    /// The arrays one by one.
    pub(super) fn each_mut(&mut self) -> impl Iterator<Item = &mut [T]> {
        let &mut Self {
            ref mut numbers,
            stride,
            lead,
            length,
        } = self;
        let padded = numbers.chunks_exact_mut(stride.max(1));
        padded.map(move |array| array.get_mut(lead..lead + length).unwrap_or_default())
    }

    /// The first `N` arrays; empty ones where there are fewer.
    #[inline(always)]
    pub(super) fn first<const N: usize>(&mut self) -> [&mut [T]; N] {
        let mut rest = &mut *self.numbers;
        core::array::from_fn(|_| {
            let padded = take(&mut rest, self.stride);
            let own = padded.get_mut(self.lead..self.lead + self.length);
            own.unwrap_or_default()
        })
    }
}

/// Numbers of a part that are formed on the way up and read on the way down.
/// Each array holds the part's links by generation.
#[derive(Debug)]
pub(super) struct Storage<'a, T> {
    pub(super) sines: &'a mut [T],
    pub(super) cosines: &'a mut [T],
    /// Angles and velocities relative to the parents; empty where nothing acts
    /// in joints.
    pub(super) bends: &'a mut [T],
    pub(super) bend_rates: &'a mut [T],
    /// Answers of inner links on the way up; on the way down the first two hold
    /// the accelerations of their pivots.
    pub(super) answers: Arrays<'a, T>,
    pub(super) kept: Arrays<'a, T>,
}

/// Arrays start where cache lines do: a vector that crosses from one into the
/// next takes two accesses.
pub(super) const LINE: usize = 64;

/// Numbers of type `T` in a line.
pub(super) fn line<T>() -> usize {
    (LINE / size_of::<T>().max(1)).max(1)
}

/// What memory for a part takes.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    sizes: Sizes,
    /// Unused numbers before each array, so that its longest generation starts
    /// with a line.
    lead: usize,
    /// All links.
    pub(super) all: usize,
    /// Those that have answers.
    pub(super) inner: usize,
}

impl Extent {
    pub(super) fn new<T>(part: &Part<'_>, sizes: Sizes) -> Self {
        let leaf = part.shape.counts.len().saturating_sub(1);
        let last = part.own(part.end.saturating_sub(1));
        Self {
            sizes,
            lead: last.next_multiple_of(line::<T>()) - last,
            all: part.own(part.end),
            inner: part.own((part.end + 1).min(leaf)),
        }
    }

    /// An odd number of lines: arrays whose distances are multiples of a power
    /// of two compete for the same places of the cache.
    pub(super) fn length<T>(&self, links: usize) -> usize {
        ((self.lead + links).div_ceil(line::<T>()) | 1) * line::<T>()
    }

    /// Of what is read on the way down.
    pub(super) fn kept<T>(&self) -> usize {
        let whole = if self.sizes.joints { 4 } else { 2 };
        whole * self.length::<T>(self.all) + self.sizes.kept * self.length::<T>(self.inner)
    }

    /// Of answers.
    pub(super) fn answers<T>(&self) -> usize {
        self.sizes.answers * self.length::<T>(self.inner)
    }

    fn array<'a, T>(&self, buffer: &mut &'a mut [T], links: usize) -> &'a mut [T] {
        let padded = take(buffer, self.length::<T>(links));
        padded
            .get_mut(self.lead..self.lead + links)
            .unwrap_or_default()
    }

    fn arrays<'a, T>(&self, buffer: &mut &'a mut [T], number: usize) -> Arrays<'a, T> {
        let stride = self.length::<T>(self.inner);
        Arrays {
            numbers: take(buffer, number * stride),
            stride,
            lead: self.lead,
            length: self.inner,
        }
    }

    pub(super) fn storage<'a, T>(
        &self,
        mut kept: &'a mut [T],
        mut answers: &'a mut [T],
    ) -> Storage<'a, T> {
        let (buffer, answers) = (&mut kept, &mut answers);
        let &Self { sizes, all, .. } = self;
        Storage {
            sines: self.array(buffer, all),
            cosines: self.array(buffer, all),
            bends: match sizes.joints {
                true => self.array(buffer, all),
                false => &mut [],
            },
            bend_rates: match sizes.joints {
                true => self.array(buffer, all),
                false => &mut [],
            },
            answers: self.arrays(answers, sizes.answers),
            kept: self.arrays(buffer, sizes.kept),
        }
    }
}

/// Takes `length` numbers off the front.
pub(super) fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let whole = core::mem::take(buffer);
    let (front, rest) = whole.split_at_mut(length.min(whole.len()));
    *buffer = rest;
    front
}
