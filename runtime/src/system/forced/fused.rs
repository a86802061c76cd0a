//! One state under torques in fused arithmetic.

use core::marker::PhantomData;

use super::Forced;
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused;
use crate::simd::{Simd, StateKernel};

/// Most links of a model whose numbers fit in arrays on the stack; larger ones are
/// computed in parts anyway.
const MOST_LINKS: usize = 64;

/// Writes accelerations under torques, the slices being torques and those of
/// [`in_fused`]. False, and nothing done, where the type or the machine does not fuse.
#[inline(always)]
pub(super) fn under_in_fused<T: Scalar, P: Forced<T>>(
    pendulum: &P,
    time: T,
    [theta, omega, torques]: [&[T]; 3],
    alpha: &mut [T],
) -> bool {
    let pushed = Pushed { pendulum, torques };
    P::KNOWN_LINKS.is_some_and(|links| links <= MOST_LINKS && torques.len() == links)
        && in_fused::<T, OneStateUnder<'_, P, T>>(&pushed, time, theta, omega, alpha)
}

/// A pendulum and the torques on its links.
struct Pushed<'a, P, T> {
    pendulum: &'a P,
    torques: &'a [T],
}

/// The accelerations of one state.
struct OneStateUnder<'a, P, T>(PhantomData<&'a (P, T)>);

impl<'a, T: Scalar, P: Forced<T>> StateKernel<T> for OneStateUnder<'a, P, T> {
    type Model = Pushed<'a, P, T>;

    const LINKS: usize = match P::KNOWN_LINKS {
        Some(links) => links,
        None => 0,
    };

    #[inline(always)]
    fn run<V: Simd<T>>(
        pushed: &Pushed<'a, P, T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let zero = V::splat(T::from_f64(0.0));
        let mut numbers = [[zero; MOST_LINKS]; 3];
        for (numbers, slice) in numbers.iter_mut().zip([theta, omega, pushed.torques]) {
            for (link, number) in numbers.iter_mut().take(Self::LINKS).enumerate() {
                *number = V::splat(at(slice, link));
            }
        }
        let [theta, omega, torques] = numbers.each_ref().map(|all| all.get(..Self::LINKS));
        let mut result = [zero; MOST_LINKS];
        let (Some(theta), Some(omega), Some(torques), Some(result)) =
            (theta, omega, torques, result.get_mut(..Self::LINKS))
        else {
            return;
        };
        P::accelerations_under_of(
            &pushed.pendulum.cast(V::splat),
            V::splat(time),
            theta,
            omega,
            torques,
            result,
        );
        for (link, value) in result.iter().enumerate() {
            if let Some(rest) = alpha.get_mut(link..) {
                value.store(rest);
            }
        }
    }
}
