//! States of a system at a single time.

use alloc::vec::Vec;
use core::fmt;

use crate::scalar::Scalar;

/// A time and the values of all components at that time.
///
/// For a second-order system, the first half of the values are positions (rad) and the second half
/// are velocities (rad/s).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State<T> {
    /// Time, in seconds.
    pub time: T,
    /// All components of the state.
    pub values: Vec<T>,
}

impl<T: Scalar> State<T> {
    /// Creates the state `values` at `time` (s).
    pub fn new(time: T, values: Vec<T>) -> Self {
        Self { time, values }
    }

    /// Creates a state of a second-order system at `time` (s).
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

    /// Creates a state of a second-order system at `time` (s) with all velocities zero.
    pub fn at_rest(time: T, positions: &[T]) -> Self {
        let mut values = positions.to_vec();
        values.resize(2 * positions.len(), T::from_f64(0.0));
        Self { time, values }
    }

    /// Returns the state of some of a model's links, in the order of `links`; `None` if a link does
    /// not exist. This is the initial state of a model without the other links, after they have
    /// fallen off.
    ///
    /// A part that falls off takes its energy and momentum with it, and the remaining links keep
    /// their velocities. A part that lands at rest and sticks conserves the momenta instead: use
    /// `new.velocities(theta, &old.momenta(theta, omega))` with `emit(momenta)`.
    ///
    /// # Examples
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::prelude::*;
    ///
    /// /// A limb with a fruit and a twig, or with snow on both.
    /// #[branched_pendulum(
    ///     gravity = 9.80665,
    ///     limb: rod(mass = 0.4 + snow, length = 0.5) [
    ///         fruit: ball(mass = 0.2, length = 0.1, radius = 0.03),
    ///         twig: rod(mass = 0.1 + snow, length = 0.3),
    ///     ],
    ///     emit(momenta),
    /// )]
    /// struct Laden;
    ///
    /// #[branched_pendulum(
    ///     gravity = 9.80665,
    ///     limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3)],
    /// )]
    /// struct Bare;
    ///
    /// let laden = Laden::new(LadenParameters { snow: 0.0 })?;
    /// let state = State::from_positions_and_velocities(0.0, &[0.5, 0.3, -0.2], &[2.0, 1.0, -3.0])?;
    ///
    /// // The fruit falls.
    /// let bare = state.of_links(&[0, 2]).expect("it has these links");
    /// let method = Dop853::new(Options::with_tolerance(1e-9));
    /// method.run(&AbsoluteAngles(Bare::new()), &bare, 1.0)?;
    ///
    /// // Or snow falls on it.
    /// let (theta, omega) = ([0.5, 0.3, -0.2], [2.0, 1.0, -3.0]);
    /// let snowy = Laden::new(LadenParameters { snow: 0.1 })?;
    /// let slower = snowy.velocities(&theta, &laden.momenta(&theta, &omega));
    /// assert!(slower[0].abs() < omega[0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn of_links(&self, links: &[usize]) -> Option<Self> {
        let (positions, velocities) = (self.positions(), self.velocities());
        let angles = links.iter().map(|&link| positions.get(link));
        let rates = links.iter().map(|&link| velocities.get(link));
        let values: Option<Vec<T>> = angles.chain(rates).map(|value| value.copied()).collect();
        Some(Self {
            time: self.time,
            values: values?,
        })
    }

    /// Returns the first half of the components, rounded down if their number is odd.
    pub fn positions(&self) -> &[T] {
        self.values.split_at(self.values.len() / 2).0
    }

    /// Returns the second half of the components, which follow the [`positions`](Self::positions).
    pub fn velocities(&self) -> &[T] {
        self.values.split_at(self.values.len() / 2).1
    }
}

/// Error: a state was given different numbers of positions and velocities.
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
