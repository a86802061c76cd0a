//! Command lines that cannot be followed are explained, program by program; what all
//! share is tested with `branched-double`.

use super::{run, text};

const ACCURACY_COST: &str = env!("CARGO_BIN_EXE_accuracy-cost");
const STABILITY_MAP: &str = env!("CARGO_BIN_EXE_stability-map");
const SWAYING_BRANCH: &str = env!("CARGO_BIN_EXE_swaying-branch");
const TREE_THRESHOLDS: &str = env!("CARGO_BIN_EXE_tree-thresholds");
const WORK_PRECISION: &str = env!("CARGO_BIN_EXE_work-precision");

#[test]
fn mistakes_are_named() {
    for (program, line, message) in [
        (
            ACCURACY_COST,
            "--scene paper",
            "unexpected argument '--scene'",
        ),
        (
            STABILITY_MAP,
            "--output",
            "a value is required for '--output",
        ),
        (STABILITY_MAP, "--steps 1", "unexpected argument '--steps'"),
        (SWAYING_BRANCH, "--duration 0", "must be from 1 to 60 s"),
        (
            SWAYING_BRANCH,
            "--frame-rate 1",
            "must be from 20 to 1000 Hz",
        ),
        (SWAYING_BRANCH, "--wind NaN", "must be from 0 to 40 m/s"),
        (TREE_THRESHOLDS, "--level 1", "must be from 1.1 to"),
        (
            TREE_THRESHOLDS,
            "--noise 1",
            "unexpected argument '--noise'",
        ),
        (
            WORK_PRECISION,
            "--output a --output b",
            "cannot be used multiple times",
        ),
    ] {
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let output = run(program, &arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {error}");
        assert!(error.contains(message), "{line}: {error}");
    }
}

#[test]
fn help_tells_usage_and_defaults() {
    for (program, reported) in [
        (ACCURACY_COST, "Usage: accuracy-cost"),
        (STABILITY_MAP, "Usage: stability-map"),
        (TREE_THRESHOLDS, "[default: 5:90:0.05]"),
        (WORK_PRECISION, "Usage: work-precision"),
    ] {
        let output = run(program, &["--help"]);
        assert!(output.status.success());
        let help = text(&output.stdout);
        assert!(help.contains(reported), "{help}");
    }
}
