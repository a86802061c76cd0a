//! The recursion through a table whose links carry children at several places.

use super::packing::{Packing, Rows, splat};
use super::turns::{self, Turns};
use super::{States, sum};
use crate::generations::memory::take;
use crate::generations::places::{HANGING, PlacedRecursion, PlacedTable};
use crate::generations::pool::Pool;
use crate::generations::root::RootDrive;
use crate::scalar::Scalar;

impl<P, T, const C: usize, const R: usize, const S: usize, const K: usize> States<T>
    for PlacedTable<P, T, C, R, S, K>
where
    P: PlacedRecursion<C, R, S, K>,
    T: Scalar,
{
    fn pool(&self) -> &Pool<T> {
        &self.pool
    }

    fn room(&self) -> usize {
        let others = P::LINKS * K + self.shape.levels() * (S + 4);
        turns::room(P::LINKS, P::JOINTS) + others
    }

    #[inline(always)]
    fn solve<N: Packing<Number = T>>(
        &self,
        drive: Option<RootDrive<N::Value>>,
        mut room: &mut [T],
        theta: impl Fn(usize) -> N::Value,
        omega: impl Fn(usize) -> N::Value,
        mut alpha: impl FnMut(usize, N::Value),
    ) -> Option<()> {
        let shape = &self.shape;
        let links = self.constants.iter().zip(&self.hanging).enumerate();
        let room = &mut room;
        let levels = shape.levels();
        // What is passed on, by depth.
        let mut sums = Rows::<_, S>(take(room, levels * S * N::COUNT));
        let mut ends = Rows::<_, 4>(take(room, levels * 4 * N::COUNT));
        let mut kept = Rows::<_, K>(take(room, P::LINKS * K * N::COUNT));
        let mut turns = Turns::<N>::new(core::mem::take(room), P::JOINTS);
        turns.form_all(shape, &theta, &omega)?;

        let zero = [N::Value::from_f64(0.0); S];
        for depth in 0..levels {
            sums.store::<N, S>(depth, zero)?;
        }
        // Of links with children alone: they are read backwards.
        let mut slot = 0;
        for (link, (constants, hanging)) in links.clone().rev() {
            let depth = shape.depth(link);
            let mut constants = splat::<N, C>(constants);
            if let (true, 0, Some(drive)) = (P::TORQUE, link, &drive) {
                constants = RootDrive::row(drive.torque, &constants);
            }
            let [square, ratio, _, rest, along, across] = splat::<N, HANGING>(hanging);
            let motion = turns.motion(link)?;
            let (mut answers, sign);
            if shape.is_leaf(link) {
                answers = P::leaf(&constants, motion);
                sign = N::Value::from_f64(-1.0);
            } else {
                let own;
                (answers, own) = P::inner(&constants, motion, sums.load::<N, S>(depth)?);
                // For the next one of that depth.
                sums.store::<N, S>(depth, zero)?;
                kept.store::<N, K>(slot, own)?;
                slot += 1;
                sign = N::Value::from_f64(1.0);
            }
            let Some(above) = depth.checked_sub(1) else {
                break;
            };
            answers[0] = square.mul_add(answers[0], rest);
            answers[1] = sign * square * answers[1];
            answers[2] = square.mul_add(answers[2], rest);
            answers[3] = sign * ratio * answers[3];
            answers[4] = ratio * answers[4];
            let carrier = turns.motion(shape.parent(link))?;
            let own = P::hang(carrier, [along, across], answers);
            let sums_above = sum(sums.load::<N, S>(above)?, own);
            sums.store::<N, S>(above, sums_above)?;
        }

        for (link, (constants, hanging)) in links {
            let depth = shape.depth(link);
            let constants = splat::<N, C>(constants);
            let motion = turns.motion(link)?;
            let pivot = match depth.checked_sub(1) {
                Some(above) => {
                    let [_, _, reach, _, along, across] = splat::<N, HANGING>(hanging);
                    let [x, y, turn_x, turn_y] = ends.load::<N, 4>(above)?;
                    [
                        reach * along.mul_add(turn_x, (-across).mul_add(turn_y, x)),
                        reach * along.mul_add(turn_y, across.mul_add(turn_x, y)),
                    ]
                }
                None => RootDrive::above(splat::<N, 2>(&self.root), drive),
            };
            let acceleration = if shape.is_leaf(link) {
                P::turn_leaf(&constants, motion, pivot)
            } else {
                slot -= 1;
                let own = kept.load::<N, K>(slot)?;
                let (acceleration, [turn_x, turn_y]) = P::turn(motion, own, pivot);
                let [x, y] = pivot;
                ends.store::<N, 4>(depth, [x, y, turn_x, turn_y])?;
                acceleration
            };
            alpha(link, acceleration);
        }
        Some(())
    }
}
