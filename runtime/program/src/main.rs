//! The command `branched-pendulum`: `branched-pendulum --help` lists what it does.

use std::process::ExitCode;

fn main() -> ExitCode {
    branched_pendulum_program::main(std::env::args_os())
}
