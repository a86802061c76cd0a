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
    eprint!("{program}: {failure}");
    let mut cause = failure.source();
    while let Some(error) = cause {
        eprint!(": {error}");
        cause = error.source();
    }
    eprintln!();
    ExitCode::FAILURE
}
