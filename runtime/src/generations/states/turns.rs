//! Sines and cosines of links, and what else their equations read.

use super::packing::{Packing, Rows};
use crate::generations::Motion;
use crate::generations::links::Shape;
use crate::scalar::Scalar;

/// Registers of sines that are formed in step: while the result of one operation is
/// awaited, the others keep the processor busy.
const STEP: usize = 2;

/// Values that so many links need room for.
pub(super) const fn room(links: usize, joints: bool) -> usize {
    (links + STEP - 1) * if joints { 5 } else { 3 }
}

/// A row for each link: sine, cosine, velocity, and where the equations read them,
/// angle and velocity relative to the parent.
pub(super) struct Turns<'a, P: Packing> {
    rows: Rows<'a, P::Number, 1>,
    joints: bool,
}

impl<'a, P: Packing> Turns<'a, P> {
    #[inline(always)]
    pub(super) fn new(room: &'a mut [P::Number], joints: bool) -> Self {
        Self {
            rows: Rows(room),
            joints,
        }
    }

    /// Forms the rows from `first` on, `STEP` at a time, as many as said or some more,
    /// of the links that `next` gives, each with its parent.
    #[inline(always)]
    pub(super) fn form(
        &mut self,
        first: usize,
        count: usize,
        mut next: impl FnMut() -> (usize, Option<usize>),
        theta: &impl Fn(usize) -> P::Value,
        omega: &impl Fn(usize) -> P::Value,
    ) -> Option<()> {
        let mut row = first;
        while row < first + count {
            let mut links = [(0, None); STEP];
            let mut angles = [P::Value::from_f64(0.0); STEP];
            for i in 0..STEP {
                links[i] = next();
                angles[i] = theta(links[i].0);
            }
            let (sines, cosines) = P::Value::sin_cos_each(&angles);
            for i in 0..STEP {
                let (link, parent) = links[i];
                let (row, velocity) = (row + i, omega(link));
                let [sine, cosine] = [sines[i], cosines[i]];
                if !self.joints {
                    self.rows.store::<P, 3>(3 * row, [sine, cosine, velocity])?;
                    continue;
                }
                let (mut bend, mut rate) = (angles[i], velocity);
                if let Some(parent) = parent {
                    bend = bend - theta(parent);
                    rate = rate - omega(parent);
                }
                self.rows
                    .store::<P, 5>(5 * row, [sine, cosine, velocity, bend, rate])?;
            }
            row += STEP;
        }
        Some(())
    }

    /// Forms those of all links of a table, in their order.
    #[inline(always)]
    pub(super) fn form_all(
        &mut self,
        shape: &Shape,
        theta: &impl Fn(usize) -> P::Value,
        omega: &impl Fn(usize) -> P::Value,
    ) -> Option<()> {
        let count = shape.parents.len();
        let last = count.checked_sub(1)?;
        let mut links = 0..;
        let next = || {
            // Behind the last link there is room for what nobody reads.
            let link = links.next().map_or(last, |link: usize| link.min(last));
            (link, (link > 0).then(|| shape.parent(link)))
        };
        self.form(0, count, next, theta, omega)
    }

    /// The motion in a row.
    #[inline(always)]
    pub(super) fn motion(&self, row: usize) -> Option<Motion<P::Value>> {
        let (sine, cosine, omega, bend, bend_rate);
        if self.joints {
            [sine, cosine, omega, bend, bend_rate] = self.rows.load::<P, 5>(5 * row)?;
        } else {
            [sine, cosine, omega] = self.rows.load::<P, 3>(3 * row)?;
            (bend, bend_rate) = (omega, omega);
        }
        Some(Motion {
            sine,
            cosine,
            omega,
            bend,
            bend_rate,
        })
    }
}
