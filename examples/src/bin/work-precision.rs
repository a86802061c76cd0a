//! What a given error costs, with which method.
//!
//! `work-precision --help` lists the options.

use std::path::Path;
use std::process::ExitCode;

use branched_pendulum_examples::branched_double::{Failure, files, table};
use branched_pendulum_examples::exit;
use branched_pendulum_examples::solvers::arguments::{Request, parse};
use branched_pendulum_examples::work_precision::{HELP, measure, output, reference};

fn main() -> ExitCode {
    match parse(std::env::args().skip(1), "work-precision-output") {
        Ok(Request::Run(folder)) => exit::of_run("work-precision", run(&folder)),
        Ok(Request::Help) => {
            print!("{HELP}");
            ExitCode::SUCCESS
        }
        Err(error) => exit::wrong_command_line("work-precision", &error),
    }
}

fn run(folder: &Path) -> Result<(), Failure> {
    // Before the work, so that a folder that cannot be made costs none.
    files::make_folder(folder)?;
    let problems = reference::problems()?;
    let problems: Vec<_> = problems
        .iter()
        .map(|problem| (problem.name, measure::measure(problem)))
        .collect();
    let drifts = measure::energy_drifts().map_err(|error| Failure::Integration {
        angle_deg: 0.3_f64.to_degrees(),
        source: error.to_string().into(),
    })?;
    print!("{}", output::table(&problems, &drifts));
    let written = output::write(folder, &problems, &drifts)?;
    print!("\n{}", table::file_list(&written));
    Ok(())
}
