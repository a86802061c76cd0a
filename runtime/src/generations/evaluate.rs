//! Accelerations of one state: the tree in one piece, or part by part where it
//! is large.

use core::ops::Range;

use super::boundary::Boundary;
use super::cut::Cut;
use super::layout;
use super::memory::{Extent, LINE, line, take};
use super::part::Part;
use super::recursion::Recursion;
use super::root::RootDrive;
use super::shared::Shared;
use super::sweep::{self, Access, Sweep};
use super::tree::Tree;
use super::turns::Turns;
use crate::scalar::Scalar;

/// The ways through a part, compiled for one recursion.
#[derive(Debug)]
pub struct Kernels<T: 'static> {
    pub(super) up: fn(&Access<'_, T>),
    pub(super) down: fn(&Access<'_, T>),
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

    /// What is known before the recursion, with what is of the generation `below`.
    fn prepare(&self, sweep: &mut Sweep<'_, T>, below: Option<Boundary<'_, T>>) {
        if let Some(below) = below {
            below.load_answers(sweep);
        }
        T::over_slices(Turns(&mut *sweep));
        if self.tree.layout.sizes.joints {
            sweep.bend();
        }
    }

    /// From the leaves, or what is known of the generation `below`, to the first
    /// generation.
    fn up(&self, sweep: &mut Sweep<'_, T>, below: Option<Boundary<'_, T>>) {
        self.prepare(sweep, below);
        if let Some(access) = sweep.access() {
            (self.kernels.up)(&access);
        }
    }

    /// From the first generation to the leaves, or the generation `below`.
    fn down(&self, sweep: &mut Sweep<'_, T>, below: Option<Boundary<'_, T>>) {
        if let Some(access) = sweep.access() {
            (self.kernels.down)(&access);
        }
        if let Some(below) = below {
            below.store_pivots(sweep);
        }
    }

    /// Up and down again: the whole tree, or what is above the first `cuts`, of which
    /// the last one starts with the generation `below`.
    fn solve(
        &self,
        cuts: usize,
        below: Option<Boundary<'_, T>>,
        buffer: &mut [T],
        alpha: Shared<'_, T>,
    ) {
        let Tree { plan, layout, .. } = self.tree;
        let mut buffer = buffer;
        let (Some(cut), Some(extent)) = (plan.cuts.get(cuts), layout.parts.get(cuts)) else {
            let lasting = take(&mut buffer, layout.top.lasting());
            let mut sweep = self.sweep(plan.top(), &layout.top, [lasting, buffer], alpha);
            sweep.torque = self.drive.map(|drive| drive.torque);
            sweep.root = Some(RootDrive::above(self.tree.root, self.drive));
            self.prepare(&mut sweep, below);
            if let Some(access) = sweep.access() {
                (self.kernels.up)(&access);
                (self.kernels.down)(&access);
            }
            if let Some(below) = below {
                below.store_pivots(&mut sweep);
            }
            return;
        };
        let threads = self.tree.threads;
        let room = Boundary::<T>::room(cut.count, layout.sizes);
        let level = Level {
            cut,
            extent,
            start: Boundary::new(take(&mut buffer, room), cut.count),
            below,
            alpha,
        };
        let workers = take(&mut buffer, layout::workers::<T>(cut, extent, threads));
        super::threads::all(level.jobs(threads, &mut *workers), |parts| {
            self.parts_up(parts);
        });
        self.solve(cuts + 1, Some(level.start), buffer, alpha);
        super::threads::all(level.jobs(threads, workers), |parts| {
            self.parts_down(parts);
        });
    }

    /// Up through parts.
    fn parts_up(&self, mut parts: Parts<'_, T>) {
        let Level {
            cut, start, below, ..
        } = parts.level;
        for part in cut.windows(&parts.links) {
            let mut sweep = self.part(part, &mut parts);
            self.up(&mut sweep, below);
            start.store_answers(&mut sweep);
        }
    }

    /// Down through them. Where nothing was kept of the way up, it is taken again:
    /// that takes less time than writing what is formed to memory and reading it back.
    fn parts_down(&self, mut parts: Parts<'_, T>) {
        let Level {
            cut, start, below, ..
        } = parts.level;
        for mut part in cut.windows(&parts.links) {
            part.ends = true;
            let mut sweep = self.part(part, &mut parts);
            if !cut.keeps {
                self.up(&mut sweep, below);
            }
            start.load_pivots(&mut sweep);
            self.down(&mut sweep, below);
        }
    }

    fn part<'a>(&'a self, part: Part<'a>, parts: &'a mut Parts<'_, T>) -> Sweep<'a, T> {
        let Level {
            cut, extent, alpha, ..
        } = parts.level;
        let lasting = match cut.keeps {
            true => take(&mut parts.lasting, extent.lasting()),
            false => &mut *parts.lasting,
        };
        self.sweep(part, extent, [lasting, &mut *parts.passing], alpha)
    }
}

/// A cut, and the state of all threads there.
#[derive(Debug)]
struct Level<'a, T> {
    cut: &'a Cut,
    extent: &'a Extent,
    /// What is told of the first generation, and of the one that comes behind.
    start: Boundary<'a, T>,
    below: Option<Boundary<'a, T>>,
    alpha: Shared<'a, T>,
}

impl<T> Clone for Level<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Level<'_, T> {}

impl<'a, T> Level<'a, T> {
    /// The parts of each thread.
    fn jobs<'b>(
        self,
        threads: usize,
        mut workers: &'b mut [T],
    ) -> impl Iterator<Item = Parts<'b, T>>
    where
        'a: 'b,
    {
        self.cut.jobs(threads).map(move |links| {
            let room = layout::worker::<T>(self.cut, self.extent, &links);
            let mut own = take(&mut workers, room);
            Parts {
                level: self,
                links,
                passing: take(&mut own, self.extent.passing()),
                lasting: own,
            }
        })
    }
}

/// The parts of a thread.
struct Parts<'a, T> {
    level: Level<'a, T>,
    /// Those that start with these links.
    links: Range<usize>,
    lasting: &'a mut [T],
    passing: &'a mut [T],
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
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    evaluation.solve(0, None, buffer, Shared::new(alpha));
}
