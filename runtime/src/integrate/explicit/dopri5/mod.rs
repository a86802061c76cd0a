//! Dormand and Prince's pair of order 5(4).

#[cfg(feature = "std")]
mod lanes;
mod tables;

use self::tables::{A2, A3, A4, A5, A6, B, C, D, E};
use super::arithmetic::{NonFiniteRates, Span, for_each_sum};
use super::memory::Memory;
use super::pair::Pair;
use crate::integrate::control::ControlConstants;
use crate::scalar::Real;
use crate::system::Ode;

/// The pair of [`Dopri5`](super::Dopri5).
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince5;

/// The estimate belongs to the formula of order 4 and is far larger than the
/// error that is made, but steps are many, and what they make adds up: over ten
/// seconds to some 160 times the tolerance, where the pairs of order 8 and 9
/// stay near it. Counting the estimate so many times brings the three together.
const ESTIMATE_WEIGHT: f64 = 20.0;

impl Pair for DormandPrince5 {
    /// As in the authors' program; the error that they act on is not.
    const CONTROL: ControlConstants = ControlConstants {
        order: tables::ORDER,
        safety: 0.9,
        smallest_factor: 0.2,
        largest_factor: 10.0,
        beta_share: 0.75,
    };
    const ORDER: u32 = tables::ORDER;
    const STAGES: usize = tables::STAGES;
    const STAGES_DENSE: usize = tables::STAGES_DENSE;
    const DENSE_TERMS: usize = 4;
    const ERROR_USES_END: bool = true;

    fn stages<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        memory.stage(ode, span, (2, C[1]), &A2)?;
        memory.stage(ode, span, (3, C[2]), &A3)?;
        memory.stage(ode, span, (4, C[3]), &A4)?;
        memory.stage(ode, span, (5, C[4]), &A5)?;
        memory.stage(ode, span, (6, C[5]), &A6)
    }

    fn finish<T: Real>(memory: &mut Memory<T>, span: Span<T>, compensated: bool) {
        memory.finish(span, &B, compensated);
    }

    fn error<T: Real>(memory: &Memory<T>, span: Span<T>) -> T {
        T::from_f64(ESTIMATE_WEIGHT) * memory.mean_square_error(span, &E)
    }

    fn prepare_dense<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        _ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        let Memory {
            start,
            end,
            rates,
            dense,
            ..
        } = memory;
        if let [increment, left, right, high] = dense.as_mut_slice() {
            for i in 0..start.len() {
                increment[i] = end[i] - start[i];
                left[i] = span.step * rates[0][i] - increment[i];
                right[i] = increment[i] - span.step * rates[6][i] - left[i];
            }
            for_each_sum(&D, rates, start.len(), |i, sum| high[i] = span.step * sum);
        }
        Ok(())
    }

    /// y + s (Δy + r (d₁ + s (d₂ + r d₃))), r = 1 − s.
    fn dense_output<T: Real>(memory: &Memory<T>, s: T, out: &mut [T]) {
        let r = T::ONE - s;
        if let [increment, d1, d2, d3] = memory.dense.as_slice() {
            for (i, out) in out.iter_mut().enumerate() {
                let tail = d1[i] + s * (d2[i] + r * d3[i]);
                *out = memory.start[i] + s * (increment[i] + r * tail);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::explicit::order_conditions::{Table, continuous, order, stage_values};

    fn table() -> Table {
        let rows: [&[(usize, f64)]; tables::STAGES_DENSE] = [&[], &A2, &A3, &A4, &A5, &A6, &B];
        Table {
            nodes: C.to_vec(),
            rows: rows.to_vec(),
        }
    }

    #[test]
    fn rows_sum_to_their_nodes() {
        table().assert_row_sums();
    }

    #[test]
    fn both_formulas_have_their_orders_and_no_more() {
        let values = stage_values(&table(), 6);
        assert_eq!(order(&values, &B), 5);
        let mut embedded = E.map(|(stage, weight)| (stage, -weight));
        for entry in &mut embedded {
            let own = B.iter().find(|own| own.0 == entry.0);
            entry.1 += own.map_or(0.0, |own| own.1);
        }
        assert_eq!(order(&values, &embedded), 4);
    }

    #[test]
    fn the_dense_output_has_order_four_everywhere() {
        let values = stage_values(&table(), 4);
        continuous(&values, 4, |s, weights| {
            let r = 1.0 - s;
            for &(stage, weight) in &B {
                // Δy with its factors in d₁ = h k₁ − Δy, d₂ = Δy − h k₇ − d₁.
                weights.add(stage, weight * (s - s * r + 2.0 * s * s * r));
            }
            weights.add(1, s * r - s * s * r);
            weights.add(7, -(s * s * r));
            for &(stage, weight) in &D {
                weights.add(stage, weight * s * s * r * r);
            }
        });
    }
}
