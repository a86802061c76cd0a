//! The value of an unknown for which the closure error of the energy budget is smallest.

/// An unknown of a closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureUnknown {
    /// Largest absolute value that is searched.
    pub largest: f64,
    /// Largest change in a step.
    pub step: f64,
    /// Change used for difference quotients; the search ends when a step is smaller.
    pub small: f64,
}

const STEPS: usize = 20;

/// Returns the weights of a closure from its standard deviations. A lower limit of the deviations
/// prevents the first times, where they are small, from dominating.
pub fn weights(deviations: impl Iterator<Item = f64>) -> Vec<f64> {
    let deviations: Vec<f64> = deviations.collect();
    let floor = deviations.iter().sum::<f64>() / deviations.len() as f64;
    let weights = deviations
        .iter()
        .map(|own| 1.0 / (own * own + floor * floor));
    weights.collect()
}

/// Returns the value of an unknown, searched from 0 on by the Gauss–Newton method, for which the
/// closure error is smallest; `None` if it becomes too large.
pub fn value(
    unknown: ClosureUnknown,
    weights: &[f64],
    closure: impl Fn(f64) -> Vec<f64>,
) -> Option<f64> {
    let mut value = 0.0_f64;
    for _ in 0..STEPS {
        let step = step(weights, &closure(value), &closure(value + unknown.small));
        let step = (unknown.small * step).clamp(-unknown.step, unknown.step);
        value += step;
        if value.is_nan() || value.abs() > unknown.largest {
            return None;
        }
        if step.abs() < unknown.small {
            return Some(value);
        }
    }
    None
}

/// Returns the step to the smallest closure error, in units of the distance between the two given
/// values.
pub fn step(weights: &[f64], here: &[f64], beside: &[f64]) -> f64 {
    let rows = here.iter().zip(beside).zip(weights);
    let sums = rows.fold([0.0; 2], |[own, square], ((here, beside), weight)| {
        let slope = beside - here;
        [own + weight * here * slope, square + weight * slope * slope]
    });
    -sums[0] / sums[1]
}

/// Returns the nonnegative coefficients of the columns for which the closure error is smallest. The
/// closure is linear in them.
pub fn coefficients(weights: &[f64], closure: &[f64], columns: &[Vec<f64>]) -> Vec<f64> {
    let mut free: Vec<usize> = (0..columns.len()).collect();
    loop {
        let found = unbounded(weights, closure, columns, &free);
        let least = free.iter().zip(&found).min_by(|a, b| a.1.total_cmp(b.1));
        match least {
            Some((&own, value)) if value.is_nan() || *value < 0.0 => {
                free.retain(|other| *other != own);
            }
            _ => {
                let mut all = vec![0.0; columns.len()];
                for (own, value) in free.iter().zip(found) {
                    all[*own] = value;
                }
                return all;
            }
        }
    }
}

fn unbounded(weights: &[f64], closure: &[f64], columns: &[Vec<f64>], free: &[usize]) -> Vec<f64> {
    let product = |a: &[f64], b: &[f64]| -> f64 {
        let rows = weights.iter().zip(a).zip(b);
        rows.map(|((weight, a), b)| weight * a * b).sum()
    };
    let count = free.len();
    // Gauss and Jordan: the matrix is positive, and small.
    let mut rows: Vec<Vec<f64>> = free
        .iter()
        .map(|&own| {
            let squares = free
                .iter()
                .map(|&other| product(&columns[own], &columns[other]));
            squares.chain([-product(&columns[own], closure)]).collect()
        })
        .collect();
    for pivot in 0..count {
        let scale = rows[pivot][pivot];
        rows[pivot].iter_mut().for_each(|cell| *cell /= scale);
        let own = rows[pivot].clone();
        for (index, row) in rows
            .iter_mut()
            .enumerate()
            .filter(|(index, _)| *index != pivot)
        {
            let _ = index;
            let factor = row[pivot];
            row.iter_mut()
                .zip(&own)
                .for_each(|(cell, own)| *cell -= factor * own);
        }
    }
    rows.iter().map(|row| row[count]).collect()
}

#[cfg(test)]
mod tests {
    use super::{ClosureUnknown, coefficients, value, weights};

    #[test]
    fn coefficients_are_found_and_not_negative() {
        let weights = vec![1.0, 0.5, 2.0, 1.0];
        let columns = [vec![0.0, -1.0, -2.0, -3.5], vec![0.0, -0.5, -2.5, -3.0]];
        for truth in [[0.3, 0.0], [0.2, 0.7], [1.5, 0.01]] {
            let closure: Vec<f64> = (0..4)
                .map(|row| -(truth[0] * columns[0][row] + truth[1] * columns[1][row]))
                .collect();
            let found = coefficients(&weights, &closure, &columns);
            assert!(
                found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-9),
                "{found:?}"
            );
        }
        // The closure would have the second one drive.
        let closure: Vec<f64> = (0..4)
            .map(|row| 0.5 * columns[1][row] - columns[0][row])
            .collect();
        let found = coefficients(&weights, &closure, &columns);
        assert!(found[0] > 0.0 && found[1] == 0.0, "{found:?}");
    }

    #[test]
    fn unknowns_are_found_or_out_of_reach() {
        let unknown = ClosureUnknown {
            largest: 0.8,
            step: 0.2,
            small: 1e-4,
        };
        let weights = weights([0.0, 0.1, 0.2].into_iter());
        for truth in [0.01_f64, -0.3, 0.75] {
            let closure = |x: f64| vec![0.0, (x - truth).sin(), 2.0 * (x - truth).sin()];
            let found = value(unknown, &weights, closure).unwrap();
            assert!((found - truth).abs() < 1e-6, "{truth}: {found}");
        }
        assert_eq!(
            value(unknown, &weights, |x| vec![0.0, x - 0.9, x - 0.9]),
            None
        );
        assert_eq!(value(unknown, &weights, |_| vec![0.0, 1.0, 1.0]), None);
    }
}
