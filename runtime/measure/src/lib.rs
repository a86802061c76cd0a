//! Analysis of measured angles of a pendulum, with error bars.
//!
//! - [`smoothing`]: angles, velocities and accelerations behind noisy samples,
//! - [`spectrum`]: amplitudes against frequency, and the lines of a motion,
//! - [`identification`]: parameters of a model from motions and frequencies,
//! - [`design`]: parameters at which quantities of a model have given values.

pub mod design;
pub mod identification;
pub mod smoothing;
pub mod spectrum;

pub use identification::{AngleRecord, FamilyOf, Fit, Identification, IdentificationError};
pub use smoothing::{
    Bands, KinematicSmoother, LeapSearch, LocalPolynomials, ModelSmoother, SmoothedCoordinates,
    SmoothedMotion, SmoothingError, bands, running_integral,
};
pub use spectrum::{
    CombinationTone, LineSearch, Lines, Passage, Passages, SpectralLine, Spectrum, SpectrumError,
    SpectrumOptions, Window,
};
