//! The traits that emitted code implements, and the systems that integrators
//! see.
//!
//! A description becomes a type that implements [`Pendulum`] (accelerations in
//! absolute angles), [`Energy`], and, where the tree has identical siblings,
//! [`SymmetricPendulum`]. Integrators know none of these: they integrate an
//! [`Ode`], a first-order system. [`AbsoluteAngles`] and
//! [`SymmetricCoordinates`] turn one into the other.

mod canonical;
pub(crate) mod cast;
mod first_integral;
mod link_name;
mod taylor;
mod workspace;

use alloc::vec::Vec;
use core::fmt;

use crate::scalar::Scalar;

pub use canonical::{Canonical, CanonicalVariables};
pub use cast::Cast;
#[doc(hidden)]
pub use cast::InRegisters;
pub use first_integral::{CanonicalEnergy, FirstIntegral};
pub use link_name::LinkName;
pub use taylor::{TaylorOde, TaylorPendulum};
pub use workspace::Workspace;

/// Equations of motion in absolute angles.
///
/// Angles are measured from the downward vertical, in radians; links stand in
/// parent-before-child order.
pub trait Pendulum<T: Scalar> {
    /// Number of links, each with one angle.
    const LINKS: usize;

    /// Names of the links, as described, in the order of the angles. Empty for
    /// trees whose code is loops over generations: their links are too many for a
    /// list, and have a [`link_name`](Self::link_name) all the same.
    const LINK_NAMES: &'static [&'static str];

    /// Name of the link with that index, if there is one.
    #[must_use]
    fn link_name(index: usize) -> Option<LinkName> {
        Self::LINK_NAMES
            .get(index)
            .map(|name| LinkName::listed(name))
    }

    /// Writes the angular accelerations, in rad/s², of a pendulum with angles
    /// `theta` (rad) and angular velocities `omega` (rad/s) at `time` (s).
    ///
    /// Emitted models in `f64` and `f32` fuse products with sums where the machine
    /// can: [`scalar`](crate::scalar#which-bits).
    ///
    /// All three slices have length [`LINKS`](Self::LINKS). An implementation
    /// must stay memory-safe for other lengths and must not make up values;
    /// filling `alpha` with NaN is the way to say that there is no answer.
    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]);

    /// Writes the same accelerations as
    /// [`accelerations_into`](Self::accelerations_into), in memory that the caller
    /// keeps: for trees in loops, which would allocate it for every evaluation.
    #[inline]
    fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let _ = workspace;
        self.accelerations_into(time, theta, omega, alpha);
    }
}

/// Equations of motion in symmetric coordinates: means and differences of
/// identical sibling subtrees.
///
/// There are as many coordinates as links. A set of differences that is
/// exactly zero, with its rates, has accelerations that are exactly zero.
pub trait SymmetricPendulum<T: Scalar>: Pendulum<T> {
    /// Names of the coordinates, in order.
    const COORDINATE_NAMES: &'static [&'static str];

    /// Writes the second time derivatives of the coordinates, in rad/s², for
    /// `coordinates` (rad) and `rates` (rad/s) at `time` (s).
    ///
    /// Lengths as in [`Pendulum::accelerations_into`].
    fn symmetric_accelerations_into(
        &self,
        time: T,
        coordinates: &[T],
        rates: &[T],
        accelerations: &mut [T],
    );
}

/// Kinetic and potential energy in absolute angles, in joules.
pub trait Energy<T: Scalar>: Pendulum<T> {
    /// Kinetic energy for angles `theta` (rad) and angular velocities `omega`
    /// (rad/s); both of length [`Pendulum::LINKS`].
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T;

    /// Potential energy for angles `theta` (rad), of length
    /// [`Pendulum::LINKS`]; zero where every link hangs straight down.
    fn potential_energy_of(&self, theta: &[T]) -> T;

    /// Returns the kinetic energy, in memory that the caller keeps: trees in loops
    /// need some, and allocate it for every call of
    /// [`kinetic_energy_of`](Self::kinetic_energy_of).
    #[inline]
    fn kinetic_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let _ = workspace;
        self.kinetic_energy_of(theta, omega)
    }

    /// Returns the potential energy, in memory that the caller keeps.
    #[inline]
    fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let _ = workspace;
        self.potential_energy_of(theta)
    }
}

/// A system of first-order ordinary differential equations y' = f(t, y).
pub trait Ode<T> {
    /// Number of components of the state.
    fn dimension(&self) -> usize;

    /// Writes f(t, y) to `rates`. Both slices have length
    /// [`dimension`](Self::dimension).
    ///
    /// Where f is not defined, write NaN: integrators stop there at once, with
    /// the time and the state.
    fn rates(&self, time: T, state: &[T], rates: &mut [T]);

    /// Writes the same rates as [`rates`](Self::rates), in memory that the caller
    /// keeps. Integrators call this one. Systems that need no memory leave it as it
    /// is.
    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let _ = workspace;
        self.rates(time, state, rates);
    }
}

impl<T, O: Ode<T> + ?Sized> Ode<T> for &O {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        (**self).rates(time, state, rates);
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        (**self).rates_with(workspace, time, state, rates);
    }
}

/// A function as an [`Ode`].
///
/// # Examples
///
/// ```
/// use branched_pendulum::system::{Ode, OdeFn};
///
/// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0];
/// });
/// let mut rates = [0.0; 2];
/// oscillator.rates(0.0, &[1.0, 0.5], &mut rates);
/// assert_eq!(rates, [0.5, -1.0]);
/// ```
#[derive(Clone, Copy)]
pub struct OdeFn<F> {
    dimension: usize,
    function: F,
}

impl<F> OdeFn<F> {
    /// The system of `dimension` equations whose rates `function(time, state,
    /// rates)` writes.
    pub fn new<T>(dimension: usize, function: F) -> Self
    where
        F: Fn(T, &[T], &mut [T]),
    {
        Self {
            dimension,
            function,
        }
    }
}

impl<F> fmt::Debug for OdeFn<F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            dimension,
            function: _,
        } = self;
        formatter
            .debug_struct("OdeFn")
            .field("dimension", dimension)
            .finish_non_exhaustive()
    }
}

impl<T, F: Fn(T, &[T], &mut [T])> Ode<T> for OdeFn<F> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        (self.function)(time, state, rates);
    }
}

/// A pendulum as a first-order system in absolute angles: the state is the
/// angles followed by the angular velocities.
#[derive(Clone, Copy, Debug)]
pub struct AbsoluteAngles<'a, P>(pub &'a P);

impl<T: Scalar, P: Pendulum<T>> Ode<T> for AbsoluteAngles<'_, P> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        second_order(P::LINKS, state, rates, |theta, omega, alpha| {
            self.0.accelerations_into(time, theta, omega, alpha);
        });
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        second_order(P::LINKS, state, rates, |theta, omega, alpha| {
            self.0
                .accelerations_with(workspace, time, theta, omega, alpha);
        });
    }
}

/// A pendulum as a first-order system in symmetric coordinates: the state is
/// the coordinates followed by their rates.
#[derive(Clone, Copy, Debug)]
pub struct SymmetricCoordinates<'a, P>(pub &'a P);

impl<T: Scalar, P: SymmetricPendulum<T>> Ode<T> for SymmetricCoordinates<'_, P> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        second_order(
            P::LINKS,
            state,
            rates,
            |coordinates, velocities, accelerations| {
                self.0
                    .symmetric_accelerations_into(time, coordinates, velocities, accelerations);
            },
        );
    }
}

/// q' = v, v' = a(q, v). Slices of another length than 2n have no answer, and
/// get NaN.
#[inline]
fn second_order<T: Scalar>(
    n: usize,
    state: &[T],
    rates: &mut [T],
    accelerations: impl FnOnce(&[T], &[T], &mut [T]),
) {
    if state.len() != 2 * n || rates.len() != 2 * n {
        rates.fill(T::from_f64(f64::NAN));
        return;
    }
    let (positions, velocities) = state.split_at(n);
    let (position_rates, velocity_rates) = rates.split_at_mut(n);
    position_rates.copy_from_slice(velocities);
    accelerations(positions, velocities, velocity_rates);
}

/// A time and the values of all components at that time.
///
/// For a second-order system the first half are positions (rad) and the second
/// half velocities (rad/s).
#[derive(Clone, Debug, PartialEq)]
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

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::{AbsoluteAngles, Ode, Pendulum, State, SymmetricCoordinates, SymmetricPendulum};
    use crate::scalar::Scalar;

    struct Uncoupled;

    impl<T: Scalar> Pendulum<T> for Uncoupled {
        const LINKS: usize = 2;
        const LINK_NAMES: &'static [&'static str] = &["left", "right"];

        fn accelerations_into(&self, time: T, theta: &[T], _omega: &[T], alpha: &mut [T]) {
            for (alpha, theta) in alpha.iter_mut().zip(theta) {
                *alpha = time - *theta;
            }
        }
    }

    impl<T: Scalar> SymmetricPendulum<T> for Uncoupled {
        const COORDINATE_NAMES: &'static [&'static str] = &["mean", "difference"];

        fn symmetric_accelerations_into(&self, _time: T, _q: &[T], rates: &[T], out: &mut [T]) {
            out.copy_from_slice(rates);
        }
    }

    #[test]
    fn adapters_put_velocities_first_and_accelerations_second() {
        let mut rates = [0.0; 4];
        AbsoluteAngles(&Uncoupled).rates(10.0, &[1.0, 2.0, 3.0, 4.0], &mut rates);
        assert_eq!(rates, [3.0, 4.0, 9.0, 8.0]);
        SymmetricCoordinates(&Uncoupled).rates(10.0, &[1.0, 2.0, 3.0, 4.0], &mut rates);
        assert_eq!(rates, [3.0, 4.0, 3.0, 4.0]);
        let ode: &dyn Ode<f64> = &AbsoluteAngles(&Uncoupled);
        assert_eq!(ode.dimension(), 4);
    }

    #[test]
    fn a_state_of_wrong_length_gets_nan_and_no_panic() {
        let mut rates = [0.0_f64; 3];
        AbsoluteAngles(&Uncoupled).rates(0.0, &[1.0, 2.0, 3.0], &mut rates);
        assert!(rates.iter().all(|rate| rate.is_nan()));
    }

    #[test]
    fn halves_of_a_state() {
        let state = State::from_positions_and_velocities(0.5, &[1.0, 2.0], &[3.0, 4.0]).unwrap();
        assert_eq!(state.time, 0.5);
        assert_eq!(state.positions(), [1.0, 2.0]);
        assert_eq!(state.velocities(), [3.0, 4.0]);
        assert_eq!(State::at_rest(0.0, &[1.0]).values, [1.0, 0.0]);
        let error = State::from_positions_and_velocities(0.0, &[1.0], &[]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a state needs as many velocities as positions, but got 1 positions and 0 velocities"
        );
    }
}
