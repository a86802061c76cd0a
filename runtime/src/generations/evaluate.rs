//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::ops::Range;

use super::memory::{Extent, LINE, Sizes, line, take};
use super::part::Part;
use super::plan::{Plan, WIDTH};
use super::recursion::Recursion;
use super::root::RootDrive;
use super::shared::Shared;
use super::sweep::{self, Sweep};
use super::tree::Tree;
use super::turns::Turns;
use crate::scalar::Scalar;

/// The ways through a part, compiled for one recursion.
#[derive(Debug)]
pub struct Kernels<T: 'static> {
    pub(super) up: fn(&mut Sweep<'_, T>),
    pub(super) down: fn(&mut Sweep<'_, T>),
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
        let part = plan.cut.map(|cut| plan.largest(cut));
        Self {
            top: Extent::new::<T>(&plan.top(), sizes),
            part: part.map(|part| Extent::new::<T>(&part, sizes)),
            sizes,
        }
    }

    /// That of the same tree in numbers of another size.
    pub(super) fn rescale<T>(&self, plan: &Plan) -> Self {
        Self::new::<T>(plan, self.sizes)
    }

    /// How many numbers an evaluation needs room for, on so many threads.
    pub(super) fn room<T>(&self, plan: &Plan, threads: usize) -> usize {
        let parts = match (&self.part, plan.cut) {
            (Some(part), Some(cut)) => {
                let each = plan.each(cut, threads);
                let jobs = plan.jobs(cut, threads).count();
                self.boundary::<T>(plan.count(cut)) + jobs * worker::<T>(plan, part, each)
            }
            _ => 0,
        };
        line::<T>() + self.top.lasting() + self.top.passing() + parts
    }

    /// Answers of all parts.
    fn boundary<T>(&self, count: usize) -> usize {
        (count * self.sizes.answers).next_multiple_of(line::<T>())
    }
}

/// Room for the parts of so many links of the cut, which one thread computes.
fn worker<T>(plan: &Plan, part: &Extent, each: usize) -> usize {
    // A line more, so that two threads never write to one.
    part.passing() + lasting(plan, part, each) + line::<T>()
}

/// Of that, what is read on the way down: of all these parts, or of the one at
/// hand.
fn lasting(plan: &Plan, part: &Extent, each: usize) -> usize {
    let parts = if plan.keeps { each.div_ceil(WIDTH) } else { 1 };
    parts * part.lasting()
}

/// One evaluation.
struct Evaluation<'a, T: 'static> {
    tree: &'a Tree<T>,
    kernels: &'a Kernels<T>,
    drive: Option<RootDrive<T>>,
    theta: &'a [T],
    omega: &'a [T],
}

impl<T: Scalar> Evaluation<'_, T> {
    fn sweep<'a>(
        &'a self,
        part: Part<'a>,
        extent: &Extent,
        [lasting, passing]: [&'a mut [T]; 2],
        alpha: Shared<'a, T>,
    ) -> Sweep<'a, T> {
        Sweep {
            part,
            constants: &self.tree.constants,
            theta: self.theta,
            omega: self.omega,
            storage: extent.storage(lasting, passing),
            root: None,
            torque: None,
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
    fn top(&self, memory: [&mut [T]; 2], alpha: Shared<'_, T>) {
        let mut sweep = self.sweep(self.tree.plan.top(), &self.tree.layout.top, memory, alpha);
        sweep.torque = self.drive.map(|drive| drive.torque);
        self.up(&mut sweep);
        sweep.root = Some(RootDrive::above(self.tree.root, self.drive));
        (self.kernels.down)(&mut sweep);
    }

    /// Up through the parts that start with these links of generation `cut`. A
    /// part's answers stand together.
    fn parts_up(&self, mut parts: Parts<'_, T>, mut answers: &mut [T]) {
        let count = self.tree.layout.sizes.answers;
        for part in self.tree.plan.windows(parts.cut, parts.links.clone()) {
            let (extent, alpha) = (parts.extent, parts.alpha);
            let mut sweep = self.sweep(part, extent, parts.memory(self.tree), alpha);
            self.up(&mut sweep);
            for column in 0..count {
                let own = sweep.storage.answers_mut(column, 0, part.width);
                copy(take(&mut answers, part.width), own);
            }
        }
    }

    /// Down through them, from the accelerations of their pivots. Where nothing was
    /// kept of the way up, it is taken again: that takes less time than writing what
    /// is formed to memory and reading it back.
    fn parts_down(&self, mut parts: Parts<'_, T>, pivots: [&[T]; 2]) {
        for part in self.tree.plan.windows(parts.cut, parts.links.clone()) {
            let (extent, alpha) = (parts.extent, parts.alpha);
            let mut sweep = self.sweep(part, extent, parts.memory(self.tree), alpha);
            if !self.tree.plan.keeps {
                self.up(&mut sweep);
            }
            for (column, all) in pivots.into_iter().enumerate() {
                let own = sweep.storage.answers_mut(column, 0, part.width);
                copy(own, all.get(part.start..).unwrap_or_default());
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
    lasting: &'a mut [T],
    passing: &'a mut [T],
    alpha: Shared<'a, T>,
}

impl<T> Parts<'_, T> {
    /// Memory for the next part.
    fn memory(&mut self, tree: &Tree<T>) -> [&mut [T]; 2] {
        let lasting = match tree.plan.keeps {
            true => take(&mut self.lasting, self.extent.lasting()),
            false => &mut *self.lasting,
        };
        [lasting, &mut *self.passing]
    }
}

/// The parts of each thread.
fn jobs<'a, T>(
    tree: &'a Tree<T>,
    cut: usize,
    extent: &'a Extent,
    mut buffer: &'a mut [T],
    alpha: Shared<'a, T>,
) -> impl Iterator<Item = Parts<'a, T>> {
    let plan = &tree.plan;
    let each = plan.each(cut, tree.threads);
    plan.jobs(cut, tree.threads).map(move |links| {
        let mut own = take(&mut buffer, worker::<T>(plan, extent, each));
        Parts {
            cut,
            extent,
            links,
            lasting: take(&mut own, lasting(plan, extent, each)),
            passing: own,
            alpha,
        }
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
    drive: Option<RootDrive<T>>,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
    buffer: &mut [T],
) {
    let evaluation = Evaluation {
        tree,
        kernels,
        drive,
        theta,
        omega,
    };
    let (plan, layout) = (&tree.plan, &tree.layout);
    let alpha = Shared::new(alpha);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let mut buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let kept = take(&mut buffer, layout.top.lasting());
    let above = take(&mut buffer, layout.top.passing());
    let (Some(cut), Some(extent)) = (plan.cut, &layout.part) else {
        evaluation.top([kept, above], alpha);
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
    let slot = plan.top().stages.last().map_or(0, |stage| stage.slot);
    let mut storage = layout.top.storage(&mut *kept, &mut *above);
    let mut rest = &*answers;
    for Part { start, width, .. } in plan.windows(cut, 0..count) {
        for column in 0..layout.sizes.answers {
            let (own, others) = rest.split_at(width.min(rest.len()));
            rest = others;
            copy(storage.answers_mut(column, slot + start, width), own);
        }
    }
    evaluation.top([&mut *kept, &mut *above], alpha);
    let storage = layout.top.storage(kept, above);
    let column = |column: usize| {
        let start = column * storage.slots + slot;
        storage
            .answers
            .get(start..start + count)
            .unwrap_or_default()
    };
    let pivots = [column(0), column(1)];
    super::threads::all(jobs(tree, cut, extent, buffer, alpha), |parts| {
        evaluation.parts_down(parts, pivots)
    });
}
