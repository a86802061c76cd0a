//! Energies, from the root to the leaves.

use super::plan::Plan;
use super::vector::Vector;
use crate::scalar::Scalar;

/// What the energies of a link are made of. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EnergyConstants<T> {
    /// Half of the mass.
    half_mass: T,
    /// First moment m d about the pivot.
    moment: T,
    /// Half of the moment of inertia I + m d² about the pivot.
    half_inertia: T,
    /// Distance ℓ of the children's pivots.
    lever: T,
    /// g h: h is the first moment about the link's pivot of what hangs on it,
    /// the subtrees of its children as masses in their pivots.
    gravity: T,
    /// Half of the stiffness of the torsion spring in the pivot.
    half_spring: T,
}

impl<T: Copy> EnergyConstants<T> {
    /// From a row, in their order.
    pub(super) fn of(
        &[half_mass, moment, half_inertia, lever, gravity, half_spring]: &[T; 6],
    ) -> Self {
        Self {
            half_mass,
            moment,
            half_inertia,
            lever,
            gravity,
            half_spring,
        }
    }
}

impl<T> EnergyConstants<T> {
    /// On other scalars.
    pub(super) fn map<S>(&self, convert: impl Fn(T) -> S) -> EnergyConstants<S>
    where
        T: Copy,
    {
        let &Self {
            half_mass,
            moment,
            half_inertia,
            lever,
            gravity,
            half_spring,
        } = self;
        EnergyConstants {
            half_mass: convert(half_mass),
            moment: convert(moment),
            half_inertia: convert(half_inertia),
            lever: convert(lever),
            gravity: convert(gravity),
            half_spring: convert(half_spring),
        }
    }
}

/// Sums, a few hundred terms at a time: the error of a long sum grows with its
/// length.
pub(super) struct Sum<T> {
    total: T,
    part: T,
    terms: usize,
}

impl<T: Scalar> Sum<T> {
    pub(super) fn new() -> Self {
        let zero = T::from_f64(0.0);
        Self {
            total: zero,
            part: zero,
            terms: 0,
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, term: T) {
        self.part = self.part + term;
        self.terms += 1;
        if self.terms == 512 {
            *self = Self {
                total: self.total(),
                ..Self::new()
            };
        }
    }

    pub(super) fn total(&self) -> T {
        self.total + self.part
    }
}

/// How many numbers [`kinetic`] needs room for.
pub(super) fn workspace(plan: &Plan) -> usize {
    2 * plan.start(plan.generations().saturating_sub(1))
}

/// K = Σ ½ m (V + d ω v)² + ½ I ω² over all links, V the velocity of a link's
/// pivot, v = (cos θ, sin θ); the pivots of its children have V + ℓ ω v.
/// `buffer` has room for [`workspace`].
pub(super) fn kinetic<T: Scalar>(
    plan: &Plan,
    constants: &[EnergyConstants<T>],
    theta: &[T],
    omega: &[T],
    buffer: &mut [T],
) -> T {
    let inner = plan.start(plan.generations().saturating_sub(1));
    let (ends_x, ends_y) = buffer.split_at_mut(inner.min(buffer.len()));
    let zero = T::from_f64(0.0);
    let mut sum = Sum::new();
    for (generation, constants) in constants.iter().enumerate() {
        let start = plan.start(generation);
        let above = generation.checked_sub(1);
        let parents = above.map(|above| (plan.start(above), plan.count(above).max(1)));
        for i in 0..plan.count(generation) {
            let [x, y] = match parents {
                Some((first, count)) => {
                    let parent = first + i % count;
                    [T::load(ends_x, parent), T::load(ends_y, parent)]
                }
                None => [zero, zero],
            };
            let (sine, cosine) = T::load(theta, start + i).sin_cos();
            let rate = T::load(omega, start + i);
            let turning = constants.moment * rate * (x * cosine + y * sine);
            let own = constants.half_mass * (x * x + y * y) + constants.half_inertia * rate * rate;
            sum.add(own + turning);
            let end = constants.lever * rate;
            // Leaves find no place, and need none.
            (x + end * cosine).store(ends_x, start + i);
            (y + end * sine).store(ends_y, start + i);
        }
    }
    sum.total()
}

/// U = Σ g h (1 − cos θ) + ½ κ (θ − θ_parent)² over all links.
pub(super) fn potential<T: Scalar>(
    plan: &Plan,
    constants: &[EnergyConstants<T>],
    theta: &[T],
) -> T {
    let one = T::from_f64(1.0);
    let mut sum = Sum::new();
    for (generation, constants) in constants.iter().enumerate() {
        let start = plan.start(generation);
        let above = generation.checked_sub(1);
        let parents = above.map(|above| (plan.start(above), plan.count(above).max(1)));
        for i in 0..plan.count(generation) {
            let angle = T::load(theta, start + i);
            let (_, cosine) = angle.sin_cos();
            let bend = match parents {
                Some((first, count)) => angle - T::load(theta, first + i % count),
                None => angle,
            };
            sum.add(constants.gravity * (one - cosine) + constants.half_spring * bend * bend);
        }
    }
    sum.total()
}
