//! Accelerations of one state: the tree in one piece, or block by block where it
//! is large.

use core::ops::Range;

use super::block::SubtreeBlock;
use super::interface::Interface;
use super::layout;
use super::memory::{LINE, Room, line, odd_lines, take};
use super::motion::{Motions, joint_motions};
use super::partition::Partition;
use super::root::RootDrive;
use super::shared::Shared;
use super::skeleton::Skeleton;
use super::small::LinkStates;
use super::sweep::{Sweep, View, Way};
use crate::scalar::kind::compiled_once;
use crate::scalar::{Scalar, at};
use crate::simd::WIDEST;
use crate::simd::dispatch::in_widest;
use crate::system::Workspace;

/// The equations of one tree, taken through a block: compiled with every model.
pub(super) type SweepFn<T> = fn(&View<'_, T, T>, Way<'_, T>);

/// One evaluation.
struct Evaluation<'a, T: 'static> {
    tree: &'a Skeleton<T>,
    sweep: SweepFn<T>,
    drive: Option<RootDrive<T>>,
    given: LinkStates<'a, T>,
    /// 1 for each held link, 0 for others; none where none is.
    held: Option<&'a [T]>,
}

impl<T: Scalar> Evaluation<'_, T> {
    fn block<'a>(
        &'a self,
        block: SubtreeBlock<'a>,
        room: &Room,
        [lasting, passing]: [&'a mut [T]; 2],
    ) -> Sweep<'a, T, T> {
        Sweep {
            block,
            constants: &self.tree.constants,
            omega: self.given.omega,
            storage: room.storage(self.tree.sizes, lasting, passing, false),
            root: None,
            torque: None,
        }
    }

    /// Forms what is known before the recursion, with what is of the generation
    /// `below`.
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
            held: self.held,
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

    /// From the leaves, or what is known of the generation `below`, to the first
    /// generation.
    fn up(
        &self,
        sweep: &mut Sweep<'_, T, T>,
        below: Option<Interface<'_, T>>,
        alpha: Shared<'_, T>,
    ) {
        self.prepare(sweep, below, alpha);
        if let Some(view) = sweep.view() {
            let way = Way {
                up: true,
                down: None,
            };
            (self.sweep)(&view, way);
        }
    }

    /// From the first generation to the leaves, or the generation `below`.
    fn down(
        &self,
        sweep: &mut Sweep<'_, T, T>,
        below: Option<Interface<'_, T>>,
        alpha: Shared<'_, T>,
    ) {
        let (start, reach) = (sweep.block.start, sweep.block.strips.reach());
        let down = alpha.window(start, reach.whole);
        if let (Some(view), true) = (sweep.view(), down.is_some()) {
            (self.sweep)(&view, Way { up: false, down });
        }
        if let Some(below) = below {
            below.store_pivots(sweep);
        }
    }

    /// Up and down again: the whole tree, or what is above all partitions, of which the
    /// last one starts with the generation `below`.
    fn top(&self, below: Option<Interface<'_, T>>, buffer: &mut [T], alpha: Shared<'_, T>) {
        let Skeleton { plan, layout, .. } = self.tree;
        let mut buffer = buffer;
        let lasting = take(&mut buffer, layout.top.lasting());
        let mut sweep = self.block(plan.top(), &layout.top, [lasting, buffer]);
        let drive = self.drive;
        sweep.torque = drive.map(|drive| drive.torque);
        sweep.root = Some(RootDrive::above(self.tree.root, drive));
        self.prepare(&mut sweep, below, alpha);
        let down = alpha.window(0, sweep.block.strips.reach().whole);
        if let (Some(view), true) = (sweep.view(), down.is_some()) {
            (self.sweep)(&view, Way { up: true, down });
        }
        if let Some(below) = below {
            below.store_pivots(&mut sweep);
        }
    }

    /// Up and down again: the whole tree, or what is above the first `partitions`, of
    /// which the last one starts with the generation `below`.
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
        let (Some(partition), Some(room)) = (
            plan.partitions.get(partitions),
            layout.blocks.get(partitions),
        ) else {
            return self.top(below, buffer, alpha);
        };
        let threads = self.tree.threads();
        let interface = Interface::<T>::room(partition.count, *sizes);
        let level = Level {
            partition,
            room,
            start: Interface::new(take(&mut buffer, interface), partition.count),
            below,
            alpha,
        };
        let workers = layout::workers::<T>(partition, room, threads);
        let workers = take(&mut buffer, workers);
        super::threads::all(level.jobs(threads, &mut *workers), |blocks| {
            self.blocks_up(blocks);
        });
        self.solve(partitions + 1, Some(level.start), buffer, alpha);
        super::threads::all(level.jobs(threads, workers), |blocks| {
            self.blocks_down(blocks);
        });
    }

    /// Up and down again, of links of any shape: their numbers stand in the order of the strips.
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
        let [own_torques, own_held] = [torques, self.held].map(|given| {
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
            held: own_held,
            ..*self
        };
        own.top(None, buffer, Shared::new(own_alpha));
        for (&acceleration, &link) in own_alpha.iter().zip(order) {
            if let Some(place) = alpha.get_mut(link as usize) {
                *place = acceleration;
            }
        }
    }

    /// Up through blocks.
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

    /// Down through them. Where nothing was kept of the way up, it is taken again:
    /// that takes less time than writing what is formed to memory and reading it back.
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
            partition, room, ..
        } = blocks.level;
        let lasting = match partition.keeps {
            true => take(&mut blocks.lasting, room.lasting()),
            false => &mut *blocks.lasting,
        };
        self.block(block, room, [lasting, &mut *blocks.passing])
    }
}

/// A partition, and the state of all threads there.
#[derive(Clone, Copy, Debug)]
struct Level<'a, T> {
    partition: &'a Partition,
    room: &'a Room,
    /// Values handed over at the first generation, and at the one that comes behind.
    start: Interface<'a, T>,
    below: Option<Interface<'a, T>>,
    alpha: Shared<'a, T>,
}

impl<'a, T: Copy> Level<'a, T> {
    /// The blocks of each thread.
    fn jobs<'b>(
        self,
        threads: usize,
        mut workers: &'b mut [T],
    ) -> impl Iterator<Item = SomeBlocks<'b, T>>
    where
        'a: 'b,
    {
        self.partition.jobs(threads).map(move |links| {
            let room = layout::worker::<T>(self.partition, self.room, &links);
            let mut own = take(&mut workers, room);
            SomeBlocks {
                level: self,
                links,
                passing: take(&mut own, self.room.passing()),
                lasting: own,
            }
        })
    }
}

/// The blocks of a thread.
struct SomeBlocks<'a, T> {
    level: Level<'a, T>,
    /// The blocks that start with these links.
    links: Range<usize>,
    lasting: &'a mut [T],
    passing: &'a mut [T],
}

/// Writes the accelerations of one state to `alpha`, with 1 for each link that is `held`:
/// NaN for slices of another length than there are links.
pub(super) fn accelerations<T: Scalar, const BLOCKS: bool>(
    tree: &Skeleton<T>,
    sweep: SweepFn<T>,
    drive: Option<RootDrive<T>>,
    given: LinkStates<'_, T>,
    held: Option<&[T]>,
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
    if !fit || unread(torques, tree.sizes.forced) || unread(held, tree.sizes.held) {
        alpha.fill(T::from_f64(f64::NAN));
        return;
    }
    let buffer = workspace.numbers(tree.room);
    let unaligned = buffer.as_ptr().align_offset(LINE).min(line::<T>());
    let buffer = buffer.get_mut(unaligned..).unwrap_or_default();
    let evaluation = Evaluation {
        tree,
        sweep,
        drive,
        given,
        held,
    };
    if !tree.plan.order.is_empty() {
        return evaluation.in_order_of_strips(buffer, alpha);
    }
    // Blocks come with threads, which small trees do without.
    match BLOCKS {
        true => evaluation.solve(0, None, buffer, Shared::new(alpha)),
        false => evaluation.top(None, buffer, Shared::new(alpha)),
    }
}

/// [`accelerations`] by equations that are compiled with a model.
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
    /// [`accelerations`] of a tree in one piece.
    pub(super) InOnePiece<T> = accelerations::<_, false>: Accelerate<T>
}

compiled_once! {
    /// [`accelerations`] of a tree that may be in blocks.
    pub(super) InBlocks<T> = accelerations::<_, true>: Accelerate<T>
}
