//! Many states of one tree, one in each lane.
//!
//! Each number of a link is a register with one state per lane, and links are computed one by one.
//! The upward pass is made subtree by subtree; each is so small that its numbers stay in the
//! first-level cache. Then both passes are made through the links above the subtrees, and then the
//! downward pass through the subtrees, the last one first. In trees that are not described by
//! generations, links above subtrees are computed between the subtrees.
//!
//! # Bits
//! Equations and the order of all sums are the same as for one state, so that the results have the
//! same bits.

use core::marker::PhantomData;

use super::block::SubtreeBlock;
use super::copies::links;
use super::equations::LinkEquations;
use super::generation::Generation;
use super::memory::{BlockMemory, Sizes, take};
use super::output::Output;
use super::partition::Policy;
use super::root::RootDrive;
use super::skeleton::Skeleton;
use super::sweep::{Passes, Sweep};
use crate::scalar::Scalar;
use crate::simd::Simd;

/// Destination of accelerations: a function of the link and its acceleration. It is given the
/// block's first link and, for trees of any shape, the order of the links.
struct AccelerationSink<'a, E, F> {
    alpha: &'a mut F,
    start: usize,
    order: &'a [u32],
    equations: PhantomData<E>,
}

#[allow(unsafe_code)]
impl<E: LinkEquations, V: Scalar, F: FnMut(usize, V)> Output<V> for AccelerationSink<'_, E, F> {
    #[inline(always)]
    unsafe fn write<W: Simd<V>>(&mut self, at: usize, alpha: W, _count: usize) {
        (self.alpha)(link::<E>(self.order, self.start + at), alpha.first());
    }
}

/// Returns the index of the link at position `place` of the order.
#[inline(always)]
fn link<E: LinkEquations>(order: &[u32], place: usize) -> usize {
    match E::COPIES.is_empty() {
        true => order.get(place).map_or(0, |&link| link as usize),
        false => place,
    }
}

/// Returns the length of an evaluation's workspace, in values of type `V`.
pub(super) fn workspace_len<T: Scalar>(tree: &Skeleton<T>) -> usize {
    let top = BlockMemory::new(&tree.states.top(), tree.sizes, 1);
    let mut buffer = top.lasting() + top.passing();
    if let Some(partition) = tree.states.partitions.first() {
        let block = BlockMemory::new(&partition.largest(), tree.sizes, 1);
        buffer += block.passing() + partition.count * block.lasting();
    }
    buffer
}

/// Actions on the states in addition to the external input of each link: the drive, and torques
/// between links.
pub(super) struct ActingOnStates<'a, V> {
    pub(super) drive: Option<RootDrive<V>>,
    /// Torques between links, unless they are included in the external torques; otherwise empty.
    pub(super) torques: &'a [V],
}

/// Computes the accelerations of several states, one in each lane of `V`, and passes those of all
/// links, in any order, to a sink; passes nothing if the workspace is too small. `outside` returns,
/// for each link, its external torque or prescribed acceleration, and 1 if it is prescribed,
/// else 0.
#[inline(always)]
pub(super) fn accelerations<E: LinkEquations, T: Scalar, V: Simd<T>>(
    tree: &Skeleton<T>,
    ActingOnStates { drive, torques }: ActingOnStates<'_, V>,
    mut buffer: &mut [V],
    theta: impl Fn(usize) -> V,
    omega: impl Fn(usize) -> V,
    outside: impl Fn(usize) -> [V; 2],
    mut alpha: impl FnMut(usize, V),
) {
    let plan = &tree.states;
    let sizes = const { Sizes::of::<E, V>() };
    let by_link = const { E::COPIES.is_empty() };
    let top_memory = BlockMemory::new(&plan.top(), sizes, 1);
    let top_lasting = take(&mut buffer, top_memory.lasting());
    let top_passing = take(&mut buffer, top_memory.passing());
    let above = plan.top().generations.last();
    let slot = above.map_or(0, |generation| generation.slot);

    // Parts that the equations exclude are not compiled: order and parents for trees by
    // generations, blocks for small trees.
    let (order, parents) = match by_link {
        true => (&*plan.order, &*plan.parents),
        false => (&[][..], &[][..]),
    };
    let partition = match links(E::COPIES) > Policy::STATES.whole {
        true => plan.partitions.first(),
        false => None,
    };
    let partition = partition.map(|all| (all, BlockMemory::new(&all.largest(), sizes, 1)));
    let blocks = partition.as_ref().map_or(0, |(all, _)| all.count);
    let passing = partition.as_ref().map_or(0, |(_, buffer)| buffer.passing());
    let passing = take(&mut buffer, passing);
    let motions = StateMotions {
        theta,
        omega,
        outside,
        torques,
        order,
        parents,
    };
    // Blocks upwards, the top in both directions, blocks downwards: one loop body, because it is
    // compiled with every set of equations for every register.
    for step in 0..=2 * blocks {
        let [rises, falls] = [step <= blocks, step >= blocks];
        let index = step.min(2 * blocks - step);
        let memory = [&mut *top_lasting, &mut *top_passing];
        let mut top = sweep(sizes, tree, plan.top(), &top_memory, memory);
        let (mut own, mut top) = match &partition {
            Some((partition, own)) if index < blocks => {
                let start = index * own.lasting();
                let Some(lasting) = buffer.get_mut(start..start + own.lasting()) else {
                    return;
                };
                let block = partition.window(index);
                let block = sweep(sizes, tree, block, own, [lasting, &mut *passing]);
                (block, Some(top))
            }
            _ => {
                top.torque = drive.map(|drive| drive.torque);
                let root = tree.root.map(V::splat);
                top.root = Some(RootDrive::apparent_gravity(root, drive));
                (top, None)
            }
        };
        if rises {
            motions.prepare::<E, T>(&mut own);
        }
        if let (Some(top), true) = (&mut top, falls) {
            copy_response(top, slot + index, &mut own, 0, 2);
        }
        let start = own.block.start;
        if let Some(view) = own.view() {
            let passes = Passes::<E, T, V, V>::of(&view);
            if rises && !by_link {
                passes.up();
            }
            if falls {
                let alpha = &mut alpha;
                passes.down(&mut AccelerationSink {
                    alpha,
                    start,
                    order,
                    equations: PhantomData::<E>,
                });
            }
        }
        if let (Some(top), true) = (&mut top, rises) {
            let count = sizes.responses;
            copy_response(&mut own, 0, top, slot + index, count);
        }
    }
}

#[inline(always)]
fn sweep<'a, T: Scalar, V: Simd<T>>(
    sizes: Sizes,
    tree: &'a Skeleton<T>,
    block: SubtreeBlock<'a>,
    buffer: &BlockMemory,
    [lasting, passing]: [&'a mut [V]; 2],
) -> Sweep<'a, T, V> {
    Sweep {
        block,
        // Rows of generations serve one state and many.
        constants: match tree.of_states.is_empty() {
            true => &tree.constants,
            false => &tree.of_states,
        },
        omega: &[],
        storage: buffer.storage(sizes, lasting, passing, V::LANES > 1),
        root: None,
        torque: None,
    }
}

/// Copies the response of a link of one block, or the acceleration of its pivot, to a link of
/// another block.
#[inline(always)]
fn copy_response<T: Scalar, V: Simd<T>>(
    from: &mut Sweep<'_, T, V>,
    own: usize,
    to: &mut Sweep<'_, T, V>,
    other: usize,
    count: usize,
) {
    if V::LANES > 1 {
        let from = from.storage.row_of_responses(own, count);
        let to = to.storage.row_of_responses(other, count);
        for (from, to) in from.iter().zip(to) {
            *to = *from;
        }
        return;
    }
    for column in 0..count {
        let from = from.storage.responses_mut(column, own, 1);
        let to = to.storage.responses_mut(column, other, 1);
        if let ([from], [to]) = (from, to) {
            *to = *from;
        }
    }
}

/// Number of registers whose sines are computed in lockstep: while one waits for a result, the
/// others keep the processor busy.
const STEP: usize = 2;

/// Angles, velocities and external inputs of all links in several states.
struct StateMotions<'a, V, A, R, O> {
    theta: A,
    omega: R,
    outside: O,
    torques: &'a [V],
    /// Order of the links, for a tree of any shape.
    order: &'a [u32],
    parents: &'a [u32],
}

// No closures around functions that must be inlined, because closures prevent it at times.
impl<V, A, R, O> StateMotions<'_, V, A, R, O>
where
    A: Fn(usize) -> V,
    R: Fn(usize) -> V,
    O: Fn(usize) -> [V; 2],
{
    /// Computes sines, cosines and joint motions of a block. For trees of any shape it also makes
    /// the upward pass, subtree by subtree.
    #[inline(always)]
    fn prepare<E: LinkEquations, T: Scalar>(&self, sweep: &mut Sweep<'_, T, V>)
    where
        V: Simd<T>,
    {
        if !const { E::COPIES.is_empty() } {
            let generations = sweep.block.own_generations();
            self.form::<E, T>(sweep, generations);
            return;
        }
        for some in sweep.block.strips.subtrees().iter().rev() {
            let links = [Generation::of_links(some.links.clone())];
            self.form::<E, T>(sweep, &links);
            if let Some(view) = sweep.view() {
                let passes = Passes::<E, T, V, V>::of(&view);
                passes.within(some.strips.clone()).up();
            }
        }
    }

    /// Computes sines, cosines and joint motions of a block's links.
    #[inline(always)]
    fn form<E: LinkEquations, T: Scalar>(&self, sweep: &Sweep<'_, T, V>, generations: &[Generation])
    where
        V: Simd<T>,
    {
        let (block, storage) = (sweep.block, &sweep.storage);
        for generation in generations {
            let first = generation.whole + block.start;
            let (above, count) = generation.above.unwrap_or_default();
            let mut index = 0;
            while index < generation.length {
                // A last register without a partner is computed twice.
                let both = [index, (index + 1).min(generation.length - 1)];
                let [one, other] = both;
                let places = [
                    first + one * generation.step,
                    first + other * generation.step,
                ];
                let links = [
                    link::<E>(self.order, places[0]),
                    link::<E>(self.order, places[1]),
                ];
                let angles = [(self.theta)(links[0]), (self.theta)(links[1])];
                let (sines, cosines) = V::sin_cos_each(&angles);
                for i in 0..STEP {
                    let own = storage.lead + generation.own + both[i];
                    let rate = (self.omega)(links[i]);
                    let _ = storage.sincos.store::<V, 2>(own, &[sines[i], cosines[i]]);
                    if let Some(velocities) = storage.velocities {
                        let _ = velocities.store::<V, 1>(own, &[rate]);
                    }
                    if storage.sizes.forced {
                        let [mut torque, prescribed] = (self.outside)(links[i]);
                        if E::COUPLED
                            && let Some(&own) = self.torques.get(links[i])
                        {
                            torque = own;
                        }
                        let _ = storage.torques.store::<V, 1>(own, &[torque]);
                        if storage.sizes.prescribed {
                            let _ = storage.prescribed.store::<V, 1>(own, &[prescribed]);
                        }
                    }
                    if !storage.sizes.joints {
                        continue;
                    }
                    let (mut angle, mut rate) = (angles[i], rate);
                    if places[i] > 0 {
                        let parent = match self.parents.get(places[i]) {
                            Some(&parent) => link::<E>(self.order, parent as usize),
                            None => {
                                above + (block.start + both[i] * generation.step) % count.max(1)
                            }
                        };
                        angle = angle - (self.theta)(parent);
                        rate = rate - (self.omega)(parent);
                    }
                    let _ = storage.joint_motions.store::<V, 2>(own, &[angle, rate]);
                }
                index += STEP;
            }
        }
    }
}
