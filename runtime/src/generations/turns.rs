//! What every recursion reads of the angles and velocities, formed before it.

use super::columns::Columns;
use super::prefetch::prefetch;
use super::shared::Shared;
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
            alpha,
            ..
        } = self.0;
        let turns = storage.turns;
        for (own, whole, length) in part.spans() {
            let span = Span {
                theta: theta.get(whole..whole + length).unwrap_or_default(),
                omega: omega.get(whole..whole + length).unwrap_or_default(),
                turns: turns.window(storage.lead + own, length.max(W::Wide::LANES)),
                velocities: storage.velocities.and_then(|column| {
                    column.window(storage.lead + own, length.max(W::Wide::LANES))
                }),
                ahead: part.ahead(),
                alpha: alpha.from(whole).filter(|_| part.ends),
            };
            let _ = span.turn::<W::Wide>();
        }
    }
}

/// Neighbours.
struct Span<'a, T> {
    theta: &'a [T],
    omega: &'a [T],
    turns: Option<Columns<'a, T, 2>>,
    velocities: Option<Columns<'a, T, 1>>,
    /// How far the links are that come next.
    ahead: Option<usize>,
    /// The results, where they are written next.
    alpha: Option<Shared<'a, T>>,
}

impl<T: Scalar> Span<'_, T> {
    /// Two vectors at a time, for while the result of one operation is awaited the
    /// other keeps the processor busy. The last ones overlap those before.
    #[inline(always)]
    fn turn<V: Vector<T>>(self) -> Option<()> {
        let (turns, count) = (self.turns?, self.theta.len());
        let last = count.saturating_sub(V::LANES);
        let mut index = 0;
        while index < count {
            let places = [index.min(last), (index + V::LANES).min(last)];
            let angles = [
                V::load(self.theta, places[0]),
                V::load(self.theta, places[1]),
            ];
            let (sines, cosines) = V::sin_cos_each(&angles);
            for i in 0..2 {
                turns.store(places[i], &[sines[i], cosines[i]])?;
                if let Some(velocities) = self.velocities {
                    velocities.store(places[i], &[V::load(self.omega, places[i])])?;
                }
                if let Some(ahead) = self.ahead {
                    let next = places[i] + ahead;
                    prefetch(self.theta.as_ptr().wrapping_add(next));
                    prefetch(self.omega.as_ptr().wrapping_add(next));
                    if let Some(alpha) = self.alpha {
                        alpha.prefetch(next);
                    }
                }
            }
            index += 2 * V::LANES;
        }
        Some(())
    }
}
