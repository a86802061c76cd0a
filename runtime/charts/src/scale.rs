//! Values along an axis, and where they stand.

/// The part of an axis that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub(crate) log: bool,
    /// Ends as coordinates: values, or their logarithms to base 10.
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Spans of linear axes for which ticks can be computed without overflow.
const SPANS: std::ops::RangeInclusive<f64> = 1e-290..=1e290;
/// Spans of linear axes, relative to the larger end, whose ticks f64 resolves.
pub(crate) const RESOLVED: f64 = 1e-13;
impl Scale {
    /// A linear scale, if its span can be divided.
    pub(crate) fn linear(low: f64, high: f64) -> Option<Self> {
        let log = false;
        let resolved = high - low > RESOLVED * low.abs().max(high.abs());
        (resolved && SPANS.contains(&(high - low))).then_some(Self { log, low, high })
    }

    /// Place of a value between the ends, 0 to 1 inside; `None` where the axis
    /// has no such value.
    pub(crate) fn fraction(&self, value: f64) -> Option<f64> {
        if !drawable(self.log, value) {
            return None;
        }
        Some(self.place(coordinate(self.log, value)))
    }

    /// Place of a coordinate between the ends.
    pub(crate) fn place(&self, coordinate: f64) -> f64 {
        (coordinate - self.low) / (self.high - self.low)
    }
}

/// The coordinate of a value along an axis: itself, or its logarithm to base 10.
pub(crate) fn coordinate(log: bool, value: f64) -> f64 {
    if log { value.log10() } else { value }
}

/// Returns true if an axis has such a value.
pub(crate) fn drawable(log: bool, value: f64) -> bool {
    value.is_finite() && (!log || value > 0.0)
}
