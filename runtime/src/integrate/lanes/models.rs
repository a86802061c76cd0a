//! Systems side by side: one in each lane.

// The interface of a sealed trait names the type.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;
use core::cell::Cell;

use crate::integrate::error::InputError;
use crate::integrate::registers::set_lane;
use crate::scalar::{Lane, Scalar};
use crate::simd::Simd;
use crate::system::LaneOde;

/// The systems of all lanes, as one system whose constants are registers.
///
/// Constants are known by their place in the order in which
/// [`LaneOde::on_scalar`] converts them: that of one model goes into its lane of
/// the register at the same place.
pub struct Models<O: LaneOde<T>, T: Lane, R: Simd<T>> {
    /// All of them at once.
    pub(crate) registers: O::Of<R>,
    /// Constants of the system in their order.
    constants: Vec<R>,
    dimension: usize,
    shape: usize,
}

impl<O: LaneOde<T>, T: Lane, R: Simd<T>> Models<O, T, R> {
    /// Puts one system into every lane.
    pub(crate) fn splat(system: &O) -> Self {
        let mut constants = vec![R::from_f64(0.0); count(system)];
        let registers = convert(system, &mut constants, |_, constant| R::splat(constant));
        Self {
            registers,
            constants,
            dimension: system.dimension(),
            shape: system.shape(),
        }
    }

    /// Returns the number of components of a state: a constant where the type tells it.
    #[inline(always)]
    pub(crate) fn dimension(&self) -> usize {
        match O::DIMENSION {
            Some(dimension) => dimension,
            None => self.dimension,
        }
    }

    /// Puts a system into a lane; those in the others stay.
    ///
    /// # Errors
    /// It differs from the first one in more than constants.
    pub(crate) fn set(&mut self, lane: usize, system: &O) -> Result<(), InputError<T>> {
        let (expected, found) = (self.dimension, system.dimension());
        if expected != found {
            return Err(InputError::Dimension { expected, found });
        }
        if self.shape != system.shape() {
            return Err(InputError::Shape);
        }
        let (expected, found) = (self.constants.len(), count(system));
        if expected != found {
            return Err(InputError::Constants { expected, found });
        }
        self.registers = convert(system, &mut self.constants, |mut register, constant| {
            set_lane(&mut register, lane, constant);
            register
        });
        Ok(())
    }
}

/// Number of constants of a system.
fn count<T: Scalar, O: LaneOde<T>>(system: &O) -> usize {
    let count = Cell::new(0);
    system.on_scalar(|constant| {
        count.set(count.get() + 1);
        constant
    });
    count.get()
}

/// Changes every register by the constant that belongs there, and makes a
/// system of them.
fn convert<O: LaneOde<T>, T: Lane, R: Simd<T>>(
    system: &O,
    constants: &mut [R],
    change: impl Fn(R, T) -> R,
) -> O::Of<R> {
    let constants = Cell::from_mut(constants).as_slice_of_cells();
    let next = Cell::new(0);
    system.on_scalar(
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
