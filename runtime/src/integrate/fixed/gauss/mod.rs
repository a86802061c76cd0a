//! Symplectic, symmetric Gauss–Legendre methods.

mod iteration;
mod solve;
mod step;

pub(super) use self::step::GaussStep;
use super::grid::GridSteps;
use super::grid_position::Grid;
use crate::integrate::error::InputError;
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::GaussOrder;
use crate::scalar::Real;
use crate::system::{Ode, State};

/// Iteration that solves the implicit equations of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Solver {
    /// Fixed-point iteration: cheap and without derivatives. It converges if the step is short
    /// compared with the shortest time scale of the system.
    FixedPoint,
    /// Newton's method, for stiff friction and long steps. The matrix of derivatives is computed by
    /// differences and used for as many steps as possible. Its accuracy affects only the speed of
    /// convergence, not the solution.
    Newton,
}

/// Gauss–Legendre methods of order 2, 4, 6 and 8 with steps of constant length: symmetric, and
/// symplectic if the state is canonical.
///
/// If the state consists of coordinates and momenta ([`CanonicalVariables`]), the energy of a
/// conservative system does not drift: even in a long run its error stays as small as in one step,
/// plus a random walk of rounding. If it consists of angles and velocities, the methods are only
/// symmetric, which for reversible motion does nearly as well.
///
/// Explicit kick-drift splittings (leapfrog, Störmer–Verlet, Yoshida) do not apply: they need a
/// kinetic energy that depends on the momenta alone, H = T(p) + U(q). The kinetic energy of links
/// that hang from other links depends on the angles.
///
/// [`Projected`] keeps the energy to rounding at every step, but is neither symmetric nor
/// symplectic.
///
/// The equations of a step are iterated until rounding stops the progress, sums are compensated,
/// and coefficients have more digits than one number holds. So rounding does not add up to a drift.
/// A step that cannot be solved is divided into halves, at most [`halvings`](Self::halvings) times;
/// then the run ends with [`IntegrationError::NotSolved`]. Halved steps are not symplectic;
/// [`Report::rejected`] counts them.
///
/// Values within a step are those of the collocation polynomial, whose order is the number of
/// stages, half the order at the ends. Memory: 3 s + 7 vectors of the state's length n for s
/// stages; with Newton's method also two matrices of s²n² and n² entries. Steps allocate nothing.
///
/// In lanes ([`Ensemble::integrate_in_lanes`]) each state has the bits of a run by itself. The
/// iteration continues until all lanes are solved.
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd edition, Springer 2006,
/// sections II.1.3, VI.4 and VIII.6; Hairer, McLachlan, Razakarivony, *Achieving Brouwer's law with
/// implicit Runge–Kutta methods*, BIT 48 (2008) 231–243.
///
/// [`CanonicalVariables`]: type@crate::system::CanonicalVariables
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
    /// Length of the steps, positive for both directions. The last step is shorter if the span is
    /// not a multiple of it.
    pub step: T,
    /// Iteration that solves the implicit equations of a step.
    pub solver: Solver,
    /// Largest change in an iteration, relative to the size of the component, at which a step
    /// counts as solved. If zero, the iteration continues down to rounding, as is necessary for the
    /// energy over long times.
    pub tolerance: T,
    /// Number of iterations after which a step counts as not solved.
    pub iteration_limit: u32,
    /// Number of times that a step may be halved before the run ends with an error.
    pub halvings: u32,
    /// Number of steps, completed and failed, after which a run ends with an error.
    pub step_limit: u64,
}

impl<T: Real> Gauss<T> {
    /// Creates the method of order `order` with steps of length `step`. Defaults: fixed-point
    /// iteration with at most 50 iterations, at most 10 halvings, no limit on the number of steps.
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

    /// Creates the implicit midpoint rule for steps as long as a frame of an animation: Newton's
    /// method, ended at a relative change of [`Real::EPSILON`]^¾.
    ///
    /// The accuracy suffices only for looking at the motion, but the method is stable: the
    /// amplitude of a linear oscillation is constant for any length of step, friction of any
    /// strength is stable, and the energy of a conservative motion oscillates about its value, by
    /// 1.5 % (2 % in `f32`) for the paper's pendulum, released from 86°, in ten minutes of 60 steps
    /// a second. A step takes ten evaluations there, five in `f32`.
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
