//! The program `transfer-orders` and the orders of accuracy that it reports.

use std::process::{Command, Output};

use branched_pendulum_examples::transfer_orders::FORMS;
use branched_pendulum_examples::transfer_orders::forms::antiphase_frequency;
use branched_pendulum_examples::transfer_orders::phase_average::{phase_average, unit_states};

/// W is even in the amplitude and begins with its square. What a form of order
/// N leaves out is of order N + 2, and so its relative error is of order N.
#[test]
fn the_relative_error_falls_with_the_order_of_the_amplitude() {
    let amplitudes = [0.05, 0.1];
    let curve = phase_average(&unit_states(300), &amplitudes);
    let [small, large] = curve.as_slice() else {
        panic!("no energy flows: {curve:?}");
    };
    let ratio = amplitudes[1] / amplitudes[0];
    for (form, order) in [(1, 2.0), (2, 4.0), (3, 6.0), (4, 8.0)] {
        let slope = (large.errors[form] / small.errors[form]).ln() / ratio.ln();
        assert!((slope - order).abs() < 0.2, "{}: {slope}", FORMS[form]);
    }
}

/// The published form leaves out terms that are quadratic in the amplitude, as
/// those that it holds: no amplitude is small enough for it.
#[test]
fn the_relative_error_of_the_published_form_does_not_fall() {
    let curve = phase_average(&unit_states(300), &[1e-3, 1e-2, 1e-1]);
    assert_eq!(curve.len(), 3);
    for point in &curve {
        let change = point.errors[0] / curve[0].errors[0];
        assert!(
            point.errors[0] > 0.3 && (change - 1.0).abs() < 0.02,
            "{point:?}"
        );
    }
}

#[test]
fn the_antiphase_frequency_is_that_of_the_paper() {
    let hertz = antiphase_frequency() / std::f64::consts::TAU;
    assert_eq!(format!("{hertz:.7}"), "1.2580584");
}

fn program(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_transfer-orders");
    Command::new(program).args(arguments).output().unwrap()
}

#[test]
fn a_command_line_that_cannot_be_followed_is_explained() {
    for (arguments, message) in [
        (&["--states", "9"][..], "whole number from 10 to 1000000"),
        (&["--states", "many"], "but got `many`"),
        (&["--states"], "`--states` needs a value"),
        (
            &["--output", "a", "--output", "b"],
            "`--output` is given twice",
        ),
        (&["--seed", "1"], "no option `--seed`"),
    ] {
        let output = program(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(error.contains(message), "{error}");
    }
    let help = program(&["--help"]);
    assert!(help.status.success());
    assert!(String::from_utf8(help.stdout).unwrap().contains("[20000]"));
}
