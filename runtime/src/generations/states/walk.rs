//! The recursion through a tree in generations, depth first.

use core::marker::PhantomData;

use super::order::{All, Order};
use super::packing::{Packing, Rows, splat};
use super::sum;
use super::turns::Turns;
use crate::generations::Generations;
use crate::generations::memory::take;
use crate::generations::plan::Plan;
use crate::generations::recursion::Recursion;
use crate::scalar::Scalar;

/// Links with children.
fn inner(plan: &Plan) -> usize {
    plan.start(plan.generations().saturating_sub(1))
}

/// Values that an evaluation needs room for.
pub(super) fn room<P, const C: usize, const L: usize, const R: usize, const K: usize>(
    plan: &Plan,
) -> usize
where
    P: Recursion<C, L, R, K>,
{
    let row = if P::JOINTS { 5 } else { 3 };
    (plan.links() + super::turns::STEP) * row + inner(plan) * K + plan.generations() * (R + 2)
}

/// Gives the accelerations, link by link in any order.
#[inline(always)]
pub(super) fn evaluate<N, P, T, const C: usize, const L: usize, const R: usize, const K: usize>(
    packing: PhantomData<N>,
    model: &Generations<P, T, C, L, R, K>,
    room: &mut [T],
    theta: impl Fn(usize) -> N::Value,
    omega: impl Fn(usize) -> N::Value,
    alpha: impl FnMut(usize, N::Value),
) where
    N: Packing<Number = T>,
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    // Where nothing acts in joints, rows are shorter.
    if P::JOINTS {
        rows::<N, P, T, C, L, R, K, 5>(packing, model, room, theta, omega, alpha);
    } else {
        rows::<N, P, T, C, L, R, K, 3>(packing, model, room, theta, omega, alpha);
    }
}

#[inline(always)]
fn rows<
    N,
    P,
    T,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
    const M: usize,
>(
    _packing: PhantomData<N>,
    model: &Generations<P, T, C, L, R, K>,
    mut room: &mut [T],
    theta: impl Fn(usize) -> N::Value,
    omega: impl Fn(usize) -> N::Value,
    mut alpha: impl FnMut(usize, N::Value),
) where
    N: Packing<Number = T>,
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    let plan = model.tree.plan();
    let rows = model.tree.constants.as_chunks::<C>().0;
    let (Some(order), Some(leaf_row)) = (Order::new(plan.stages()), rows.last()) else {
        return;
    };
    let room = &mut room;
    let generations = plan.stages().len();
    let inners = order.inners();
    let mut sums = Rows(take(room, generations * R * N::COUNT));
    let mut ends = Rows(take(room, generations * 2 * N::COUNT));
    let mut kept = Rows(take(room, inners * K * N::COUNT));
    let mut turns = Turns::<N, M>::new(core::mem::take(room));
    let mut all = All::new(order);

    // Places on the stack: of all links, and of those with children.
    let (mut place, mut slot) = (0, 0);
    let mut at = order.first();
    'up: loop {
        let Some(row) = rows.get(at.generation) else {
            return;
        };
        turns.form(place + order.leaves + 1, || all.next(), &theta, &omega);
        let leaf_constants = splat::<N, C>(leaf_row);
        let mut below = P::leaf(&leaf_constants, turns.motion(place));
        for copy in 1..order.leaves {
            below = sum(below, P::leaf(&leaf_constants, turns.motion(place + copy)));
        }
        place += order.leaves;
        let (mut answers, own) = P::stem(&splat::<N, C>(row), turns.motion(place), below);
        kept.store::<N, K>(slot, own);
        (place, slot) = (place + 1, slot + 1);
        loop {
            let Some(above) = order.above(at) else {
                break 'up;
            };
            let parent = above.parent.generation;
            if above.copy > 0 {
                answers = sum(sums.load::<N, R>(parent), answers);
            }
            if !above.last {
                sums.store::<N, R>(parent, answers);
                at = order.beside(at);
                break;
            }
            at = above.parent;
            let Some(row) = rows.get(parent) else {
                return;
            };
            turns.form(place + 1, || all.next(), &theta, &omega);
            let own;
            (answers, own) = P::inner(&splat::<N, C>(row), turns.motion(place), answers);
            kept.store::<N, K>(slot, own);
            (place, slot) = (place + 1, slot + 1);
        }
    }

    loop {
        let Some(row) = rows.get(at.generation) else {
            return;
        };
        (place, slot) = (place - 1, slot - 1);
        let pivot = match at.generation.checked_sub(1) {
            Some(parent) => ends.load::<N, 2>(parent),
            None => splat::<N, 2>(&model.tree.root),
        };
        let (motion, own) = (turns.motion(place), kept.load::<N, K>(slot));
        let (acceleration, below) = P::turn(&splat::<N, C>(row), motion, own, pivot);
        alpha(order.link(at), acceleration);
        if at.generation == order.stems {
            let constants = splat::<N, C>(leaf_row);
            for copy in (0..order.leaves).rev() {
                place -= 1;
                let acceleration = P::turn_leaf(&constants, turns.motion(place), below);
                alpha(order.leaf(at, copy), acceleration);
            }
        } else {
            ends.store::<N, 2>(at.generation, below);
        }
        let Some(before) = order.before(at) else {
            return;
        };
        at = before;
    }
}
