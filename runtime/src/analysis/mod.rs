//! From matrices and trajectories to physics: linear modes, of a whole tree and
//! sector by sector, spectra, averages with their errors ([`statistics`]), motions
//! estimated from data and parameters identified from them ([`identification`]), the growth
//! of deviations and of differences between copies, and how far truncated transfers reach;
//! and which model and method to take ([`advice`]).

pub mod advice;
pub mod equilibrium;
pub mod growth;
pub mod identification;
pub mod modes;
mod random;
pub mod sector_modes;
pub mod smoothing;
#[cfg(feature = "spectra")]
pub mod spectrum;
pub mod statistics;
pub mod truncation;
pub mod variational;

pub use equilibrium::{AtRest, EquilibriumError, equilibrium, equilibrium_of_torques};
pub use identification::{AngleRecord, FamilyOf, Fit, Identification, IdentificationError};
pub use modes::{Modes, ModesError};
pub use sector_modes::{SectorBlock, SectorModes, SectorModesError};
pub use smoothing::{
    Bands, KinematicSmoother, LocalPolynomials, ModelSmoother, SmoothedCoordinates, SmoothedMotion,
    SmoothingError, bands, running_integral,
};
#[cfg(feature = "spectra")]
pub use spectrum::{
    CombinationTone, LineSearch, Lines, Passage, Passages, SpectralLine, Spectrum, SpectrumError,
    SpectrumOptions, Window,
};
