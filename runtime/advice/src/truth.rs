//! The reference: states more accurate than the tolerances require, with estimates of their errors.

use std::error::Error;

use crate::extrapolation::extrapolate;
use crate::paths::{MOVE, OutputValues, Paths};
use crate::wanted::Wanted;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Verner98};
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{CastOde, Ode, State};

/// A method of computing references.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Precise {
    Verner98(f64),
    Dop853(f64),
    /// Extrapolation in double-double numbers, with this tolerance.
    Extrapolated(f64),
}

/// Pairs of methods, from the cheapest to the most accurate. The difference of a pair estimates the
/// error of its first method, which is the reference.
const LADDER: [[Precise; 2]; 3] = [
    [Precise::Verner98(1e-14), Precise::Dop853(2e-14)],
    [Precise::Extrapolated(1e-21), Precise::Extrapolated(1e-18)],
    [Precise::Extrapolated(1e-28), Precise::Extrapolated(1e-25)],
];

impl Precise {
    fn name(self) -> String {
        match self {
            Self::Verner98(tolerance) => format!("Verner 9(8) at {tolerance:e} in f64"),
            Self::Dop853(tolerance) => format!("Dormand–Prince 8(5,3) at {tolerance:e} in f64"),
            Self::Extrapolated(tolerance) => {
                format!("extrapolation at {tolerance:e} in double-double")
            }
        }
    }
}

/// A system that can be integrated in `f64` and in double-double numbers.
pub(crate) trait Exact {
    fn dimension(&self) -> usize;

    /// Integrates from a start. If `moved` is given, it is the change of each component of the
    /// start.
    fn follow(
        &self,
        by: Precise,
        start: &State<f64>,
        moved: Option<&[f64]>,
        times: &[f64],
        visit: &mut dyn FnMut(usize, &[f64]),
    ) -> Result<(), Box<dyn Error + Send + Sync>>;
}

impl<O: CastOde<f64>> Exact for O {
    fn dimension(&self) -> usize {
        Ode::dimension(self)
    }

    fn follow(
        &self,
        by: Precise,
        start: &State<f64>,
        moved: Option<&[f64]>,
        times: &[f64],
        visit: &mut dyn FnMut(usize, &[f64]),
    ) -> Result<(), Box<dyn Error + Send + Sync>> {
        let mut number = 0;
        let mut count = |_: f64, values: &[f64]| {
            visit(number, values);
            number += 1;
        };
        let options = |tolerance| Options {
            compensated: true,
            ..Options::with_tolerance(tolerance)
        };
        match by {
            Precise::Verner98(tolerance) => {
                Verner98::new(options(tolerance)).sample(self, start, times, count)?;
            }
            Precise::Dop853(tolerance) => {
                Dop853::new(options(tolerance)).sample(self, start, times, count)?;
            }
            Precise::Extrapolated(tolerance) => {
                let ode = self.cast(Double::from_f64);
                let moves = moved.unwrap_or_default().iter().copied();
                let moves = moves.chain(std::iter::repeat(0.0));
                let both = start.values.iter().zip(moves);
                let mut state: Vec<Double> = both.map(|(&y, by)| Double::sum(y, by)).collect();
                let mut values = vec![0.0; state.len()];
                extrapolate(
                    &ode,
                    start.time,
                    &mut state,
                    times,
                    tolerance,
                    |index, state| {
                        for (value, precise) in values.iter_mut().zip(state) {
                            *value = precise.high();
                        }
                        count(times[index], &values);
                    },
                )?;
            }
        }
        Ok(())
    }
}

/// Reference motion of the scene, with its errors.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    pub(crate) method: String,
    /// Values of each output.
    pub(crate) outputs: Vec<OutputValues>,
    /// Error of the reference, for each output and time.
    errors: Vec<Vec<f64>>,
    /// For each output, the number of times at which its values are compared with the reference.
    pub(crate) trusted: Vec<usize>,
    pub(crate) digits: Digits,
}

/// Numbers of times until which the 16 digits of `f64` suffice.
#[derive(Clone, Debug)]
pub(crate) struct Digits {
    /// For each output, the number of times at which accumulated rounding errors are negligible.
    limits: Vec<usize>,
    /// True if one rounding error is enough to spoil a value before the end.
    are_too_few: bool,
    /// Growth rate of small deviations, in 1/s, if it was computed.
    pub(crate) growth: Option<f64>,
}

/// Largest allowed error of the reference, as a fraction of the tolerance.
const SHARE: f64 = 0.01;

/// Integrates from all starts. If the paths `along` are given, each start is perturbed by the
/// rounding errors estimated along its path.
fn follow_all(
    exact: &dyn Exact,
    by: Precise,
    starts: &[State<f64>],
    along: Option<&Paths>,
    times: &[f64],
) -> Result<Paths, Box<dyn Error + Send + Sync>> {
    let mut paths = Paths::new(exact.dimension(), starts.len(), times.len());
    for (index, start) in starts.iter().enumerate() {
        let moves = along.map(|along| along.roundings(index, start));
        exact.follow(by, start, moves.as_deref(), times, &mut |time, state| {
            paths.set(index, time, state);
        })?;
    }
    Ok(paths)
}

/// Returns, for each output, the number of times at which two runs agree within [`SHARE`] of the
/// tolerance.
fn known_until(
    outputs: &[OutputValues],
    checks: &[OutputValues],
    wanted: &[Wanted<'_>],
) -> Vec<usize> {
    wanted
        .iter()
        .zip(outputs.iter().zip(checks))
        .map(|(wanted, (own, check))| parting(own, check, SHARE * wanted.tolerance))
        .collect()
}

/// Returns the index of the first time at which two runs differ by more than `most`.
fn parting(a: &OutputValues, b: &OutputValues, most: f64) -> usize {
    let apart = |&time: &usize| a.difference(b, time) > most;
    (0..a.times).find(apart).unwrap_or(a.times)
}

impl Truth {
    /// Computes the reference with increasingly accurate methods, until a pair agrees to a
    /// hundredth of the tolerances or the 16 digits of `f64` no longer determine the motion.
    pub(crate) fn find(
        exact: &dyn Exact,
        starts: &[State<f64>],
        times: &[f64],
        wanted: &[Wanted<'_>],
    ) -> Result<Self, Box<dyn Error + Send + Sync>> {
        let follow = |by, along: Option<&Paths>| follow_all(exact, by, starts, along, times);
        let all = |paths: &Paths| -> Vec<OutputValues> {
            let outputs = wanted.iter().map(|wanted| paths.outputs(wanted, times));
            outputs.collect()
        };
        let mut digits: Option<Digits> = None;
        let mut found = Err("there is no reference".into());
        for [fine, check] in LADDER {
            let runs = follow(fine, None).and_then(|best| Ok((best, follow(check, None)?)));
            let (best, check) = match runs {
                Ok(runs) => runs,
                Err(error) if found.is_err() => {
                    found = Err(error);
                    continue;
                }
                Err(_) => break,
            };
            let (outputs, checks) = (all(&best), all(&check));
            if matches!(fine, Precise::Extrapolated(_)) && digits.is_none() {
                let moved = follow(fine, Some(&best))?;
                let growth = rate_of_growth(&best, &moved, starts.len(), times);
                digits = Some(Digits::of(&outputs, &all(&moved), wanted, growth));
            }
            let known = known_until(&outputs, &checks, wanted);
            let last = || Digits::that_last(wanted.len(), times.len());
            let digits = digits.clone().unwrap_or_else(last);
            let enough = digits.suffice(&known, times.len());
            let errors = outputs.iter().zip(&checks).map(|(own, check)| {
                let errors = (0..times.len()).map(|time| own.difference(check, time));
                errors.collect()
            });
            let mut truth = Self {
                method: fine.name(),
                errors: errors.collect(),
                outputs,
                trusted: known,
                digits,
            };
            if truth.digits.are_too_few {
                truth.trust_less();
            }
            found = Ok(truth);
            if enough {
                break;
            }
        }
        found
    }

    /// Shortens the comparison to the times at which rounding errors are negligible. Returns true
    /// if it became shorter.
    pub(crate) fn trust_less(&mut self) -> bool {
        let before = self.trusted.clone();
        for (trusted, limit) in self.trusted.iter_mut().zip(&self.digits.limits) {
            *trusted = (*trusted).min(*limit);
        }
        self.trusted != before
    }

    /// Returns the largest error of the reference of an output, over all times that are compared.
    pub(crate) fn error(&self, output: usize) -> f64 {
        let errors = self.errors[output].iter().take(self.trusted[output]);
        errors.copied().fold(0.0, f64::max)
    }
}

impl Digits {
    /// Creates digits that suffice to the end.
    fn that_last(outputs: usize, times: usize) -> Self {
        Self {
            limits: vec![times; outputs],
            are_too_few: false,
            growth: None,
        }
    }

    /// Returns true if the numbers of times in `known` reach to the end, or as far as the digits
    /// suffice.
    fn suffice(&self, known: &[usize], times: usize) -> bool {
        let mut both = known.iter().zip(&self.limits);
        both.all(|(&known, &limit)| known >= if self.are_too_few { limit } else { times })
    }

    /// Estimates the digits by comparing the motion from a start with the motion from a perturbed
    /// start.
    fn of(
        own: &[OutputValues],
        moved: &[OutputValues],
        wanted: &[Wanted<'_>],
        growth: Option<f64>,
    ) -> Self {
        let until = |share: f64| -> Vec<usize> {
            let outputs = own.iter().zip(moved).zip(wanted);
            outputs
                .map(|((own, moved), wanted)| parting(own, moved, share * wanted.tolerance))
                .collect()
        };
        // While a deviation is small, it is proportional to its initial value.
        let of_one = until(2.0 * MOVE / f64::EPSILON);
        Self {
            limits: until(1.0),
            are_too_few: of_one
                .iter()
                .zip(own)
                .any(|(until, own)| *until < own.times),
            growth,
        }
    }
}

/// Returns the mean growth rate of a deviation while it is small, over all starts; `None` if it
/// grows by less than a factor of ten.
fn rate_of_growth(own: &Paths, moved: &Paths, starts: usize, times: &[f64]) -> Option<f64> {
    let rate = |start: usize| {
        let distances =
            (0..times.len()).map(|time| (times[time], own.distance(moved, start, time)));
        // Below this range the digits end; above it the deviation is no longer small.
        let mut small = distances.filter(|(_, distance)| (1e-13..1e-2).contains(distance));
        let (first, last) = (small.next()?, small.next_back()?);
        let growth = (last.1 / first.1).ln();
        (growth > 10.0_f64.ln()).then(|| growth / (last.0 - first.0))
    };
    let rates: Vec<f64> = (0..starts).filter_map(rate).collect();
    (!rates.is_empty()).then(|| rates.iter().sum::<f64>() / rates.len() as f64)
}
