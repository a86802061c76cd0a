//! Relative error of approximations of the energy transfer W, as a function of the amplitude.

use core::fmt;

use crate::transfer_forms::TransferForm;

/// Relative errors of truncated forms of the energy transfer W into one sector, by amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorCurve {
    /// Name of the sector into which W transfers energy.
    pub receiver: String,
    /// The truncated forms, in the order of [`ErrorPoint::errors`].
    pub forms: Vec<TransferForm>,
    /// The points in order of amplitude; amplitudes at which no energy flows are left out.
    pub points: Vec<ErrorPoint>,
}

/// Relative error of each truncated form over many states of about the same amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPoint {
    /// Amplitude of the states, rad.
    pub amplitude: f64,
    /// Number of states.
    pub states: u64,
    /// For each form, the root mean square of its error W − W_exact, divided by the root mean
    /// square of W_exact.
    pub errors: Vec<f64>,
}

impl ErrorCurve {
    /// Returns the errors of the form with this index in [`forms`](Self::forms), one for each
    /// point; NaN if there is no such form.
    #[must_use]
    pub fn errors(&self, form: usize) -> Vec<f64> {
        let error = |point: &ErrorPoint| point.errors.get(form).copied().unwrap_or(f64::NAN);
        self.points.iter().map(error).collect()
    }

    /// Returns the amplitude at which the error of the form with this index in
    /// [`forms`](Self::forms) first exceeds `level`, interpolated between two points by a power
    /// law. `None` if there are no points or no such form.
    #[must_use]
    pub fn crossing(&self, form: usize, level: f64) -> Option<LevelCrossing> {
        let mut previous: Option<(f64, f64)> = None;
        for point in &self.points {
            let here = (point.amplitude, *point.errors.get(form)?);
            if here.1 > level {
                let Some(below) = previous else {
                    return Some(LevelCrossing::Below(here.0));
                };
                // The error may be zero at the point below, where no power law applies.
                let part = if below.1 > 0.0 {
                    (level / below.1).ln() / (here.1 / below.1).ln()
                } else {
                    1.0
                };
                return Some(LevelCrossing::At(below.0 * (here.0 / below.0).powf(part)));
            }
            previous = Some(here);
        }
        previous.map(|(amplitude, _)| LevelCrossing::Above(amplitude))
    }
}

/// Amplitude at which a growing error exceeds a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelCrossing {
    /// The error exceeds the level already at the smallest amplitude, which is given in rad.
    Below(f64),
    /// The error first exceeds the level at this amplitude, in rad.
    At(f64),
    /// The error does not exceed the level up to the largest amplitude, which is given in rad.
    Above(f64),
}

impl LevelCrossing {
    /// Returns the amplitude, rad; `None` if it is outside the range examined.
    #[must_use]
    pub fn amplitude(self) -> Option<f64> {
        match self {
            Self::At(amplitude) => Some(amplitude),
            Self::Below(_) | Self::Above(_) => None,
        }
    }
}

impl fmt::Display for LevelCrossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Uses `pad`, which respects the width that the caller gives.
        f.pad(&match self {
            Self::Below(amplitude) => format!("< {amplitude:.3}"),
            Self::At(amplitude) => format!("{amplitude:.3}"),
            Self::Above(amplitude) => format!("> {amplitude:.2}"),
        })
    }
}

/// Sums of squares of W and of its errors over states, for each sector.
#[derive(Clone, Debug)]
pub(super) struct SquareSums {
    states: u64,
    /// Sums of the squares of the exact W, by sector.
    exact: Vec<f64>,
    /// Sums of the squares of the errors, by truncated form, then by sector.
    errors: Vec<f64>,
}

impl SquareSums {
    pub(super) fn new(receivers: usize, forms: usize) -> Self {
        Self {
            states: 0,
            exact: vec![0.0; receivers],
            errors: vec![0.0; receivers * forms],
        }
    }

    /// Adds a state: `exact` is the exact W by sector, `forms` is the W of all truncated forms, by
    /// form, then by sector.
    pub(super) fn add(&mut self, exact: &[f64], forms: &[f64]) {
        self.states += 1;
        for (sum, exact) in self.exact.iter_mut().zip(exact) {
            *sum += exact * exact;
        }
        let references = exact.iter().cycle();
        for ((sum, form), exact) in self.errors.iter_mut().zip(forms).zip(references) {
            *sum += (form - exact).powi(2);
        }
    }

    /// Adds all states of another set of sums.
    pub(super) fn append(&mut self, others: &Self) {
        self.states += others.states;
        let pairs = [
            (&mut self.exact, &others.exact),
            (&mut self.errors, &others.errors),
        ];
        for (own, others) in pairs {
            for (sum, other) in own.iter_mut().zip(others) {
                *sum += other;
            }
        }
    }
}

/// Returns one error curve per receiving sector, from the sums at ascending amplitudes.
pub(super) fn curves(
    receivers: &[String],
    forms: &[TransferForm],
    sums: &[(f64, SquareSums)],
) -> Vec<ErrorCurve> {
    let point = |receiver: usize, amplitude: f64, sums: &SquareSums| {
        let exact = sums.exact.get(receiver).copied().unwrap_or(0.0);
        let own = sums.errors.iter().skip(receiver).step_by(receivers.len());
        (exact > 0.0).then(|| ErrorPoint {
            amplitude,
            states: sums.states,
            errors: own.map(|sum| (sum / exact).sqrt()).collect(),
        })
    };
    let curve = |(index, receiver): (usize, &String)| ErrorCurve {
        receiver: receiver.clone(),
        forms: forms.to_vec(),
        points: sums
            .iter()
            .filter_map(|(amplitude, sums)| point(index, *amplitude, sums))
            .collect(),
    };
    receivers.iter().enumerate().map(curve).collect()
}

#[cfg(test)]
mod tests {
    use super::{ErrorCurve, ErrorPoint, LevelCrossing, SquareSums, curves};
    use crate::analysis::truncation::logarithmic;
    use crate::transfer_forms::TransferForm;

    fn curve(exponent: i32) -> ErrorCurve {
        let point = |amplitude: f64| ErrorPoint {
            amplitude,
            states: 1,
            errors: vec![0.0, amplitude.powi(exponent)],
        };
        ErrorCurve {
            receiver: "d".to_owned(),
            forms: vec![TransferForm::Amplitude(2), TransferForm::Amplitude(4)],
            points: logarithmic([1e-3, 1.5], 12)
                .into_iter()
                .map(point)
                .collect(),
        }
    }

    #[test]
    fn a_power_law_is_interpolated_exactly() {
        let crossing = curve(2).crossing(1, 0.01);
        let amplitude = crossing.and_then(LevelCrossing::amplitude).unwrap();
        assert!((amplitude - 0.1).abs() < 1e-12, "{amplitude}");
    }

    #[test]
    fn a_level_may_be_passed_outside_the_range() {
        let crossing = |level| curve(2).crossing(1, level).unwrap().to_string();
        assert_eq!(crossing(1e-7), "< 0.001");
        assert_eq!(crossing(3.0), "> 1.50");
        assert_eq!(curve(2).crossing(2, 1.0), None);
        assert_eq!(curve(2).crossing(0, 0.5), Some(LevelCrossing::Above(1.5)));
    }

    #[test]
    fn errors_go_to_their_form_and_sector() {
        let forms = [TransferForm::Angle(1), TransferForm::Amplitude(2)];
        let mut sums = SquareSums::new(2, 2);
        // Two states: W exact is 3 and 4 into the first sector, zero into the second.
        sums.add(&[3.0, 0.0], &[3.0, 0.0, 3.5, 1.0]);
        sums.add(&[4.0, 0.0], &[4.0, 0.0, 4.0, 1.0]);
        let curves = curves(&["a", "b"].map(str::to_owned), &forms, &[(0.1, sums)]);
        assert_eq!(curves[0].receiver, "a");
        assert_eq!(curves[0].points[0].errors, [0.0, 0.1]);
        assert_eq!(curves[0].points[0].states, 2);
        assert!(curves[1].points.is_empty(), "no energy flows into `b`");
    }
}
