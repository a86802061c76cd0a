//! Systems of equations in the lanes, one in each.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

use crate::integrate::error::InputError;
use crate::integrate::registers::set_lane;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::CastOde;

/// The systems of all lanes, stored as one system whose constants are registers.
///
/// A constant is identified by its index in the order in which [`CastOde::cast`] converts
/// constants. Each model's constant goes into its lane of the register with the same index.
pub struct Models<O: CastOde<T>, T: Lane, R: Simd<T>> {
    /// The systems of all lanes, as one system with registers as constants.
    pub(crate) registers: O::Of<R>,
    /// Constants of the systems, in the order of conversion.
    constants: Vec<R>,
    dimension: usize,
    shape: usize,
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> Models<O, T, R> {
    /// Creates the systems with the same system in every lane.
    pub(crate) fn splat(system: &O) -> Self {
        let constants = RefCell::new(Vec::new());
        let registers = convert(system, &|constant| {
            let register = R::splat(constant);
            constants.borrow_mut().push(register);
            register
        });
        Self {
            registers,
            constants: constants.into_inner(),
            dimension: system.dimension(),
            shape: system.shape(),
        }
    }

    /// Returns the number of components of a state, as a compile-time constant if the type has one.
    #[inline(always)]
    pub(crate) fn dimension(&self) -> usize {
        match O::DIMENSION {
            Some(dimension) => dimension,
            None => self.dimension,
        }
    }

    /// Puts a system into a lane and leaves the other lanes unchanged.
    ///
    /// # Errors
    /// If the system differs from the first one in more than its constants.
    pub(crate) fn set(&mut self, lane: usize, system: &O) -> Result<(), InputError<T>> {
        let (expected, found) = (self.dimension, system.dimension());
        if expected != found {
            return Err(InputError::Dimension { expected, found });
        }
        if self.shape != system.shape() {
            return Err(InputError::Shape);
        }
        let mut constants = self.constants.clone();
        let places = Cell::from_mut(&mut *constants).as_slice_of_cells();
        let next = Cell::new(0);
        let registers = convert(system, &|constant| {
            // Surplus constants are refused below.
            let Some(place) = places.get(next.replace(next.get() + 1)) else {
                return R::splat(constant);
            };
            let mut register = place.get();
            set_lane(&mut register, lane, constant);
            place.set(register);
            register
        });
        let (expected, found) = (constants.len(), next.get());
        if expected != found {
            return Err(InputError::Constants { expected, found });
        }
        (self.constants, self.registers) = (constants, registers);
        Ok(())
    }
}

/// Converts a system to one whose constants are registers. Takes `&dyn Fn` so that the function is
/// compiled once for all conversions.
fn convert<O: CastOde<T>, T: Lane, R: Simd<T>>(system: &O, convert: &dyn Fn(T) -> R) -> O::Of<R> {
    system.cast(convert)
}
