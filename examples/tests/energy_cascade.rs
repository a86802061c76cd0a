//! The program `energy-cascade`.

use std::process::{Command, Output};

use branched_pendulum_examples::energy_cascade::scene::{Tree, TreeParameters, modes};

/// A pair of outermost rods moves against each other on a pivot at rest.
#[test]
fn the_outermost_sectors_have_the_frequency_of_a_rod() {
    let still = TreeParameters {
        torque: 0.0,
        pace: 0.0,
    };
    let modes = modes(&Tree::new(still).unwrap()).unwrap();
    assert!(modes.mass_off_block < 1e-15 && modes.stiffness_off_block < 1e-15);
    let length = 0.3 * 0.7_f64.powi(3);
    let rod = (1.5 * 9.80665 / length).sqrt() / std::f64::consts::TAU;
    let outermost = modes
        .blocks
        .iter()
        .filter(|block| block.name.starts_with("arm_4"));
    let mut seen = 0;
    for block in outermost {
        let [frequency] = block.modes.frequencies_hz[..] else {
            panic!("{} modes", block.modes.frequencies_hz.len());
        };
        assert!((frequency / rod - 1.0).abs() < 1e-13, "{frequency}, {rod}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

fn program(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_energy-cascade");
    Command::new(program).args(arguments).output().unwrap()
}

#[test]
fn a_short_run_leaves_table_and_charts() {
    let folder = std::env::temp_dir().join(format!("energy-cascade-{}", std::process::id()));
    let output = program(&["--duration", "0.2", "--output", folder.to_str().unwrap()]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    assert!(text.contains("| `in_phase` | 4 | 0."), "{text}");
    let csv = std::fs::read_to_string(folder.join("energy-cascade.csv")).unwrap();
    // The header and one sample each fiftieth of a second from 0 to 0.2 s.
    assert_eq!(csv.lines().count(), 12);
    for chart in ["energy-cascade.svg", "energy-cascade.png"] {
        assert!(folder.join(chart).metadata().unwrap().len() > 1000);
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_command_line_that_cannot_be_followed_is_explained() {
    for (arguments, message) in [
        (&["--duration", "0"][..], "must be from 0.1 to 1000 s"),
        (&["--torque", "NaN"], "must be from 0 to 100 N m"),
        (&["--frequency"], "a value is required for '--frequency"),
        (
            &["--output", "a", "--output", "b"],
            "cannot be used multiple times",
        ),
        (&["--seed", "1"], "unexpected argument '--seed'"),
    ] {
        let output = program(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(error.contains(message), "{error}");
    }
    let help = program(&["--help"]);
    assert!(help.status.success());
    let help = String::from_utf8(help.stdout).unwrap();
    for default in [
        "20",
        "0.2",
        "0.6",
        "0.001",
        "1e-12",
        "energy-cascade-output",
    ] {
        assert!(help.contains(&format!("[default: {default}]")), "{help}");
    }
}
