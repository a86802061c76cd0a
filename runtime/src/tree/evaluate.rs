//! Accelerations for a single state: the whole tree at once, or block by block if the tree is
//! large.

use core::ops::Range;

use super::block::SubtreeBlock;
use super::interface::Interface;
use super::layout;
use super::memory::{BlockMemory, LINE, line, odd_lines, take};
use super::motion::{Motions, joint_motions};
use super::partition::Partition;
use super::root::RootDrive;
use super::shared::Shared;
use super::skeleton::Skeleton;
use super::small::LinkStates;
use super::sweep::{PassSelection, Sweep, View};
use crate::scalar::kind::compiled_once;
use crate::scalar::{Scalar, at};
use crate::simd::WIDEST;
use crate::simd::dispatch::in_widest;
use crate::system::Workspace;

/// Function that evaluates the equations of one tree for one block; it is compiled with every
/// model.
pub(super) type SweepFn<T> = fn(&View<'_, T, T>, PassSelection<'_, T>);

/// Input of one evaluation.
struct Evaluation<'a, T: 'static> {
    tree: &'a Skeleton<T>,
    sweep: SweepFn<T>,
    drive: Option<RootDrive<T>>,
    given: LinkStates<'a, T>,
    /// For each link, 1 if it is prescribed and 0 otherwise; `None` if no link is prescribed.
    prescribed: Option<&'a [T]>,
}

impl<T: Scalar> Evaluation<'_, T> {
    fn block<'a>(
        &'a self,
        block: SubtreeBlock<'a>,
        block_memory: &BlockMemory,
        [lasting, passing]: [&'a mut [T]; 2],
    ) -> Sweep<'a, T, T> {
        Sweep {
            block,
            constants: &self.tree.constants,
            omega: self.given.omega,
            storage: block_memory.storage(self.tree.sizes, lasting, passing, false),
            root: None,
            torque: None,
        }
    }

    /// Computes sines, cosines and joint motions of a block before its passes, and loads the
    /// responses of the generation `below`, if there is one.
    fn prepare(
        &self,
        sweep: &mut Sweep<'_, T, T>,
        below: Option<Interface<'_, T>>,
        alpha: Shared<'_, T>,
    ) {
        if let Some(below) = below {
            below.load_responses(sweep);
        }
        let ends = sweep.block.ends;
        in_widest::<T, _>(Motions {
            sweep: &mut *sweep,
            theta: self.given.theta,
            omega: self.given.omega,
            torques: self.given.torques,
            prescribed: self.prescribed,
            alpha: ends.then_some(alpha),
        });
        if self.tree.sizes.joints {
            joint_motions(
                sweep,
                &self.tree.plan.parents,
                |link| at(self.given.theta, link),
                |link| at(self.given.omega, link),
            );
        }
    }

    /// Runs the upward pass from the leaves, or from the known responses of the generation `below`,
    /// to the first generation of the block.
    fn up(
        &self,
        sweep: &mut Sweep<'_, T, T>,
        below: Option<Interface<'_, T>>,
        alpha: Shared<'_, T>,
    ) {
        self.prepare(sweep, below, alpha);
        if let Some(view) = sweep.view() {
            let way = PassSelection {
                up: true,
                down: None,
            };
            (self.sweep)(&view, way);
        }
    }

    /// Runs the downward pass from the first generation of the block to the leaves, or to the
    /// generation `below`.
    fn down(
        &self,
        sweep: &mut Sweep<'_, T, T>,
        below: Option<Interface<'_, T>>,
        alpha: Shared<'_, T>,
    ) {
        let (start, reach) = (sweep.block.start, sweep.block.strips.reach());
        let down = alpha.window(start, reach.whole);
        if let (Some(view), true) = (sweep.view(), down.is_some()) {
            (self.sweep)(&view, PassSelection { up: false, down });
        }
        if let Some(below) = below {
            below.store_pivots(sweep);
        }
    }

    /// Runs both passes through the whole tree or, if it is partitioned, through the part above all
    /// partitions, which ends above the generation `below`.
    fn top(&self, below: Option<Interface<'_, T>>, buffer: &mut [T], alpha: Shared<'_, T>) {
        let Skeleton { plan, layout, .. } = self.tree;
        let mut buffer = buffer;
        let lasting = take(&mut buffer, layout.top.lasting());
        let mut sweep = self.block(plan.top(), &layout.top, [lasting, buffer]);
        let drive = self.drive;
        sweep.torque = drive.map(|drive| drive.torque);
        sweep.root = Some(RootDrive::apparent_gravity(self.tree.root, drive));
        self.prepare(&mut sweep, below, alpha);
        let down = alpha.window(0, sweep.block.strips.reach().whole);
        if let (Some(view), true) = (sweep.view(), down.is_some()) {
            (self.sweep)(&view, PassSelection { up: true, down });
        }
        if let Some(below) = below {
            below.store_pivots(&mut sweep);
        }
    }

    /// Runs both passes through the whole tree, or through the part above the first `partitions`
    /// partitions, which ends above the generation `below`.
    fn solve(
        &self,
        partitions: usize,
        below: Option<Interface<'_, T>>,
        buffer: &mut [T],
        alpha: Shared<'_, T>,
    ) {
        let Skeleton {
            plan,
            layout,
            sizes,
            ..
        } = self.tree;
        let mut buffer = buffer;
        let (Some(partition), Some(block_memory)) = (
            plan.partitions.get(partitions),
            layout.blocks.get(partitions),
        ) else {
            return self.top(below, buffer, alpha);
        };
        let threads = self.tree.threads();
        let interface = Interface::<T>::workspace_len(partition.count, *sizes);
        let level = Level {
            partition,
            block_memory,
            start: Interface::new(take(&mut buffer, interface), partition.count),
            below,
            alpha,
        };
        let workers = layout::workers::<T>(partition, block_memory, threads);
        let workers = take(&mut buffer, workers);
        super::threads::all(level.jobs(threads, &mut *workers), |blocks| {
            self.blocks_up(blocks);
        });
        self.solve(partitions + 1, Some(level.start), buffer, alpha);
        super::threads::all(level.jobs(threads, workers), |blocks| {
            self.blocks_down(blocks);
        });
    }

    /// Runs both passes through a tree of any shape. All arrays are in the order of the strips
    /// (links that are computed together).
    fn in_order_of_strips(&self, mut buffer: &mut [T], alpha: &mut [T]) {
        let Skeleton { plan, .. } = self.tree;
        let (order, links) = (&plan.order, plan.links());
        let LinkStates {
            theta,
            omega,
            torques,
        } = self.given;
        let mut column = || take(&mut buffer, odd_lines(line::<T>(), links + WIDEST));
        let [own_theta, own_omega, own_alpha] = [column(), column(), column()];
        for ((own_theta, own_omega), &link) in own_theta.iter_mut().zip(&mut *own_omega).zip(order)
        {
            let link = link as usize;
            if let (Some(&angle), Some(&rate)) = (theta.get(link), omega.get(link)) {
                (*own_theta, *own_omega) = (angle, rate);
            }
        }
        let [own_torques, own_prescribed] = [torques, self.prescribed].map(|given| {
            given.map(|given| {
                let own = column();
                for (own, &link) in own.iter_mut().zip(order) {
                    if let Some(&value) = given.get(link as usize) {
                        *own = value;
                    }
                }
                &*own
            })
        });
        let own = Evaluation {
            given: LinkStates {
                theta: own_theta.get(..links).unwrap_or_default(),
                omega: own_omega,
                torques: own_torques,
            },
            prescribed: own_prescribed,
            ..*self
        };
        own.top(None, buffer, Shared::new(own_alpha));
        for (&acceleration, &link) in own_alpha.iter().zip(order) {
            if let Some(place) = alpha.get_mut(link as usize) {
                *place = acceleration;
            }
        }
    }

    /// Upward pass through blocks.
    fn blocks_up(&self, mut blocks: SomeBlocks<'_, T>) {
        let Level {
            partition,
            start,
            below,
            alpha,
            ..
        } = blocks.level;
        for block in partition.windows(&blocks.links) {
            let mut sweep = self.next_block(block, &mut blocks);
            self.up(&mut sweep, below, alpha);
            start.store_responses(&mut sweep);
        }
    }

    /// Runs the downward pass through blocks. If the results of the upward pass were not kept, each
    /// block repeats it, which is faster than writing them to memory and reading them back.
    fn blocks_down(&self, mut blocks: SomeBlocks<'_, T>) {
        let Level {
            partition,
            start,
            below,
            alpha,
            ..
        } = blocks.level;
        for mut block in partition.windows(&blocks.links) {
            block.ends = true;
            let mut sweep = self.next_block(block, &mut blocks);
            if !partition.keeps {
                self.up(&mut sweep, below, alpha);
            }
            start.load_pivots(&mut sweep);
            self.down(&mut sweep, below, alpha);
        }
    }

    fn next_block<'a>(
        &'a self,
        block: SubtreeBlock<'a>,
        blocks: &'a mut SomeBlocks<'_, T>,
    ) -> Sweep<'a, T, T> {
        let Level {
            partition,
            block_memory,
            ..
        } = blocks.level;
        let lasting = match partition.keeps {
            true => take(&mut blocks.lasting, block_memory.lasting()),
            false => &mut *blocks.lasting,
        };
        self.block(block, block_memory, [lasting, &mut *blocks.passing])
    }
}

/// A partition of the tree into blocks, with the memory of all threads that compute it.
#[derive(Clone, Copy, Debug)]
struct Level<'a, T> {
    partition: &'a Partition,
    block_memory: &'a BlockMemory,
    /// Values that blocks exchange at the partition's first generation, and at the generation after
    /// its last.
    start: Interface<'a, T>,
    below: Option<Interface<'a, T>>,
    alpha: Shared<'a, T>,
}

impl<'a, T: Copy> Level<'a, T> {
    /// Iterates over the threads: each gets a set of blocks and a part of the workspace.
    fn jobs<'b>(
        self,
        threads: usize,
        mut workers: &'b mut [T],
    ) -> impl Iterator<Item = SomeBlocks<'b, T>>
    where
        'a: 'b,
    {
        self.partition.jobs(threads).map(move |links| {
            let block_memory = layout::worker::<T>(self.partition, self.block_memory, &links);
            let mut own = take(&mut workers, block_memory);
            SomeBlocks {
                level: self,
                links,
                passing: take(&mut own, self.block_memory.passing()),
                lasting: own,
            }
        })
    }
}

/// Blocks of one thread.
struct SomeBlocks<'a, T> {
    level: Level<'a, T>,
    /// First links of the blocks.
    links: Range<usize>,
    lasting: &'a mut [T],
    passing: &'a mut [T],
}

/// Writes the accelerations of one state to `alpha`. `held` is 1 for each prescribed link and 0 for
/// others. NaN if a slice does not have one number per link.
pub(super) fn accelerations<T: Scalar, const BLOCKS: bool>(
    tree: &Skeleton<T>,
    sweep: SweepFn<T>,
    drive: Option<RootDrive<T>>,
    given: LinkStates<'_, T>,
    prescribed: Option<&[T]>,
    alpha: &mut [T],
    workspace: &mut Workspace<T>,
) {
    let links = tree.plan.links();
    let LinkStates {
        theta,
        omega,
        torques,
    } = given;
    let fit = [theta.len(), omega.len(), alpha.len()] == [links; 3];
    let unread =
        |given: Option<&[T]>, read: bool| given.is_some_and(|given| given.len() != links || !read);
    if !fit || unread(torques, tree.sizes.forced) || unread(prescribed, tree.sizes.prescribed) {
        alpha.fill(T::from_f64(f64::NAN));
        return;
    }
    let buffer = workspace.numbers(tree.buffer);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let evaluation = Evaluation {
        tree,
        sweep,
        drive,
        given,
        prescribed,
    };
    if !tree.plan.order.is_empty() {
        return evaluation.in_order_of_strips(buffer, alpha);
    }
    // Blocks need threads, which small trees are compiled without.
    match BLOCKS {
        true => evaluation.solve(0, None, buffer, Shared::new(alpha)),
        false => evaluation.top(None, buffer, Shared::new(alpha)),
    }
}

/// Pointer to [`accelerations`], together with the equations that are compiled with a model.
type Accelerate<T> = fn(
    &Skeleton<T>,
    SweepFn<T>,
    Option<RootDrive<T>>,
    LinkStates<'_, T>,
    Option<&[T]>,
    &mut [T],
    &mut Workspace<T>,
);

compiled_once! {
    /// Pointer to [`accelerations`] for a tree that is computed as one block.
    pub(super) InOnePiece<T> = accelerations::<_, false>: Accelerate<T>
}

compiled_once! {
    /// Pointer to [`accelerations`] for a tree that may be divided into blocks.
    pub(super) InBlocks<T> = accelerations::<_, true>: Accelerate<T>
}
