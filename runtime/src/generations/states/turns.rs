//! Sines and cosines of links, and what else their equations read.

use core::marker::PhantomData;

use super::packing::{Packing, Rows};
use crate::generations::Motion;
use crate::scalar::Scalar;

/// Registers of sines that are formed in step: while the result of one operation is
/// awaited, the others keep the processor busy.
pub(super) const STEP: usize = 2;

/// Rows of `M` values: sine, cosine, velocity of a link, and where `M` is 5, angle
/// and velocity relative to its parent.
pub(super) struct Turns<'a, P: Packing, const M: usize> {
    rows: Rows<'a, P::Number, M>,
    packing: PhantomData<P>,
}

impl<'a, P: Packing, const M: usize> Turns<'a, P, M> {
    #[inline(always)]
    pub(super) fn new(room: &'a mut [P::Number]) -> Self {
        Self {
            rows: Rows(room),
            packing: PhantomData,
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
                let velocity = omega(link);
                let mut values = [velocity; M];
                values[0] = sines[i];
                values[1] = cosines[i];
                if M == 5 {
                    let (mut bend, mut rate) = (angles[i], velocity);
                    if let Some(parent) = parent {
                        bend = bend - theta(parent);
                        rate = rate - omega(parent);
                    }
                    values[3] = bend;
                    values[4] = rate;
                }
                self.rows.store::<P, M>(row + i, values)?;
            }
            row += STEP;
        }
        Some(())
    }

    /// The motion in a row.
    #[inline(always)]
    pub(super) fn motion(&self, row: usize) -> Option<Motion<P::Value>> {
        let values = self.rows.load::<P, M>(row)?;
        let [bend, bend_rate] = match M {
            5 => [values[3], values[4]],
            _ => [values[2]; 2],
        };
        Some(Motion {
            sine: values[0],
            cosine: values[1],
            omega: values[2],
            bend,
            bend_rate,
        })
    }
}
