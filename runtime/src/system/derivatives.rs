//! Derivatives of functions of a state, computed with dual numbers.

use alloc::vec::Vec;

use crate::scalar::{Dual, Scalar};

/// Number of derivatives that one evaluation computes.
const WIDTH: usize = 8;

/// A number with several derivatives.
pub type Slopes<T> = Dual<T, WIDTH>;

/// Writes the derivatives of a function by its variables to `slopes`. Each evaluation computes
/// several of them at once.
pub fn gradient<T: Scalar>(
    values: &[T],
    slopes: &mut [T],
    mut function: impl FnMut(&[Slopes<T>]) -> Slopes<T>,
) {
    let mut point: Vec<Slopes<T>> = values.iter().copied().map(Dual::constant).collect();
    for (part, slopes) in slopes.chunks_mut(WIDTH).enumerate() {
        let own = |point: &mut Vec<Slopes<T>>, change: fn((usize, &mut Slopes<T>))| {
            let own = point.iter_mut().skip(part * WIDTH).take(WIDTH);
            own.enumerate().for_each(change);
        };
        own(&mut point, |(direction, value)| {
            *value = Dual::variable(value.value, direction);
        });
        let result = function(&point);
        for (slope, tangent) in slopes.iter_mut().zip(result.tangents) {
            *slope = tangent;
        }
        own(&mut point, |(_, value)| {
            *value = Dual::constant(value.value);
        });
    }
}
