//! Collocation polynomials at the nodes of the Gauss–Legendre methods.

mod tables;

pub(in crate::integrate) use self::tables::GaussTable;
use super::Lift;
use crate::scalar::Scalar;

/// Order of a [`Gauss`](crate::integrate::Gauss) method, which is twice its number of stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GaussOrder {
    /// Order 2, with one stage: the implicit midpoint rule.
    Two,
    /// Two stages.
    Four,
    /// Three stages.
    Six,
    /// Four stages.
    Eight,
}

impl GaussOrder {
    /// Returns the nodes and coefficients of the method of this order.
    pub(in crate::integrate) fn table(self) -> &'static GaussTable {
        &tables::TABLES[match self {
            Self::Two => 0,
            Self::Four => 1,
            Self::Six => 2,
            Self::Eight => 3,
        }]
    }

    /// Returns the number of stages.
    #[cfg(feature = "serde")]
    pub(super) fn stages(self) -> usize {
        self.table().nodes.len()
    }

    /// Returns the integral from 0 to x of the Lagrange polynomial of node j; zero if the method
    /// has no node j.
    #[inline(always)]
    pub(in crate::integrate) fn integral<S: Scalar>(self, j: usize, x: S) -> S {
        let table = self.table();
        let row = table.integrals.chunks_exact(table.nodes.len()).nth(j);
        // Not a closure, which the compiler may compile without the instructions of vector
        // registers.
        let mut sum = S::from_f64(0.0);
        for &coefficient in row.unwrap_or_default().iter().rev() {
            sum = (sum + S::from_f64(coefficient)) * x;
        }
        sum
    }

    /// Returns the weights of the stages' rates in the increment over the first fraction `s` of a
    /// step of length `length`. Weights after the last node are zero.
    #[inline(always)]
    pub(in crate::integrate) fn weights<W: Scalar, S: Lift<W>>(self, length: W, s: S) -> [S; 4] {
        let mut weights = [S::from_f64(0.0); 4];
        for (j, weight) in weights.iter_mut().enumerate() {
            *weight = S::lift(length) * self.integral(j, s);
        }
        weights
    }
}

/// Returns component i (of n) of the start plus Σ weight · rate, with the weights from
/// [`weights`](GaussOrder::weights).
#[inline(always)]
pub(in crate::integrate) fn weigh<W: Scalar, S: Lift<W>>(
    weights: &[S; 4],
    start: W,
    rates: &[W],
    n: usize,
    i: usize,
) -> S {
    let mut value = S::lift(start);
    for (rates, &weight) in rates.chunks_exact(n).zip(weights) {
        value = value + weight * S::lift(rates[i]);
    }
    value
}
