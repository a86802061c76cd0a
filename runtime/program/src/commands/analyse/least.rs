//! The value of one unknown for which a closure is least.

/// An unknown of a closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureUnknown {
    /// Largest size that is looked for.
    pub largest: f64,
    /// Largest change in a step.
    pub step: f64,
    /// Change by which derivatives are taken, and below which a step is the last.
    pub small: f64,
}

const STEPS: usize = 20;

/// Weights of a closure by its deviations. Small ones of the first times alone would decide without
/// a floor.
pub fn weights(deviations: impl Iterator<Item = f64>) -> Vec<f64> {
    let deviations: Vec<f64> = deviations.collect();
    let floor = deviations.iter().sum::<f64>() / deviations.len() as f64;
    let weights = deviations
        .iter()
        .map(|own| 1.0 / (own * own + floor * floor));
    weights.collect()
}

/// The value of an unknown, from 0 on, for which a closure is least by the method of Gauss and
/// Newton; none where it leads too far.
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

/// The step to the least closure, in steps from one to the other of two values.
pub fn step(weights: &[f64], here: &[f64], beside: &[f64]) -> f64 {
    let rows = here.iter().zip(beside).zip(weights);
    let sums = rows.fold([0.0; 2], |[own, square], ((here, beside), weight)| {
        let slope = beside - here;
        [own + weight * here * slope, square + weight * slope * slope]
    });
    -sums[0] / sums[1]
}

#[cfg(test)]
mod tests {
    use super::{ClosureUnknown, value, weights};

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
