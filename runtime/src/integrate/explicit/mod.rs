//! Explicit Runge–Kutta pairs: a table of coefficients and an estimate each.
//!
//! [`stages`] has the arithmetic of a step, for one state or for one in each lane;
//! [`steps`] the steps of one trajectory, [`lanes`] those of many.

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

use self::pair::EmbeddedPair;
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

/// The explicit Runge–Kutta method of J. R. Dormand and P. J. Prince of order
/// 8, with error estimates of order 5 and 3 and dense output of order 7.
///
/// Twelve evaluations of the right-hand side for an accepted step, eleven for
/// a rejected one, three more where values inside a step are asked for.
/// Memory: 16 + 14 vectors of the state's length.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
/// I*, 2nd edition, Springer 1993, section II.10.
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

/// The explicit Runge–Kutta method of J. R. Dormand and P. J. Prince of order
/// 5, with an error estimate of order 4 and dense output of order 4: for loose
/// tolerances.
///
/// Six evaluations of the right-hand side for an accepted or a rejected step,
/// none for values inside. Memory: 7 + 12 vectors of the state's length.
///
/// The error estimate counts twentyfold, unlike in the authors' program: at
/// equal tolerance the error of a run is then not far above that of the methods
/// of higher order.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
/// I*, 2nd edition, Springer 1993, table II.5.2 and section II.6.
pub type Dopri5<T> = ExplicitRungeKutta<DormandPrince5, T>;

/// J. H. Verner's "most efficient" explicit Runge–Kutta method of order 9, with
/// an error estimate of order 8 and dense output of order 8: for tight
/// tolerances.
///
/// Sixteen evaluations of the right-hand side for an accepted step, fifteen for
/// a rejected one, four more where values inside a step are asked for. Memory:
/// 21 + 15 vectors of the state's length.
///
/// Source: J. H. Verner, *Numerically optimal Runge–Kutta pairs with
/// interpolants*, Numerical Algorithms 53 (2010) 383–396; coefficients in the
/// author's later, better version of 7 April 2024.
pub type Verner98<T> = ExplicitRungeKutta<Verner9, T>;

/// An adaptive explicit Runge–Kutta method: an embedded pair and options.
///
/// Used by the names of its pairs:
///
/// | pair | order | dense output | for |
/// |---|---|---|---|
/// | [`Dopri5`] | 5(4) | 4 | tolerances above 1e-5 |
/// | [`Dop853`] | 8(5,3) | 7 | most things |
/// | [`Verner98`] | 9(8) | 8 | tolerances below 1e-10 |
///
/// Coefficients are rounded to `f64`: in numbers of more digits a run is good to some 1e-16 for
/// each unit of time, whatever the tolerance. [`Taylor`](super::Taylor) has all digits.
///
/// All memory is allocated when a run starts; steps allocate nothing.
///
/// Same input, same target, same bits: nothing in a run depends on anything
/// but its arguments. A run that an observer or the step limit has stopped
/// continues with exactly the steps that it would have made, when started
/// again from its last state with [`Report::next_step`] as initial step,
/// provided that [`Options::beta`] is zero and [`Options::compensated`] is
/// off: the memory of the two is not part of a [`State`].
///
/// [`Report::next_step`]: super::Report::next_step
#[derive(Clone, Debug)]
pub struct ExplicitRungeKutta<M, T> {
    pub(super) options: Options<T>,
    pair: PhantomData<M>,
}

/// The smallest relative tolerance of use. Below it the estimate of the error is mostly its
/// own rounding: steps get ten times as many for each digit that is asked for, and the
/// error stays.
fn smallest_tolerance<T: Real>() -> T {
    T::EPSILON * T::from_f64(0.25)
}

impl<M: EmbeddedPair, T: Real> ExplicitRungeKutta<M, T> {
    /// The method with these options, which are checked when a run starts.
    pub fn new(options: Options<T>) -> Self {
        Self {
            options,
            pair: PhantomData,
        }
    }

    /// The options of the method.
    pub fn options(&self) -> &Options<T> {
        &self.options
    }

    /// One step of length `step` (negative: backwards), whatever its error.
    ///
    /// For tests of the method and for loops with a step of their own; it
    /// evaluates the stages once and allocates. Tolerances and
    /// step limits have no say, and sums are plain.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] if the request makes no sense, or if the state or
    /// its rates are not finite.
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
