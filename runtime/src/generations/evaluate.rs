//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::ops::Range;

use super::memory::{Extent, LINE, Sizes, line, take};
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
    up: fn(&mut Sweep<'_, T>),
    down: fn(&mut Sweep<'_, T>),
}

impl<T: Scalar> Kernels<T> {
    pub(super) fn of<P, const C: usize, const L: usize, const R: usize, const K: usize>() -> Self
    where
        P: Recursion<C, L, R, K>,
    {
        Self {
            up: sweep::up::<P, T, C, L, R, K>,
            down: sweep::down::<P, T, C, L, R, K>,
        }
    }
}

/// The memory of an evaluation.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Of the tree or of what is above the parts.
    top: Extent,
    /// Of a part.
    part: Option<Extent>,
    sizes: Sizes,
}

impl Layout {
    pub(super) fn new<T>(plan: &Plan, sizes: Sizes) -> Self {
        let part = plan.cut.map(|cut| plan.window(cut, 0));
        Self {
            top: Extent::new::<T>(&plan.top(), sizes),
            part: part.map(|part| Extent::new::<T>(&part, sizes)),
            sizes,
        }
    }

    /// How many numbers an evaluation needs room for, on so many threads.
    pub(super) fn room<T>(&self, plan: &Plan, threads: usize) -> usize {
        let parts = match (&self.part, plan.cut) {
            (Some(part), Some(cut)) => {
                self.boundary::<T>(plan.count(cut)) + threads * worker::<T>(part)
            }
            _ => 0,
        };
        line::<T>() + self.top.room() + parts
    }

    /// Answers of all parts.
    fn boundary<T>(&self, count: usize) -> usize {
        (count * self.sizes.answers).next_multiple_of(line::<T>())
    }
}

/// Room for one thread's parts: a line more, so that two threads never write to
/// one.
fn worker<T>(part: &Extent) -> usize {
    part.room() + line::<T>()
}

/// One evaluation.
struct Evaluation<'a, T: 'static> {
    tree: &'a Tree<T>,
    kernels: &'a Kernels<T>,
    theta: &'a [T],
    omega: &'a [T],
}

impl<T: Scalar> Evaluation<'_, T> {
    fn sweep<'a>(
        &'a self,
        part: Part<'a>,
        extent: &Extent,
        buffer: &'a mut [T],
        alpha: Shared<'a, T>,
    ) -> Sweep<'a, T> {
        Sweep {
            part,
            constants: &self.tree.constants,
            theta: self.theta,
            omega: self.omega,
            storage: extent.storage(buffer),
            alpha,
        }
    }

    /// From the leaves to the first generation.
    fn up(&self, sweep: &mut Sweep<'_, T>) {
        T::over_slices(Turns(&mut *sweep));
        if self.tree.layout.sizes.joints {
            sweep.bend();
        }
        (self.kernels.up)(sweep);
    }

    /// Up and down again: the whole tree, or what is above the parts, whose
    /// answers are in memory.
    fn top(&self, buffer: &mut [T], alpha: Shared<'_, T>) {
        let mut sweep = self.sweep(self.tree.plan.top(), &self.tree.layout.top, buffer, alpha);
        self.up(&mut sweep);
        for (column, root) in self.tree.root.into_iter().enumerate() {
            sweep.storage.answers_mut(column, 0, 1).fill(root);
        }
        (self.kernels.down)(&mut sweep);
    }

    /// Up through the parts that start with these links of generation `cut`. A
    /// part's answers stand together.
    fn parts_up(&self, parts: Parts<'_, T>, mut answers: &mut [T]) {
        let count = self.tree.layout.sizes.answers;
        for start in parts.links.step_by(WIDTH) {
            let part = self.tree.plan.window(parts.cut, start);
            let mut sweep = self.sweep(part, parts.extent, parts.buffer, parts.alpha);
            self.up(&mut sweep);
            for column in 0..count {
                let own = sweep.storage.answers_mut(column, 0, part.width);
                copy(take(&mut answers, part.width), own);
            }
        }
    }

    /// Up again and down through them, from the accelerations of their pivots.
    /// What was formed on the first way up is formed again: that takes less time
    /// than writing it to memory and reading it back.
    fn parts_down(&self, parts: Parts<'_, T>, pivots: [&[T]; 2]) {
        for start in parts.links.step_by(WIDTH) {
            let part = self.tree.plan.window(parts.cut, start);
            let mut sweep = self.sweep(part, parts.extent, parts.buffer, parts.alpha);
            self.up(&mut sweep);
            for (column, all) in pivots.into_iter().enumerate() {
                let own = sweep.storage.answers_mut(column, 0, part.width);
                copy(own, all.get(start..).unwrap_or_default());
            }
            (self.kernels.down)(&mut sweep);
        }
    }
}

/// Some of the parts below the generation `cut`, and what a thread needs for them.
struct Parts<'a, T> {
    cut: usize,
    extent: &'a Extent,
    /// Of this generation, from a part's first link on.
    links: Range<usize>,
    buffer: &'a mut [T],
    alpha: Shared<'a, T>,
}

/// The parts of each thread.
fn jobs<'a, T>(
    tree: &Tree<T>,
    cut: usize,
    extent: &'a Extent,
    mut buffer: &'a mut [T],
    alpha: Shared<'a, T>,
) -> impl Iterator<Item = Parts<'a, T>> {
    let count = tree.plan.count(cut);
    let each = count.div_ceil(WIDTH).div_ceil(tree.threads.max(1)) * WIDTH;
    (0..count).step_by(each).map(move |start| Parts {
        cut,
        extent,
        links: start..(start + each).min(count),
        buffer: take(&mut buffer, worker::<T>(extent)),
        alpha,
    })
}

/// As many numbers as both have.
fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Writes the accelerations to `alpha`. The tree has two generations at least,
/// all slices one number a link, `buffer` has the tree's room.
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
    let (plan, layout) = (&tree.plan, &tree.layout);
    let alpha = Shared::new(alpha);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let mut buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let above = take(&mut buffer, layout.top.room());
    let (Some(cut), Some(extent)) = (plan.cut, &layout.part) else {
        evaluation.top(above, alpha);
        return;
    };
    let count = plan.count(cut);
    let answers = take(&mut buffer, layout.boundary::<T>(count));
    {
        let mut answers = &mut *answers;
        let with_answers = jobs(tree, cut, extent, &mut *buffer, alpha).map(|parts| {
            let length = parts.links.len() * layout.sizes.answers;
            (parts, take(&mut answers, length))
        });
        super::threads::all(with_answers, |(parts, answers)| {
            evaluation.parts_up(parts, answers);
        });
    }
    let slot = plan.top().slot(cut);
    let mut storage = layout.top.storage(&mut *above);
    let mut rest = &*answers;
    for start in (0..count).step_by(WIDTH) {
        let width = WIDTH.min(count - start);
        for column in 0..layout.sizes.answers {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(storage.answers_mut(column, slot + start, width), own);
        }
    }
    evaluation.top(&mut *above, alpha);
    let storage = layout.top.storage(above);
    let column = |column: usize| {
        let start = column * storage.slots + slot;
        storage.answers.get(start..start + count).unwrap_or_default()
    };
    let pivots = [column(0), column(1)];
    super::threads::all(jobs(tree, cut, extent, buffer, alpha), |parts| evaluation.parts_down(parts, pivots));
}
