//! From matrices and trajectories to physics: linear modes, of a whole tree and
//! sector by sector, spectra, motions estimated from data and parameters identified from
//! them, the growth of deviations, and how far truncated transfers reach; and which model and
//! method to take ([`advice`]).

pub mod advice;
pub mod equilibrium;
pub mod identification;
pub mod modes;
pub mod sector_modes;
pub mod smoothing;
pub mod spectrum;
pub mod truncation;
pub mod variational;

pub use equilibrium::{AtRest, EquilibriumError, equilibrium};
pub use identification::{AngleRecord, FamilyOf, Fit, Identification, IdentificationError};
pub use modes::{Modes, ModesError};
pub use sector_modes::{SectorBlock, SectorModes, SectorModesError};
pub use smoothing::{
    Bands, KinematicSmoother, ModelSmoother, SmoothedMotion, SmoothingError, bands,
};
pub use spectrum::{Peak, Spectrum, SpectrumError, SpectrumOptions, Window};
