//! Explicit Runge–Kutta pairs, each with a table of coefficients and an error estimate.
//!
//! [`stages`] contains the arithmetic of a step, for a single state or for one state in each lane;
//! [`steps`] integrates one trajectory, [`lanes`] many.

mod dense_output;
mod dop853;
mod dopri5;
#[cfg(feature = "std")]
mod lanes;
#[cfg(test)]
mod order_conditions;
mod pair;
mod stages;
mod steps;
mod verner98;

use core::marker::PhantomData;

pub(in crate::integrate) use self::pair::EmbeddedPair;
use self::steps::PairSteps;
use super::error::{InputError, IntegrationError};
use super::evaluator::{Evaluator, NonFinite};
use super::options::Options;
use super::report::Report;
use super::request::{all_finite, check_start};
use super::right_hand_side::StepSpan;
use super::steps::Failure;
use crate::scalar::Real;
use crate::system::{Ode, State, Workspace};

pub use self::dop853::DormandPrince8;
pub use self::dopri5::DormandPrince5;
pub use self::verner98::Verner9;

/// The explicit Runge–Kutta method of J. R. Dormand and P. J. Prince of order 8, with error
/// estimates of order 5 and 3 and dense output of order 7.
///
/// Takes twelve evaluations of the right-hand side for an accepted step, eleven for a rejected one,
/// and three more if values within a step are requested. Memory: 16 + 14 vectors of the state's
/// length.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd edition,
/// Springer 1993, section II.10.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0];
/// });
/// let start = State::at_rest(0.0, &[1.0]);
/// let method = Dop853::new(Options::with_tolerance(1e-12));
///
/// // Stop at the first step that passes through zero.
/// let solution = method.integrate(&oscillator, &start, 10.0, |step| {
///     if step.end()[0] < 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert_eq!(solution.report.stop, StopReason::StoppedByObserver);
/// assert!((solution.state.values[0] - solution.state.time.cos()).abs() < 1e-11);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub type Dop853<T> = ExplicitRungeKutta<DormandPrince8, T>;

/// The explicit Runge–Kutta method of J. R. Dormand and P. J. Prince of order 5, with an error
/// estimate of order 4 and dense output of order 4, for loose tolerances.
///
/// Takes six evaluations of the right-hand side for each step, accepted or rejected, and none for
/// values within a step. Memory: 7 + 12 vectors of the state's length.
///
/// The error estimate is multiplied by twenty, unlike in the authors' program, so that at equal
/// tolerance the error of a run is not far above that of the methods of higher order.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd edition,
/// Springer 1993, table II.5.2 and section II.6.
pub type Dopri5<T> = ExplicitRungeKutta<DormandPrince5, T>;

/// J. H. Verner's "most efficient" explicit Runge–Kutta method of order 9, with an error estimate
/// of order 8 and dense output of order 8, for tight tolerances.
///
/// Takes sixteen evaluations of the right-hand side for an accepted step, fifteen for a rejected
/// one, and four more if values within a step are requested. Memory: 21 + 15 vectors of the state's
/// length.
///
/// Source: J. H. Verner, *Numerically optimal Runge–Kutta pairs with interpolants*, Numerical
/// Algorithms 53 (2010) 383–396; coefficients in the author's later, better version of 7 April
/// 2024.
pub type Verner98<T> = ExplicitRungeKutta<Verner9, T>;

/// An adaptive explicit Runge–Kutta method: an embedded pair and its options.
///
/// Used under the names of its pairs:
///
/// | pair | order | dense output | for |
/// |---|---|---|---|
/// | [`Dopri5`] | 5(4) | 4 | tolerances above 1e-5 |
/// | [`Dop853`] | 8(5,3) | 7 | most problems |
/// | [`Verner98`] | 9(8) | 8 | tolerances below 1e-10 |
///
/// Coefficients are rounded to `f64`. In number types with more digits, the error of a run is
/// therefore about 1e-16 per unit of time, at any tolerance; [`Taylor`](super::Taylor) has no such
/// limit.
///
/// All memory is allocated when a run starts. Steps allocate nothing.
///
/// A run depends only on its arguments: the same input gives the same bits. A run that an observer
/// or the step limit has stopped continues with exactly the steps that it would have made, if it is
/// started from its last state with [`Report::next_step`] as the initial step, [`Options::beta`] is
/// zero and [`Options::compensated`] is off. The memory of these two options is not part of a
/// [`State`].
///
/// [`Report::next_step`]: super::Report::next_step
#[derive(Clone, Debug)]
pub struct ExplicitRungeKutta<M, T> {
    pub(super) options: Options<T>,
    pair: PhantomData<M>,
}

/// Returns the smallest useful relative tolerance. Below it the error estimate is mostly rounding:
/// ten times the steps are needed for each further digit of the tolerance, and the error stays the
/// same.
fn smallest_tolerance<T: Real>() -> T {
    T::EPSILON * T::from_f64(0.25)
}

impl<M: EmbeddedPair, T: Real> ExplicitRungeKutta<M, T> {
    /// Creates the method with these options, which are checked when a run starts.
    pub fn new(options: Options<T>) -> Self {
        Self {
            options,
            pair: PhantomData,
        }
    }

    /// Returns the options of the method.
    pub fn options(&self) -> &Options<T> {
        &self.options
    }

    /// Makes one step of length `step` (negative: backwards), without error control.
    ///
    /// For tests of the method and for callers that choose their own steps. Evaluates the stages
    /// once and allocates. Tolerances and step limits are ignored, and sums are not compensated.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] if an argument is invalid, or if the state or its rates are not finite.
    pub fn step<O: Ode<T> + ?Sized>(
        &self,
        ode: &O,
        start: &State<T>,
        step: T,
    ) -> Result<State<T>, IntegrationError<T>> {
        check_start(ode, (start.time, &start.values))?;
        self.options.validate(start.values.len())?;
        if !step.is_finite() {
            return Err(InputError::FixedStep { value: step }.into());
        }
        let (time, end_time) = (start.time, start.time + step);
        let mut report = Report::new();
        let system = &mut Evaluator {
            ode,
            dimension: start.values.len(),
            workspace: &mut Workspace::new(),
            report: &mut report,
        };
        let stages = &mut PairSteps::<M, T>::new(&self.options, start).stages;
        let made = stages
            .evaluate_start(system, time)
            .and_then(|()| stages.make::<M, _>(system, StepSpan { time, step }))
            .and_then(|()| {
                if all_finite(&stages.end) {
                    Ok(())
                } else {
                    Err(NonFinite::new(end_time, &stages.end))
                }
            });
        match made {
            Ok(()) => Ok(State::new(end_time, stages.end.clone())),
            Err(place) => Err(Failure::from(place).error(start.clone(), &report)),
        }
    }
}
