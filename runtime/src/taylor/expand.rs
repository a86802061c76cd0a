//! The recurrences of a tree.
//!
//! Let γ + iσ = e^(i(θ−θ₀)) for each link, θ₀ its angle at the start, and
//! C + iS the second derivative of that. The equation of motion is
//!
//! γ_i X_i − σ_i Y_i + bias_i = 0,
//!
//! where X and Y are the force on the link, times its lever, across and along what
//! it was at the start, its own inertia and its weight included. Both are linear in
//! the C and S of all links, with coefficients of the start. Four products of series
//! a link are all there is, for a tree of any shape and depth.
//!
//! In each order X follows from the equation, C from lower orders, and then S and Y
//! from a linear system, by [`elimination`](super::elimination) along the tree, whose
//! factors are formed once and serve all orders. From order 28 on, which is that of
//! tolerances near rounding, the S of order 0 is refined once more.

use super::bias::{Bias, ConstantBias, KnownOrder, MovingBias};
use super::elimination::FACTORS;
use super::links::{Connectivity, KnownLinks, TreeLinks};
use super::orders::Orders;
use super::room::{Rooms, SharedNumbers, StackRooms};
use super::series::SERIES;
use super::start::{Constants, LinkConstants, Origin, Start};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lanes, Scalar};
use crate::simd::dispatch::in_fours;
use crate::simd::{Quad, Simd};

/// Number of quads that [`expand`] works in, for `links` links and polynomials of
/// order `order`.
#[must_use]
pub const fn workspace(links: usize, order: usize) -> usize {
    links * FACTORS + links.div_ceil(4) * SERIES * (order + 1)
}

/// Writes the Taylor coefficients of the motion from `start`, order by order:
/// those of the angles, then those of the angular velocities. `Q` must be
/// ⌈N/4⌉.
///
/// `bias`, if there is one, returns the coefficient of an order of
/// [`Start::bias`]. It is called with every order from 1 on, in turn.
///
/// Where `Q` or the length of `work` ([`workspace`]) does not fit, all coefficients
/// are NaN.
///
/// Complexity: O(n p) for each of p orders of n links. Uses AVX2 and FMA for `f64`
/// where the machine has them: results there differ by rounding from those
/// elsewhere.
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
        // Velocities of order 1 follow.
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
    let rooms = StackRooms::<N, Q>;
    match bias {
        Some(bias) => expansion.run(rooms, work, MovingBias::<_, N>(bias)),
        None => expansion.run(rooms, work, ConstantBias),
    }
}

/// Request for the orders of an expansion, the first of which are known.
pub(super) struct Expansion<'a, T, L, S> {
    pub(super) links: L,
    pub(super) origin: Origin<'a, T, S>,
    pub(super) constants: Constants<'a, T>,
    /// Angles of all links, then angular velocities, order by order.
    pub(super) coefficients: &'a mut [T],
    /// Number of orders in them.
    pub(super) count: usize,
}

impl<T: Scalar, L: TreeLinks, S: SharedNumbers<T>> Expansion<'_, T, L, S> {
    /// Runs the orders in packs of links, or link by link where a number stands for several
    /// states already.
    #[inline(always)]
    pub(super) fn run(self, rooms: impl Rooms<T>, work: &mut [Quad<T>], bias: impl Bias<T>) {
        T::by_kind(OrdersOf {
            expansion: self,
            rooms,
            work,
            bias,
        });
    }

    /// Returns the orders in this room.
    #[inline(always)]
    fn orders<'o, R, B>(
        self,
        room: R,
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
            room,
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

/// Asks for the orders.
struct OrdersOf<'a, 'w, T, L, S, R, B> {
    expansion: Expansion<'a, T, L, S>,
    rooms: R,
    work: &'w mut [Quad<T>],
    bias: B,
}

impl<T, L, S, R, B> ByKind<T> for OrdersOf<'_, '_, T, L, S, R, B>
where
    T: Scalar,
    L: TreeLinks,
    S: SharedNumbers<T>,
    R: Rooms<T>,
    B: Bias<T>,
{
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        let room = self.rooms.in_fours();
        in_fours::<T, _>(self.expansion.orders(room, self.work, self.bias));
    }

    #[inline(always)]
    fn of_wide<W: Scalar>(self)
    where
        T: Simd<W>,
    {
        let room = self.rooms.one_by_one();
        let orders = self.expansion.orders(room, self.work, self.bias);
        orders.form::<T, Lanes<T, 4>, true>();
    }
}
