//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::ops::Range;

use super::memory::{Extent, LINE, Sizes, Storage, line, take};
use super::part::Part;
use super::plan::{Plan, WIDTH};
use super::recursion::Recursion;
use super::shared::Shared;
use super::sweep::{self, Sweep};
use super::tree::Tree;
use super::turns::Turns;
use crate::scalar::Scalar;

/// The ways through a part, compiled for one recursion.
#[derive(Debug)]
pub struct Kernels<T: 'static> {
    pub(super) sizes: Sizes,
    up: fn(&mut Sweep<'_, T>),
    down: fn(&mut Sweep<'_, T>, &mut [T]),
}

impl<T: Scalar> Kernels<T> {
    pub(super) fn of<P, const C: usize, const L: usize, const R: usize, const K: usize>() -> Self
    where
        P: Recursion<C, L, R, K>,
    {
        Self {
            sizes: Sizes {
                answers: R,
                kept: K,
                joints: P::JOINTS,
            },
            up: sweep::up::<P, T, C, L, R, K>,
            down: sweep::down::<P, T, C, L, R, K>,
        }
    }
}

/// How many numbers an evaluation needs room for, on so many threads.
pub(super) fn workspace<T>(plan: &Plan, sizes: Sizes, threads: usize) -> usize {
    let top = Extent::new::<T>(&plan.top(), sizes);
    let parts = plan.cut.map_or(0, |cut| {
        let window = Extent::new::<T>(&plan.window(cut, 0), sizes);
        answers::<T>(plan, cut, sizes)
            + plan.count(cut).div_ceil(WIDTH) * window.kept::<T>()
            + threads * worker::<T>(plan, cut, sizes)
    });
    line::<T>() + top.kept::<T>() + top.answers::<T>() + parts
}

/// Answers of all parts.
fn answers<T>(plan: &Plan, cut: usize, sizes: Sizes) -> usize {
    (plan.count(cut) * sizes.answers).next_multiple_of(line::<T>())
}

/// Room for one thread's parts, and for accelerations.
fn worker<T>(plan: &Plan, cut: usize, sizes: Sizes) -> usize {
    let window = plan.window(cut, 0);
    let extent = Extent::new::<T>(&window, sizes);
    // A line more, so that two threads never write to one.
    extent.answers::<T>() + extent.length::<T>(extent.all) + line::<T>()
}

/// One evaluation.
struct Evaluation<'a, T: 'static> {
    tree: &'a Tree<T>,
    kernels: &'a Kernels<T>,
    theta: &'a [T],
    omega: &'a [T],
}

impl<T: Scalar> Evaluation<'_, T> {
    fn sweep<'a>(&'a self, part: Part<'a>, storage: Storage<'a, T>) -> Sweep<'a, T> {
        Sweep {
            part,
            constants: &self.tree.constants,
            theta: self.theta,
            omega: self.omega,
            storage,
        }
    }

    /// Up and down again: the whole tree, or what is above the parts, whose
    /// answers are in memory.
    fn top(&self, kept: &mut [T], answers: &mut [T], alpha: &mut [T]) {
        let part = self.tree.plan.top();
        let extent = Extent::new::<T>(&part, self.kernels.sizes);
        let mut sweep = self.sweep(part, extent.storage(kept, answers));
        prepare(&mut sweep);
        (self.kernels.up)(&mut sweep);
        for (pivots, root) in sweep.storage.answers.each_mut().zip(self.tree.root) {
            if let Some(first) = pivots.first_mut() {
                *first = root;
            }
        }
        (self.kernels.down)(&mut sweep, alpha);
    }

    /// Up through the parts that start with these links of generation `cut`. A
    /// part's answers stand together.
    fn parts_up(
        &self,
        cut: usize,
        links: Range<usize>,
        mut answers: &mut [T],
        mut kept: &mut [T],
        buffer: &mut [T],
    ) {
        for start in links.step_by(WIDTH) {
            let part = self.tree.plan.window(cut, start);
            let extent = Extent::new::<T>(&part, self.kernels.sizes);
            let kept = take(&mut kept, extent.kept::<T>());
            let mut sweep = self.sweep(part, extent.storage(kept, buffer));
            prepare(&mut sweep);
            (self.kernels.up)(&mut sweep);
            for own in sweep.storage.answers.each_mut() {
                copy(take(&mut answers, part.width), own);
            }
        }
    }

    /// Down through them, from the accelerations of their pivots.
    fn parts_down(
        &self,
        cut: usize,
        links: Range<usize>,
        pivots: [&[T]; 2],
        mut alpha: Shared<'_, T>,
        mut kept: &mut [T],
        buffer: &mut [T],
    ) {
        for start in links.step_by(WIDTH) {
            let part = self.tree.plan.window(cut, start);
            let extent = Extent::new::<T>(&part, self.kernels.sizes);
            let (answers, turned) = buffer.split_at_mut(extent.answers::<T>());
            let kept = take(&mut kept, extent.kept::<T>());
            let mut sweep = self.sweep(part, extent.storage(kept, answers));
            for (own, all) in sweep.storage.answers.each_mut().zip(pivots) {
                let all = all.get(start..start + part.width);
                copy(own, all.unwrap_or_default());
            }
            (self.kernels.down)(&mut sweep, turned);
            for run in part.all() {
                let own = turned.get(run.own..run.own + run.length);
                alpha.write(run.whole, own.unwrap_or_default());
            }
        }
    }
}

/// Sines, cosines and relative motions.
fn prepare<T: Scalar>(sweep: &mut Sweep<'_, T>) {
    T::over_slices(Turns(&mut *sweep));
    if !sweep.storage.bends.is_empty() {
        sweep.bend();
    }
}

/// As many numbers as both have.
pub(super) fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Writes the accelerations to `alpha`. The tree has two generations at least,
/// all slices one number a link, `buffer` has room for [`workspace`].
pub(super) fn accelerations<T: Scalar>(
    tree: &Tree<T>,
    kernels: &Kernels<T>,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
    buffer: &mut [T],
) {
    let evaluation = Evaluation {
        tree,
        kernels,
        theta,
        omega,
    };
    let (plan, sizes) = (&tree.plan, kernels.sizes);
    let top = plan.top();
    let extent = Extent::new::<T>(&top, sizes);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let mut buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let kept = take(&mut buffer, extent.kept::<T>());
    let above = take(&mut buffer, extent.answers::<T>());
    let Some(cut) = plan.cut else {
        evaluation.top(kept, above, alpha);
        return;
    };
    let count = plan.count(cut);
    let answers = take(&mut buffer, answers::<T>(plan, cut, sizes));
    let size = worker::<T>(plan, cut, sizes);
    let parts = count.div_ceil(WIDTH);
    let each = parts.div_ceil(tree.threads.max(1)) * WIDTH;
    let window = Extent::new::<T>(&plan.window(cut, 0), sizes).kept::<T>();
    let all_kept = take(&mut buffer, parts * window);
    let some = each / WIDTH * window;
    {
        let (mut answers, mut buffer, mut kept) = (&mut *answers, &mut *buffer, &mut *all_kept);
        let jobs = (0..count).step_by(each).map(|start| {
            let links = start..(start + each).min(count);
            let answers = take(&mut answers, links.len() * sizes.answers);
            let memory = [answers, take(&mut kept, some), take(&mut buffer, size)];
            (links, memory)
        });
        super::threads::all(jobs, |(links, [answers, kept, buffer])| {
            evaluation.parts_up(cut, links, answers, kept, buffer);
        });
    }
    let boundary = top.own(cut);
    let mut rest = &*answers;
    let mut storage = extent.storage(kept, above);
    for start in (0..count).step_by(WIDTH) {
        let width = WIDTH.min(count - start);
        for all in storage.answers.each_mut() {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(all.get_mut(boundary + start..).unwrap_or_default(), own);
        }
    }
    evaluation.top(kept, above, &mut *alpha);
    let mut storage = extent.storage(kept, above);
    let pivots = storage.answers.first::<2>();
    let pivots = pivots.map(|all| &*all.get_mut(boundary..boundary + count).unwrap_or_default());
    let alpha = Shared::new(alpha);
    let (mut buffer, mut all_kept) = (&mut *buffer, &mut *all_kept);
    let jobs = (0..count).step_by(each).map(|start| {
        let links = start..(start + each).min(count);
        let memory = [take(&mut all_kept, some), take(&mut buffer, size)];
        (links, alpha, memory)
    });
    super::threads::all(jobs, |(links, alpha, [kept, buffer])| {
        evaluation.parts_down(cut, links, pivots, alpha, kept, buffer);
    });
}
