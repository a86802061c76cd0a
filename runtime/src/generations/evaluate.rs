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

/// Arrays start where cache lines do: a vector that crosses from one into the
/// next takes two accesses.
const LINE: usize = 64;

/// Numbers of type `T` in a line.
fn line<T>() -> usize {
    (LINE / size_of::<T>().max(1)).max(1)
}

/// What memory for a part takes.
struct Extent {
    /// Unused numbers before each array, so that its longest generation starts
    /// with a line.
    lead: usize,
    /// All links.
    all: usize,
    /// Those that have answers.
    inner: usize,
    /// Forces in joints: two arrays more.
    joints: bool,
}

impl Extent {
    #[inline(always)]
    fn new<T>(part: &Part<'_>, joints: bool) -> Self {
        let leaf = part.shape.counts.len().saturating_sub(1);
        let last = part.own(part.end.saturating_sub(1));
        Self {
            lead: last.next_multiple_of(line::<T>()) - last,
            all: part.own(part.end),
            inner: part.own((part.end + 1).min(leaf)),
            joints,
        }
    }

    /// An odd number of lines: arrays whose distances are multiples of a power
    /// of two compete for the same places of the cache.
    fn length<T>(&self, links: usize) -> usize {
        ((self.lead + links).div_ceil(line::<T>()) | 1) * line::<T>()
    }

    /// Of what is read on the way down.
    fn kept<T, const K: usize>(&self) -> usize {
        let whole = if self.joints { 4 } else { 2 };
        whole * self.length::<T>(self.all) + K * self.length::<T>(self.inner)
    }

    /// Of answers.
    fn answers<T, const R: usize>(&self) -> usize {
        R * self.length::<T>(self.inner)
    }

    fn array<'a, T>(&self, buffer: &mut &'a mut [T], links: usize) -> &'a mut [T] {
        let padded = take(buffer, self.length::<T>(links));
        padded
            .get_mut(self.lead..self.lead + links)
            .unwrap_or_default()
    }

    fn memory<'a, T, const R: usize, const K: usize>(
        &self,
        mut kept: &'a mut [T],
        mut answers: &'a mut [T],
    ) -> Memory<'a, T, R, K> {
        let (buffer, answers) = (&mut kept, &mut answers);
        let &Self {
            all, inner, joints, ..
        } = self;
        Memory {
            sines: self.array(buffer, all),
            cosines: self.array(buffer, all),
            bends: if joints {
                self.array(buffer, all)
            } else {
                &mut []
            },
            bend_rates: if joints {
                self.array(buffer, all)
            } else {
                &mut []
            },
            answers: core::array::from_fn(|_| self.array(answers, inner)),
            kept: core::array::from_fn(|_| self.array(buffer, inner)),
        }
    }
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
    let top = Extent::new::<T>(&plan.top(), joints);
    let parts = plan.cut.map_or(0, |cut| {
        let window = Extent::new::<T>(&plan.window(cut, 0), joints);
        answers::<T, R>(plan, cut)
            + plan.count(cut).div_ceil(WIDTH) * window.kept::<T, K>()
            + threads * worker::<T, R, K>(plan, cut, joints)
    });
    line::<T>() + top.kept::<T, K>() + top.answers::<T, R>() + parts
}

/// Answers of all parts.
fn answers<T, const R: usize>(plan: &Plan, cut: usize) -> usize {
    (plan.count(cut) * R).next_multiple_of(line::<T>())
}

/// Room for one thread's parts, and for accelerations.
fn worker<T, const R: usize, const K: usize>(plan: &Plan, cut: usize, joints: bool) -> usize {
    let window = plan.window(cut, 0);
    let extent = Extent::new::<T>(&window, joints);
    // A line more, so that two threads never write to one.
    extent.answers::<T, R>() + extent.length::<T>(extent.all) + line::<T>()
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
    kept: &'a mut [T],
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
            let extent = Extent::new::<T>(&part, P::JOINTS);
            let answers = take(&mut buffer, extent.answers::<T, R>());
            let kept = take(&mut self.kept, extent.kept::<T, K>());
            let mut sweep = Sweep::<P, T, C, L, R, K> {
                part,
                constants,
                theta,
                omega,
                memory: extent.memory(kept, answers),
                recursion: PhantomData,
            };
            if !matches!(self.pass, Pass::Down { .. }) {
                sweep.prepare::<W>();
                sweep.up::<W>();
            }
            let width = part.width;
            match &mut self.pass {
                Pass::Top { .. } => fill_front(sweep.memory.pivots_mut(), root),
                Pass::Up { answers, .. } => {
                    for own in &sweep.memory.answers {
                        copy(take(answers, width), own);
                    }
                    next.start += width;
                    continue;
                }
                Pass::Down { pivots, .. } => {
                    for (own, all) in sweep.memory.pivots_mut().into_iter().zip(pivots) {
                        copy(
                            own,
                            all.get(next.start..next.start + width).unwrap_or_default(),
                        );
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
                for Run {
                    own, whole, length, ..
                } in part.all()
                {
                    alpha.write(whole, turned.get(own..own + length).unwrap_or_default());
                }
            }
            next.start += width;
        }
    }
}

fn fill_front<T: Copy>(arrays: [&mut [T]; 2], values: [T; 2]) {
    for (array, value) in arrays.into_iter().zip(values) {
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
    let run = |pass: Pass<'_, T>, kept: &mut [T], buffer: &mut [T]| {
        T::over_slices(Job::<P, T, C, L, R, K> {
            given,
            pass,
            kept,
            buffer,
            recursion: PhantomData,
        });
    };
    let top = plan.top();
    let extent = Extent::new::<T>(&top, P::JOINTS);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let mut buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let kept = take(&mut buffer, extent.kept::<T, K>());
    let above = take(&mut buffer, extent.answers::<T, R>());
    let Some(cut) = plan.cut else {
        run(Pass::Top { alpha }, kept, above);
        return;
    };
    let count = plan.count(cut);
    let answers = take(&mut buffer, answers::<T, R>(plan, cut));
    let size = worker::<T, R, K>(plan, cut, P::JOINTS);
    let parts = count.div_ceil(WIDTH);
    let each = parts.div_ceil(threads.max(1)) * WIDTH;
    let window = Extent::new::<T>(&plan.window(cut, 0), P::JOINTS).kept::<T, K>();
    let all_kept = take(&mut buffer, parts * window);
    let some = each / WIDTH * window;
    {
        let (mut answers, mut buffer, mut kept) = (&mut *answers, &mut *buffer, &mut *all_kept);
        let jobs = (0..count).step_by(each).map(|start| {
            let links = start..(start + each).min(count);
            let answers = take(&mut answers, links.len() * R);
            let pass = Pass::Up {
                cut,
                links,
                answers,
            };
            (pass, take(&mut kept, some), take(&mut buffer, size))
        });
        super::threads::all(jobs, |(pass, kept, buffer)| run(pass, kept, buffer));
    }
    let boundary = top.own(cut);
    let mut memory = extent.memory::<T, R, K>(kept, above);
    let mut rest = &*answers;
    for start in (0..count).step_by(WIDTH) {
        let width = WIDTH.min(count - start);
        for all in &mut memory.answers {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(all.get_mut(boundary + start..).unwrap_or_default(), own);
        }
    }
    run(Pass::Top { alpha: &mut *alpha }, kept, above);
    let mut memory = extent.memory::<T, R, K>(kept, above);
    let pivots = memory.pivots_mut();
    let pivots = pivots.map(|all| &*all.get_mut(boundary..boundary + count).unwrap_or_default());
    let alpha = Shared::new(alpha);
    let (mut buffer, mut all_kept) = (&mut *buffer, &mut *all_kept);
    let jobs = (0..count).step_by(each).map(|start| {
        let links = start..(start + each).min(count);
        let pass = Pass::Down {
            cut,
            links,
            pivots,
            alpha,
        };
        (pass, take(&mut all_kept, some), take(&mut buffer, size))
    });

    super::threads::all(jobs, |(pass, kept, buffer)| run(pass, kept, buffer));
}
