//! Why a program could not finish.

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
use branched_pendulum_measure::{IdentificationError, SmoothingError, SpectrumError};

use crate::sealed::SealError;
use crate::sweep_error::SweepError;

/// Why a program could not finish. Causes are told by `source`, once each.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// A parameter that no model can have.
    #[error("the model is not possible")]
    Parameter(#[from] ParameterError),
    /// A description that is no tree, or values that it cannot have.
    #[error("{name}")]
    Tree {
        /// Name of the file or of the shipped tree.
        name: String,
        /// The mistakes.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A file with a description that could not be read.
    #[error(
        "there is no tree `{name}`: neither a shipped one ({shipped}) nor a file that can be read"
    )]
    NoTree {
        /// The name given.
        name: String,
        /// Names of the shipped trees.
        shipped: String,
        /// The system's error.
        source: io::Error,
    },
    /// A name that no link has.
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
        /// The mistake, with what to write.
        what: String,
    },
    /// The tree does not come to rest.
    #[error("no place was found where the tree rests: give all angles by `--start`")]
    Equilibrium(#[from] EquilibriumError),
    /// A motion could not be integrated to its end.
    #[error("the motion did not reach its end")]
    Motion(#[source] Box<dyn Error + Send + Sync>),
    /// What the command asks of a tree, this one has not.
    #[error("{what}")]
    Lacking {
        /// What is missing, and what to do.
        what: String,
    },
    /// The equations of motion were not integrated to the end.
    #[error("the run from {angle_deg}° did not reach its end")]
    Integration {
        /// Initial angle of the run, in degrees.
        angle_deg: f64,
        /// The integrator's error, whatever the precision it ran in.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A start of a cascade whose numbers are no longer finite.
    #[error("start {start} has diverged at {time:.1} s: take more `--steps`")]
    Diverged {
        /// Number of the start.
        start: usize,
        /// Time, s.
        time: f64,
    },
    /// The linear modes could not be found.
    #[error("the linear modes could not be found")]
    Modes(#[from] ModesError),
    /// The linear modes of the sectors could not be found.
    #[error("the linear modes of the sectors could not be found")]
    SectorModes(#[from] SectorModesError),
    /// A spectrum could not be taken.
    #[error("the spectrum could not be taken")]
    Spectrum(#[from] SpectrumError),
    /// There is no linear model of small motions.
    #[error("the linear model could not be made")]
    Linear(#[from] LinearError),
    /// A motion in real time could not begin.
    #[error("the frames could not begin")]
    Frames(#[source] Box<dyn Error + Send + Sync>),
    /// Forms of W could not be compared.
    #[error("the forms of W could not be compared")]
    Truncation(#[from] TruncationError),
    /// The growth of differences could not be found.
    #[error("the growth of differences could not be found")]
    Growth(#[from] GrowthError),
    /// A tree without copies that move alike.
    #[error("the tree has no pair that moves in phase")]
    NoPair,
    /// There is no advice.
    #[error("there is no advice")]
    Advice(#[source] Box<dyn Error + Send + Sync>),
    /// A file of measurements could not be read.
    #[error("the measurements could not be read{}", options(&.0.kind))]
    Reading(#[from] ReadError),
    /// A file holds another number of links than the pendulum.
    #[error("{} holds angles of {found} links where the pendulum has {needed}; name them by `--columns` or `--dots`, or the place of a pivot without a dot by `--pivot`", path.display())]
    Links {
        /// The file.
        path: PathBuf,
        /// Number of links found.
        found: usize,
        /// Number of links of the pendulum.
        needed: usize,
    },
    /// A file of constants is none.
    #[error("{} is no table of names and values", path.display())]
    Parameters {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Measured angles could not be smoothed.
    #[error("the motion could not be estimated")]
    Smoothing(#[from] SmoothingError),
    /// Parameters could not be identified.
    #[error("the parameters could not be identified")]
    Identification(#[from] IdentificationError),
    /// The output folder could not be made.
    #[error("cannot make the output folder {}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Another run writes into the output folder.
    #[error("another run{holder} writes into {}: wait until it ends, or name another folder by `--output`", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Program and process of the other run in brackets, if they could be read.
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
    /// A checkpoint or a part of a sweep cannot be used.
    #[error("cannot go on from {}; without it the run begins anew", path.display())]
    Sealed {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: SealError,
    },
    /// Shards do not make a whole.
    #[error("the shards do not make a whole")]
    Sweep(#[from] SweepError),
    /// There is no average.
    #[error("there is no average")]
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
    /// The reader of the standard output has read enough.
    #[error("the standard output was closed")]
    Closed,
}

impl Failure {
    /// A description, named by its file or as a shipped tree, with mistakes.
    pub fn tree(name: &str, mistakes: impl Error + Send + Sync + 'static) -> Self {
        Self::Tree {
            name: name.to_owned(),
            source: Box::new(mistakes),
        }
    }

    /// A question to which there is no advice.
    pub fn advice(error: impl Error + Send + Sync + 'static) -> Self {
        Self::Advice(Box::new(error))
    }

    /// A run that an integrator has not brought to its end.
    pub fn integration(angle_deg: f64, error: impl Error + Send + Sync + 'static) -> Self {
        Self::Integration {
            angle_deg,
            source: Box::new(error),
        }
    }
}

/// The options of a program that say what a table leaves open.
fn options(kind: &ReadErrorKind) -> &'static str {
    match kind {
        ReadErrorKind::NoTime => "; `--time` or `--frame-rate` helps",
        ReadErrorKind::FrameNumbers { .. } | ReadErrorKind::WholeTimes { .. } => {
            "; `--frame-rate` helps"
        }
        ReadErrorKind::TimeOrder { previous, time } if previous == time => {
            "; `--drop-repeated` helps"
        }
        ReadErrorKind::AngleUnit { .. } => "; `--unit` helps",
        ReadErrorKind::NotAngle { .. } => "; `--columns` or `--dots` helps",
        ReadErrorKind::Nothing { .. } => "; `--columns`, `--dots` or `--pivot` helps",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::Failure;
    use crate::messages;
    use branched_pendulum::analysis::truncation::TruncationError;
    use branched_pendulum::analysis::variational::LyapunovError;
    use branched_pendulum::analysis::{ModesError, SectorModesError};
    use branched_pendulum::approximate::LinearError;
    use branched_pendulum::integrate::{IntegrationError, RunError};
    use branched_pendulum::prelude::*;
    use branched_pendulum::system::OdeFn;
    use branched_pendulum_charts::ChartError;
    use branched_pendulum_data::{CsvError, ReadError, ReadErrorKind};
    use std::{error::Error, io, path::PathBuf};

    fn refused() -> io::Error {
        io::Error::from(io::ErrorKind::PermissionDenied)
    }

    fn chart() -> ChartError {
        ChartError::Io {
            path: PathBuf::from("chart.svg"),
            source: refused(),
        }
    }

    fn csv() -> CsvError {
        CsvError::Io {
            path: PathBuf::from("samples.csv"),
            action: "write",
            source: refused(),
        }
    }

    /// Of a run that is given one step for a second.
    fn integration() -> IntegrationError<f64> {
        let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1e9);
        let method = Dop853::new(Options {
            step_limit: 1,
            ..Options::with_tolerance(1e-9)
        });
        let start = State::new(0.0, vec![0.0]);
        let run = method.run(&ode, &start, 1.0);
        run.expect_err("one step does not reach the end")
    }

    /// Of a run that is asked to end at no time.
    fn request() -> IntegrationError<f64> {
        let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1.0);
        let start = State::new(0.0, vec![0.0]);
        let run = Rk4::new(0.1).run(&ode, &start, f64::NAN);
        run.expect_err("NaN is no time")
    }

    fn no_rows() -> ModesError {
        ModesError::Empty { matrix: "mass" }
    }

    fn modes() -> SectorModesError {
        SectorModesError::Sector {
            sector: "child".to_owned(),
            source: no_rows(),
        }
    }

    fn parameter() -> ParameterError {
        branched_pendulum::emitted::require_positive("mass of `child`", -1.0).expect_err("negative")
    }

    /// Every error of the workspace that has a cause: no text of a chain stands
    /// in a message above it.
    #[test]
    fn every_cause_is_told_once() {
        let truncation = || TruncationError::Integration(integration());
        let folder = || PathBuf::from("output");
        let chains: Vec<Box<dyn Error>> = vec![
            Box::new(chart()),
            Box::new(ChartError::Encode(Box::new(refused()))),
            Box::new(csv()),
            Box::new(request()),
            Box::new(RunError::<f64, CsvError>::Integration(request())),
            Box::new(RunError::Observer {
                error: csv(),
                last: State::new(0.0, vec![0.0]),
                report: *integration().report().expect("it has begun"),
            }),
            Box::new(truncation()),
            Box::new(LyapunovError::Integration(integration())),
            Box::new(SectorModesError::Matrices(no_rows())),
            Box::new(modes()),
            Box::new(Failure::Parameter(parameter())),
            Box::new(Failure::integration(50.0, integration())),
            Box::new(Failure::Modes(no_rows())),
            Box::new(Failure::SectorModes(modes())),
            Box::new(Failure::Linear(LinearError::NotFinite)),
            Box::new(Failure::Frames(Box::new(request()))),
            Box::new(Failure::Truncation(truncation())),
            Box::new(Failure::Growth(request().into())),
            Box::new(Failure::tree("swing.txt", no_rows())),
            Box::new(Failure::advice(modes())),
            Box::new(Failure::Folder {
                path: folder(),
                source: refused(),
            }),
            Box::new(Failure::File {
                path: folder(),
                source: refused(),
            }),
            Box::new(Failure::Csv(csv())),
            Box::new(Failure::Chart(chart())),
            Box::new(Failure::Print(refused())),
        ];
        for chain in chains {
            let messages = messages(chain.as_ref());
            for (index, cause) in messages.iter().enumerate().skip(1) {
                let told = messages[..index].iter().any(|above| above.contains(cause));
                assert!(!told, "twice: {messages:?}");
            }
        }
    }

    #[test]
    fn what_a_table_leaves_open_has_an_option() {
        let repeated = ReadErrorKind::TimeOrder {
            previous: 0.5,
            time: 0.5,
        };
        let backwards = ReadErrorKind::TimeOrder {
            previous: 0.5,
            time: 0.4,
        };
        let name = || "a".to_owned();
        for (kind, option) in [
            (ReadErrorKind::NoTime, Some("`--time` or `--frame-rate`")),
            (
                ReadErrorKind::FrameNumbers { name: name() },
                Some("`--frame-rate`"),
            ),
            (repeated, Some("`--drop-repeated`")),
            (backwards, None),
            (
                ReadErrorKind::AngleUnit {
                    name: name(),
                    largest: 10.0,
                },
                Some("`--unit`"),
            ),
            (ReadErrorKind::Empty, None),
        ] {
            let failure = Failure::Reading(ReadError {
                path: PathBuf::from("swing.csv"),
                place: None,
                kind: Box::new(kind),
            });
            let text = failure.to_string();
            match option {
                Some(option) => assert!(text.contains(option), "{text}"),
                None => assert!(!text.contains("--"), "{text}"),
            }
        }
    }
}
