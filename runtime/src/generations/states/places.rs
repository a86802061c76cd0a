//! The recursion through a table whose links carry children at several places.

use super::States;
use super::packing::{Packing, splat};
use super::stack::{self, Stack};
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
        stack::room::<S, 4, K>(&self.shape, P::JOINTS)
    }

    #[inline(always)]
    fn solve<N: Packing<Number = T>>(
        &self,
        drive: Option<RootDrive<N::Value>>,
        room: &mut [T],
        theta: impl Fn(usize) -> N::Value,
        omega: impl Fn(usize) -> N::Value,
        mut alpha: impl FnMut(usize, N::Value),
    ) -> Option<()> {
        let shape = &self.shape;
        let mut stack = Stack::<N, S, 4, K>::new(shape, P::JOINTS, room, &theta, &omega)?;
        let links = self.constants.iter().zip(&self.hanging).enumerate();
        for (link, (constants, hanging)) in links.clone().rev() {
            let depth = shape.depth(link);
            let mut constants = splat::<N, C>(constants);
            if let (true, 0, Some(drive)) = (P::TORQUE, link, &drive) {
                constants = RootDrive::row(drive.torque, &constants);
            }
            let [square, ratio, _, rest, along, across] = splat::<N, HANGING>(hanging);
            let motion = stack.turns.motion(link)?;
            let (mut answers, sign);
            if shape.is_leaf(link) {
                answers = P::leaf(&constants, motion);
                sign = N::Value::from_f64(-1.0);
            } else {
                let own;
                (answers, own) = P::inner(&constants, motion, stack.below(depth)?);
                stack.push(own)?;
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
            let carrier = stack.turns.motion(shape.parent(link))?;
            let own = P::hang(carrier, [along, across], answers);
            stack.join(above, |i, sum| sum + own[i])?;
        }

        for (link, (constants, hanging)) in links {
            let depth = shape.depth(link);
            let constants = splat::<N, C>(constants);
            let motion = stack.turns.motion(link)?;
            let pivot = match depth.checked_sub(1) {
                Some(above) => {
                    let [_, _, reach, _, along, across] = splat::<N, HANGING>(hanging);
                    let [x, y, turn_x, turn_y] = stack.handed(above)?;
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
                let own = stack.pop()?;
                let (acceleration, [turn_x, turn_y]) = P::turn(motion, own, pivot);
                let [x, y] = pivot;
                stack.hand(depth, [x, y, turn_x, turn_y])?;
                acceleration
            };
            alpha(link, acceleration);
        }
        Some(())
    }
}
