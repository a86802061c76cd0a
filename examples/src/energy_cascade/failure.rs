//! Why the program could not finish.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

use branched_pendulum::ParameterError;
use branched_pendulum::analysis::SectorModesError;
use branched_pendulum::data::CsvError;
use branched_pendulum_charts::ChartError;

/// Why the program could not finish.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// A drive that no model can have.
    Drive(ParameterError),
    /// The linear modes could not be found.
    Modes(SectorModesError),
    /// The equations of motion were not integrated to the end.
    Integration(Box<dyn Error + Send + Sync>),
    /// The output folder could not be made.
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A table could not be written.
    Csv(CsvError),
    /// A chart could not be drawn or written.
    Chart(ChartError),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Drive(_) => write!(f, "the drive is not possible"),
            Self::Modes(_) => write!(f, "the linear modes could not be found"),
            Self::Integration(_) => write!(f, "the run did not reach its end"),
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
            Self::Drive(source) => Some(source),
            Self::Modes(source) => Some(source),
            Self::Integration(source) => Some(source.as_ref()),
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
    Drive(ParameterError),
    Modes(SectorModesError),
    Csv(CsvError),
    Chart(ChartError)
);
