//! The symplectic, symmetric Gauss–Legendre methods.

mod iteration;
mod solve;
mod step;

pub(super) use self::step::GaussStep;
use super::grid::GridSteps;
use super::place::Grid;
use crate::integrate::error::InputError;
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::GaussOrder;
use crate::scalar::Real;
use crate::system::{Ode, State};

/// The iteration that solves the equations of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Solver {
    /// Fixed-point iteration: no derivatives, cheap, and converges where the
    /// step is short beside the shortest time scale of the system.
    FixedPoint,
    /// Newton's method with one matrix of derivatives, by differences, for as
    /// many steps as it serves: for stiff friction and long steps. The
    /// derivatives decide how fast it converges, never where to.
    Newton,
}

/// The Gauss–Legendre methods of order 2, 4, 6 and 8, with steps of one
/// length: symmetric, and symplectic where the state is canonical.
///
/// With coordinates and momenta as state ([`Canonical`]) the energy of a
/// conservative system does not drift, however long the run: its error stays
/// that of one step, plus a random walk of rounding. With angles and
/// velocities as state the methods are symmetric only, which for reversible
/// motion does nearly as well.
///
/// Kick-drift splittings (leapfrog, Störmer–Verlet, Yoshida) would be explicit,
/// but need a kinetic energy of the momenta alone, and that of links that hang from
/// other links depends on the angles, H ≠ T(p) + U(q). A splitting would be neither
/// symplectic nor of its order then, and there is none here.
///
/// [`Projected`] keeps the energy to rounding at every step, at the price of
/// both properties.
///
/// The equations of a step are iterated until rounding stops them, sums are
/// compensated and coefficients carry more digits than one number holds: that
/// keeps rounding from adding up to a drift. A step that cannot be solved is
/// made in halves, at most [`halvings`](Self::halvings) times, and then the run
/// ends with [`IntegrationError::NotSolved`]. Halved steps cost the symplectic
/// property; [`Report::rejected`] counts them.
///
/// Values inside a step are those of the collocation polynomial, whose order
/// is the number of stages, half the order at the ends. Memory: 3 s + 7 vectors
/// of the state's length n for s stages; with Newton's method two matrices of
/// s²n² and n² entries more. Steps allocate nothing.
///
/// In lanes ([`Ensemble::integrate_in_lanes`]) each state has the bits that it has alone; the
/// iteration goes on until the last lane is solved.
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd
/// edition, Springer 2006, sections II.1.3, VI.4 and VIII.6; Hairer, McLachlan,
/// Razakarivony, *Achieving Brouwer's law with implicit Runge–Kutta methods*,
/// BIT 48 (2008) 231–243.
///
/// [`Canonical`]: crate::system::Canonical
/// [`Ensemble::integrate_in_lanes`]: crate::ensemble::Ensemble::integrate_in_lanes
/// [`IntegrationError::NotSolved`]: crate::integrate::IntegrationError::NotSolved
/// [`Projected`]: crate::integrate::Projected
/// [`Report::rejected`]: crate::integrate::Report::rejected
///
/// # Examples
///
/// ```
/// use branched_pendulum::integrate::{Gauss, GaussOrder};
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// // A pendulum: H = p²/2 − cos q.
/// let pendulum = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0].sin();
/// });
/// let energy = |y: &[f64]| 0.5 * y[1] * y[1] - y[0].cos();
/// let start = State::at_rest(0.0, &[2.0]);
/// let mut worst = 0.0_f64;
/// Gauss::new(GaussOrder::Six, 0.1).integrate(&pendulum, &start, 1000.0, |step| {
///     worst = worst.max((energy(step.end()) - energy(&start.values)).abs());
///     ControlFlow::Continue(())
/// })?;
/// assert!(worst < 1e-9);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gauss<T> {
    /// Order of the method.
    pub order: GaussOrder,
    /// Length of the steps, positive whatever the direction. The last one is
    /// shorter where the span is no multiple of it.
    pub step: T,
    /// The iteration that solves the equations of a step.
    pub solver: Solver,
    /// Largest change in an iteration, relative to the size of its component,
    /// with which a step counts as solved. Zero iterates until rounding, as the
    /// energy over long times needs it.
    pub tolerance: T,
    /// Iterations after which a step counts as not solved.
    pub iteration_limit: u32,
    /// Number of times that a step may be halved before the run ends with an error.
    pub halvings: u32,
    /// Number of steps, made and failed together, after which a run ends with
    /// an error.
    pub step_limit: u64,
}

impl<T: Real> Gauss<T> {
    /// The method of order `order` with steps of length `step`: fixed-point
    /// iteration of at most 50 rounds, at most 10 halvings, no limit on the
    /// number of steps.
    pub fn new(order: GaussOrder, step: T) -> Self {
        Self {
            order,
            step,
            solver: Solver::FixedPoint,
            tolerance: T::ZERO,
            iteration_limit: 50,
            halvings: 10,
            step_limit: u64::MAX,
        }
    }

    /// The implicit midpoint rule for steps as long as a frame of an animation:
    /// Newton's method, ended at a change of [`Real::EPSILON`]^¾.
    ///
    /// No accuracy beyond the eye's, but no instability: the amplitude of a
    /// linear oscillation stays what it is at any length of step, friction is
    /// stable at any strength, and the energy of a conservative motion swings
    /// about its value: by 1.5 % for the paper's pendulum, released from 86°, in
    /// ten minutes of 60 steps a second, by 2 % in `f32`. There a step takes ten
    /// evaluations, five in `f32`.
    ///
    /// Source: Hairer, Wanner, *Solving ODEs II*, section IV.12 (B-stability).
    pub fn for_animation(step: T) -> Self {
        Self {
            solver: Solver::Newton,
            tolerance: T::EPSILON.powf(T::from_f64(0.75)),
            ..Self::new(GaussOrder::Two, step)
        }
    }

    pub(super) fn grid(&self) -> Grid<T> {
        Grid {
            step: self.step,
            halvings: self.halvings,
            step_limit: self.step_limit,
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> Integrator<T, O> for Gauss<T> {
    type Steps = GridSteps<GaussStep<T, T>, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>> {
        let step = GaussStep::new(self, start.values.clone());
        Ok(GridSteps::new(step, self.grid().place()?))
    }
}
