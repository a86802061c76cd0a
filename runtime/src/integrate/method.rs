//! Choice of an integration method by its name, for programs whose users choose one.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use super::checkpoint::Memory;
use super::error::InputError;
use super::evaluator::{Evaluator, NonFinite};
use super::explicit::{Dop853, Dopri5, Verner98};
use super::fixed::{Gauss, Rk4};
use super::integrator::Integrator;
use super::options::Options;
use super::piece::{GaussOrder, Piece};
use super::steps::{Failure, Goal, Steps};
use super::taylor::Taylor;
use crate::scalar::Real;
use crate::system::{State, TaylorOde};

/// Name of an integration method, without its tolerance or step length.
///
/// Written and parsed as `dop853`, `gauss8` and so on, in capitals or not;
/// [`ALL`](Self::ALL) lists them.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{OdeFn, RatesOnly};
///
/// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
/// let method: Method = "verner98".parse()?;
/// let start = State::new(0.0, vec![1.0]);
/// let end = method
///     .with(1e-10)
///     .run(&RatesOnly(&decay), &start, 1.0)?;
/// assert!((end.state.values[0] - (-1.0_f64).exp()).abs() < 1e-10);
///
/// let error = "verner89".parse::<Method>().unwrap_err().to_string();
/// assert!(error.starts_with("there is no method `verner89`; did you mean `verner98`?"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    /// [`Rk4`].
    Rk4,
    /// [`Dopri5`].
    Dopri5,
    /// [`Dop853`].
    Dop853,
    /// [`Verner98`].
    Verner98,
    /// [`Taylor`].
    Taylor,
    /// [`Gauss`], by fixed-point iteration.
    Gauss(GaussOrder),
    /// [`Gauss::for_animation`].
    Animation,
}

/// Declares all methods, each with the name that is parsed and the name for titles.
macro_rules! methods {
    ($($method:ident $(($order:ident))?: $word:literal, $title:literal;)+) => {
        impl Method {
            /// All methods.
            pub const ALL: &[Self] = &[$(Self::$method $((GaussOrder::$order))?),+];

            /// Returns the name of the method as it is parsed.
            fn word(self) -> &'static str {
                match self {
                    $(Self::$method $((GaussOrder::$order))? => $word,)+
                }
            }

            /// Returns the name for titles and legends, such as `Dormand–Prince 8(5,3)`.
            pub fn title(self) -> &'static str {
                match self {
                    $(Self::$method $((GaussOrder::$order))? => $title,)+
                }
            }
        }
    };
}

methods! {
    Rk4: "rk4", "RK4";
    Dopri5: "dopri5", "Dormand–Prince 5(4)";
    Dop853: "dop853", "Dormand–Prince 8(5,3)";
    Verner98: "verner98", "Verner 9(8)";
    Taylor: "taylor", "Taylor";
    Gauss(Two): "gauss2", "Gauss 2";
    Gauss(Four): "gauss4", "Gauss 4";
    Gauss(Six): "gauss6", "Gauss 6";
    Gauss(Eight): "gauss8", "Gauss 8";
    Animation: "animation", "midpoint";
}

/// Tolerance below which the Taylor method uses compensated sums.
const COMPENSATED_BELOW: f64 = 1e-12;

impl Method {
    /// Returns the Rust expression that builds this method like [`Method::with`], for the scalar
    /// type named `scalar`: `Dop853::new(Options::with_tolerance(1e-10))`.
    #[must_use]
    pub fn as_source(self, scalar: &str, setting: f64) -> String {
        let options = match self {
            Self::Taylor if setting < COMPENSATED_BELOW => {
                format!("Options {{ compensated: true, ..Options::with_tolerance({setting:e}) }}")
            }
            _ => format!("Options::with_tolerance({setting:e})"),
        };
        let of = match scalar {
            "f64" => String::new(),
            other => format!("::<{other}>"),
        };
        match self {
            Self::Dopri5 => format!("Dopri5{of}::new({options})"),
            Self::Dop853 => format!("Dop853{of}::new({options})"),
            Self::Verner98 => format!("Verner98{of}::new({options})"),
            Self::Taylor => format!("Taylor{of}::new({options})"),
            Self::Rk4 => format!("Rk4{of}::new({setting})"),
            Self::Animation => format!("Gauss{of}::for_animation({setting})"),
            Self::Gauss(order) => format!("Gauss{of}::new(GaussOrder::{order:?}, {setting})"),
        }
    }

    /// Returns true if the method takes a tolerance, false if it takes a step length.
    pub fn is_adaptive(self) -> bool {
        match self {
            Self::Dopri5 | Self::Dop853 | Self::Verner98 | Self::Taylor => true,
            Self::Rk4 | Self::Gauss(_) | Self::Animation => false,
        }
    }

    /// Returns the method with the tolerance `setting` or, if it is not adaptive, with steps of the
    /// length `setting`; all other options have their defaults.
    ///
    /// [`Taylor`] uses compensated sums at tolerances below 1e-12, where rounding begins to matter.
    pub fn with<T: Real>(self, setting: T) -> AnyIntegrator<T> {
        let near_rounding = self == Self::Taylor && setting.to_f64() < COMPENSATED_BELOW;
        let tolerance = Options {
            compensated: near_rounding,
            ..Options::with_tolerance(setting)
        };
        self.made_of(tolerance, setting)
    }

    /// Returns a finer setting, for a comparison run: a hundredth of a tolerance (but at least
    /// 1e-15, unless `setting` is smaller), or half of a step length.
    pub fn finer(self, setting: f64) -> f64 {
        match self.is_adaptive() {
            true => (0.01 * setting).max(setting.min(1e-15)),
            false => 0.5 * setting,
        }
    }

    /// Returns the method with these options. A method with constant steps uses only
    /// [`Options::initial_step`], as the step length, and [`Options::step_limit`].
    pub fn with_options<T: Real>(self, options: Options<T>) -> AnyIntegrator<T> {
        // Without a step the run is refused, as it is with any invalid step.
        let (step, limit) = (options.initial_step.unwrap_or(T::NAN), options.step_limit);
        self.made_of(options, step).with_step_limit(limit)
    }

    /// Returns the method with these options or, if it is not adaptive, with steps of length
    /// `step`.
    fn made_of<T: Real>(self, options: Options<T>, step: T) -> AnyIntegrator<T> {
        match self {
            Self::Dopri5 => AnyIntegrator::Dopri5(Dopri5::new(options)),
            Self::Dop853 => AnyIntegrator::Dop853(Dop853::new(options)),
            Self::Verner98 => AnyIntegrator::Verner98(Verner98::new(options)),
            Self::Taylor => AnyIntegrator::Taylor(Taylor::new(options)),
            Self::Gauss(order) => AnyIntegrator::Gauss(Gauss::new(order, step)),
            Self::Animation => AnyIntegrator::Gauss(Gauss::for_animation(step)),
            Self::Rk4 => AnyIntegrator::Rk4(Rk4::new(step)),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.word())
    }
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let found = Self::ALL
            .iter()
            .find(|method| method.word().eq_ignore_ascii_case(name));
        found.copied().ok_or_else(|| UnknownMethod {
            name: name.to_string(),
        })
    }
}

/// Error: no method has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownMethod {
    /// The unknown name.
    pub name: String,
}

impl UnknownMethod {
    /// Returns the method with the most similar name; `None` if no name is similar.
    pub fn nearest(&self) -> Option<Method> {
        let name = self.name.to_ascii_lowercase();
        let distances = Method::ALL
            .iter()
            .map(|&method| (distance(&name, method.word()), method));
        let (distance, method) = distances.min_by_key(|&(distance, _)| distance)?;
        (2 * distance < method.word().len()).then_some(method)
    }
}

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no method `{}`", self.name)?;
        if let Some(method) = self.nearest() {
            write!(f, "; did you mean `{method}`?")?;
        }
        write!(f, " (methods: ")?;
        for (index, method) in Method::ALL.iter().enumerate() {
            let separator = if index == 0 { "" } else { ", " };
            write!(f, "{separator}{method}")?;
        }
        write!(f, ")")
    }
}

impl core::error::Error for UnknownMethod {}

/// Returns the edit distance: the number of letters to insert, remove or replace to turn one word
/// into the other.
fn distance(one: &str, other: &str) -> usize {
    let mut row: Vec<usize> = (0..=other.chars().count()).collect();
    for (i, letter) in one.chars().enumerate() {
        let mut diagonal = core::mem::replace(&mut row[0], i + 1);
        for (j, own) in other.chars().enumerate() {
            let replaced = diagonal + usize::from(letter != own);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row.last().copied().unwrap_or(0)
}

/// One of the integration methods that [`Method`] names, as a single type.
///
/// It implements [`Integrator`]. [`Taylor`] requires systems that provide their Taylor
/// coefficients; [`RatesOnly`](crate::system::RatesOnly) adapts any other system, which only
/// `Taylor` then refuses.
#[derive(Clone, Debug)]
pub enum AnyIntegrator<T> {
    /// The classical Runge–Kutta method of order 4.
    Rk4(Rk4<T>),
    /// Dormand and Prince's pair of order 5(4).
    Dopri5(Dopri5<T>),
    /// Dormand and Prince's pair of order 8(5,3).
    Dop853(Dop853<T>),
    /// Verner's pair of order 9(8).
    Verner98(Verner98<T>),
    /// Taylor series.
    Taylor(Taylor<T>),
    /// Gauss–Legendre methods.
    Gauss(Gauss<T>),
}

impl<T: Real> AnyIntegrator<T> {
    /// Sets the number of steps, completed and failed, after which a run ends with an error.
    pub fn with_step_limit(mut self, limit: u64) -> Self {
        *match &mut self {
            Self::Rk4(method) => &mut method.step_limit,
            Self::Dopri5(method) => &mut method.options.step_limit,
            Self::Dop853(method) => &mut method.options.step_limit,
            Self::Verner98(method) => &mut method.options.step_limit,
            Self::Taylor(method) => &mut method.options.step_limit,
            Self::Gauss(method) => &mut method.step_limit,
        } = limit;
        self
    }

    /// Sets how often a step may be halved if its equations cannot be solved. Only implicit methods
    /// (Gauss) have such equations; others ignore this.
    pub fn with_halvings(mut self, halvings: u32) -> Self {
        if let Self::Gauss(method) = &mut self {
            method.halvings = halvings;
        }
        self
    }
}

impl<T: Real, O: TaylorOde<T> + ?Sized> Integrator<T, O> for AnyIntegrator<T> {
    type Steps = AnySteps<T, O>;

    fn steps(&self, ode: &O, start: &State<T>) -> Result<AnySteps<T, O>, InputError<T>> {
        Ok(match self {
            Self::Rk4(method) => Box::new(method.steps(ode, start)?),
            Self::Dopri5(method) => Box::new(method.steps(ode, start)?),
            Self::Dop853(method) => Box::new(method.steps(ode, start)?),
            Self::Verner98(method) => Box::new(method.steps(ode, start)?),
            Self::Taylor(method) => Box::new(method.steps(ode, start)?),
            Self::Gauss(method) => Box::new(method.steps(ode, start)?),
        })
    }
}

/// Data that a method keeps during a run.
type AnySteps<T, O> = Box<dyn Steps<T, O> + Send + Sync>;

impl<T: Real, O: ?Sized> Steps<T, O> for AnySteps<T, O> {
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>> {
        (**self).step(system, time, goal)
    }

    fn prepare(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        (**self).prepare(system, time)
    }

    fn piece(&self) -> Piece<'_, T> {
        (**self).piece()
    }

    fn advance(&mut self) {
        (**self).advance();
    }

    fn restart(&mut self, values: &[T]) {
        (**self).restart(values);
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        (**self).remember(memory);
    }
}

#[cfg(test)]
mod tests {
    use super::{Method, distance};
    use alloc::string::ToString;

    #[test]
    fn names_are_parsed_as_they_are_written() {
        for &method in Method::ALL {
            assert_eq!(method.to_string().parse(), Ok(method));
            assert_eq!(method.to_string().to_uppercase().parse(), Ok(method));
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_all_and_the_nearest() {
        let error = |name: &str| name.parse::<Method>().unwrap_err();
        assert_eq!(error("dop583").nearest(), Some(Method::Dop853));
        assert_eq!(error("Tailor").nearest(), Some(Method::Taylor));
        assert_eq!(error("euler").nearest(), None);
        let message = error("euler").to_string();
        assert!(Method::ALL.iter().all(|m| message.contains(&m.to_string())));
    }

    #[test]
    fn distances_count_letters() {
        assert_eq!(distance("", "rk4"), 3);
        assert_eq!(distance("kitten", "sitting"), 3);
    }
}
