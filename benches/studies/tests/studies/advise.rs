//! Command line of `advise`.

use branched_pendulum_advice::TimeLimit;
use branched_pendulum_frame::command_line::parse_line;
use branched_pendulum_studies::advise::arguments::{Arguments, Limit};
use branched_pendulum_studies::advise::requests::OutputName;

#[test]
fn outputs_and_limits_are_read() {
    let line = "--right angles:1e-4,pixels:0.5 --limit sample:5 --scene branch";
    let arguments = parse_line::<Arguments>(line).unwrap();
    let outputs = [(OutputName::Angles, 1e-4), (OutputName::Pixels, 0.5)];
    assert_eq!(arguments.right.0, outputs);
    assert_eq!(arguments.limit, Some(Limit(TimeLimit::Sample(5.0 * 1e-6))));
}

#[test]
fn what_cannot_be_followed_is_explained() {
    for (line, message) in [
        ("--right angles", "names no output with its largest error"),
        (
            "--right speed:1",
            "outputs: angles, energy, pixels, transfer",
        ),
        ("--right angles:0", "must be from"),
        ("--limit 5", "must be `step:` or `sample:`"),
        ("--chart", "not provided:\n  --output <FOLDER>"),
        (
            "--scene branch --right transfer:1e-3",
            "of `--scene paper` alone",
        ),
        ("--starts 0", "1..=1000"),
    ] {
        let error = parse_line::<Arguments>(line).unwrap_err();
        assert!(error.contains(message), "{line}: {error}");
    }
}
