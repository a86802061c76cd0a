//! The frame that all programs share: how one starts, shows its progress, keeps
//! its results and ends.
//!
//! - [`command_line`]: options, `--output` and `--repeat`,
//! - [`job`]: one run: what it prints, its files, its `run.json`,
//! - [`figures`]: charts as figures of a paper,
//! - [`files`]: files that are whole or absent,
//! - `lock`: one run at a time in a folder,
//! - [`progress`]: a bar on a terminal.
//!
//! A program ends with 0 where it is done, 1 after a failure, 2 for a wrong
//! command line, 130 after Ctrl-C and 143 where it was told to end. All but the
//! first say so in one line, with the folder of what was finished.

pub mod checkpoint;
pub mod command_line;
pub mod failure;
pub mod figures;
pub mod files;
pub mod film;
mod interrupt;
mod interruption;
pub mod job;
mod lock;
pub mod progress;
pub mod quadrature;
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
pub use job::{Ended, Job};
pub use progress::Progress;
pub use sweep::Sharding;

/// Reads the command line of the process and runs the program.
pub fn main<A: Arguments>(run: impl FnOnce(&A, &Job) -> Result<(), Failure>) -> ExitCode {
    self::run(std::env::args_os(), run)
}

/// Prints what the reader of a command line says in place of a run, the help or a mistake, and
/// returns the exit code: 0 for the help and for nothing to say.
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

/// Reads a command line, which begins with the program's name, and runs the program.
pub fn run<A: Arguments>(
    words: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(&A, &Job) -> Result<(), Failure>,
) -> ExitCode {
    let CommandLine {
        arguments,
        output: mut folder,
        figures,
        values,
    } = match command_line::parse::<A>(words) {
        Ok(line) => line,
        Err(error) => return answer(Some(error)),
    };
    let name = A::command().get_name().to_owned();
    if let (Some(folder), Some(shard)) = (&mut folder, arguments.shard()) {
        folder.push(shard.folder());
    }
    let job = match Job::start(&name, folder, values) {
        Ok(job) => job.with_figures(figures),
        Err(failure) => {
            say(&name, &messages(&failure).join(": "));
            return ExitCode::FAILURE;
        }
    };
    interrupt::watch(&job);
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

/// Writes all bytes to the standard output and returns the exit code: 0, too, where its reader
/// has read enough.
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

/// Messages of an error and of its causes, the outermost first.
pub fn messages(error: &dyn Error) -> Vec<String> {
    let mut messages = vec![error.to_string()];
    let mut cause = error.source();
    while let Some(error) = cause {
        messages.push(error.to_string());
        cause = error.source();
    }
    messages
}
