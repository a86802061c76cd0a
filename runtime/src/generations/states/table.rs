//! The recursion through a table of links, depth first.

use core::marker::PhantomData;

use super::packing::{Packing, Rows, splat};
use super::turns::{STEP, Turns};
use crate::generations::memory::take;
use crate::generations::recursion::Recursion;
use crate::generations::table::{HANGING, Table};
use crate::scalar::Scalar;

/// Values that an evaluation needs room for, in a tree of that depth.
pub(super) fn room<P, const C: usize, const R: usize, const K: usize>(deepest: usize) -> usize
where
    P: Recursion<C, R, R, K>,
{
    let row = if P::JOINTS { 5 } else { 3 };
    (P::LINKS + STEP) * row + P::LINKS * K + (deepest + 1) * (R + 2)
}

/// Gives the accelerations, link by link in any order.
#[inline(always)]
pub(super) fn evaluate<N, P, T, const C: usize, const R: usize, const K: usize>(
    packing: PhantomData<N>,
    model: &Table<P, T, C, R, K>,
    room: &mut [T],
    theta: impl Fn(usize) -> N::Value,
    omega: impl Fn(usize) -> N::Value,
    alpha: impl FnMut(usize, N::Value),
) -> Option<()>
where
    N: Packing<Number = T>,
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    // Where nothing acts in joints, rows are shorter.
    if P::JOINTS {
        rows::<N, P, T, C, R, K, 5>(packing, model, room, theta, omega, alpha)
    } else {
        rows::<N, P, T, C, R, K, 3>(packing, model, room, theta, omega, alpha)
    }
}

#[inline(always)]
fn rows<N, P, T, const C: usize, const R: usize, const K: usize, const M: usize>(
    _packing: PhantomData<N>,
    model: &Table<P, T, C, R, K>,
    mut room: &mut [T],
    theta: impl Fn(usize) -> N::Value,
    omega: impl Fn(usize) -> N::Value,
    mut alpha: impl FnMut(usize, N::Value),
) -> Option<()>
where
    N: Packing<Number = T>,
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    let parents = model.parents;
    let parent_of = |link: usize| parents.get(link).map_or(0, |&parent| parent as usize);
    // Links stand depth first: a link's first child comes next.
    let is_leaf = |link: usize| link + 1 >= parents.len() || parent_of(link + 1) != link;
    let links = model.constants.iter().zip(&model.hanging);
    let links = links.zip(&model.depths).enumerate();
    let room = &mut room;
    let depths = model.deepest() + 1;
    let mut sums = Rows::<_, R>(take(room, depths * R * N::COUNT));
    let mut ends = Rows::<_, 2>(take(room, depths * 2 * N::COUNT));
    let mut kept = Rows::<_, K>(take(room, parents.len() * K * N::COUNT));
    let mut turns = Turns::<N, M>::new(core::mem::take(room));

    // Places on the stack: of all links, and of those with children.
    let (mut place, mut slot) = (0, 0);
    let (mut next, mut formed) = (parents.len(), 0);
    let zero = [N::Value::from_f64(0.0); R];
    for depth in 0..depths {
        sums.store::<N, R>(depth, zero)?;
    }
    for (link, ((constants, hanging), &depth)) in links.clone().rev() {
        if formed <= place {
            let form = || {
                next = next.saturating_sub(1);
                (next, (next > 0).then(|| parent_of(next)))
            };
            turns.form(formed, STEP, form, &theta, &omega)?;
            formed += STEP;
        }
        let constants = splat::<N, C>(constants);
        let [square, ratio, _] = splat::<N, HANGING>(hanging);
        let motion = turns.motion(place)?;
        place += 1;
        let (mut answers, across, along);
        if is_leaf(link) {
            answers = P::leaf(&constants, motion);
            (across, along) = (-square, -ratio);
        } else {
            let own;
            (answers, own) = P::inner(&constants, motion, sums.load::<N, R>(depth as usize)?);
            // For the next one of that depth.
            sums.store::<N, R>(depth as usize, zero)?;
            kept.store::<N, K>(slot, own)?;
            slot += 1;
            (across, along) = (square, ratio);
        }
        let Some(above) = (depth as usize).checked_sub(1) else {
            break;
        };
        let factors = [square, across, square, along, ratio];
        let sum = sums.load::<N, R>(above)?;
        for i in 0..R {
            answers[i] = match factors.get(i) {
                Some(&factor) => factor.mul_add(answers[i], sum[i]),
                // Torques have no unit of length.
                None => answers[i] + sum[i],
            };
        }
        sums.store::<N, R>(above, answers)?;
    }

    for (link, ((constants, hanging), &depth)) in links {
        let constants = splat::<N, C>(constants);
        place -= 1;
        let motion = turns.motion(place)?;
        let pivot = match (depth as usize).checked_sub(1) {
            Some(above) => {
                let reach = N::splat(hanging[2]);
                let [x, y] = ends.load::<N, 2>(above)?;
                [reach * x, reach * y]
            }
            None => splat::<N, 2>(&model.root),
        };
        let acceleration = if is_leaf(link) {
            P::turn_leaf(&constants, motion, pivot)
        } else {
            slot -= 1;
            let own = kept.load::<N, K>(slot)?;
            let (acceleration, end) = P::turn(&constants, motion, own, pivot);
            ends.store::<N, 2>(depth as usize, end)?;
            acceleration
        };
        alpha(link, acceleration);
    }
    Some(())
}
