//! How wrong each form of the energy transfer W is, and what it costs.
//!
//! `transfer-orders --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::branched_double::{Failure, files, table};
use branched_pendulum_examples::exit;
use branched_pendulum_examples::transfer_orders::arguments::HELP;
use branched_pendulum_examples::transfer_orders::{Arguments, Request, output, scenes};

fn main() -> ExitCode {
    let arguments = match Arguments::parse(std::env::args().skip(1)) {
        Ok(Request::Run(arguments)) => arguments,
        Ok(Request::Help) => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        Err(error) => return exit::wrong_command_line("transfer-orders", &error),
    };
    exit::of_run("transfer-orders", run(&arguments))
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    // Before the work, so that a folder that cannot be made costs none.
    files::make_folder(&arguments.output)?;
    let mut written = Vec::new();
    for study in scenes::all(arguments.states)? {
        print!("{}", output::table(&study));
        written.extend(output::write(&arguments.output, &study)?);
    }
    print!("{}", table::file_list(&written));
    Ok(())
}
