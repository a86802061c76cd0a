//! Bias terms of the equation of motion, order by order.

use super::room::{collect, spread};
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Coefficients of one order of what a torque may depend on, of all links.
#[derive(Clone, Copy, Debug)]
pub struct KnownOrder<T, const N: usize> {
    /// Number of the order.
    pub order: usize,
    /// Of the angles.
    pub theta: [T; N],
    /// Of the angular velocities.
    pub omega: [T; N],
    /// Of their sines.
    pub sines: [T; N],
    /// Of their cosines.
    pub cosines: [T; N],
}

/// State that a bias may depend on, in one order.
pub(super) struct KnownState<'a, T> {
    /// Number of the order.
    pub(super) order: usize,
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    /// Of the sines of all links, zeros unless the bias asks for them.
    pub(super) sines: &'a [Quad<T>],
    /// Of their cosines.
    pub(super) cosines: &'a [Quad<T>],
}

/// The coefficients of the bias.
pub(super) trait Bias<T> {
    /// True if sines and cosines are asked for.
    const TURNS: bool;

    /// Returns true if there are any coefficients beyond order 0.
    fn moves(&self) -> bool;

    /// Writes those of one order, of four links each.
    fn write(&mut self, known: KnownState<'_, T>, bias: &mut [Quad<T>]);

    /// Returns the coefficient of an order of the uniform acceleration, along and against the
    /// weights, of which these are the torques at one; none if it is one at all times.
    #[inline(always)]
    fn fall(&self, order: usize) -> Option<[T; 2]> {
        let _ = order;
        None
    }
}

/// The bias that a function gives.
pub(super) struct MovingBias<F, const N: usize>(pub(super) F);

impl<T: Scalar, F, const N: usize> Bias<T> for MovingBias<F, N>
where
    F: FnMut(&KnownOrder<T, N>) -> [T; N],
{
    const TURNS: bool = true;

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

/// None: a type of its own, so that nothing of it is left in the loop.
pub(super) struct ConstantBias;

impl<T> Bias<T> for ConstantBias {
    const TURNS: bool = false;

    #[inline(always)]
    fn moves(&self) -> bool {
        false
    }

    #[inline(always)]
    fn write(&mut self, _known: KnownState<'_, T>, _bias: &mut [Quad<T>]) {}
}
