//! Why the program could not finish.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

use branched_pendulum::ParameterError;
use branched_pendulum::analysis::truncation::TruncationError;
use branched_pendulum::analysis::{ModesError, SpectrumError};
use branched_pendulum::data::CsvError;
use branched_pendulum_charts::ChartError;

/// Why the program could not finish.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// A friction coefficient that no joint can have.
    Friction(ParameterError),
    /// The equations of motion were not integrated to the end.
    Integration {
        /// Initial angle of the run, in degrees.
        angle_deg: f64,
        /// What the integrator says, with the precision it ran in.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The linear modes could not be found.
    Modes(ModesError),
    /// A spectrum could not be taken.
    Spectrum(SpectrumError),
    /// Forms of W could not be compared.
    Truncation(TruncationError),
    /// The output folder could not be made.
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A table of samples could not be written.
    Csv(CsvError),
    /// A chart could not be drawn or written.
    Chart(ChartError),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Friction(_) => write!(f, "the joint friction is not possible"),
            Self::Integration {
                angle_deg,
                source: _,
            } => write!(f, "the run from {angle_deg}° did not reach its end"),
            Self::Modes(_) => write!(f, "the linear modes could not be found"),
            Self::Spectrum(_) => write!(f, "the spectrum of θ_m could not be taken"),
            Self::Truncation(_) => write!(f, "the forms of W could not be compared"),
            Self::Folder { path, source: _ } => {
                write!(f, "cannot make the output folder {}", path.display())
            }
            Self::Csv(_) => write!(f, "the samples could not be written"),
            Self::Chart(_) => write!(f, "a chart could not be written"),
        }
    }
}

impl Error for Failure {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Friction(source) => Some(source),
            Self::Integration {
                angle_deg: _,
                source,
            } => Some(source.as_ref()),
            Self::Modes(source) => Some(source),
            Self::Spectrum(source) => Some(source),
            Self::Truncation(source) => Some(source),
            Self::Folder { path: _, source } => Some(source),
            Self::Csv(source) => Some(source),
            Self::Chart(source) => Some(source),
        }
    }
}

macro_rules! from {
    ($($variant:ident($error:ty)),*) => {
        $(impl From<$error> for Failure {
            fn from(source: $error) -> Self {
                Self::$variant(source)
            }
        })*
    };
}

from!(
    Friction(ParameterError),
    Modes(ModesError),
    Spectrum(SpectrumError),
    Truncation(TruncationError),
    Csv(CsvError),
    Chart(ChartError)
);
