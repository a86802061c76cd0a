//! Search for the coarsest setting at which a candidate is right.

use crate::candidate::SettingRange;

/// Largest number of runs of one candidate.
const MOST: usize = 14;

/// Searches for the coarsest setting that is right. `measure` takes the logarithm of a setting and
/// returns the ratio of the largest error to the allowed one, and the seconds of the run. The
/// search ends if the setting is known well enough, if a run costs more than `allowed` seconds and
/// its error is still too large, or if finer settings bring no improvement.
///
/// The search starts at the setting for `tolerance`.
pub(crate) fn bracket(
    range: SettingRange,
    tolerance: f64,
    allowed: f64,
    mut measure: impl FnMut(f64) -> (f64, f64),
) {
    let (coarsest, finest) = range.ends();
    let (mut at, power) = range.guess(tolerance);
    let longest = match range {
        SettingRange::Tolerance { .. } => 2.0,
        SettingRange::Step { .. } | SettingRange::Fixed => 0.5,
    };
    // Logarithm of a setting, and its error.
    let mut good: Option<(f64, f64)> = None;
    let mut bad: Option<(f64, f64)> = None;
    let mut useless = 0;
    for _ in 0..MOST {
        let (ratio, seconds) = measure(at);
        if ratio <= 1.0 {
            good = Some((at, ratio));
        } else {
            // A setting that is finer by some decades should reduce the error by a good part of as
            // many decades.
            let no_better = bad.is_some_and(|(coarser, before)| {
                let expected = power * (coarser - at);
                at < coarser && (before / ratio).log10() < 0.2 * expected
            });
            useless = if no_better { useless + 1 } else { 0 };
            bad = Some((at, ratio));
            if good.is_none() && (seconds > allowed || useless == 3) {
                return;
            }
        }
        let distance = |ratio: f64| (ratio.log10() / power).clamp(-longest, longest);
        at = match (good, bad) {
            (Some((fine, low)), Some((coarse, high))) => {
                if coarse - fine <= range.resolution() {
                    return;
                }
                between((fine, low), (coarse, high))
            }
            (Some((fine, _)), None) if fine >= coarsest => return,
            (Some((fine, low)), None) => {
                (fine - distance(low).min(-2.0 * range.resolution())).min(coarsest)
            }
            (None, Some((coarse, _))) if coarse <= finest => return,
            (None, Some((coarse, high))) => {
                let further = distance(high).max(4.0 * range.resolution());
                if seconds * cost_ratio(range, further) > 2.0 * allowed {
                    return;
                }
                (coarse - further).max(finest)
            }
            (None, None) => return,
        };
    }
}

/// Returns the setting between two settings at which the error should be a little below the allowed
/// one.
fn between((fine, low): (f64, f64), (coarse, high): (f64, f64)) -> f64 {
    let share = (0.8_f64.ln() - low.ln()) / (high.ln() - low.ln());
    let share = if share.is_finite() { share } else { 0.5 };
    fine + share.clamp(0.2, 0.8) * (coarse - fine)
}

/// Returns a lower bound of the factor by which a run becomes more expensive if its setting is
/// finer by `further` decades: half the step costs twice as much.
fn cost_ratio(range: SettingRange, further: f64) -> f64 {
    match range {
        SettingRange::Step { .. } => 10.0_f64.powf(0.5 * further),
        SettingRange::Tolerance { .. } | SettingRange::Fixed => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::bracket;
    use crate::SettingRange;

    const TOLERANCE: SettingRange = SettingRange::Tolerance {
        coarsest: 1e-1,
        finest: 1e-14,
    };

    const STEP: SettingRange = SettingRange::Step {
        coarsest: 0.2,
        finest: 1e-5,
    };

    /// Simulates the search on a method with the error `factor` · settingᵖ and the cost setting^−c,
    /// and returns its runs.
    fn runs(range: SettingRange, factor: f64, [p, c]: [f64; 2], allowed: f64) -> Vec<(f64, f64)> {
        let mut runs = Vec::new();
        bracket(range, 1.0, allowed, |at| {
            let setting = 10.0_f64.powf(at);
            let ratio = factor * setting.powf(p);
            runs.push((setting, ratio));
            (ratio, setting.powf(-c))
        });
        runs
    }

    fn coarsest_good(runs: &[(f64, f64)]) -> Option<f64> {
        let good = runs.iter().filter(|(_, ratio)| *ratio <= 1.0);
        good.map(|(setting, _)| *setting).reduce(f64::max)
    }

    #[test]
    fn the_coarsest_good_setting_is_found_in_few_runs() {
        for factor in [3e1, 2e5, 7e10] {
            let runs = runs(TOLERANCE, factor, [1.0, 0.125], f64::INFINITY);
            let found = coarsest_good(&runs).unwrap() * factor;
            assert!((0.75..=1.0).contains(&found), "{runs:?}");
            assert!(runs.len() <= 12, "{runs:?}");
        }
        for order in [2.0, 4.0, 8.0] {
            let factor = 0.01_f64.powf(-order);
            let runs = runs(STEP, factor, [order, 1.0], f64::INFINITY);
            let found = coarsest_good(&runs).unwrap() / 0.01;
            assert!((0.94..=1.0).contains(&found), "{order}: {runs:?}");
        }
    }

    /// Checks a search that starts where errors are slightly too large and fluctuate.
    #[test]
    fn an_error_that_is_nearly_right_is_pursued() {
        let mut found = f64::NAN;
        bracket(TOLERANCE, 1e-6, f64::INFINITY, |at| {
            let bump = if (-7.9..-7.1).contains(&at) { 0.3 } else { 0.0 };
            let ratio = 1.2 * 10.0_f64.powf(at + 7.0 + bump);
            if ratio <= 1.0 {
                found = at;
            }
            (ratio, 1.0)
        });
        assert!(found < -7.0, "{found}");
    }

    #[test]
    fn what_costs_too_much_is_left() {
        // Right at a step of 1e-4, which costs 1e4.
        let runs = runs(STEP, 1e4, [1.0, 1.0], 100.0);
        assert_eq!(coarsest_good(&runs), None);
        let dearest = runs.iter().fold(0.0_f64, |most, run| most.max(1.0 / run.0));
        assert!(dearest < 1e3, "{runs:?}");
    }

    #[test]
    fn an_error_that_no_setting_makes_smaller_ends_the_search() {
        let mut count = 0;
        bracket(TOLERANCE, 1e-6, f64::INFINITY, |_| {
            count += 1;
            (5.0, 1.0)
        });
        assert_eq!(count, 4);
        // Without a setting there is nothing to search.
        bracket(SettingRange::Fixed, 1e-6, f64::INFINITY, |_| {
            count += 1;
            (0.1, 1.0)
        });
        assert_eq!(count, 5);
    }

    #[test]
    fn the_coarsest_of_all_is_tried_where_anything_is_good() {
        let runs = runs(TOLERANCE, 1e-3, [1.0, 0.125], f64::INFINITY);
        assert_eq!(coarsest_good(&runs), Some(0.1));
    }
}
