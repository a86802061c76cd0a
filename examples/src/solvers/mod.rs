//! The methods of the runtime under one roof, for programs that compare them.

pub mod arguments;
pub mod scenes;

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;

/// Tolerance below which the rounding of sums is carried along.
const COMPENSATED: f64 = 1e-12;

/// A method; what it takes, a tolerance or a step, is given to its runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// The classical method of order 4.
    Rk4,
    /// Dormand and Prince's 5(4).
    Dopri5,
    /// Dormand and Prince's 8(5,3).
    Dop853,
    /// Verner's 9(8).
    Verner98,
    /// Taylor series of the order that the tolerance asks for; sums compensated
    /// at tolerances near rounding.
    Taylor,
    /// Gauss–Legendre, by fixed-point iteration.
    Gauss(GaussOrder),
    /// The midpoint rule by Newton's method.
    Animation,
}

impl Method {
    /// The method's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rk4 => "RK4",
            Self::Dopri5 => "Dormand–Prince 5(4)",
            Self::Dop853 => "Dormand–Prince 8(5,3)",
            Self::Verner98 => "Verner 9(8)",
            Self::Taylor => "Taylor",
            Self::Gauss(GaussOrder::Two) => "Gauss 2",
            Self::Gauss(GaussOrder::Four) => "Gauss 4",
            Self::Gauss(GaussOrder::Six) => "Gauss 6",
            Self::Gauss(GaussOrder::Eight) => "Gauss 8",
            Self::Animation => "midpoint",
        }
    }

    /// Whether it takes a tolerance; the others take a step.
    pub fn is_adaptive(self) -> bool {
        matches!(
            self,
            Self::Dopri5 | Self::Dop853 | Self::Verner98 | Self::Taylor
        )
    }

    /// The head of a CSV column that holds indices into `methods`.
    pub fn legend(methods: &[Self]) -> String {
        let numbered = methods.iter().enumerate();
        let names: Vec<_> = numbered
            .map(|(index, method)| format!("{index} {}", method.name().replace(',', ".")))
            .collect();
        format!("method: {}", names.join("; "))
    }

    /// Integrates with the tolerance or the step `setting` and shows `visit`
    /// the time and the state at the end of each step.
    ///
    /// # Errors
    /// As the method's.
    pub fn integrate(
        self,
        setting: f64,
        ode: &impl TaylorOde<f64>,
        start: &State<f64>,
        end: f64,
        mut visit: impl FnMut(f64, &[f64]) -> ControlFlow<()>,
    ) -> Result<Solution<f64>, IntegrationError<f64>> {
        let observer = |step: &mut DenseStep<'_, f64>| visit(step.end_time(), step.end());
        let options = || Options {
            step_limit: 5_000_000,
            ..Options::with_tolerance(setting)
        };
        match self {
            Self::Rk4 => Rk4::new(setting).integrate(ode, start, end, observer),
            Self::Dopri5 => Dopri5::new(options()).integrate(ode, start, end, observer),
            Self::Dop853 => Dop853::new(options()).integrate(ode, start, end, observer),
            Self::Verner98 => Verner98::new(options()).integrate(ode, start, end, observer),
            Self::Taylor => {
                let options = Options {
                    compensated: setting < COMPENSATED,
                    ..options()
                };
                Taylor::new(options).integrate(ode, start, end, observer)
            }
            Self::Gauss(order) => Gauss {
                // What cannot be solved in one piece shows as that.
                halvings: 0,
                ..Gauss::new(order, setting)
            }
            .integrate(ode, start, end, observer),
            Self::Animation => Gauss {
                halvings: 0,
                ..Gauss::for_animation(setting)
            }
            .integrate(ode, start, end, observer),
        }
    }
}
