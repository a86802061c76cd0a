//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::marker::PhantomData;
use core::ops::Range;

use super::columns::Columns;
use super::part::{Part, SLOTS};
use super::plan::{Plan, WIDTH};
use super::recursion::Recursion;
use super::shared::Shared;
use super::sweep::Sweep;
use super::vector::{SliceKernel, Vectors};
use crate::scalar::Scalar;

/// What does not change during an evaluation.
#[derive(Debug)]
pub(super) struct Given<'a, T, const C: usize> {
    pub(super) plan: &'a Plan,
    pub(super) constants: &'a [[T; C]],
    /// Acceleration of the root's pivot.
    pub(super) root: [T; 2],
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
}

/// Arrays start where cache lines do: a vector that crosses from one into the
/// next takes two accesses.
const LINE: usize = 64;

/// Numbers of type `T` in a line.
fn line<T>() -> usize {
    (LINE / size_of::<T>().max(1)).max(1)
}

/// What memory for a part takes.
#[derive(Clone, Copy)]
struct Extent {
    /// Unused numbers before the links, so that their longest generation starts
    /// with a line.
    lead: usize,
    /// Numbers of sines, and of cosines, velocities, angles and velocities relative
    /// to the parents: of all links.
    links: usize,
    /// Numbers of each answer, and of what is kept: of links with children.
    slots: usize,
    /// Whether something acts in joints.
    joints: bool,
}

impl Extent {
    #[inline(always)]
    fn new<T>(part: &Part<'_>, joints: bool) -> Self {
        let leaf = part.shape.counts.len().saturating_sub(1);
        let last = part.own(part.end.saturating_sub(1));
        let lead = last.next_multiple_of(line::<T>()) - last;
        // A register more: the last numbers are read with what is behind them.
        Self {
            lead,
            links: odd::<T>(lead + part.own(part.end) + SLOTS),
            slots: odd::<T>(part.slot((part.end + 1).min(leaf)) + SLOTS),
            joints,
        }
    }

    /// How many numbers there are.
    fn room<const R: usize, const K: usize>(&self) -> usize {
        self.turns() + (R + K) * self.slots
    }

    /// Those of all links.
    #[inline(always)]
    fn turns(&self) -> usize {
        self.links * if self.joints { 5 } else { 3 }
    }
}

/// An odd number of lines: arrays whose distances are multiples of a power of two
/// compete for the same places of the cache.
fn odd<T>(numbers: usize) -> usize {
    (numbers.div_ceil(line::<T>()) | 1) * line::<T>()
}

/// Takes `length` numbers off the front.
fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let whole = core::mem::take(buffer);
    let (front, rest) = whole.split_at_mut(length.min(whole.len()));
    *buffer = rest;
    front
}

/// How many numbers an evaluation needs room for, on so many threads.
pub(super) fn workspace<T, const R: usize, const K: usize>(
    plan: &Plan,
    joints: bool,
    threads: usize,
) -> usize {
    let top = Extent::new::<T>(&plan.top(), joints).room::<R, K>();
    let parts = plan.cut.map_or(0, |cut| {
        boundary::<T, R>(plan, cut) + threads * worker::<T, R, K>(plan, cut, joints)
    });
    line::<T>() + top + parts
}

/// Room for the answers of all parts.
fn boundary<T, const R: usize>(plan: &Plan, cut: usize) -> usize {
    (plan.count(cut) * R).next_multiple_of(line::<T>())
}

/// Room for one thread's parts. A line more, so that two threads never write to
/// one.
fn worker<T, const R: usize, const K: usize>(plan: &Plan, cut: usize, joints: bool) -> usize {
    Extent::new::<T>(&plan.window(cut, 0), joints).room::<R, K>() + line::<T>()
}

/// One way through the top of the tree, or through some of the parts below.
enum Pass<'a, T> {
    /// Up and down again, the whole tree or what is above the parts, whose
    /// answers are in memory.
    Top,
    /// Up through the parts that start with these links of their generation. A
    /// part's answers stand together.
    Up {
        cut: usize,
        links: Range<usize>,
        answers: &'a mut [T],
    },
    /// Up again and down through them, from the accelerations of their pivots.
    /// What was formed on the first way up is formed again: that takes less time
    /// than writing it to memory and reading it back.
    Down {
        cut: usize,
        links: Range<usize>,
        pivots: [&'a [T]; 2],
    },
}

struct Job<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    given: &'a Given<'a, T, C>,
    pass: Pass<'a, T>,
    alpha: Shared<'a, T>,
    buffer: &'a mut [T],
    recursion: PhantomData<P>,
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize> SliceKernel<T>
    for Job<'_, P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    #[inline(always)]
    fn run<W: Vectors<T>>(mut self) {
        let &Given {
            plan,
            constants,
            root,
            theta,
            omega,
        } = self.given;
        let mut next = match &self.pass {
            Pass::Top => 0..1,
            Pass::Up { links, .. } | Pass::Down { links, .. } => links.clone(),
        };
        // The passes share one loop: each one's code is long.
        while !next.is_empty() {
            let part = match self.pass {
                Pass::Top => plan.top(),
                Pass::Up { cut, .. } | Pass::Down { cut, .. } => plan.window(cut, next.start),
            };
            let extent = Extent::new::<T>(&part, P::JOINTS);
            let mut buffer = &mut *self.buffer;
            let turns = take(&mut buffer, 3 * extent.links);
            let bends = take(&mut buffer, extent.turns() - 3 * extent.links);
            let answers = take(&mut buffer, R * extent.slots);
            let mut sweep = Sweep::<P, T, C, L, R, K> {
                part,
                constants,
                theta,
                omega,
                turns: Columns::new(turns, extent.links),
                bends: Columns::new(bends, extent.links),
                lead: extent.lead,
                answers: Columns::new(answers, extent.slots),
                kept: Columns::new(buffer, extent.slots),
                alpha: self.alpha,
                recursion: PhantomData,
            };
            sweep.prepare::<W>();
            sweep.up::<W>();
            let width = part.width;
            let here = next.start;
            next.start += width;
            match &mut self.pass {
                Pass::Top => {
                    for (column, root) in root.into_iter().enumerate() {
                        copy(sweep.answers.slice_mut(column, 0, 1), &[root]);
                    }
                }
                Pass::Up { answers, .. } => {
                    for column in 0..R {
                        let own = sweep.answers.slice_mut(column, 0, width);
                        copy(take(answers, width), own);
                    }
                    continue;
                }
                Pass::Down { pivots, .. } => {
                    for (column, all) in pivots.iter().enumerate() {
                        let all = all.get(here..here + width).unwrap_or_default();
                        copy(sweep.answers.slice_mut(column, 0, width), all);
                    }
                }
            }
            sweep.down::<W>();
        }
    }
}

/// As many numbers as both have.
fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Writes the accelerations to `alpha`. The tree has two generations at least,
/// all slices one number a link, `buffer` has room for [`workspace`].
pub(super) fn accelerations<P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    given: &Given<'_, T, C>,
    alpha: &mut [T],
    buffer: &mut [T],
    threads: usize,
) where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    let plan = given.plan;
    let alpha = Shared::new(alpha);
    let run = |pass: Pass<'_, T>, alpha: Shared<'_, T>, buffer: &mut [T]| {
        T::over_slices(Job::<P, T, C, L, R, K> {
            given,
            pass,
            alpha,
            buffer,
            recursion: PhantomData,
        });
    };
    let top = plan.top();
    let extent = Extent::new::<T>(&top, P::JOINTS);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let mut buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let above = take(&mut buffer, extent.room::<R, K>());
    let Some(cut) = plan.cut else {
        run(Pass::Top, alpha, above);
        return;
    };
    let count = plan.count(cut);
    let answers = take(&mut buffer, boundary::<T, R>(plan, cut));
    let size = worker::<T, R, K>(plan, cut, P::JOINTS);
    let parts = count.div_ceil(WIDTH);
    let each = parts.div_ceil(threads.max(1)) * WIDTH;
    {
        let (mut answers, mut buffer) = (&mut *answers, &mut *buffer);
        let jobs = (0..count).step_by(each).map(|start| {
            let links = start..(start + each).min(count);
            let answers = take(&mut answers, links.len() * R);
            let pass = Pass::Up {
                cut,
                links,
                answers,
            };
            (pass, alpha, take(&mut buffer, size))
        });
        super::threads::all(jobs, |(pass, alpha, buffer)| run(pass, alpha, buffer));
    }
    let first = extent.turns();
    let slot = top.slot(cut);
    let inner = above.get_mut(first..).unwrap_or_default();
    let mut columns = Columns::<T, R>::new(inner, extent.slots);
    let mut rest = &*answers;
    for start in (0..count).step_by(WIDTH) {
        let width = WIDTH.min(count - start);
        for column in 0..R {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(columns.slice_mut(column, slot + start, width), own);
        }
    }
    run(Pass::Top, alpha, above);
    let (x, y) = above.get_mut(first..).unwrap_or_default().split_at_mut(extent.slots);
    let pivots = [x, y].map(|all| &*all.get_mut(slot..slot + count).unwrap_or_default());
    let mut buffer = &mut *buffer;
    let jobs = (0..count).step_by(each).map(|start| {
        let links = start..(start + each).min(count);
        let pass = Pass::Down { cut, links, pivots };
        (pass, alpha, take(&mut buffer, size))
    });
    super::threads::all(jobs, |(pass, alpha, buffer)| run(pass, alpha, buffer));
}
