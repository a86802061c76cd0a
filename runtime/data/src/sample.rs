//! What was measured at one time.

/// The angle of a link at one time, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Sample {
    /// A measured angle.
    Measured(f64),
    /// One that does not fit its neighbours.
    Outlier(f64),
    /// One whose points were found with too small a likelihood.
    Unlikely(f64),
    /// None was measured.
    Missing,
}
