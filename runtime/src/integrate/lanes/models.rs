//! Systems side by side: one in each lane.

// The interface of a sealed trait names the type.
#![allow(unreachable_pub)]

use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

use crate::integrate::error::InputError;
use crate::integrate::registers::set_lane;
use crate::scalar::Lane;
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
        let mut constants = self.constants.clone();
        let places = Cell::from_mut(&mut *constants).as_slice_of_cells();
        let next = Cell::new(0);
        let registers = convert(system, &|constant| {
            // Too many are refused below.
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

/// Returns a system of registers: in one function, whatever `convert` does with the constants.
fn convert<O: LaneOde<T>, T: Lane, R: Simd<T>>(system: &O, convert: &dyn Fn(T) -> R) -> O::Of<R> {
    system.on_scalar(convert)
}
