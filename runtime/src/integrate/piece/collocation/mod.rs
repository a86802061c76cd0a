//! Collocation at the nodes of the Gauss–Legendre methods.

mod tables;

pub(in crate::integrate) use self::tables::GaussTable;
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
    pub(in crate::integrate) fn integral<S: Scalar>(self, j: usize, x: S) -> S {
        let table = self.table();
        let row = table.integrals.chunks_exact(table.nodes.len()).nth(j);
        let coefficients = row.unwrap_or_default().iter().rev();
        coefficients.fold(S::from_f64(0.0), |sum, &c| (sum + S::from_f64(c)) * x)
    }
}
