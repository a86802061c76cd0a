//! The Taylor series method.

#[cfg(feature = "std")]
mod lanes;
mod root;
mod steps;

use self::steps::TaylorSteps;
use super::error::InputError;
use super::integrator::Integrator;
use super::options::{Options, Tolerance};
use crate::scalar::Real;
use crate::system::{State, TaylorOde};

/// The Taylor series method: each step evaluates the Taylor polynomial of the solution about the
/// start of the step. It suits all tolerances, down to rounding.
///
/// It integrates systems that provide their Taylor coefficients ([`TaylorOde`]): in
/// [`AbsoluteAngles`], models whose description has `emit(taylor)`, and trees that are read at run
/// time.
///
/// *Order*: p = ⌈8 − 0.65 ln ε⌉ for the smallest tolerance ε, unless
/// [`with_order`](Self::with_order) sets one. The step is ρ ε^(1/p) at a radius
/// of convergence ρ. Where the cost of a step grows as p², 1 − ½ ln ε is cheapest,
/// with steps of ρ/e² (Jorba and Zou, section 3.3.1); here it grows like p² + 30 p + 500
/// on trees of three and of seven links, for which longer steps of a higher order
/// are cheaper: p with p² (2 p + 30) = −(p² + 30 p + 500) ln (ε/e²). *Step*: so long that
/// neither of the last two terms, orders p − 1 and p, exceeds the tolerance
/// `absolute_i + relative_i |y_i|` in any component, times exp(−2/(p − 1)) to
/// be on the safe side (heyoka, a program of the same method, has 0.7 in the place
/// of 2: terms that fall more slowly leave more out). The terms left out are smaller by
/// about ε^(1/p) for each order. No step is rejected.
///
/// *Dense output* is the polynomial itself, of the method's order and free of
/// evaluations. The coefficients belong to the start of the step: at its end it
/// agrees with the state to the tolerance and to rounding.
///
/// *Cost*: a step computes p orders of the coefficients, each of which
/// [`Report::evaluations`] counts as one; the sums of products in order k grow
/// with k, so a step costs O(p²). Memory, allocated when a run starts: p + 6
/// vectors of the state's length, and [`TaylorOde::workspace`].
///
/// *Options*: [`Options::initial_step`] bounds the first step from above.
/// [`Options::beta`] has no part here: other values than zero are refused. With
/// [`Options::compensated`] the rounding errors of the state are carried along,
/// and the energy of a long run at a tolerance near rounding makes a random
/// walk (Brouwer's law) instead of a drift.
///
/// Same input, same machine, same bits. A run that was stopped continues from
/// its last state with exactly the steps it would have made, unless sums are
/// compensated, or a bound or the end cut a step short:
/// a step depends on the state at its start and on nothing before.
///
/// Source: À. Jorba and M. Zou, *A software package for the numerical
/// integration of ODEs by means of high-order Taylor methods*, Experimental
/// Mathematics 14 (2005) 99–117.
///
/// [`AbsoluteAngles`]: crate::system::AbsoluteAngles
/// [`Report::evaluations`]: super::Report::evaluations
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Taylor<T> {
    pub(super) options: Options<T>,
    order: Option<usize>,
}

/// Orders that [`Taylor::with_order`] accepts. The choice of the step needs two terms beyond the
/// first, and orders above the highest improve nothing in any precision of this crate.
const ORDERS: core::ops::RangeInclusive<usize> = 3..=100;

impl<T: Real> Taylor<T> {
    /// Creates the method with these options, which are checked when a run starts.
    pub fn new(options: Options<T>) -> Self {
        Self {
            options,
            order: None,
        }
    }

    /// Sets the order of the polynomials, 3 to 100, independent of the tolerance.
    pub fn with_order(self, order: usize) -> Self {
        Self {
            order: Some(order),
            ..self
        }
    }

    /// The options of the method.
    pub fn options(&self) -> &Options<T> {
        &self.options
    }

    /// Returns the order of the polynomials that a run uses.
    ///
    /// # Examples
    /// ```
    /// use branched_pendulum::prelude::*;
    ///
    /// assert_eq!(Taylor::<f64>::new(Options::with_tolerance(1e-16)).order(), 32);
    /// assert_eq!(Taylor::<f64>::new(Options::with_tolerance(1e-3)).order(), 13);
    /// ```
    pub fn order(&self) -> usize {
        self.order
            .unwrap_or_else(|| order_for(smallest(&self.options)))
    }

    /// Checks that the method can use the order and the options.
    fn check_options(&self) -> Result<(), InputError<T>> {
        if self.options.beta != T::ZERO {
            let value = self.options.beta;
            return Err(InputError::BetaUnused { value });
        }
        let order = self.order();
        if !ORDERS.contains(&order) {
            let (smallest, largest) = (*ORDERS.start(), *ORDERS.end());
            return Err(InputError::Order {
                order,
                smallest,
                largest,
            });
        }
        Ok(())
    }
}

/// Returns the smallest useful relative tolerance. It may be smaller than the rounding of a state:
/// tolerances only decide which terms are left out, the step length contains no rounding, and
/// compensated sums keep some more digits of an increment.
fn smallest_tolerance<T: Real>() -> T {
    T::EPSILON * T::from_f64(1.0 / 1024.0)
}

/// Returns the safety factor exp(−2/(p − 1)) of the step length, for polynomials of order p.
fn safety<T: Real>(order: usize) -> T {
    let exponent = T::from_f64(-2.0) / T::from_f64((order - 1) as f64);
    T::from_f64(core::f64::consts::E).powf(exponent)
}

/// Returns the order p = ⌈8 − 0.65 ln ε⌉ for the tolerance ε; tolerances above one count as one.
fn order_for<T: Real>(tolerance: T) -> usize {
    // e^(−1/0.65): there is no logarithm without `std`.
    const PER_ORDER: f64 = 0.214_711_172_341_697_3;
    let mut order = 8;
    let mut reached = 1.0;
    while reached > tolerance.to_f64() && order < *ORDERS.end() {
        order += 1;
        reached *= PER_ORDER;
    }
    order
}

/// Returns the smallest nonzero tolerance: the smallest relative one or, if all of these are zero,
/// the smallest absolute one.
fn smallest<T: Real>(options: &Options<T>) -> T {
    let least = |tolerance: &Tolerance<T>| {
        let positive = tolerance
            .values()
            .iter()
            .copied()
            .filter(|value| *value > T::ZERO);
        positive.reduce(|least, value| least.min(value))
    };
    least(&options.relative)
        .or_else(|| least(&options.absolute))
        .unwrap_or(T::EPSILON)
}

impl<T: Real, O: TaylorOde<T> + ?Sized> Integrator<T, O> for Taylor<T> {
    type Steps = TaylorSteps<T>;

    // Where a system has no series, nothing of the steps is compiled.
    #[inline(always)]
    fn steps(&self, ode: &O, start: &State<T>) -> Result<TaylorSteps<T>, InputError<T>> {
        self.options.validate(start.values.len())?;
        self.options
            .check_digits(&start.values, smallest_tolerance())?;
        self.check_options()?;
        if !ode.has_series() {
            return Err(InputError::NoSeries);
        }
        let order = self.order();
        let workspace = ode.workspace(order);
        Ok(TaylorSteps::new(
            &self.options,
            order,
            workspace,
            &start.values,
        ))
    }
}
