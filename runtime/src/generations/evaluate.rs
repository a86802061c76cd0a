//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::marker::PhantomData;
use core::ops::Range;

use super::part::{Part, Run};
use super::plan::{Plan, WIDTH};
use super::recursion::Recursion;
use super::shared::Shared;
use super::sweep::{Memory, Sweep};
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

/// Numbers of a part: of all its links, and of those with answers.
fn sizes(part: &Part<'_>) -> (usize, usize) {
    let leaf = part.shape.counts.len() - 1;
    (part.own(part.end), part.own((part.end + 1).min(leaf)))
}

fn length<const R: usize, const K: usize>(part: &Part<'_>, joints: bool) -> usize {
    let (all, inner) = sizes(part);
    all * if joints { 4 } else { 2 } + inner * (R + 2 + K)
}

/// Takes `length` numbers off the front.
fn take<'a, T>(buffer: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let whole = core::mem::take(buffer);
    let length = length.min(whole.len());
    let (front, rest) = whole.split_at_mut(length);
    *buffer = rest;
    front
}

fn memory<'a, T, const R: usize, const K: usize>(
    part: &Part<'_>,
    joints: bool,
    mut buffer: &'a mut [T],
) -> Memory<'a, T, R, K> {
    let (all, inner) = sizes(part);
    let buffer = &mut buffer;
    let bends = if joints { all } else { 0 };
    Memory {
        sines: take(buffer, all),
        cosines: take(buffer, all),
        bends: take(buffer, bends),
        bend_rates: take(buffer, bends),
        answers: core::array::from_fn(|_| take(buffer, inner)),
        pivots: core::array::from_fn(|_| take(buffer, inner)),
        kept: core::array::from_fn(|_| take(buffer, inner)),
    }
}

/// How many numbers an evaluation needs room for, on so many threads.
pub(super) fn workspace<const R: usize, const K: usize>(
    plan: &Plan,
    joints: bool,
    threads: usize,
) -> usize {
    let top = length::<R, K>(&plan.top(), joints);
    match plan.cut {
        None => top,
        Some(cut) => top + plan.count(cut) * R + threads * worker::<R, K>(plan, cut, joints),
    }
}

/// The same for one thread alone.
fn worker<const R: usize, const K: usize>(plan: &Plan, cut: usize, joints: bool) -> usize {
    let window = plan.window(cut, 0);
    // A line more, so that two threads never write to one.
    length::<R, K>(&window, joints) + window.own(window.end) + 16
}

/// One way through the top of the tree, or through some of the parts below.
enum Pass<'a, T> {
    /// Up and down again, the whole tree or what is above the parts, whose
    /// answers are in memory.
    Top { alpha: &'a mut [T] },
    /// Up through the parts that start with these links of their generation. A
    /// part's answers stand together.
    Up {
        cut: usize,
        links: Range<usize>,
        answers: &'a mut [T],
    },
    /// Down through them, from the accelerations of their pivots. What was
    /// formed on the way up is formed again: that takes less time than writing
    /// it to memory and reading it back.
    Down {
        cut: usize,
        links: Range<usize>,
        pivots: [&'a [T]; 2],
        alpha: Shared<'a, T>,
    },
}

struct Job<'a, P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    given: &'a Given<'a, T, C>,
    pass: Pass<'a, T>,
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
            Pass::Top { .. } => 0..1,
            Pass::Up { links, .. } | Pass::Down { links, .. } => links.clone(),
        };
        // The passes share one loop: each one's code is long.
        while !next.is_empty() {
            let part = match self.pass {
                Pass::Top { .. } => plan.top(),
                Pass::Up { cut, .. } | Pass::Down { cut, .. } => plan.window(cut, next.start),
            };
            let mut buffer = &mut *self.buffer;
            let own = take(&mut buffer, length::<R, K>(&part, P::JOINTS));
            let mut sweep = Sweep::<P, T, C, L, R, K> {
                part,
                constants,
                theta,
                omega,
                memory: memory(&part, P::JOINTS, own),
                recursion: PhantomData,
            };
            sweep.prepare::<W>();
            sweep.up::<W>();
            let width = part.width;
            match &mut self.pass {
                Pass::Top { .. } => fill_front(&mut sweep.memory.pivots, root),
                Pass::Up { answers, .. } => {
                    for own in &sweep.memory.answers {
                        copy(take(answers, width), own);
                    }
                    next.start += width;
                    continue;
                }
                Pass::Down { pivots, .. } => {
                    for (own, all) in sweep.memory.pivots.iter_mut().zip(pivots) {
                        copy(own, all.get(next.start..next.start + width).unwrap_or_default());
                    }
                }
            }
            let scattered = match &self.pass {
                Pass::Down { alpha, .. } => Some(*alpha),
                _ => None,
            };
            let turned = match &mut self.pass {
                Pass::Top { alpha } => &mut **alpha,
                _ => buffer,
            };
            sweep.down::<W>(turned);
            if let Some(mut alpha) = scattered {
                for Run { own, whole, length, .. } in part.all() {
                    alpha.write(whole, turned.get(own..own + length).unwrap_or_default());
                }
            }
            next.start += width;
        }
    }
}

fn fill_front<T: Copy>(arrays: &mut [&mut [T]; 2], values: [T; 2]) {
    for (array, value) in arrays.iter_mut().zip(values) {
        if let Some(first) = array.first_mut() {
            *first = value;
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
    let run = |pass: Pass<'_, T>, buffer: &mut [T]| {
        T::over_slices(Job::<P, T, C, L, R, K> {
            given,
            pass,
            buffer,
            recursion: PhantomData,
        });
    };
    let top = plan.top();
    let mut buffer = buffer;
    let above = take(&mut buffer, length::<R, K>(&top, P::JOINTS));
    let Some(cut) = plan.cut else {
        run(Pass::Top { alpha }, above);
        return;
    };
    let count = plan.count(cut);
    let answers = take(&mut buffer, count * R);
    let size = worker::<R, K>(plan, cut, P::JOINTS);
    let parts = count.div_ceil(WIDTH);
    let each = parts.div_ceil(threads.max(1)) * WIDTH;
    {
        let (mut answers, mut buffer) = (&mut *answers, &mut *buffer);
        let jobs = (0..count).step_by(each).map(|start| {
            let links = start..(start + each).min(count);
            let answers = take(&mut answers, links.len() * R);
            let pass = Pass::Up { cut, links, answers };
            (pass, take(&mut buffer, size))
        });
        super::threads::all(jobs, |(pass, buffer)| run(pass, buffer));
    }
    let boundary = top.own(cut);
    let mut memory = memory::<T, R, K>(&top, P::JOINTS, above);
    let mut rest = &*answers;
    for start in (0..count).step_by(WIDTH) {
        let width = WIDTH.min(count - start);
        for all in &mut memory.answers {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(all.get_mut(boundary + start..).unwrap_or_default(), own);
        }
    }
    run(Pass::Top { alpha: &mut *alpha }, above);
    let memory = self::memory::<T, R, K>(&top, P::JOINTS, above);
    let pivots = memory.pivots.map(|pivots| &*pivots);
    let pivots = pivots.map(|pivots| pivots.get(boundary..boundary + count).unwrap_or_default());
    let alpha = Shared::new(alpha);
    let mut buffer = &mut *buffer;
    let jobs = (0..count).step_by(each).map(|start| {
        let links = start..(start + each).min(count);
        let pass = Pass::Down { cut, links, pivots, alpha };
        (pass, take(&mut buffer, size))
    });
    super::threads::all(jobs, |(pass, buffer)| run(pass, buffer));
}
