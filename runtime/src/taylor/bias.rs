//! Taylor coefficients of the bias, the part of the equation of motion that comes from friction,
//! springs and drives, order by order.

use super::buffer::{collect, spread};
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Taylor coefficients of one order, for all links, of the quantities on which a torque can depend.
#[derive(Clone, Copy, Debug)]
pub struct KnownOrder<T, const N: usize> {
    /// Order of the coefficients.
    pub order: usize,
    /// Coefficients of the angles.
    pub theta: [T; N],
    /// Coefficients of the angular velocities.
    pub omega: [T; N],
    /// Taylor coefficients of the sines of the angles, one per link.
    pub sines: [T; N],
    /// Taylor coefficients of the cosines of the angles, one per link.
    pub cosines: [T; N],
}

/// Taylor coefficients of one order on which a bias can depend, with four links in each quad.
pub(super) struct KnownState<'a, T> {
    /// Order of the coefficients.
    pub(super) order: usize,
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    /// Coefficients of the sines of all links' angles; zero unless the bias depends on them.
    pub(super) sines: &'a [Quad<T>],
    /// Coefficients of the cosines of all links' angles; zero unless the bias depends on them.
    pub(super) cosines: &'a [Quad<T>],
}

/// Computes the Taylor coefficients of the bias (torques of friction, springs and drives).
pub(super) trait Bias<T> {
    /// True if the bias depends on sines and cosines of the angles.
    const NEEDS_SINES: bool;

    /// Returns true if the bias has nonzero Taylor coefficients above order 0.
    fn moves(&self) -> bool;

    /// Writes the bias coefficients of one order, with four links in each quad.
    fn write(&mut self, known: KnownState<'_, T>, bias: &mut [Quad<T>]);

    /// Returns the coefficient of one order of the uniform acceleration (gravity and the motion of
    /// the root's pivot), along and across the direction of the weights; the weights are torques at
    /// an acceleration of 1. `None` if the acceleration is always 1.
    #[inline(always)]
    fn acceleration_coefficients(&self, order: usize) -> Option<[T; 2]> {
        let _ = order;
        None
    }
}

/// Bias computed by a function.
pub(super) struct MovingBias<F, const N: usize>(pub(super) F);

impl<T: Scalar, F, const N: usize> Bias<T> for MovingBias<F, N>
where
    F: FnMut(&KnownOrder<T, N>) -> [T; N],
{
    const NEEDS_SINES: bool = true;

    #[inline(always)]
    fn moves(&self) -> bool {
        true
    }

    #[inline(always)]
    fn write(&mut self, known: KnownState<'_, T>, bias: &mut [Quad<T>]) {
        let (Some(theta), Some(omega)) = (known.theta.first_chunk(), known.omega.first_chunk())
        else {
            return;
        };
        let [mut sines, mut cosines] = [*theta; 2];
        collect(known.sines, &mut sines);
        collect(known.cosines, &mut cosines);
        let known = KnownOrder {
            order: known.order,
            theta: *theta,
            omega: *omega,
            sines,
            cosines,
        };
        spread((self.0)(&known).as_slice(), N, bias);
    }
}

/// Bias without coefficients above order 0. It is a separate type, so that no code for the bias
/// remains in the loop.
pub(super) struct ConstantBias;

impl<T> Bias<T> for ConstantBias {
    const NEEDS_SINES: bool = false;

    #[inline(always)]
    fn moves(&self) -> bool {
        false
    }

    #[inline(always)]
    fn write(&mut self, _known: KnownState<'_, T>, _bias: &mut [Quad<T>]) {}
}
