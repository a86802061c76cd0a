//! Work-precision diagrams: error against cost of methods on one motion.

use std::fmt;
use std::hint::black_box;
use std::time::{Duration, Instant};

use branched_pendulum::integrate::{GaussOrder, Integrator, Method};
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{Ode, State, TaylorOde};

use crate::error::AdviceError;
use crate::extrapolation::extrapolate;

/// Total duration of the repetitions of a run, of which the shortest counts; at least three are
/// made.
const REPEATED: Duration = Duration::from_millis(30);

/// Largest number of steps of a run, completed and failed.
const STEPS: u64 = 5_000_000;

/// Tolerances of the two runs that compute a [`KnownEnd`].
const TOLERANCES: [f64; 2] = [1e-18, 1e-21];

/// State at the end of a motion, computed with 31 digits.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownEnd {
    /// Values at the end, rounded to `f64`.
    pub values: Vec<f64>,
    /// Estimated error: the largest difference between two runs with tolerances that differ by a
    /// factor of a thousand. It is large if a chaotic motion is followed too long.
    pub uncertainty: f64,
}

impl KnownEnd {
    /// Integrates a system from `start` to the time `end` twice, by extrapolation of the midpoint
    /// rule. Its coefficients are exact, whereas coefficients of Runge–Kutta pairs are rounded to
    /// `f64`.
    ///
    /// # Errors
    /// [`AdviceError::Reference`] if one of the runs fails.
    pub fn of<O: Ode<Double>>(
        system: &O,
        start: &State<f64>,
        end: f64,
    ) -> Result<Self, AdviceError> {
        let run = |tolerance: f64| {
            let values = start.values.iter().copied();
            let mut state: Vec<Double> = values.map(Double::from_f64).collect();
            extrapolate(system, start.time, &mut state, &[end], tolerance, |_, _| {})
                .map_err(|error| AdviceError::Reference(Box::new(error)))?;
            Ok::<Vec<Double>, AdviceError>(state)
        };
        let [coarse, fine] = TOLERANCES.map(run);
        let (coarse, fine) = (coarse?, fine?);
        let both = coarse.iter().zip(&fine);
        let differences = both.map(|(a, b)| (*a - *b).high().abs());
        Ok(Self {
            uncertainty: differences.fold(0.0, f64::max),
            values: fine.iter().map(|value| value.high()).collect(),
        })
    }
}

/// Returns the largest difference of two lists of values; infinite if their lengths differ or a
/// value is NaN.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    if one.len() != other.len() {
        return f64::INFINITY;
    }
    let differences = one
        .iter()
        .zip(other)
        .map(|(one, other)| (one - other).abs());
    differences.fold(0.0, |worst, own| match own.is_nan() {
        true => f64::INFINITY,
        false => worst.max(own),
    })
}

/// One run of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MethodRun {
    /// The method.
    pub method: Method,
    /// Tolerance, or step length in s for a method with constant steps.
    pub setting: f64,
    /// Largest error of the values at the end, in their units; infinite if the number of expected
    /// values differs.
    pub error: f64,
    /// Time in s, the shortest of several, since disturbances only lengthen a run.
    pub seconds: f64,
    /// Number of evaluations of the right-hand side; for Taylor series the sum of the orders of
    /// their coefficients.
    pub evaluations: u64,
}

/// Error against cost of methods on one motion: a work–precision diagram (E. Hairer,
/// S. P. Nørsett and G. Wanner, *Solving Ordinary Differential Equations I*, II.10).
///
/// Any system that gives its Taylor coefficients is measured; with
/// [`RatesOnly`](branched_pendulum::system::RatesOnly) any other, without Taylor series.
///
/// # Examples
///
/// ```
/// use branched_pendulum::integrate::Method;
/// use branched_pendulum::system::{OdeFn, RatesOnly, State};
/// use branched_pendulum_advice::WorkPrecision;
///
/// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
/// let start = State::new(0.0, vec![1.0]);
/// let methods = [Method::Rk4, Method::Dop853];
/// let measured = WorkPrecision::measure(&RatesOnly(&decay), &start, 1.0, &[(-1.0_f64).exp()], &methods, |_, _| {});
/// assert_eq!(measured.fastest(1e-12), Some(Method::Dop853));
/// println!("{}", measured.table(&[1e-3, 1e-6, 1e-9, 1e-12]));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkPrecision {
    runs: Vec<MethodRun>,
}

impl WorkPrecision {
    /// Methods that are compared by default.
    pub const METHODS: [Method; 8] = [
        Method::Rk4,
        Method::Dopri5,
        Method::Dop853,
        Method::Verner98,
        Method::Taylor,
        Method::Gauss(GaussOrder::Four),
        Method::Gauss(GaussOrder::Six),
        Method::Gauss(GaussOrder::Eight),
    ];

    /// Runs `methods`, each at many tolerances or steps from loose to tight, from `start` to the
    /// time `end`, where the values should be `expected`.
    ///
    /// Before each run, `told` is called with the method and the completed fraction (0 to 1) of all
    /// runs. A run that fails is left out: its step is too long, or the system provides no Taylor
    /// coefficients. A step of a Gauss method whose equations cannot be solved is not halved. Each
    /// run is repeated for some 30 ms, at least three times.
    pub fn measure<O: TaylorOde<f64>>(
        system: &O,
        start: &State<f64>,
        end: f64,
        expected: &[f64],
        methods: &[Method],
        mut reported: impl FnMut(Method, f64),
    ) -> Self {
        let settings = |method: Method| settings(method).into_iter();
        let all = methods.iter();
        let all = all.flat_map(|&method| settings(method).map(move |setting| (method, setting)));
        let all: Vec<(Method, f64)> = all.collect();
        let mut runs = Vec::new();
        for (number, &(method, setting)) in all.iter().enumerate() {
            reported(method, number as f64 / all.len() as f64);
            let integrator = method.with(setting).with_step_limit(STEPS).with_halvings(0);
            let run = || {
                let start = black_box(start);
                integrator.run(system, start, end)
            };
            let Ok(solution) = run() else {
                continue;
            };
            runs.push(MethodRun {
                method,
                setting,
                error: difference(&solution.state.values, expected),
                seconds: shortest(run),
                evaluations: solution.report.evaluations,
            });
        }
        Self { runs }
    }

    /// Creates a diagram from runs measured elsewhere; those of a method must be ordered from loose
    /// to tight.
    #[must_use]
    pub const fn of(runs: Vec<MethodRun>) -> Self {
        Self { runs }
    }

    /// Returns all runs, method by method, from loose to tight.
    #[must_use]
    pub fn runs(&self) -> &[MethodRun] {
        &self.runs
    }

    /// Returns the methods that have runs, in their order.
    #[must_use]
    pub fn methods(&self) -> Vec<Method> {
        let mut methods: Vec<Method> = self.runs.iter().map(|run| run.method).collect();
        methods.dedup();
        methods
    }

    /// Returns the runs of a method.
    pub fn runs_of(&self, method: Method) -> impl Iterator<Item = &MethodRun> {
        self.runs.iter().filter(move |run| run.method == method)
    }

    /// Returns the time (s) that a method takes for an error, interpolated between its runs on
    /// logarithmic scales. `None` if no run is as accurate.
    #[must_use]
    pub fn seconds(&self, method: Method, error: f64) -> Option<f64> {
        let mut before = None;
        for after in self.runs_of(method) {
            if after.error > error {
                before = Some(after);
                continue;
            }
            // An infinite error has no logarithm to interpolate.
            let before =
                before.filter(|before: &&MethodRun| before.error.is_finite() && after.error > 0.0);
            let share = before.map(|before| {
                let part = (before.error / error).ln() / (before.error / after.error).ln();
                before.seconds * (after.seconds / before.seconds).powf(part)
            });
            return Some(share.unwrap_or(after.seconds));
        }
        None
    }

    /// Returns the method that reaches an error in the shortest time; `None` if no run is as
    /// accurate.
    #[must_use]
    pub fn fastest(&self, error: f64) -> Option<Method> {
        let times = self.methods().into_iter();
        let times = times.filter_map(|method| Some((method, self.seconds(method, error)?)));
        let best = times.min_by(|(_, a), (_, b)| a.total_cmp(b));
        best.map(|(method, _)| method)
    }

    /// Returns a table of times as text: one row per method, one column for each of `errors`, in
    /// µs, with the shortest time of each column marked.
    #[must_use]
    pub fn table<'a>(&'a self, errors: &'a [f64]) -> impl fmt::Display + 'a {
        CostTable {
            measured: self,
            errors,
        }
    }
}

/// Contents of a table of times.
struct CostTable<'a> {
    measured: &'a WorkPrecision,
    errors: &'a [f64],
}

impl fmt::Display for CostTable<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:24}", "")?;
        for error in self.errors {
            write!(formatter, "{error:>10e} ")?;
        }
        writeln!(formatter)?;
        for method in self.measured.methods() {
            write!(formatter, "{:24}", method.title())?;
            for &error in self.errors {
                let is_fastest = self.measured.fastest(error) == Some(method);
                match self.measured.seconds(method, error) {
                    Some(time) => {
                        let mark = if is_fastest { '*' } else { ' ' };
                        write!(formatter, "{:10.0}{mark}", time * 1e6)?;
                    }
                    None => write!(formatter, "{:>10} ", "-")?,
                }
            }
            writeln!(formatter)?;
        }
        Ok(())
    }
}

/// Returns the tolerances or steps of a method, from loose to tight.
fn settings(method: Method) -> Vec<f64> {
    let steps = |longest: f64, count: i32| {
        let halves = |k| longest * 0.5_f64.powf(0.5 * f64::from(k));
        (0..count).map(halves).collect()
    };
    let tolerances = |last: i32| {
        let tolerance = |k| 10.0_f64.powf(-0.5 * f64::from(k));
        (6..=last).map(tolerance).collect()
    };
    match method {
        Method::Taylor => tolerances(32),
        Method::Dopri5 | Method::Dop853 | Method::Verner98 => tolerances(28),
        Method::Rk4 => steps(0.02, 14),
        Method::Gauss(_) | Method::Animation => steps(0.08, 11),
    }
}

/// Returns the shortest time of repeated runs, in s.
fn shortest<R>(run: impl Fn() -> R) -> f64 {
    let (mut best, mut spent, mut runs) = (Duration::MAX, Duration::ZERO, 0);
    while runs < 3 || (spent < REPEATED && runs < 1000) {
        let clock = Instant::now();
        black_box(run());
        let time = clock.elapsed();
        best = best.min(time);
        spent += time;
        runs += 1;
    }
    best.as_secs_f64()
}

#[cfg(test)]
mod tests {
    use branched_pendulum::integrate::{GaussOrder, Method};
    use branched_pendulum::scalar::Double;
    use branched_pendulum::system::{OdeFn, RatesOnly, State};

    use super::{KnownEnd, MethodRun, WorkPrecision, difference};

    #[test]
    fn times_are_interpolated_between_runs() {
        let run = |method, error, seconds| MethodRun {
            method,
            setting: 0.0,
            error,
            seconds,
            evaluations: 0,
        };
        let measured = WorkPrecision::of(vec![
            run(Method::Rk4, 1e-2, 10.0),
            run(Method::Rk4, 1e-4, 1000.0),
            run(Method::Dop853, 1e-3, 50.0),
        ]);
        let time = |error| measured.seconds(Method::Rk4, error);
        assert!((time(1e-3).unwrap() - 100.0).abs() < 1e-9);
        assert_eq!(time(1.0), Some(10.0));
        assert_eq!(time(1e-5), None);
        assert_eq!(measured.seconds(Method::Taylor, 1.0), None);
        // Runs without an error, or with an infinite one, are not interpolated.
        let edges = WorkPrecision::of(vec![
            run(Method::Rk4, f64::INFINITY, 1.0),
            run(Method::Rk4, 1e-2, 10.0),
            run(Method::Rk4, 0.0, 1000.0),
        ]);
        assert_eq!(edges.seconds(Method::Rk4, 0.1), Some(10.0));
        assert_eq!(edges.seconds(Method::Rk4, 1e-3), Some(1000.0));
        assert_eq!(difference(&[1.0], &[1.0, 2.0]), f64::INFINITY);
        assert_eq!(difference(&[1.0, f64::NAN], &[1.0, 2.0]), f64::INFINITY);
        assert_eq!(measured.fastest(1e-3), Some(Method::Dop853));
        assert_eq!(measured.fastest(1e-4), Some(Method::Rk4));
        let table = measured.table(&[1e-2, 1e-3, 1e-5]).to_string();
        let rows: Vec<Vec<&str>> = table
            .lines()
            .map(|line| line.split_whitespace().collect())
            .collect();
        assert_eq!(rows[0], ["1e-2", "1e-3", "1e-5"]);
        assert_eq!(
            rows[1][rows[1].len() - 3..],
            ["10000000*", "100000000", "-"]
        );
        assert_eq!(rows[2][rows[2].len() - 3..], ["50000000", "50000000*", "-"]);
    }

    /// Checks that errors decrease with the order of each method, and that failed runs are left
    /// out.
    #[test]
    fn errors_fall_as_the_orders_say() {
        let turn = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
            rates.copy_from_slice(&[y[1], -y[0]]);
        });
        let start = State::new(0.0, vec![1.0, 0.0]);
        let expected = [2.0_f64.cos(), -2.0_f64.sin()];
        let wide = OdeFn::new(2, |_time: Double, y: &[Double], rates: &mut [Double]| {
            rates.copy_from_slice(&[y[1], -y[0]]);
        });
        let known = KnownEnd::of(&wide, &start, 2.0).unwrap();
        assert!(known.uncertainty < 1e-17, "{known:?}");
        // The only error is that of rounding to `f64`.
        assert!(difference(&known.values, &expected) < 1.2e-16, "{known:?}");
        let methods = [Method::Rk4, Method::Taylor, Method::Gauss(GaussOrder::Four)];
        let mut parts = Vec::new();
        let measured = WorkPrecision::measure(
            &RatesOnly(&turn),
            &start,
            2.0,
            &expected,
            &methods,
            |method, part| parts.push((method, part)),
        );
        // A system that provides no Taylor coefficients has no Taylor series.
        assert_eq!(measured.methods(), [methods[0], methods[2]]);
        assert!(parts.is_sorted_by(|(_, a), (_, b)| a < b));
        assert_eq!(parts.first(), Some(&(Method::Rk4, 0.0)));
        for method in measured.methods() {
            let runs: Vec<&MethodRun> = measured.runs_of(method).collect();
            let of_step = |step: f64| {
                let near = runs.iter().find(|run| (run.setting - step).abs() < 1e-9);
                near.unwrap().error
            };
            // Both have the order 4: the error falls by 2⁴ where the step is halved.
            let ratio = of_step(0.02) / of_step(0.01);
            assert!((ratio - 16.0).abs() < 0.5, "{method:?} {ratio}");
            assert!(
                runs.iter()
                    .all(|run| run.seconds > 0.0 && run.evaluations > 0)
            );
        }
    }
}
