//! Fuzz test of files with measured data: any bytes give a valid recording, or an error that names
//! the file.

#![no_main]

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use branched_pendulum_data::{
    AngleColumns, Clock, Gravity, Markers, ReadError, Recording, Repeated, Table, TableOptions,
    read_angles,
};
use libfuzzer_sys::fuzz_target;

/// Path of the file, which no other process uses.
static FILE: LazyLock<PathBuf> = LazyLock::new(|| {
    let name = format!("branched-pendulum-fuzz-{}.csv", std::process::id());
    std::env::temp_dir().join(name)
});

fuzz_target!(|bytes: &[u8]| {
    fs::write(&*FILE, bytes).expect("the temporary folder is writable");
    let table = match Table::read(&*FILE, &TableOptions::default()) {
        Ok(table) => table,
        Err(error) => return check_error(&error),
    };
    for column in 0..table.columns().len() {
        match table.values(column) {
            Ok(values) => assert_eq!(values.len(), table.rows()),
            Err(error) => check_error(&error),
        }
    }
    for clock in [Clock::Detect, Clock::FrameRate(60.0)] {
        let columns = AngleColumns {
            clock: clock.clone(),
            ..AngleColumns::default()
        };
        let markers = Markers {
            clock: clock.clone(),
            ..Markers::default()
        };
        check(read_angles(&table, &columns, &markers));
        check(columns.read(&table));
        check(markers.read(&table));
        let chain = Markers {
            pivot: Some([0.0, 0.0]),
            gravity: Gravity::FirstLink,
            ..markers
        };
        check(chain.read(&table));
        match table
            .clone()
            .without_repeated_times(&clock, Repeated::First)
        {
            Ok(table) => check(columns.read(&table)),
            Err(error) => check_error(&error),
        }
    }
});

fn check(read: Result<Recording, ReadError>) {
    let recording = match read {
        Ok(recording) => recording,
        Err(error) => return check_error(&error),
    };
    let Recording {
        times,
        links,
        timing,
        findings,
    } = recording;
    assert!(times.iter().all(|time| time.is_finite()));
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(timing.interval > 0.0 && timing.jitter >= 0.0, "{timing:?}");
    assert!(
        findings
            .iter()
            .all(|finding| !finding.to_string().is_empty())
    );
    for link in links {
        assert_eq!(link.samples.len(), times.len());
        let mut angles = (0..times.len()).filter_map(|index| link.angle(index));
        assert!(angles.all(f64::is_finite), "{link:?}");
    }
}

fn check_error(error: &ReadError) {
    assert!(
        error.to_string().starts_with(&*FILE.to_string_lossy()),
        "{error}"
    );
}
