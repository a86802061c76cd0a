//! Measurement of an angle at one time.

/// Angle of a link at one time, in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Sample {
    /// A measured angle.
    Measured(f64),
    /// An angle that does not fit to its neighbours.
    Outlier(f64),
    /// An angle whose points were detected with too small a likelihood.
    Unlikely(f64),
    /// No angle was measured.
    Missing,
}
