//! How wrong each form of the energy transfer W is, and what it costs.
//!
//! `transfer-orders --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::branched_double::{Failure, files, table};
use branched_pendulum_examples::exit;
use branched_pendulum_examples::transfer_orders::arguments::HELP;
use branched_pendulum_examples::transfer_orders::error_curve::{AMPLITUDES, logarithmic};
use branched_pendulum_examples::transfer_orders::nested;
use branched_pendulum_examples::transfer_orders::output::{self, Curves};
use branched_pendulum_examples::transfer_orders::phase_average::{phase_average, unit_states};
use branched_pendulum_examples::transfer_orders::trajectories::along_trajectories;
use branched_pendulum_examples::transfer_orders::{Arguments, Costs, Request};

/// Amplitudes of the phase average, and bins of the trajectories.
const POINTS: usize = 45;

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
    let states = unit_states(arguments.states);
    let curves = Curves {
        phase_average: phase_average(&states, &logarithmic(AMPLITUDES, POINTS)),
        trajectories: along_trajectories(POINTS)?,
        nested: nested::phase_average(
            &nested::unit_states(arguments.states),
            &logarithmic(AMPLITUDES, POINTS),
        ),
    };
    print!("{}", output::table(&curves, &Costs::measure()));
    print!("{}", output::nested_table(&curves.nested, &nested::costs()));
    let written = output::write(&arguments.output, &curves)?;
    print!("\n{}", table::file_list(&written));
    Ok(())
}
