//! Maximisation of likelihoods.

/// Returns the argument at which a function is largest in an interval: the best point of a grid,
/// refined between its neighbours by golden sections. Values that are not finite count as smallest.
pub(super) fn largest(function: impl Fn(f64) -> f64, [low, high]: [f64; 2]) -> f64 {
    const GRID: u32 = 40;
    const SECTIONS: u32 = 16;
    let value = |at: f64| {
        let value = function(at);
        if value.is_nan() {
            f64::NEG_INFINITY
        } else {
            value
        }
    };
    let width = (high - low) / f64::from(GRID);
    let grid = (0..=GRID).map(|index| low + width * f64::from(index));
    let values = grid.map(|at| (at, value(at)));
    let (best, _) = values.fold((low, f64::NEG_INFINITY), |best, next| {
        if next.1 > best.1 { next } else { best }
    });
    let (mut low, mut high) = ((best - width).max(low), (best + width).min(high));
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_left, mut at_right) = (value(left), value(right));
    for _ in 0..SECTIONS {
        if at_left >= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - golden * (high - low);
            at_left = value(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + golden * (high - low);
            at_right = value(right);
        }
    }
    0.5 * (low + high)
}

/// Returns a point near `at` at which a function of several variables is large. It changes one
/// variable after the other in steps, as long as the value increases, and halves the steps down to
/// `least` if no step increases it. No variable falls below `low`.
pub(super) fn climb(
    function: impl Fn(&[f64]) -> f64,
    mut at: Vec<f64>,
    low: f64,
    [mut step, least]: [f64; 2],
) -> Vec<f64> {
    let mut best = function(&at);
    while step >= least {
        let mut gains = false;
        for index in 0..at.len() {
            for side in [step, -step] {
                loop {
                    let before = at[index];
                    at[index] = (before + side).max(low);
                    let value = function(&at);
                    // False for NaN.
                    if value > best && at[index] != before {
                        (best, gains) = (value, true);
                    } else {
                        at[index] = before;
                        break;
                    }
                }
            }
        }
        if !gains {
            step *= 0.5;
        }
    }
    at
}
