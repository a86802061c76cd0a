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

    /// The state of some of a model's links, in this order: to go on with a model of
    /// fewer links after others have fallen off, which takes no velocity from those that
    /// stay. None where a link is not there.
    ///
    /// A part that falls off takes its energy and momentum with it, and what stays keeps its
    /// velocities. What lands at rest and sticks leaves the momenta as they are instead:
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
