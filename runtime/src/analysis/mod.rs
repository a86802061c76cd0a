//! From matrices and trajectories to physics: linear modes and spectra.

pub mod modes;
pub mod spectrum;

pub use modes::{Modes, ModesError};
pub use spectrum::{Peak, Spectrum, SpectrumError, SpectrumOptions, Window};
pub mod variational;
