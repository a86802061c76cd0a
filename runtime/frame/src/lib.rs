//! Common parts of all programs: start, progress display, storage of results and exit.
//!
//! - [`command_line`]: options, `--output` and `--repeat`,
//! - [`job`]: one run: the text that it prints, its files; `record`: its `run.json`,
//! - [`figures`]: charts as figures of a paper,
//! - [`files`]: files that are either complete or absent,
//! - [`input`]: content of the files that a run reads,
//! - `owned`: files that this project has created, apart from all others,
//! - `lock`: one run at a time in a folder,
//! - [`progress`]: a bar on a terminal.
//!
//! A program ends with 0 where it is done, 1 after a failure, 2 for a wrong
//! command line, 130 after Ctrl-C and 143 where it was terminated. All but the
//! first say so in one line, with the folder of what was finished.

pub mod checkpoint;
pub mod command_line;
pub mod failure;
pub mod figures;
pub mod files;
pub mod film;
pub mod input;
mod interrupt;
mod interruption;
pub mod job;
mod legible;
mod lock;
mod owned;
pub mod progress;
pub mod quadrature;
mod record;
pub mod sealed;
pub mod sweep;
mod sweep_error;
pub mod windows;

use std::error::Error;
use std::ffi::OsString;
use std::process::ExitCode;

pub use checkpoint::Checkpoint;
pub use command_line::{Arguments, CommandLine, RecordOptions};
pub use failure::Failure;
pub use figures::Charts;
pub use input::Input;
pub use job::{Ended, Job};
pub use progress::Progress;
pub use sweep::Sharding;

/// Parses the command line of the process, runs the program, and returns its exit code.
pub fn main<A: Arguments>(run: impl FnOnce(&A, &Job) -> Result<(), Failure>) -> ExitCode {
    self::run(std::env::args_os(), run)
}

/// Prints the text that is shown instead of a run (the help text, or a mistake), and returns the
/// exit code: 0 for the help text, and if there is nothing to print.
pub fn answer(answer: Option<clap::Error>) -> ExitCode {
    let Some(answer) = answer else {
        return ExitCode::SUCCESS;
    };
    let code = u8::try_from(answer.exit_code()).unwrap_or(2);
    match answer.print() {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::from(code),
    }
}

/// Parses a command line, whose first word is the program's name, and runs the program.
pub fn run<A: Arguments>(
    words: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(&A, &Job) -> Result<(), Failure>,
) -> ExitCode {
    let CommandLine {
        arguments,
        output: mut folder,
        figures,
        values,
        recorded,
    } = match command_line::parse::<A>(words) {
        Ok(line) => line,
        Err(error) => return answer(Some(error)),
    };
    let name = A::command().get_name().to_owned();
    if let (Some(folder), Some(shard)) = (&mut folder, arguments.shard()) {
        folder.push(shard.folder());
    }
    // Before the job owns a folder: from then on a signal must find its handler.
    let signals = interrupt::register();
    let job = match Job::start(&name, folder, values) {
        Ok(job) => job.with_figures(figures).with_recorded(recorded),
        Err(failure) => {
            say(&name, &messages(&failure).join(": "));
            return ExitCode::FAILURE;
        }
    };
    interrupt::watch(signals, &job);
    let result = run(&arguments, &job);
    let signal = job.interruption.signal();
    let ended = match &result {
        Ok(()) if signal.is_some() => Ended::Interrupted,
        Ok(()) | Err(Failure::Closed) => Ended::Finished,
        Err(failure) => Ended::Failed(messages(failure).join(": ")),
    };
    let left = job.end(&ended);
    let left = left.map(|left| left.map_or(String::new(), |left| format!("; {left}")));
    if let (Ok(()), Ok(left), Some(signal)) = (&result, &left, signal) {
        say(&name, &format!("interrupted{left}"));
        return ExitCode::from(u8::try_from(128 + signal).unwrap_or(1));
    }
    match (result, left) {
        (Ok(()), Ok(_)) if !job.is_closed() => ExitCode::SUCCESS,
        (Ok(()) | Err(Failure::Closed), Ok(left)) => {
            say(&name, &format!("standard output was closed{left}"));
            ExitCode::SUCCESS
        }
        (Err(failure), Ok(left)) => {
            say(&name, &format!("{}{left}", messages(&failure).join(": ")));
            ExitCode::FAILURE
        }
        (Ok(()), Err(failure)) | (Err(failure), Err(_)) => {
            say(&name, &messages(&failure).join(": "));
            ExitCode::FAILURE
        }
    }
}

/// Writes all bytes to the standard output and returns the exit code, which is also 0 if the reader
/// has closed it.
pub fn write_out(bytes: &[u8]) -> ExitCode {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::SUCCESS,
    }
}

/// Writes a line to the standard error stream, which may be closed.
fn say(program: &str, text: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "{program}: {text}");
}

/// Returns the messages of an error and of its causes, the outermost first.
pub fn messages(error: &dyn Error) -> Vec<String> {
    let mut messages = vec![error.to_string()];
    let mut cause = error.source();
    while let Some(error) = cause {
        messages.push(error.to_string());
        cause = error.source();
    }
    messages
}
