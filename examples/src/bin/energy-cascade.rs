//! Energy of a driven binary tree, sector by sector.
//!
//! `energy-cascade --help` lists the options.

use std::fs;
use std::process::ExitCode;

use branched_pendulum_examples::branched_double::table;
use branched_pendulum_examples::energy_cascade::arguments::HELP;
use branched_pendulum_examples::energy_cascade::scene::{self, Tree, TreeParameters};
use branched_pendulum_examples::energy_cascade::{
    Arguments, Failure, Request, Run, charts, report,
};
use branched_pendulum_examples::exit;

fn main() -> ExitCode {
    let arguments = match Arguments::parse(std::env::args().skip(1)) {
        Ok(Request::Run(arguments)) => arguments,
        Ok(Request::Help) => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        Err(error) => return exit::wrong_command_line("energy-cascade", &error),
    };
    exit::of_run("energy-cascade", run(&arguments))
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    // Before the work, so that a folder that cannot be made costs none.
    let folder = &arguments.output;
    fs::create_dir_all(folder).map_err(|source| Failure::Folder {
        path: folder.clone(),
        source,
    })?;
    // The modes do not depend on the drive.
    let modes = scene::modes(&Tree::new(TreeParameters {
        torque: 0.0,
        pace: 0.0,
    })?)?;
    let run = Run::new(arguments)?;
    print!("{}", report::report(arguments, &modes, &run));
    let mut written = vec![report::write_samples(folder, &run)?];
    written.extend(charts::write(folder, &run)?);
    print!("\n{}", table::file_list(&written));
    Ok(())
}
