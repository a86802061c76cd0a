//! From matrices and trajectories to physics: linear modes, of a whole tree and
//! sector by sector, spectra, and the growth of deviations.

pub mod modes;
pub mod sector_modes;
pub mod spectrum;

pub use modes::{Modes, ModesError};
pub use sector_modes::{SectorBlock, SectorModes, SectorModesError};
pub use spectrum::{Peak, Spectrum, SpectrumError, SpectrumOptions, Window};
pub mod variational;
