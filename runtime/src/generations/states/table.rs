//! The recursion through a table of links, depth first.

use super::States;
use super::packing::{Packing, Rows, splat};
use super::turns::{self, Turns};
use crate::generations::memory::take;
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
        let others = P::LINKS * K + self.shape.levels() * (R + 2);
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
        let mut sums = Rows::<_, R>(take(room, levels * R * N::COUNT));
        let mut ends = Rows::<_, 2>(take(room, levels * 2 * N::COUNT));
        let mut kept = Rows::<_, K>(take(room, P::LINKS * K * N::COUNT));
        let mut turns = Turns::<N>::new(core::mem::take(room), P::JOINTS);
        turns.form_all(shape, &theta, &omega)?;

        let zero = [N::Value::from_f64(0.0); R];
        for depth in 0..levels {
            sums.store::<N, R>(depth, zero)?;
        }
        // Of links with children alone: they are read backwards.
        let mut slot = 0;
        for (link, (constants, hanging)) in links.clone().rev() {
            let depth = shape.depth(link);
            let mut constants = splat::<N, C>(constants);
            if let (true, 0, Some(drive)) = (P::TORQUE, link, &drive) {
                constants = RootDrive::row(drive.torque, &constants);
            }
            let [square, ratio, _] = splat::<N, HANGING>(hanging);
            let motion = turns.motion(link)?;
            let (mut answers, across, along);
            if shape.is_leaf(link) {
                answers = P::leaf(&constants, motion);
                (across, along) = (-square, -ratio);
            } else {
                let own;
                (answers, own) = P::inner(&constants, motion, sums.load::<N, R>(depth)?);
                // For the next one of that depth.
                sums.store::<N, R>(depth, zero)?;
                kept.store::<N, K>(slot, own)?;
                slot += 1;
                (across, along) = (square, ratio);
            }
            let Some(above) = depth.checked_sub(1) else {
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

        for (link, (constants, hanging)) in links {
            let depth = shape.depth(link);
            let constants = splat::<N, C>(constants);
            let motion = turns.motion(link)?;
            let pivot = match depth.checked_sub(1) {
                Some(above) => {
                    let reach = N::splat(hanging[2]);
                    let [x, y] = ends.load::<N, 2>(above)?;
                    [reach * x, reach * y]
                }
                None => RootDrive::above(splat::<N, 2>(&self.root), drive),
            };
            let acceleration = if shape.is_leaf(link) {
                P::turn_leaf(&constants, motion, pivot)
            } else {
                slot -= 1;
                let own = kept.load::<N, K>(slot)?;
                let (acceleration, end) = P::turn(&constants, motion, own, pivot);
                ends.store::<N, 2>(depth, end)?;
                acceleration
            };
            alpha(link, acceleration);
        }
        Some(())
    }
}
