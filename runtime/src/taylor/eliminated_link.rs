//! One link during the elimination along the tree.

use crate::scalar::Scalar;
use crate::simd::Simd;

/// A link during the elimination: its coefficients, including the contributions of its children.
/// The symbols are defined in the module `elimination`.
#[derive(Clone, Copy)]
pub(super) struct EliminatedLink<P> {
    /// Articulated inertia J.
    pub(super) inertia: P,
    /// Inertia K that multiplies C: the part along the link's direction at the start.
    pub(super) inertia_along: P,
    /// Product of inertia q.
    pub(super) product: P,
    /// First moment b.
    pub(super) moment: [P; 2],
    /// First moment g for C.
    pub(super) moment_along: [P; 2],
    /// Symmetric 2 × 2 matrix N, as N_xx, N_xy, N_yy.
    pub(super) deficit: [P; 3],
}

/// Number of values in an [`EliminatedLink`].
pub(super) const ELIMINATED: usize = 10;

impl<P: Scalar> EliminatedLink<P> {
    /// Creates the link from the array that [`numbers`](Self::numbers) returns.
    #[inline(always)]
    pub(super) fn of(numbers: [P; ELIMINATED]) -> Self {
        let [inertia, inertia_along, product, numbers @ ..] = numbers;
        let [b_x, b_y, g_x, g_y, xx, xy, yy] = numbers;
        Self {
            inertia,
            inertia_along,
            product,
            moment: [b_x, b_y],
            moment_along: [g_x, g_y],
            deficit: [xx, xy, yy],
        }
    }

    /// Returns all values of the link as one array.
    #[inline(always)]
    pub(super) fn numbers(self) -> [P; ELIMINATED] {
        let Self {
            inertia,
            inertia_along,
            product,
            moment: [b_x, b_y],
            moment_along: [g_x, g_y],
            deficit: [xx, xy, yy],
        } = self;
        [
            inertia,
            inertia_along,
            product,
            b_x,
            b_y,
            g_x,
            g_y,
            xx,
            xy,
            yy,
        ]
    }

    /// Creates a link without children.
    #[inline(always)]
    pub(super) fn alone(inertia: P, [m_x, m_y]: [P; 2]) -> Self {
        let zero = P::from_f64(0.0);
        Self {
            inertia,
            inertia_along: inertia,
            product: zero,
            moment: [m_x, m_y],
            moment_along: [zero - m_y, m_x],
            deficit: [zero; 3],
        }
    }

    /// Adds b bᵀ/J to the matrix N; the argument is n = b/J.
    #[inline(always)]
    pub(super) fn relieve(&mut self, [n_x, n_y]: [P; 2]) {
        let ([b_x, b_y], [xx, xy, yy]) = (self.moment, self.deficit);
        self.deficit = [
            xx.plus_product(b_x, n_x),
            xy.plus_product(b_x, n_y),
            yy.plus_product(b_y, n_y),
        ];
    }

    /// Adds the contribution of a child with the matrix N, attached at the point r.
    #[inline(always)]
    pub(super) fn carry(&mut self, [xx, xy, yy]: [P; 3], [r_x, r_y]: [P; 2]) {
        // The vectors N r and N i r.
        let across = [
            (xx * r_x).plus_product(xy, r_y),
            (xy * r_x).plus_product(yy, r_y),
        ];
        let along = [
            (xy * r_x).minus_product(xx, r_y),
            (yy * r_x).minus_product(xy, r_y),
        ];
        self.inertia = self
            .inertia
            .minus_product(r_x, across[0])
            .minus_product(r_y, across[1]);
        self.inertia_along = self
            .inertia_along
            .minus_product(r_x, along[1])
            .plus_product(r_y, along[0]);
        self.product = self
            .product
            .plus_product(r_x, across[1])
            .minus_product(r_y, across[0]);
        for x in 0..2 {
            self.moment[x] = self.moment[x] - across[x];
            self.moment_along[x] = self.moment_along[x] - along[x];
        }
        for (sum, own) in self.deficit.iter_mut().zip([xx, xy, yy]) {
            *sum = *sum + own;
        }
    }
}
