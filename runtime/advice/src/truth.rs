//! The reference: states that are known better than they are asked for, and how far.

use std::error::Error;

use crate::extrapolation::extrapolate;
use crate::paths::{MOVE, OutputValues, Paths};
use crate::wanted::Wanted;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Verner98};
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{CastOde, Ode, State};

/// A way to compute references.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Precise {
    Verner98(f64),
    Dop853(f64),
    /// In double-double numbers.
    Extrapolated(f64),
}

/// Ways in pairs, of which the difference tells the error, from the cheapest on: the
/// first of a pair is the reference.
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

/// A system that is integrated in `f64` and in double-double numbers.
pub(crate) trait Exact {
    fn dimension(&self) -> usize;

    /// Follows a start, each component `moved` by as much, if it is.
    fn follow(
        &self,
        by: Precise,
        start: &State<f64>,
        moved: Option<&[f64]>,
        times: &[f64],
        visit: &mut dyn FnMut(usize, &[f64]),
    ) -> Result<(), Box<dyn Error + Send + Sync>>;
}

impl<O: CastOde<f64, Double>> Exact for O {
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

/// The scene as it moves, and how far it is known.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    pub(crate) method: String,
    /// For each output: its values.
    pub(crate) outputs: Vec<OutputValues>,
    /// For each output and time: the error of the reference.
    errors: Vec<Vec<f64>>,
    /// For each output: the number of times up to which its values are asked for.
    pub(crate) trusted: Vec<usize>,
    pub(crate) digits: Digits,
}

/// How long the digits of `f64` last.
#[derive(Clone, Debug)]
pub(crate) struct Digits {
    /// For each output: the number of times up to which some roundings do not matter.
    limits: Vec<usize>,
    /// True if a single one matters before the end.
    are_too_few: bool,
    /// Rate at which small deviations grow, 1/s, where it was looked at.
    pub(crate) growth: Option<f64>,
}

/// The part of a tolerance that the reference may be off by.
const SHARE: f64 = 0.01;

/// Follows all starts, each moved by roundings of the paths that it goes `along`, if there are any.
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

/// For each output: the number of times up to which two runs agree to the part of the tolerance.
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

/// The first time at which two runs differ by more than `most`.
fn parting(a: &OutputValues, b: &OutputValues, most: f64) -> usize {
    let apart = |&time: &usize| a.difference(b, time) > most;
    (0..a.times).find(apart).unwrap_or(a.times)
}

impl Truth {
    /// Follows the scene with methods that get better until they agree to a hundredth of
    /// the tolerances; at least as far as numbers of 16 digits can follow it.
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

    /// Asks for values only as long as some roundings do not matter. Returns true if that
    /// is shorter than before.
    pub(crate) fn trust_less(&mut self) -> bool {
        let before = self.trusted.clone();
        for (trusted, limit) in self.trusted.iter_mut().zip(&self.digits.limits) {
            *trusted = (*trusted).min(*limit);
        }
        self.trusted != before
    }

    /// Largest error of the reference of an output, as far as its values are asked for.
    pub(crate) fn error(&self, output: usize) -> f64 {
        let errors = self.errors[output].iter().take(self.trusted[output]);
        errors.copied().fold(0.0, f64::max)
    }
}

impl Digits {
    /// Digits that last to the end, as far as was looked.
    fn that_last(outputs: usize, times: usize) -> Self {
        Self {
            limits: vec![times; outputs],
            are_too_few: false,
            growth: None,
        }
    }

    /// Returns whether outputs that are `known` for as many times are so to the end, or as long
    /// as the digits last.
    fn suffice(&self, known: &[usize], times: usize) -> bool {
        let mut both = known.iter().zip(&self.limits);
        both.all(|(&known, &limit)| known >= if self.are_too_few { limit } else { times })
    }

    /// By what became of a start that was moved by some roundings.
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
        // As long as it is small, a deviation is in proportion to what it was.
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

/// Mean rate at which a deviation grows while it is small, over all starts; none if it
/// does not by a factor of ten.
fn rate_of_growth(own: &Paths, moved: &Paths, starts: usize, times: &[f64]) -> Option<f64> {
    let rate = |start: usize| {
        let distances =
            (0..times.len()).map(|time| (times[time], own.distance(moved, start, time)));
        // Below, the digits end; above, the deviation is no longer small.
        let mut small = distances.filter(|(_, distance)| (1e-13..1e-2).contains(distance));
        let (first, last) = (small.next()?, small.next_back()?);
        let growth = (last.1 / first.1).ln();
        (growth > 10.0_f64.ln()).then(|| growth / (last.0 - first.0))
    };
    let rates: Vec<f64> = (0..starts).filter_map(rate).collect();
    (!rates.is_empty()).then(|| rates.iter().sum::<f64>() / rates.len() as f64)
}
