//! Causes of failures, once each, and options in messages.

use super::Failure;
use crate::messages;
use branched_pendulum::analysis::truncation::TruncationError;
use branched_pendulum::analysis::variational::LyapunovError;
use branched_pendulum::analysis::{ModesError, SectorModesError};
use branched_pendulum::approximate::LinearError;
use branched_pendulum::integrate::{IntegrationError, RunError};
use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_charts::ChartError;
use branched_pendulum_data::{CsvError, ReadError, ReadErrorKind};
use std::{error::Error, io, path::PathBuf};

fn refused() -> io::Error {
    io::Error::from(io::ErrorKind::PermissionDenied)
}

fn chart() -> ChartError {
    ChartError::Io {
        path: PathBuf::from("chart.svg"),
        source: refused(),
    }
}

fn csv() -> CsvError {
    CsvError::Io {
        path: PathBuf::from("samples.csv"),
        action: "write",
        source: refused(),
    }
}

/// Returns the error of a run that has only one step for a second.
fn integration() -> IntegrationError<f64> {
    let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1e9);
    let method = Dop853::new(Options {
        step_limit: 1,
        ..Options::with_tolerance(1e-9)
    });
    let start = State::new(0.0, vec![0.0]);
    let run = method.run(&ode, &start, 1.0);
    run.expect_err("one step does not reach the end")
}

/// Returns the error of a run with an invalid end time.
fn request() -> IntegrationError<f64> {
    let ode = OdeFn::new(1, |_: f64, _: &[f64], rates: &mut [f64]| rates[0] = 1.0);
    let start = State::new(0.0, vec![0.0]);
    let run = Rk4::new(0.1).run(&ode, &start, f64::NAN);
    run.expect_err("NaN is not a time")
}

fn no_rows() -> ModesError {
    ModesError::Empty { matrix: "mass" }
}

fn modes() -> SectorModesError {
    SectorModesError::Sector {
        sector: "child".to_owned(),
        source: no_rows(),
    }
}

fn parameter() -> ParameterError {
    branched_pendulum::emitted::require_positive("mass of `child`", -1.0).expect_err("negative")
}

/// Checks, for every error of the workspace that has a cause, that no message in a chain is
/// contained in a message above it.
#[test]
fn every_cause_is_told_once() {
    let truncation = || TruncationError::Integration(integration());
    let folder = || PathBuf::from("output");
    let chains: Vec<Box<dyn Error>> = vec![
        Box::new(chart()),
        Box::new(ChartError::Encode(Box::new(refused()))),
        Box::new(csv()),
        Box::new(request()),
        Box::new(RunError::<f64, CsvError>::Integration(request())),
        Box::new(RunError::Observer {
            error: csv(),
            last: State::new(0.0, vec![0.0]),
            report: *integration().report().expect("it has begun"),
        }),
        Box::new(truncation()),
        Box::new(LyapunovError::Integration(integration())),
        Box::new(SectorModesError::Matrices(no_rows())),
        Box::new(modes()),
        Box::new(Failure::Parameter(parameter())),
        Box::new(Failure::integration(50.0, integration())),
        Box::new(Failure::Modes(no_rows())),
        Box::new(Failure::SectorModes(modes())),
        Box::new(Failure::Linear(LinearError::NotFinite)),
        Box::new(Failure::Frames(Box::new(request()))),
        Box::new(Failure::Truncation(truncation())),
        Box::new(Failure::Growth(request().into())),
        Box::new(Failure::tree("swing.txt", no_rows())),
        Box::new(Failure::advice(modes())),
        Box::new(Failure::Folder {
            path: folder(),
            source: refused(),
        }),
        Box::new(Failure::File {
            path: folder(),
            source: refused(),
        }),
        Box::new(Failure::Csv(csv())),
        Box::new(Failure::Chart(chart())),
        Box::new(Failure::Print(refused())),
    ];
    for chain in chains {
        let messages = messages(chain.as_ref());
        for (index, cause) in messages.iter().enumerate().skip(1) {
            let reported = messages[..index].iter().any(|above| above.contains(cause));
            assert!(!reported, "twice: {messages:?}");
        }
    }
}

#[test]
fn what_a_table_leaves_open_has_an_option() {
    let repeated = ReadErrorKind::TimeOrder {
        previous: 0.5,
        time: 0.5,
    };
    let backwards = ReadErrorKind::TimeOrder {
        previous: 0.5,
        time: 0.4,
    };
    let name = || "a".to_owned();
    for (kind, option) in [
        (ReadErrorKind::NoTime, Some("`--time` or `--frame-rate`")),
        (
            ReadErrorKind::FrameNumbers { name: name() },
            Some("`--frame-rate`"),
        ),
        (repeated, Some("`--drop-repeated`")),
        (backwards, None),
        (
            ReadErrorKind::AngleUnit {
                name: name(),
                largest: 10.0,
                counts: None,
            },
            Some("`--unit`"),
        ),
        (
            ReadErrorKind::AngleUnit {
                name: name(),
                largest: 4000.0,
                counts: Some(4096),
            },
            Some("`--unit counts:N`"),
        ),
        (
            ReadErrorKind::RoundedTimes {
                time: 10.1,
                rate: "30".to_owned(),
            },
            Some("`--frame-rate`"),
        ),
        (
            ReadErrorKind::Recordings {
                previous: 1.0,
                time: 0.0,
                count: 2,
                column: None,
            },
            Some("`--recording 1`"),
        ),
        (
            ReadErrorKind::Jumps {
                name: name(),
                count: 30,
                measured: 300,
                first: "1.2 s".to_owned(),
            },
            Some("`--leave-out`"),
        ),
        (ReadErrorKind::Empty, None),
    ] {
        let failure = Failure::Reading(ReadError {
            path: PathBuf::from("swing.csv"),
            sheet: None,
            place: None,
            kind: Box::new(kind),
        });
        let text = failure.to_string();
        match option {
            Some(option) => assert!(text.contains(option), "{text}"),
            None => assert!(!text.contains("--"), "{text}"),
        }
    }
}
