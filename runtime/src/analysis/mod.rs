//! From matrices and trajectories to physics: linear modes, spectra, and the
//! growth of deviations.

pub mod modes;
pub mod spectrum;

pub use modes::{Modes, ModesError};
pub use spectrum::{Peak, Spectrum, SpectrumError, SpectrumOptions, Window};
pub mod variational;
