//! Where each method fails.
//!
//! `stability-map --help` lists the options.

use std::path::Path;
use std::process::ExitCode;

use branched_pendulum_examples::branched_double::{Failure, files, table};
use branched_pendulum_examples::exit;
use branched_pendulum_examples::solvers::arguments::{Request, parse};
use branched_pendulum_examples::stability_map::{HELP, output, truncation};

fn main() -> ExitCode {
    match parse(std::env::args().skip(1), "stability-map-output") {
        Ok(Request::Run(folder)) => exit::of_run("stability-map", run(&folder)),
        Ok(Request::Help) => {
            print!("{HELP}");
            ExitCode::SUCCESS
        }
        Err(error) => exit::wrong_command_line("stability-map", &error),
    }
}

fn run(folder: &Path) -> Result<(), Failure> {
    // Before the work, so that a folder that cannot be made costs none.
    files::make_folder(folder)?;
    let maps = output::maps()?;
    print!("{}", output::table(&maps));
    let truncations = truncation::map()?;
    print!("{}", truncation::table(&truncations));
    let mut written = output::write(folder, &maps)?;
    written.extend(truncation::write(folder, &truncations)?);
    print!("{}", table::file_list(&written));
    Ok(())
}
