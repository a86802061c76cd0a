//! Passes on small programs that are built value by value.

mod angles;
mod dead;
mod factors;
mod fuse;
mod live;
mod rounding;

use branched_pendulum_codegen::functions::{Argument, Purpose, ResultShape};
use branched_pendulum_codegen::program::{Builder, Entry, Program, SolveChoice, ValueId};
use branched_pendulum_codegen::scene::Solve;

/// Finishes a program with one entry point.
fn program_of(builder: Builder, purpose: Purpose, outputs: Vec<ValueId>) -> Program {
    let choice = SolveChoice {
        solve: Solve::Factorization,
        factorization: Default::default(),
        recursion: Default::default(),
    };
    let entry = Entry {
        name: "outputs".to_owned(),
        purpose,
        arguments: vec![Argument::Theta],
        outputs,
        shape: ResultShape::Vector,
    };
    let program = builder
        .finish(vec![entry], choice)
        .expect("a small program");
    assert_eq!(program.verify(), Ok(()));
    program
}
