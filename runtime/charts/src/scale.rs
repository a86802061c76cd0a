//! Scales: conversion of values along an axis to positions.

/// The part of an axis that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub(crate) log: bool,
    /// Lower end as a coordinate: a value, or its logarithm to base 10.
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Spans of linear axes for which ticks can be computed without overflow.
const SPANS: std::ops::RangeInclusive<f64> = 1e-290..=1e290;
/// Smallest span of a linear axis, relative to its larger end, whose ticks `f64` resolves.
pub(crate) const RESOLVED: f64 = 1e-13;
impl Scale {
    /// Creates a linear scale; `None` if its span cannot be divided into ticks.
    pub(crate) fn linear(low: f64, high: f64) -> Option<Self> {
        let log = false;
        let resolved = high - low > RESOLVED * low.abs().max(high.abs());
        (resolved && SPANS.contains(&(high - low))).then_some(Self { log, low, high })
    }

    /// Returns the position of a value between the ends, 0 to 1 inside; `None` if the axis cannot
    /// show such a value.
    pub(crate) fn fraction(&self, value: f64) -> Option<f64> {
        if !drawable(self.log, value) {
            return None;
        }
        Some(self.place(coordinate(self.log, value)))
    }

    /// Returns the position of a coordinate between the ends.
    pub(crate) fn place(&self, coordinate: f64) -> f64 {
        (coordinate - self.low) / (self.high - self.low)
    }
}

/// Returns the coordinate of a value along an axis: the value itself, or its logarithm to base 10.
pub(crate) fn coordinate(log: bool, value: f64) -> f64 {
    if log { value.log10() } else { value }
}

/// Returns true if an axis can show such a value.
pub(crate) fn drawable(log: bool, value: f64) -> bool {
    value.is_finite() && (!log || value > 0.0)
}
