//! Pendulums side by side: one in each lane.

// The interface of a sealed trait names the type.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;
use core::cell::Cell;

use super::registers::set_lane;
use crate::integrate::error::InputError;
use crate::scalar::{Lane, Scalar};
use crate::simd::Simd;
use crate::system::Cast;

/// The pendulums of all lanes, as one pendulum whose constants are registers.
///
/// Constants are known by their place in the order in which
/// [`Cast::cast`] converts them: that of one model goes into its lane of
/// the register at the same place.
pub struct Models<P: Cast<T>, T: Lane, R: Simd<T>> {
    /// All of them at once.
    pub(crate) registers: P::Of<R>,
    /// Its constants in their order.
    constants: Vec<R>,
}

impl<P: Cast<T>, T: Lane, R: Simd<T>> Models<P, T, R> {
    /// Puts one pendulum into every lane.
    pub(crate) fn splat(pendulum: &P) -> Self {
        let mut constants = vec![R::from_f64(0.0); count(pendulum)];
        let registers = convert(pendulum, &mut constants, |_, constant| R::splat(constant));
        Self {
            registers,
            constants,
        }
    }

    /// Puts a pendulum into a lane; those in the others stay.
    ///
    /// # Errors
    /// It has not as many constants as the first one.
    pub(crate) fn set(&mut self, lane: usize, pendulum: &P) -> Result<(), InputError<T>> {
        let (expected, found) = (self.constants.len(), count(pendulum));
        if expected != found {
            return Err(InputError::Constants { expected, found });
        }
        self.registers = convert(pendulum, &mut self.constants, |mut register, constant| {
            set_lane(&mut register, lane, constant);
            register
        });
        Ok(())
    }
}

/// Number of constants of a pendulum.
fn count<T: Scalar, P: Cast<T>>(pendulum: &P) -> usize {
    let count = Cell::new(0);
    pendulum.cast(|constant| {
        count.set(count.get() + 1);
        constant
    });
    count.get()
}

/// Changes every register by the constant that belongs there, and makes a
/// pendulum of them.
fn convert<P: Cast<T>, T: Lane, R: Simd<T>>(
    pendulum: &P,
    constants: &mut [R],
    change: impl Fn(R, T) -> R,
) -> P::Of<R> {
    let constants = Cell::from_mut(constants).as_slice_of_cells();
    let next = Cell::new(0);
    pendulum.cast(
        |constant| match constants.get(next.replace(next.get() + 1)) {
            Some(place) => {
                place.set(change(place.get(), constant));
                place.get()
            }
            // They have been counted.
            None => R::splat(constant),
        },
    )
}
