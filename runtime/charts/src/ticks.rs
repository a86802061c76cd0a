use crate::decimal::{leading_decade, number, plain, power, reads_plain};
use crate::description::Axis;
use crate::label::Label;
use crate::scale::Scale;

/// A labelled tick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Coordinate along the axis: the value, or its logarithm to base 10.
    pub(crate) at: f64,
    /// Text as label markup.
    pub(crate) label: String,
}

/// The ticks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Ticks {
    pub(crate) major: Vec<Tick>,
    /// Coordinates of ticks without label.
    pub(crate) minor: Vec<f64>,
    /// Part that is common to all labels, as label markup: a power of ten by which they are
    /// multiplied, and a number that is added afterwards.
    pub(crate) common: Option<String>,
    /// Exponent of that common power of ten, if no number is added.
    pub(crate) exponent: Option<i32>,
}

/// Number of digits above which the common part is removed from labels.
const MOST_DIGITS: u32 = 6;

/// Returns the ticks for a scale, at most `most` of them with labels if `most` >= 2. If 5 or more
/// are allowed, a linear scale has at least 2.
pub(crate) fn ticks(scale: &Scale, most: usize) -> Ticks {
    if scale.log {
        logarithmic(scale.low, scale.high, most)
    } else {
        linear(scale.low, scale.high, most, 0.0)
    }
}

/// Returns the ticks of an axis, and the label of the axis, in which the unit gets the SI prefix of
/// the power of ten that is common to all ticks.
pub(crate) fn labelled(axis: &Axis, scale: &Scale, most: usize) -> (Ticks, String) {
    let mut ticks = match axis.whole && !scale.log {
        true => linear(scale.low, scale.high, most, 1.0),
        false => ticks(scale, most),
    };
    match ticks
        .exponent
        .and_then(|power| prefixed(&axis.label, power))
    {
        Some(label) => {
            (ticks.common, ticks.exponent) = (None, None);
            (ticks, label)
        }
        None => (ticks, axis.label.clone()),
    }
}

/// SI units that can get a prefix; units that usually have prefixes for large numbers come first.
const UNITS: [&str; 4] = ["J", "W", "Hz", "N"];
const UNITS_OF_SMALL: [&str; 3] = ["s", "m", "rad"];

/// Returns a label that ends with a unit, with the SI prefix of a power of ten added; `None` for
/// other units.
fn prefixed(label: &str, exponent: i32) -> Option<String> {
    let (quantity, unit) = label.strip_suffix(')')?.rsplit_once('(')?;
    let has_prefix = UNITS.contains(&unit) || (exponent < 0 && UNITS_OF_SMALL.contains(&unit));
    let prefix = match exponent {
        -15 => "f",
        -12 => "p",
        -9 => "n",
        -6 => "µ",
        -3 => "m",
        3 => "k",
        6 => "M",
        9 => "G",
        _ => return None,
    };
    has_prefix.then(|| format!("{quantity}({prefix}{unit})"))
}

/// Returns ticks at multiples of 1, 2 or 5 times a power of ten. A tick is a whole number of such
/// powers, so that its label is exact. Ticks are at least `least_step` apart.
fn linear(low: f64, high: f64, most: usize, least_step: f64) -> Ticks {
    let even = (high - low) / (most + 1) as f64;
    let (mut step, mut exponent) = step_at_least(even.max(least_step));
    let (mut first, mut last) = multiples(low, high, step, exponent);
    while last - first >= most.max(2) as i64 {
        // Coarser by a factor of at least 5/4, so the next of 1, 2 and 5.
        (step, exponent) = step_at_least(1.25 * Unit(exponent).times(step));
        (first, last) = multiples(low, high, step, exponent);
    }
    let unit = Unit(exponent);
    let digits: Vec<i64> = (first..=last).map(|n| n * step).collect();
    let at = digits.iter().map(|n| unit.times(*n).clamp(low, high));
    let (labels, common, power) = labels(&digits, exponent);
    Ticks {
        major: at
            .zip(labels)
            .map(|(at, label)| Tick { at, label })
            .collect(),
        minor: Vec::new(),
        common,
        exponent: power,
    }
}

/// A power of ten, given by its exponent.
#[derive(Clone, Copy)]
struct Unit(i32);

impl Unit {
    /// Returns `digits` x 10^exponent. Dividing by a positive power rounds once, whereas
    /// multiplying by a negative power, which is rounded itself, rounds twice.
    fn times(self, digits: i64) -> f64 {
        if self.0 < 0 {
            digits as f64 / 10f64.powi(-self.0)
        } else {
            digits as f64 * 10f64.powi(self.0)
        }
    }
}

/// Returns the smallest product of 1, 2 or 5 and a power of ten that is at least `least`, as these
/// two factors.
fn step_at_least(least: f64) -> (i64, i32) {
    let exponent = least.log10().floor() as i32;
    for step in [1, 2, 5] {
        if Unit(exponent).times(step) >= least * (1.0 - 1e-9) {
            return (step, exponent);
        }
    }
    (1, exponent + 1)
}

/// Returns the first and the last multiple of `step` x 10^`exponent` within a range. Multiples that
/// coincide with an end of the range up to rounding count.
fn multiples(low: f64, high: f64, step: i64, exponent: i32) -> (i64, i64) {
    let step = Unit(exponent).times(step);
    let (low, high) = (low / step, high / step);
    let slack = |quotient: f64| 1e-9 + 2.0 * f64::EPSILON * quotient.abs();
    let first = (low - slack(low)).ceil() as i64;
    (first, (high + slack(high)).floor() as i64)
}

/// Returns the range, with an end moved outwards to a multiple of a coarse step if one lies closer
/// than a hundredth of the span: 0 to 19.99 becomes 0 to 20.
pub(crate) fn rounded_outwards(low: f64, high: f64) -> (f64, f64) {
    let span = high - low;
    let (step, exponent) = step_at_least(span / 10.0);
    let (first, last) = multiples(low, high, step, exponent);
    let before = Unit(exponent).times((first - 1) * step);
    let after = Unit(exponent).times((last + 1) * step);
    (
        if low - before < 0.01 * span {
            before
        } else {
            low
        },
        if after - high < 0.01 * span {
            after
        } else {
            high
        },
    )
}

/// Returns the labels of the multiples `digits` of a power of ten, their common part, and its
/// exponent if the common part is only a power of ten.
fn labels(digits: &[i64], exponent: i32) -> (Vec<String>, Option<String>, Option<i32>) {
    let largest = |digits: &[i64]| {
        let largest = digits.iter().copied().max_by_key(|n| n.unsigned_abs());
        largest.unwrap_or(0)
    };
    let offset = offset(digits, largest(digits));
    let digits: Vec<i64> = digits.iter().map(|n| n - offset).collect();
    let leading = leading_decade(largest(&digits), exponent);
    let shift = if reads_plain(leading) {
        0
    } else {
        3 * leading.div_euclid(3)
    };
    let common = match (shift, offset) {
        (0, 0) => None,
        (0, _) => Some(signed(offset, exponent)),
        (_, 0) => Some(format!("×{}", power(shift))),
        _ => {
            let offset = signed(offset, exponent);
            Some(format!("×{} {offset}", power(shift)))
        }
    };
    let power = (shift != 0 && offset == 0).then_some(shift);
    let labels = digits.iter().map(|n| plain(*n, exponent - shift));
    (labels.collect(), common, power)
}

/// Returns the number to subtract so that labels are short, if ticks are close to each other and
/// far from zero: the roundest number between the first and the last tick.
fn offset(digits: &[i64], largest: i64) -> i64 {
    let (Some(&first), Some(&last)) = (digits.first(), digits.last()) else {
        return 0;
    };
    let many = largest.unsigned_abs() >= 10u64.pow(MOST_DIGITS);
    // Trailing zeros cost nothing where a power of ten is taken out.
    let zeros = digits.iter().all(|n| n % 10i64.pow(MOST_DIGITS - 2) == 0);
    if !many || zeros {
        return 0;
    }
    // Coarser multiples lie in the range no more often than finer ones, so the
    // last found is the roundest. 10^18 is the largest power that fits.
    let multiple = |power: u32| {
        let round = 10i64.pow(power);
        -(-first).div_euclid(round) * round
    };
    (0..=18)
        .map(multiple)
        .take_while(|candidate| *candidate <= last)
        .last()
        .unwrap_or(0)
}

/// Formats a number with a sign that shows it is to be added.
fn signed(digits: i64, exponent: i32) -> String {
    let sign = if digits < 0 { "−" } else { "+" };
    format!("{sign} {}", number(digits.abs(), exponent))
}

/// Returns ticks for an axis from 10^`low` to 10^`high`: at decades, at every n-th decade if there
/// are many, or within the decade if there is hardly one.
fn logarithmic(low: f64, high: f64, most: usize) -> Ticks {
    let first = (low - 1e-9).ceil() as i32;
    let last = (high + 1e-9).floor() as i32;
    if last - first < 1 {
        return within_decade(low, high, most);
    }
    let decades = (last - first + 1) as usize;
    let stride = [1, 2, 3, 5, 10, 20, 50, 100, 200]
        .into_iter()
        .find(|stride| decades.div_ceil(*stride as usize) <= most.max(2))
        .unwrap_or(500);
    let exponents: Vec<i32> = (first..=last).filter(|k| k % stride == 0).collect();
    let plainly = exponents.iter().all(|k| (-2..=3).contains(k));
    let label = |k: i32| if plainly { plain(1, k) } else { power(k) };
    let minor: Vec<f64> = if stride > 1 {
        (first..=last)
            .filter(|k| k % stride != 0)
            .map(f64::from)
            .collect()
    } else {
        (first - 1..=last)
            .flat_map(|k| (2..=9).map(move |n| f64::from(k) + f64::from(n).log10()))
            .filter(|at| (low..=high).contains(at))
            .collect()
    };
    Ticks {
        major: exponents
            .iter()
            .map(|k| Tick {
                at: f64::from(*k).clamp(low, high),
                label: label(*k),
            })
            .collect(),
        minor,
        ..Ticks::default()
    }
}

/// Returns ticks at 1, 2 and 5 in each decade or, in a narrower range, at the even steps of a
/// linear axis.
fn within_decade(low: f64, high: f64, most: usize) -> Ticks {
    let decades = low.floor() as i32..=high.floor() as i32;
    let digits = decades
        .flat_map(|k| [1i64, 2, 5].map(|n| (n, k)))
        .map(|(n, k)| ((n as f64).log10() + f64::from(k), n, k))
        .filter(|(at, ..)| (low - 1e-9..=high + 1e-9).contains(at));
    let major: Vec<Tick> = digits
        .map(|(at, n, k)| Tick {
            at: at.clamp(low, high),
            label: number(n, k),
        })
        .collect();
    let (from, to) = (10f64.powf(low), 10f64.powf(high));
    let linear_works = Scale::linear(from, to).is_some();
    if (3..=most.max(3)).contains(&major.len()) || !linear_works {
        return Ticks {
            major,
            ..Ticks::default()
        };
    }
    let mut ticks = linear(from, to, most, 0.0);
    for tick in &mut ticks.major {
        tick.at = tick.at.log10().clamp(low, high);
    }
    ticks
}

pub(crate) fn tick_labels(ticks: &Ticks) -> Vec<Label> {
    let labels = ticks.major.iter();
    labels.map(|tick| Label::parse(&tick.label)).collect()
}

/// Returns how many ticks fit on an axis of this length if they are `apart` px apart.
pub(crate) fn most(length: f64, apart: f64) -> usize {
    ((length / apart) as usize).clamp(5, 40)
}
