//! Values graded by powers of ε, the size of the differences.
//!
//! Without truncation everything has order 0, and a series is a single value. With truncation,
//! differences have order 1, and products drop terms beyond the highest order. The same formulas
//! then give both the exact form and the expansion about the in-phase motion (physics §4).

use crate::exact::Rational;
use crate::program::ValueId;
use crate::program::builder::Builder;

/// A truncated power series in ε; coefficient k belongs to ε^k. Zero has no coefficients.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::program) struct TruncatedSeries(Vec<Option<ValueId>>);

impl TruncatedSeries {
    /// Creates a series with a single coefficient, that of ε^order.
    pub(in crate::program) fn of_order(order: usize, value: ValueId) -> Self {
        let mut coefficients = vec![None; order];
        coefficients.push(Some(value));
        Self(coefficients)
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the coefficient of ε^order, if it is not zero.
    pub(super) fn coefficient(&self, order: usize) -> Option<ValueId> {
        self.0.get(order).copied().flatten()
    }

    fn orders(&self) -> impl Iterator<Item = (usize, ValueId)> {
        let coefficients = self.0.iter().enumerate();
        coefficients.filter_map(|(order, value)| value.map(|value| (order, value)))
    }
}

/// Arithmetic on series.
pub(in crate::program) struct SeriesArithmetic<'b> {
    pub(in crate::program) builder: &'b mut Builder,
    /// Highest order that is kept, if differences count as small.
    pub(in crate::program) truncation: Option<usize>,
}

impl SeriesArithmetic<'_> {
    fn highest(&self) -> usize {
        self.truncation.unwrap_or(0)
    }

    fn collected(&mut self, mut coefficients: Vec<Option<ValueId>>) -> TruncatedSeries {
        for coefficient in &mut coefficients {
            *coefficient = coefficient.filter(|&value| !self.builder.is(value, 0));
        }
        while coefficients.last() == Some(&None) {
            coefficients.pop();
        }
        TruncatedSeries(coefficients)
    }

    /// Creates a series from a value that does not depend on ε.
    pub(in crate::program) fn value(&mut self, value: ValueId) -> TruncatedSeries {
        self.collected(vec![Some(value)])
    }

    pub(super) fn number(&mut self, number: Rational) -> TruncatedSeries {
        let value = self.builder.number(number);
        self.value(value)
    }

    pub(super) fn integer(&mut self, number: i64) -> TruncatedSeries {
        self.number(Rational::from(number))
    }

    /// Creates a series from a value of first order; of order 0 if there is no truncation.
    pub(in crate::program) fn small(&mut self, value: ValueId) -> TruncatedSeries {
        if self.builder.is(value, 0) {
            return TruncatedSeries::default();
        }
        TruncatedSeries::of_order(usize::from(self.truncation.is_some()), value)
    }

    /// Returns the part of order 0.
    pub(super) fn leading(&mut self, series: &TruncatedSeries) -> TruncatedSeries {
        let kept = series.0.iter().take(1).copied().collect();
        self.collected(kept)
    }

    fn by_order(
        &mut self,
        a: &TruncatedSeries,
        b: &TruncatedSeries,
        both: fn(&mut Builder, ValueId, ValueId) -> ValueId,
        right: fn(&mut Builder, ValueId) -> ValueId,
    ) -> TruncatedSeries {
        let length = a.0.len().max(b.0.len());
        let coefficients = (0..length)
            .map(|order| match (a.coefficient(order), b.coefficient(order)) {
                (Some(a), Some(b)) => Some(both(self.builder, a, b)),
                (Some(a), None) => Some(a),
                (None, Some(b)) => Some(right(self.builder, b)),
                (None, None) => None,
            })
            .collect();
        self.collected(coefficients)
    }

    pub(in crate::program) fn add(
        &mut self,
        a: &TruncatedSeries,
        b: &TruncatedSeries,
    ) -> TruncatedSeries {
        self.by_order(a, b, Builder::add, |_, value| value)
    }

    pub(super) fn sub(&mut self, a: &TruncatedSeries, b: &TruncatedSeries) -> TruncatedSeries {
        self.by_order(a, b, Builder::sub, Builder::neg)
    }

    pub(super) fn neg(&mut self, a: &TruncatedSeries) -> TruncatedSeries {
        self.sub(&TruncatedSeries::default(), a)
    }

    /// Returns the product, truncated at the highest order.
    pub(super) fn mul(&mut self, a: &TruncatedSeries, b: &TruncatedSeries) -> TruncatedSeries {
        let highest = self.highest();
        let mut coefficients: Vec<Option<ValueId>> = vec![None; highest + 1];
        for (order_a, a) in a.orders() {
            for (order_b, b) in b.orders() {
                if let Some(sum) = coefficients.get_mut(order_a + order_b) {
                    let product = self.builder.mul(a, b);
                    *sum = Some(match *sum {
                        Some(sum) => self.builder.add(sum, product),
                        None => product,
                    });
                }
            }
        }
        self.collected(coefficients)
    }

    pub(super) fn scale(&mut self, factor: &Rational, a: &TruncatedSeries) -> TruncatedSeries {
        let factor = self.number(factor.clone());
        self.mul(&factor, a)
    }

    /// Returns the sum of all orders: the value at ε = 1.
    pub(in crate::program) fn total(&mut self, series: &TruncatedSeries) -> ValueId {
        let mut total = self.builder.integer(0);
        for (_, value) in series.orders() {
            total = self.builder.add(total, value);
        }
        total
    }

    /// Suggests names for the values, order by order.
    pub(super) fn hint(&mut self, series: &TruncatedSeries, name: &str) {
        for (order, value) in series.orders() {
            match order {
                0 => self.builder.hint(value, name),
                _ => self.builder.hint(value, &format!("{name}_order_{order}")),
            }
        }
    }

    /// Returns the series without the highest order.
    pub(in crate::program) fn without_highest(
        &mut self,
        series: &TruncatedSeries,
    ) -> TruncatedSeries {
        let highest = self.highest();
        let kept = series.0.iter().take(highest).copied().collect();
        self.collected(kept)
    }

    /// Returns 1/√a of the part of order 0, which must not be zero.
    pub(super) fn inverse_root(&mut self, a: &TruncatedSeries) -> TruncatedSeries {
        let Some(leading) = a.coefficient(0) else {
            unreachable!("a width of friction is positive")
        };
        let one = self.builder.integer(1);
        let root = self.builder.sqrt(leading);
        let inverse = self.builder.div(one, root);
        self.value(inverse)
    }

    /// Returns 1/a, computed from the lowest order upwards; the part of order 0 must not be zero.
    pub(super) fn reciprocal(&mut self, a: &TruncatedSeries) -> TruncatedSeries {
        let Some(leading) = a.coefficient(0) else {
            unreachable!("a pivot vanishes with the differences")
        };
        let one = self.builder.integer(1);
        let inverse = self.builder.div(one, leading);
        let start = self.value(inverse);
        let leading = self.value(leading);
        let rest = self.sub(a, &leading);
        let mut result = start.clone();
        for _ in 0..self.highest() {
            let product = self.mul(&rest, &result);
            let correction = self.mul(&start, &product);
            result = self.sub(&start, &correction);
        }
        result
    }
}
