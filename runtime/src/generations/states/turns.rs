//! Sines and cosines of the links that come next.

use core::marker::PhantomData;

use super::packing::{Packing, Rows};
use crate::generations::Motion;
use crate::scalar::Scalar;

/// Registers of sines that are formed in step: while the result of one operation is
/// awaited, the others keep the processor busy.
pub(super) const STEP: usize = 4;

/// Rows of `M` values: sine, cosine, velocity of a link, and where `M` is 5, angle
/// and velocity relative to its parent.
pub(super) struct Turns<'a, P: Packing, const M: usize> {
    rows: Rows<'a, P::Number>,
    /// How many there are.
    formed: usize,
    packing: PhantomData<P>,
}

impl<'a, P: Packing, const M: usize> Turns<'a, P, M> {
    #[inline(always)]
    pub(super) fn new(room: &'a mut [P::Number]) -> Self {
        Self {
            rows: Rows(room),
            formed: 0,
            packing: PhantomData,
        }
    }

    /// Forms them of the links that `next` gives, each with its parent, until there
    /// are `count`.
    #[inline(always)]
    pub(super) fn form(
        &mut self,
        count: usize,
        mut next: impl FnMut() -> Option<(usize, Option<usize>)>,
        theta: &impl Fn(usize) -> P::Value,
        omega: &impl Fn(usize) -> P::Value,
    ) {
        while self.formed < count {
            let mut links = [(0, None); STEP];
            let mut angles = [P::Value::from_f64(0.0); STEP];
            for i in 0..STEP {
                // Behind the last link there is room for what nobody reads.
                links[i] = next().unwrap_or((0, None));
                angles[i] = theta(links[i].0);
            }
            let (sines, cosines) = P::Value::sin_cos_each(&angles);
            for i in 0..STEP {
                let (link, parent) = links[i];
                let velocity = omega(link);
                let mut row = [velocity; M];
                row[0] = sines[i];
                row[1] = cosines[i];
                if M == 5 {
                    let (mut bend, mut rate) = (angles[i], velocity);
                    if let Some(parent) = parent {
                        bend = bend - theta(parent);
                        rate = rate - omega(parent);
                    }
                    row[3] = bend;
                    row[4] = rate;
                }
                self.rows.store::<P, M>(self.formed + i, row);
            }
            self.formed += STEP;
        }
    }

    /// The motion of the link whose sine was formed at that place.
    #[inline(always)]
    pub(super) fn motion(&self, place: usize) -> Motion<P::Value> {
        let row = self.rows.load::<P, M>(place);
        let [bend, bend_rate] = match M {
            5 => [row[3], row[4]],
            _ => [row[2]; 2],
        };
        Motion {
            sine: row[0],
            cosine: row[1],
            omega: row[2],
            bend,
            bend_rate,
        }
    }
}
