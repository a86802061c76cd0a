//! Spectra of evenly sampled series: amplitudes against frequency, and the spectral lines of which
//! a motion consists.
//!
//! - [`Spectrum`]: amplitudes at the Fourier frequencies or at any others,
//! - [`LineSearch`]: frequencies far closer than the grid of a spectrum separates, with
//!   their errors: the lines of a quasi-periodic motion out of a short record,
//! - [`CombinationTone`]: names of lines, as 2f_+ − f_−,
//! - [`Passages`]: spectra or lines in one stretch of time after the other, for lines that
//!   friction shifts.

mod amplitudes;
mod combination;
mod error;
mod fit;
mod lines;
mod passages;
mod transform;
mod trend;
mod window;

pub use amplitudes::{Spectrum, SpectrumOptions};
pub use combination::CombinationTone;
pub use error::SpectrumError;
pub use lines::{LineSearch, Lines, SpectralLine};
pub use passages::{Passage, Passages};
pub use window::Window;
