//! States of systems.

use alloc::vec::Vec;
use core::fmt;

use crate::scalar::Scalar;

/// A time and the values of all components at that time.
///
/// For a second-order system the first half are positions (rad) and the second
/// half velocities (rad/s).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State<T> {
    /// Time, in seconds.
    pub time: T,
    /// All components.
    pub values: Vec<T>,
}

impl<T: Scalar> State<T> {
    /// The state `values` at `time`.
    pub fn new(time: T, values: Vec<T>) -> Self {
        Self { time, values }
    }

    /// A state of a second-order system at `time`.
    ///
    /// # Errors
    ///
    /// [`LengthMismatch`] unless both slices have the same length.
    pub fn from_positions_and_velocities(
        time: T,
        positions: &[T],
        velocities: &[T],
    ) -> Result<Self, LengthMismatch> {
        if positions.len() != velocities.len() {
            return Err(LengthMismatch {
                positions: positions.len(),
                velocities: velocities.len(),
            });
        }
        Ok(Self {
            time,
            values: [positions, velocities].concat(),
        })
    }

    /// A state of a second-order system with all velocities zero.
    pub fn at_rest(time: T, positions: &[T]) -> Self {
        let mut values = positions.to_vec();
        values.resize(2 * positions.len(), T::from_f64(0.0));
        Self { time, values }
    }

    /// The first half of the components, rounded down where their number is
    /// odd.
    pub fn positions(&self) -> &[T] {
        self.values.split_at(self.values.len() / 2).0
    }

    /// The components that [`positions`](Self::positions) leaves.
    pub fn velocities(&self) -> &[T] {
        self.values.split_at(self.values.len() / 2).1
    }
}

/// Positions and velocities of a state differ in number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthMismatch {
    /// Number of positions given.
    pub positions: usize,
    /// Number of velocities given.
    pub velocities: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            positions,
            velocities,
        } = self;
        write!(
            formatter,
            "a state needs as many velocities as positions, \
             but got {positions} positions and {velocities} velocities"
        )
    }
}

impl core::error::Error for LengthMismatch {}
