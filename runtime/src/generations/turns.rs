//! What every recursion reads of the angles and velocities, formed before it.

use super::columns::Columns;
use super::prefetch::prefetch;
use super::sweep::Sweep;
use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;

/// Sines and cosines of a part's angles, and its velocities.
pub(super) struct Turns<'a, 'b, T>(pub(super) &'a mut Sweep<'b, T>);

impl<T: Scalar> SliceKernel<T> for Turns<'_, '_, T> {
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let Sweep {
            part,
            theta,
            omega,
            storage,
            ..
        } = self.0;
        for (own, whole, length) in part.spans() {
            let mut span = Span {
                theta,
                omega,
                turns: &mut storage.turns,
                own: storage.lead + own,
                whole,
                ahead: part.ahead(),
            };
            let _ = span.turn::<W::Wide>(length);
        }
    }
}

/// Neighbours, and where they stand.
struct Span<'a, 'b, T> {
    theta: &'a [T],
    omega: &'a [T],
    turns: &'a mut Columns<'b, T, 3>,
    own: usize,
    whole: usize,
    ahead: Option<usize>,
}

impl<T: Scalar> Span<'_, '_, T> {
    /// Two vectors at a time, for while the result of one operation is awaited the
    /// other keeps the processor busy. The last ones overlap those before.
    #[inline(always)]
    fn turn<V: Vector<T>>(&mut self, count: usize) -> Option<()> {
        let last = count.saturating_sub(V::LANES);
        let mut index = 0;
        while index < count {
            let places = [index.min(last), (index + V::LANES).min(last)];
            let whole = [self.whole + places[0], self.whole + places[1]];
            let angles = [V::load(self.theta, whole[0]), V::load(self.theta, whole[1])];
            let (sines, cosines) = V::sin_cos_each(&angles);
            for i in 0..2 {
                let velocity = V::load(self.omega, whole[i]);
                let mut row = self.turns.row_mut(self.own + places[i])?;
                row.store([sines[i], cosines[i], velocity]);
                if let Some(ahead) = self.ahead {
                    prefetch(self.theta, whole[i] + ahead);
                    prefetch(self.omega, whole[i] + ahead);
                }
            }
            index += 2 * V::LANES;
        }
        Some(())
    }
}
