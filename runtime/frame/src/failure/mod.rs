//! Errors with which programs end.

use std::error::Error;
use std::io;
use std::path::PathBuf;

use branched_pendulum::ParameterError;
use branched_pendulum::analysis::growth::GrowthError;
use branched_pendulum::analysis::statistics::StatisticsError;
use branched_pendulum::analysis::truncation::TruncationError;
use branched_pendulum::analysis::{EquilibriumError, ModesError, SectorModesError};
use branched_pendulum::approximate::LinearError;
use branched_pendulum_charts::ChartError;
use branched_pendulum_data::{CsvError, ReadError, ReadErrorKind};
use branched_pendulum_measure::design::DesignError;
use branched_pendulum_measure::{IdentificationError, SmoothingError, SpectrumError};

use crate::input::InputDifference;
use crate::sealed::SealError;
use crate::sweep_error::SweepError;

/// Error with which a program ends. `source` returns its causes, each once.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// A parameter of the model is not physical.
    #[error("the parameters of the model are not physical")]
    Parameter(#[from] ParameterError),
    /// A description is not a valid tree, or its values are not physical.
    #[error("{name}")]
    Tree {
        /// Name of the file, or of the example tree included in the program.
        name: String,
        /// The mistakes.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A file with a description could not be read.
    #[error(
        "there is no tree `{name}`: it is neither a shipped tree ({shipped}) nor a readable file"
    )]
    NoTree {
        /// The name given.
        name: String,
        /// Names of the shipped trees.
        shipped: String,
        /// The system's error.
        source: io::Error,
    },
    /// No link has the given name.
    #[error("there is no link `{name}`: the tree has {links}")]
    NoLink {
        /// The name given.
        name: String,
        /// Names of the links.
        links: String,
    },
    /// A start that is none.
    #[error("`{option}`: {what}")]
    Start {
        /// Option that was given.
        option: &'static str,
        /// Message about the mistake, with what to write.
        what: String,
    },
    /// No equilibrium of the tree was found.
    #[error("found no angles at which the tree is at rest: give all initial angles by `--start`")]
    Equilibrium(#[from] EquilibriumError),
    /// A motion could not be integrated to its end.
    #[error("the motion could not be integrated to its end time")]
    Motion(#[source] Box<dyn Error + Send + Sync>),
    /// The tree lacks something that the command needs, or an option cannot be applied.
    #[error("{what}")]
    Lacking {
        /// Message about what is missing, and what to do.
        what: String,
    },
    /// The equations of motion were not integrated to the end.
    #[error("the motion released from {angle_deg}° could not be integrated to its end time")]
    Integration {
        /// Initial angle of the motion, in degrees.
        angle_deg: f64,
        /// Error of the integrator, in any precision.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A motion of a cascade has become infinite or NaN.
    #[error(
        "the motion from start {start} diverged at {time:.1} s: give a larger number of `--steps`"
    )]
    Diverged {
        /// Number of the start.
        start: usize,
        /// Time, s.
        time: f64,
    },
    /// The linear modes could not be computed.
    #[error("the linear modes of the tree could not be computed")]
    Modes(#[from] ModesError),
    /// The linear modes of the sectors could not be computed.
    #[error("the linear modes of the symmetric coordinates (sectors) could not be computed")]
    SectorModes(#[from] SectorModesError),
    /// A spectrum could not be computed.
    #[error("the spectrum of the samples could not be computed")]
    Spectrum(#[from] SpectrumError),
    /// The linear model of small motions could not be derived.
    #[error("the linear model of small motions could not be derived")]
    Linear(#[from] LinearError),
    /// A motion in real time could not be started.
    #[error("the motion in real time could not be started")]
    Frames(#[source] Box<dyn Error + Send + Sync>),
    /// Forms of the energy transfer W could not be compared.
    #[error("the exact power W between copies could not be compared with its approximations")]
    Truncation(#[from] TruncationError),
    /// The growth of differences could not be computed.
    #[error("the growth of small differences between copies could not be computed")]
    Growth(#[from] GrowthError),
    /// The tree has no copies that can move in phase.
    #[error(
        "the tree has no two identical subtrees that can move in phase: write them as `child(...) * 2`"
    )]
    NoPair,
    /// There is no advice.
    #[error("no method could be recommended")]
    Advice(#[source] Box<dyn Error + Send + Sync>),
    /// A file of measurements could not be read.
    #[error("the measurements could not be read{}", options(&.0.kind))]
    Reading(#[from] ReadError),
    /// A file contains angles of another number of links than the pendulum has.
    #[error("{} has angles of {found} links, but the pendulum has {needed}; name the columns or dots of the links by `--columns` or `--dots`; give the position of a pivot without a dot by `--pivot`", path.display())]
    Links {
        /// The file.
        path: PathBuf,
        /// Number of links found.
        found: usize,
        /// Number of links that the pendulum has.
        needed: usize,
    },
    /// A file is not a valid table of constants.
    #[error("{} is not a table of names and values (JSON)", path.display())]
    Parameters {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Measured angles could not be smoothed.
    #[error("the motion could not be estimated from the measured angles")]
    Smoothing(#[from] SmoothingError),
    /// Parameters could not be identified.
    #[error("the parameters could not be identified from the measured motion")]
    Identification(#[from] IdentificationError),
    /// No parameters were found at which a tree reaches its targets.
    #[error("no design was found")]
    Design(#[from] DesignError),
    /// The output folder could not be created.
    #[error("cannot create the output folder {}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Another run is writing into the output folder.
    #[error("another run{holder} is writing into {}: wait until it ends, or name another folder by `--output`", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Program and process of the other run, in brackets, if they could be read.
        holder: String,
    },
    /// A file could not be written.
    #[error("cannot write {}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file could not be read.
    #[error("cannot read {}", path.display())]
    Unread {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A checkpoint or the results of a shard cannot be used.
    #[error("cannot resume from {}; delete this file to start the run from the beginning", path.display())]
    Sealed {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: SealError,
    },
    /// A file that a recorded run has read has changed since.
    #[error(
        "the recorded run cannot be repeated: {difference}; help: restore the file, or give the \
         command itself instead of `--repeat`"
    )]
    Changed {
        /// First difference.
        difference: InputDifference,
    },
    /// The shards of a sweep cannot be merged.
    #[error("the shards of the sweep cannot be merged")]
    Sweep(#[from] SweepError),
    /// There is no average.
    #[error("the averages over the motion could not be computed")]
    Statistics(#[from] StatisticsError),
    /// A table could not be written.
    #[error("a table could not be written")]
    Csv(#[from] CsvError),
    /// A chart could not be drawn.
    #[error("a chart could not be drawn")]
    Chart(#[from] ChartError),
    /// Text could not be printed.
    #[error("cannot write to the standard output")]
    Print(#[source] io::Error),
    /// The reader of the standard output has closed it.
    #[error("the standard output was closed")]
    Closed,
}

impl Failure {
    /// Creates the error for a description with mistakes; `name` is its file or the shipped tree.
    pub fn tree(name: &str, mistakes: impl Error + Send + Sync + 'static) -> Self {
        Self::Tree {
            name: name.to_owned(),
            source: Box::new(mistakes),
        }
    }

    /// Creates the error of the advisor if it cannot recommend a method.
    pub fn advice(error: impl Error + Send + Sync + 'static) -> Self {
        Self::Advice(Box::new(error))
    }

    /// Creates the error for a motion that could not be integrated to its end time.
    pub fn integration(angle_deg: f64, error: impl Error + Send + Sync + 'static) -> Self {
        Self::Integration {
            angle_deg,
            source: Box::new(error),
        }
    }
}

/// Returns the command-line options that resolve what a table leaves open, for messages.
fn options(kind: &ReadErrorKind) -> &'static str {
    match kind {
        ReadErrorKind::NoTime => "; `--time` or `--frame-rate` helps",
        ReadErrorKind::FrameNumbers { .. } => "; `--frame-rate` helps",
        ReadErrorKind::WholeTimes { .. } => {
            "; `--frame-rate` helps, or `--time` with the name and the unit"
        }
        ReadErrorKind::TimeOrder { previous, time } if previous == time => {
            "; `--drop-repeated` helps"
        }
        ReadErrorKind::RoundedTimes { .. } => "; `--frame-rate` with that rate helps",
        ReadErrorKind::Recordings { .. } => "; `--recording 1` takes the first",
        ReadErrorKind::Still { .. } => "; `--columns` or `--dots` helps",
        ReadErrorKind::TooWide { .. } => "; `--columns` or `--dots` helps",
        ReadErrorKind::AngleUnit {
            counts: Some(_), ..
        } => "; `--unit` helps, of an encoder `--unit counts:N` with the counts a turn",
        ReadErrorKind::AngleUnit { counts: None, .. } => "; `--unit` helps",
        ReadErrorKind::NotAngle { .. } => "; `--columns` or `--dots` helps",
        ReadErrorKind::Jumps { .. } => {
            "; `--unit` helps if the angles have another unit, `--leave-out` if dots were lost there"
        }
        ReadErrorKind::Nothing { .. } => "; `--columns`, `--dots` or `--pivot` helps",
        _ => "",
    }
}

#[cfg(test)]
mod tests;
