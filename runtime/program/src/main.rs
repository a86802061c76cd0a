//! The command-line program `branched-pendulum`; `branched-pendulum --help` lists its subcommands.

use std::process::ExitCode;

fn main() -> ExitCode {
    branched_pendulum_program::main(std::env::args_os())
}
