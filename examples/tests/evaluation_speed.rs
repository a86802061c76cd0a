//! The command line of `evaluation-speed`; what it measures is tested beside it.

use std::process::Command;

#[test]
fn a_command_line_that_cannot_be_followed_is_explained() {
    let program = env!("CARGO_BIN_EXE_evaluation-speed");
    let wrong = Command::new(program).arg("--output").output().unwrap();
    assert_eq!(wrong.status.code(), Some(2));
    let help = Command::new(program).arg("--help").output().unwrap();
    assert!(help.status.success());
    assert!(
        String::from_utf8(help.stdout)
            .unwrap()
            .contains("Usage: evaluation-speed")
    );
}
