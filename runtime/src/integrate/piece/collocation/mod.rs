//! Collocation at the nodes of the Gauss–Legendre methods.

mod tables;

pub(in crate::integrate) use self::tables::GaussTable;
use super::Lift;
use crate::scalar::Scalar;

/// The order of a [`Gauss`](crate::integrate::Gauss) method: twice its number of stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GaussOrder {
    /// One stage: the implicit midpoint rule.
    Two,
    /// Two stages.
    Four,
    /// Three stages.
    Six,
    /// Four stages.
    Eight,
}

impl GaussOrder {
    /// Nodes and coefficients of the method.
    pub(in crate::integrate) fn table(self) -> &'static GaussTable {
        &tables::TABLES[match self {
            Self::Two => 0,
            Self::Four => 1,
            Self::Six => 2,
            Self::Eight => 3,
        }]
    }

    /// Number of stages.
    #[cfg(feature = "serde")]
    pub(super) fn stages(self) -> usize {
        self.table().nodes.len()
    }

    /// Integral from 0 to x of the Lagrange polynomial of node j; zero where there is no
    /// such node.
    #[inline(always)]
    pub(in crate::integrate) fn integral<S: Scalar>(self, j: usize, x: S) -> S {
        let table = self.table();
        let row = table.integrals.chunks_exact(table.nodes.len()).nth(j);
        // No closure, which the compiler may leave without the instructions of registers.
        let mut sum = S::from_f64(0.0);
        for &coefficient in row.unwrap_or_default().iter().rev() {
            sum = (sum + S::from_f64(coefficient)) * x;
        }
        sum
    }

    /// Weights of the rates at the nodes in the increment from the start of a step of length
    /// `length` to its fraction `s`: zeros beyond the last node.
    #[inline(always)]
    pub(in crate::integrate) fn weights<W: Scalar, S: Lift<W>>(self, length: W, s: S) -> [S; 4] {
        let mut weights = [S::from_f64(0.0); 4];
        for (j, weight) in weights.iter_mut().enumerate() {
            *weight = S::lift(length) * self.integral(j, s);
        }
        weights
    }
}

/// The start and the increment that [`weights`](GaussOrder::weights) give, for component i
/// of n.
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
