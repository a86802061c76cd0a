//! Relative error of W against amplitude.

use std::fmt;

use super::forms::{FORMS, Powers};

/// Smallest and largest amplitude of the antiphase motion looked at, rad.
pub const AMPLITUDES: [f64; 2] = [1e-3, 1.5];

/// The error of each form over many states of about one amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Amplitude, rad.
    pub amplitude: f64,
    /// Number of states.
    pub states: u64,
    /// Rms of (W − W exact) over rms of W exact, in the order of [`FORMS`].
    pub errors: [f64; FORMS.len()],
}

/// Sums of squares over states.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    states: u64,
    exact: f64,
    errors: [f64; FORMS.len()],
}

impl Sums {
    pub(super) fn add(&mut self, powers: &Powers) {
        self.states += 1;
        self.exact += powers.exact.powi(2);
        for (sum, form) in self.errors.iter_mut().zip(powers.forms) {
            *sum += (form - powers.exact).powi(2);
        }
    }

    /// The point at this amplitude; none where no energy flows.
    pub(super) fn point(&self, amplitude: f64) -> Option<Point> {
        (self.exact > 0.0).then(|| Point {
            amplitude,
            states: self.states,
            errors: self.errors.map(|sum| (sum / self.exact).sqrt()),
        })
    }
}

/// `count` values from `low` to `high`, both positive, with equal ratios.
pub fn logarithmic([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|index| low * (high / low).powf(index as f64 / last))
        .collect()
}

/// Where an error passes a level, as the amplitude grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    /// Above the level from the smallest amplitude on, which is given, rad.
    Below(f64),
    /// It passes the level at this amplitude first, rad.
    At(f64),
    /// Not above the level up to the largest amplitude, which is given, rad.
    Above(f64),
}

impl Crossing {
    /// Where the form with this index in [`FORMS`] first passes `level`,
    /// between two points by a power law. None without points or such a form.
    pub fn of(curve: &[Point], form: usize, level: f64) -> Option<Self> {
        let mut previous: Option<(f64, f64)> = None;
        for point in curve {
            let here = (point.amplitude, *point.errors.get(form)?);
            if here.1 > level {
                let Some(below) = previous else {
                    return Some(Self::Below(here.0));
                };
                let part = (level / below.1).ln() / (here.1 / below.1).ln();
                return Some(Self::At(below.0 * (here.0 / below.0).powf(part)));
            }
            previous = Some(here);
        }
        previous.map(|(amplitude, _)| Self::Above(amplitude))
    }
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Through `pad`, so that a width given by the caller is kept.
        f.pad(&match self {
            Self::Below(amplitude) => format!("< {amplitude:.3}"),
            Self::At(amplitude) => format!("{amplitude:.3}"),
            Self::Above(amplitude) => format!("> {amplitude:.2}"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{AMPLITUDES, Crossing, Point, logarithmic};

    fn curve(exponent: i32) -> Vec<Point> {
        let point = |amplitude: f64| Point {
            amplitude,
            states: 1,
            errors: [amplitude.powi(exponent); 5],
        };
        logarithmic(AMPLITUDES, 12).into_iter().map(point).collect()
    }

    #[test]
    fn a_power_law_is_interpolated_exactly() {
        let Some(Crossing::At(amplitude)) = Crossing::of(&curve(2), 1, 0.01) else {
            panic!("no crossing");
        };
        assert!((amplitude - 0.1).abs() < 1e-12, "{amplitude}");
    }

    #[test]
    fn a_level_may_be_passed_outside_the_range() {
        let crossing = |level| Crossing::of(&curve(2), 0, level).unwrap().to_string();
        assert_eq!(crossing(1e-7), "< 0.001");
        assert_eq!(crossing(3.0), "> 1.50");
        assert_eq!(Crossing::of(&curve(2), 5, 1.0), None);
        assert_eq!(Crossing::of(&[], 0, 1.0), None);
    }
}
