//! The paper's experiment, from the release to tables and charts.
//!
//! `branched-double --help` lists the options.

use std::io::{self, IsTerminal};
use std::process::ExitCode;

use branched_pendulum_examples::branched_double::help::HELP;
use branched_pendulum_examples::branched_double::progress::ProgressBar;
use branched_pendulum_examples::branched_double::{
    Apparatus, Arguments, Failure, Findings, Frequencies, Request, Run, charts, files, scenes,
    table,
};
use branched_pendulum_examples::exit;

fn main() -> ExitCode {
    let arguments = match Arguments::parse(std::env::args().skip(1)) {
        Ok(Request::Run(arguments)) => arguments,
        Ok(Request::Help) => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        Err(error) => return exit::wrong_command_line("branched-double", &error),
    };
    exit::of_run("branched-double", run(&arguments))
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    // Before the work, so that a folder that cannot be made costs none.
    files::make_folder(&arguments.output)?;
    let frequencies = Frequencies::of(&scenes::BranchedDouble::new())?;
    let runs = experiments(arguments)?;
    let findings: Vec<Findings> = runs.iter().map(Findings::new).collect();
    print!(
        "{}",
        table::report(
            arguments,
            &Apparatus::new(arguments.friction)?,
            frequencies,
            &runs,
            &findings
        )
    );

    let mut written = Vec::new();
    for run in &runs {
        written.push(files::write_samples(&arguments.output, run)?);
    }
    written.extend(charts::write_charts(
        &arguments.output,
        arguments,
        frequencies,
        &runs,
    )?);
    print!("\n{}", table::file_list(&written));
    Ok(())
}

fn experiments(arguments: &Arguments) -> Result<Vec<Run>, Failure> {
    let mut bar = ProgressBar::new(io::stderr(), io::stderr().is_terminal());
    let count = arguments.angles_deg.len() as f64;
    let runs = arguments.angles_deg.iter().enumerate();
    let runs = runs
        .map(|(index, &angle)| {
            Run::new(angle, arguments, |part| {
                bar.show((index as f64 + part) / count, &format!("{angle:?}°"));
            })
        })
        .collect();
    bar.clear();
    runs
}
