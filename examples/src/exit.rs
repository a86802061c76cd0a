//! How the examples end: 0 done, 1 a failure, 2 a wrong command line.

use std::error::Error;
use std::fmt::Display;
use std::process::ExitCode;

/// Says what is wrong with the command line, and where help is.
pub fn wrong_command_line(program: &str, error: &impl Display) -> ExitCode {
    eprintln!("{program}: {error}\nTry `{program} --help`.");
    ExitCode::from(2)
}

/// The exit code of a run; a failure is told with all its causes.
pub fn of_run(program: &str, result: Result<(), impl Error>) -> ExitCode {
    let Err(failure) = result else {
        return ExitCode::SUCCESS;
    };
    eprintln!("{program}: {}", messages(&failure).join(": "));
    ExitCode::FAILURE
}

/// Messages of an error and of its causes, the outermost first.
fn messages(error: &dyn Error) -> Vec<String> {
    let mut messages = vec![error.to_string()];
    let mut cause = error.source();
    while let Some(error) = cause {
        messages.push(error.to_string());
        cause = error.source();
    }
    messages
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{branched_double, energy_cascade};
    use branched_pendulum::analysis::truncation::TruncationError;
    use branched_pendulum::analysis::variational::LyapunovError;
    use branched_pendulum::analysis::{ModesError, SectorModesError};
    use branched_pendulum::data::CsvError;
    use branched_pendulum::integrate::RunError;
    use branched_pendulum::prelude::*;
    use branched_pendulum::system::OdeFn;
    use branched_pendulum_charts::ChartError;
    use std::io;
    use std::path::PathBuf;

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
        let run = method.integrate(&ode, &start, 1.0, |_| std::ops::ControlFlow::Continue(()));
        run.expect_err("one step does not reach the end")
    }

    /// Of a run that is asked to end at no time.
    fn request() -> IntegrationError<f64> {
        let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1.0);
        let start = State::new(0.0, vec![0.0]);
        let run = Rk4::new(0.1).integrate(&ode, &start, f64::NAN, |_| ControlFlow::Continue(()));
        run.expect_err("NaN is no time")
    }

    fn no_rows() -> ModesError {
        ModesError::Empty { matrix: "mass" }
    }

    fn modes() -> SectorModesError {
        SectorModesError::Sector {
            sector: "child",
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
        use branched_double::Failure as Experiment;
        use energy_cascade::Failure as Cascade;
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
            Box::new(Experiment::Friction(parameter())),
            Box::new(Experiment::Integration {
                angle_deg: 50.0,
                source: Box::new(integration()),
            }),
            Box::new(Experiment::Modes(no_rows())),
            Box::new(Experiment::Truncation(truncation())),
            Box::new(Experiment::Folder {
                path: folder(),
                source: refused(),
            }),
            Box::new(Experiment::Csv(csv())),
            Box::new(Experiment::Chart(chart())),
            Box::new(Cascade::Drive(parameter())),
            Box::new(Cascade::Modes(modes())),
            Box::new(Cascade::Integration(Box::new(integration()))),
            Box::new(Cascade::Folder {
                path: folder(),
                source: refused(),
            }),
            Box::new(Cascade::Csv(csv())),
            Box::new(Cascade::Chart(chart())),
        ];
        for chain in chains {
            let messages = messages(chain.as_ref());
            for (index, cause) in messages.iter().enumerate().skip(1) {
                let told = messages[..index].iter().any(|above| above.contains(cause));
                assert!(!told, "twice: {messages:?}");
            }
        }
    }
}
