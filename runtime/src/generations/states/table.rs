//! The recursion through a table of links, depth first.

use super::States;
use super::packing::{Packing, splat};
use super::stack::{self, Stack};
use crate::generations::pool::Pool;
use crate::generations::recursion::Recursion;
use crate::generations::root::RootDrive;
use crate::generations::table::{HANGING, Table};
use crate::scalar::Scalar;

impl<P, T, const C: usize, const R: usize, const K: usize> States<T> for Table<P, T, C, R, K>
where
    P: Recursion<C, R, R, K>,
    T: Scalar,
{
    fn pool(&self) -> &Pool<T> {
        &self.pool
    }

    fn room(&self) -> usize {
        stack::room::<R, 2, K>(&self.shape, P::JOINTS)
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
        let mut stack = Stack::<N, R, 2, K>::new(shape, P::JOINTS, room, &theta, &omega)?;
        let links = self.constants.iter().zip(&self.hanging).enumerate();
        for (link, (constants, hanging)) in links.clone().rev() {
            let depth = shape.depth(link);
            let mut constants = splat::<N, C>(constants);
            if let (true, 0, Some(drive)) = (P::TORQUE, link, &drive) {
                constants = RootDrive::row(drive.torque, &constants);
            }
            let [square, ratio, _] = splat::<N, HANGING>(hanging);
            let motion = stack.turns.motion(link)?;
            let (answers, across, along);
            if shape.is_leaf(link) {
                answers = P::leaf(&constants, motion);
                (across, along) = (-square, -ratio);
            } else {
                let own;
                (answers, own) = P::inner(&constants, motion, stack.below(depth)?);
                stack.push(own)?;
                (across, along) = (square, ratio);
            }
            let Some(above) = depth.checked_sub(1) else {
                break;
            };
            let factors = [square, across, square, along, ratio];
            stack.join(above, |i, sum| match factors.get(i) {
                Some(&factor) => factor.mul_add(answers[i], sum),
                // Torques have no unit of length.
                None => answers[i] + sum,
            })?;
        }

        for (link, (constants, hanging)) in links {
            let depth = shape.depth(link);
            let constants = splat::<N, C>(constants);
            let motion = stack.turns.motion(link)?;
            let pivot = match depth.checked_sub(1) {
                Some(above) => {
                    let reach = N::splat(hanging[2]);
                    let [x, y] = stack.handed(above)?;
                    [reach * x, reach * y]
                }
                None => RootDrive::above(splat::<N, 2>(&self.root), drive),
            };
            let acceleration = if shape.is_leaf(link) {
                P::turn_leaf(&constants, motion, pivot)
            } else {
                let own = stack.pop()?;
                let (acceleration, end) = P::turn(&constants, motion, own, pivot);
                stack.hand(depth, end)?;
                acceleration
            };
            alpha(link, acceleration);
        }
        Some(())
    }
}
