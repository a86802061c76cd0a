//! Taylor recurrences of a tree.
//!
//! Let γ + iσ = e^(i(θ−θ₀)) for each link, where θ₀ is its angle at the start, and C + iS its
//! second derivative. The equation of motion is
//!
//! γ_i X_i − σ_i Y_i + bias_i = 0,
//!
//! where X and Y are the force on the link, times its lever, across and along its direction at the
//! start, including its inertia and weight. Both are linear in the C and S of all links, with
//! coefficients from the start. So a link takes only four products of series, for a tree of any
//! shape and depth.
//!
//! In each order X follows from the equation and C from lower orders; then S and Y follow from a
//! linear system, by [`elimination`](super::elimination) along the tree, whose factors are computed
//! once for all orders. From order 28 on (tolerances near rounding) the S of order 0 is refined
//! once more.

use super::bias::{Bias, ConstantBias, KnownOrder, MovingBias};
use super::buffer::{Buffers, SharedNumbers, StackBuffers};
use super::elimination::FACTORS;
use super::links::{Connectivity, KnownLinks, TreeLinks};
use super::orders::Orders;
use super::series::SERIES;
use super::start::{Constants, LinkConstants, Origin, Start};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lanes, Scalar};
use crate::simd::dispatch::in_fours;
use crate::simd::{Quad, Simd};

/// Returns the number of quads of workspace that [`expand`] needs for `links` links and polynomials
/// of order `order`.
#[must_use]
pub const fn workspace(links: usize, order: usize) -> usize {
    links * FACTORS + links.div_ceil(4) * SERIES * (order + 1)
}

/// Writes the Taylor coefficients of the motion from `start`. For each order these are the
/// coefficients of the angles, then of the angular velocities. `Q` must be ⌈N/4⌉ for N links.
///
/// `bias`, if given, returns the coefficient of an order of [`Start::bias`]. It is called with
/// every order from 1 on, in ascending order.
///
/// If `Q` or the length of `work` (see [`workspace`]) does not fit, all coefficients are NaN.
///
/// Complexity: O(n p) for each of p orders of n links. Uses AVX2 and FMA for `f64` if the machine
/// has them; results then differ by rounding from those of other machines.
#[inline(always)]
pub fn expand<T: Scalar, C: Connectivity<N>, const N: usize, const Q: usize, F>(
    start: &Start<'_, T, N>,
    constants: &LinkConstants<T, N>,
    coefficients: &mut [[[T; N]; 2]],
    work: &mut [Quad<T>],
    bias: Option<F>,
) where
    F: FnMut(&KnownOrder<T, N>) -> [T; N],
{
    const { C::ORDERED };
    let order = coefficients.len().saturating_sub(1);
    if Q != N.div_ceil(4) || work.len() < workspace(N, order) {
        coefficients
            .as_flattened_mut()
            .as_flattened_mut()
            .fill(T::from_f64(f64::NAN));
        return;
    }
    let orders = coefficients.iter_mut();
    for (row, angles) in orders.zip([start.theta, start.omega]) {
        // The velocities of order 1 follow later.
        *row = [*angles, *start.omega];
    }
    let expansion = Expansion {
        links: KnownLinks::<C, N>::new(),
        origin: Origin {
            omega: start.omega,
            sines: start.sines.as_slice(),
            cosines: start.cosines.as_slice(),
            bias: start.bias.as_slice(),
        },
        constants: Constants {
            inertias: &constants.inertias,
            moments: &constants.moments,
            attachments: &constants.attachments,
            weights: &constants.weights,
            lateral_weights: &constants.lateral_weights,
        },
        count: coefficients.len(),
        coefficients: coefficients.as_flattened_mut().as_flattened_mut(),
    };
    let buffers = StackBuffers::<N, Q>;
    match bias {
        Some(bias) => expansion.run(buffers, work, MovingBias::<_, N>(bias)),
        None => expansion.run(buffers, work, ConstantBias),
    }
}

/// An expansion to compute; its first orders are already known.
pub(super) struct Expansion<'a, T, L, S> {
    pub(super) links: L,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// For each order, the coefficients of all angles, then of all angular velocities.
    pub(super) coefficients: &'a mut [T],
    /// Number of orders in `coefficients`.
    pub(super) count: usize,
}

impl<T: Scalar, L: TreeLinks, S: SharedNumbers<T>> Expansion<'_, T, L, S> {
    /// Computes the orders, in packs of four links, or link by link if one number already holds
    /// several states.
    #[inline(always)]
    pub(super) fn run(self, buffers: impl Buffers<T>, work: &mut [Quad<T>], bias: impl Bias<T>) {
        T::by_kind(OrdersOf {
            expansion: self,
            buffers,
            work,
            bias,
        });
    }

    /// Returns the computation of the orders, with its workspace.
    #[inline(always)]
    fn orders<'o, R, B>(
        self,
        buffer: R,
        work: &'o mut [Quad<T>],
        bias: B,
    ) -> Orders<'o, T, L, S, R, B>
    where
        Self: 'o,
    {
        let (factors, rows) = work.split_at_mut(self.links.count() * FACTORS);
        let (factors, _) = factors.as_chunks_mut::<2>();
        let (factors, _) = factors.as_chunks_mut::<5>();
        let (rows, _) = rows.as_chunks_mut::<SERIES>();
        Orders {
            links: self.links,
            buffer,
            origin: self.origin,
            constants: self.constants,
            coefficients: self.coefficients,
            count: self.count,
            rows,
            factors,
            bias,
        }
    }
}

/// Operation that computes the orders of an expansion, run with the vector instructions of the
/// machine.
struct OrdersOf<'a, 'w, T, L, S, R, B> {
    expansion: Expansion<'a, T, L, S>,
    buffers: R,
    work: &'w mut [Quad<T>],
    bias: B,
}

impl<T, L, S, R, B> ByKind<T> for OrdersOf<'_, '_, T, L, S, R, B>
where
    T: Scalar,
    L: TreeLinks,
    S: SharedNumbers<T>,
    R: Buffers<T>,
    B: Bias<T>,
{
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        let buffer = self.buffers.in_fours();
        in_fours::<T, _>(self.expansion.orders(buffer, self.work, self.bias));
    }

    #[inline(always)]
    fn of_wide<W: Scalar>(self)
    where
        T: Simd<W>,
    {
        let buffer = self.buffers.one_by_one();
        let orders = self.expansion.orders(buffer, self.work, self.bias);
        orders.form::<T, Lanes<T, 4>, true>();
    }
}
