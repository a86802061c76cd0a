//! Many states of one tree, each in a lane.
//!
//! The numbers of the sweep are registers then, each link by itself. One subtree goes
//! up after the other, each so small that what is handed on in it stays in the first
//! cache, then what is above them up and down, then the subtrees down, the last one
//! first. In trees of any shape, links above subtrees go up between them.
//!
//! # Which bits
//! The equations are those of one state, and so is the order of each sum: a state
//! has the bits that it has alone.

use core::marker::PhantomData;

use super::block::SubtreeBlock;
use super::copies::links;
use super::equations::LinkEquations;
use super::generation::Generation;
use super::memory::{Room, Sizes, take};
use super::output::Output;
use super::partition::Policy;
use super::root::RootDrive;
use super::skeleton::Skeleton;
use super::sweep::{Passes, Sweep};
use crate::scalar::Scalar;
use crate::simd::Simd;

/// Where accelerations go: to a function of the link and its acceleration. Blocks
/// start with some link; links of any shape have an order.
struct Told<'a, E, F> {
    alpha: &'a mut F,
    start: usize,
    order: &'a [u32],
    equations: PhantomData<E>,
}

#[allow(unsafe_code)]
impl<E: LinkEquations, V: Scalar, F: FnMut(usize, V)> Output<V> for Told<'_, E, F> {
    #[inline(always)]
    unsafe fn write<W: Simd<V>>(&mut self, at: usize, alpha: W, _count: usize) {
        (self.alpha)(link::<E>(self.order, self.start + at), alpha.first());
    }
}

/// The number of the link in a place.
#[inline(always)]
fn link<E: LinkEquations>(order: &[u32], place: usize) -> usize {
    match E::COPIES.is_empty() {
        true => order.get(place).map_or(0, |&link| link as usize),
        false => place,
    }
}

/// Returns how many values an evaluation needs room for.
pub(super) fn room<T: Scalar>(tree: &Skeleton<T>) -> usize {
    let top = Room::new(&tree.states.top(), tree.sizes, 1);
    let mut room = top.lasting() + top.passing();
    if let Some(partition) = tree.states.partitions.first() {
        let block = Room::new(&partition.largest(), tree.sizes, 1);
        room += block.passing() + partition.count * block.lasting();
    }
    room
}

/// What acts on states beside what comes from outside link by link.
pub(super) struct ActingOnStates<'a, V> {
    pub(super) drive: Option<RootDrive<V>>,
    /// The torques on all links, if some act between them and are not among those from outside.
    pub(super) torques: &'a [V],
}

/// Hands over the accelerations of all links, in any order, of states in the lanes of `V`;
/// of none where the room is too small. What comes from `outside` to a link is its torque
/// or given acceleration, and 1 where it is held.
#[inline(always)]
pub(super) fn accelerations<E: LinkEquations, T: Scalar, V: Simd<T>>(
    tree: &Skeleton<T>,
    ActingOnStates { drive, torques }: ActingOnStates<'_, V>,
    mut room: &mut [V],
    theta: impl Fn(usize) -> V,
    omega: impl Fn(usize) -> V,
    outside: impl Fn(usize) -> [V; 2],
    mut alpha: impl FnMut(usize, V),
) {
    let plan = &tree.states;
    let sizes = const { Sizes::of::<E, V>() };
    let by_link = const { E::COPIES.is_empty() };
    let top_room = Room::new(&plan.top(), sizes, 1);
    let top_lasting = take(&mut room, top_room.lasting());
    let top_passing = take(&mut room, top_room.passing());
    let above = plan.top().generations.last();
    let slot = above.map_or(0, |generation| generation.slot);

    // Where the equations say it, what a tree is without is not compiled: order and
    // parents if it has generations, blocks if these are small.
    let (order, parents) = match by_link {
        true => (&*plan.order, &*plan.parents),
        false => (&[][..], &[][..]),
    };
    let partition = match links(E::COPIES) > Policy::STATES.whole {
        true => plan.partitions.first(),
        false => None,
    };
    let partition = partition.map(|all| (all, Room::new(&all.largest(), sizes, 1)));
    let blocks = partition.as_ref().map_or(0, |(all, _)| all.count);
    let passing = partition.as_ref().map_or(0, |(_, room)| room.passing());
    let passing = take(&mut room, passing);
    let motions = StateMotions {
        theta,
        omega,
        outside,
        torques,
        order,
        parents,
    };
    // Blocks up, the top up and down, blocks down: one body for all, which is compiled
    // with every set of equations for every register.
    for step in 0..=2 * blocks {
        let [rises, falls] = [step <= blocks, step >= blocks];
        let index = step.min(2 * blocks - step);
        let memory = [&mut *top_lasting, &mut *top_passing];
        let mut top = sweep(sizes, tree, plan.top(), &top_room, memory);
        let (mut own, mut top) = match &partition {
            Some((partition, own)) if index < blocks => {
                let start = index * own.lasting();
                let Some(lasting) = room.get_mut(start..start + own.lasting()) else {
                    return;
                };
                let block = partition.window(index);
                let block = sweep(sizes, tree, block, own, [lasting, &mut *passing]);
                (block, Some(top))
            }
            _ => {
                top.torque = drive.map(|drive| drive.torque);
                let root = tree.root.map(V::splat);
                top.root = Some(RootDrive::above(root, drive));
                (top, None)
            }
        };
        if rises {
            motions.prepare::<E, T>(&mut own);
        }
        if let (Some(top), true) = (&mut top, falls) {
            hand_over(top, slot + index, &mut own, 0, 2);
        }
        let start = own.block.start;
        if let Some(view) = own.view() {
            let passes = Passes::<E, T, V, V>::of(&view);
            if rises && !by_link {
                passes.up();
            }
            if falls {
                let alpha = &mut alpha;
                passes.down(&mut Told {
                    alpha,
                    start,
                    order,
                    equations: PhantomData::<E>,
                });
            }
        }
        if let (Some(top), true) = (&mut top, rises) {
            let count = sizes.responses;
            hand_over(&mut own, 0, top, slot + index, count);
        }
    }
}

#[inline(always)]
fn sweep<'a, T: Scalar, V: Simd<T>>(
    sizes: Sizes,
    tree: &'a Skeleton<T>,
    block: SubtreeBlock<'a>,
    room: &Room,
    [lasting, passing]: [&'a mut [V]; 2],
) -> Sweep<'a, T, V> {
    Sweep {
        block,
        // Where constants are a row a generation, for one state as for many.
        constants: match tree.of_states.is_empty() {
            true => &tree.constants,
            false => &tree.of_states,
        },
        omega: &[],
        storage: room.storage(sizes, lasting, passing, V::LANES > 1),
        root: None,
        torque: None,
    }
}

/// Copies the first responses of a link of one block, or the acceleration of its pivot,
/// to a link of another.
#[inline(always)]
fn hand_over<T: Scalar, V: Simd<T>>(
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

/// Registers of sines that are formed in step: while the result of one operation is
/// awaited, the others keep the processor busy.
const STEP: usize = 2;

/// The motions of all links in many states, and what acts on them.
struct StateMotions<'a, V, A, R, O> {
    theta: A,
    omega: R,
    outside: O,
    torques: &'a [V],
    /// Of links of any shape.
    order: &'a [u32],
    parents: &'a [u32],
}

// No closures around what must be inlined: they are not, always.
impl<V, A, R, O> StateMotions<'_, V, A, R, O>
where
    A: Fn(usize) -> V,
    R: Fn(usize) -> V,
    O: Fn(usize) -> [V; 2],
{
    /// Forms the motions of a block, and goes up through links of any shape with them, subtree
    /// by subtree.
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

    /// Forms the motions of a block's links.
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
                // The last one may come alone, and is formed twice then.
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
                        let [mut torque, held] = (self.outside)(links[i]);
                        if E::COUPLED
                            && let Some(&own) = self.torques.get(links[i])
                        {
                            torque = own;
                        }
                        let _ = storage.torques.store::<V, 1>(own, &[torque]);
                        if storage.sizes.held {
                            let _ = storage.held.store::<V, 1>(own, &[held]);
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
