//! Files of numbers, written and read.

mod cells;
mod clocks;
mod exchanges;
mod findings;
mod headers;
mod leaps;
mod malformed;
mod points;
mod reading;
mod refused;
#[cfg(feature = "spreadsheets")]
mod spreadsheets;
mod tables;
mod writing;
mod wrong_pictures;

use branched_pendulum_data::{
    AngleColumns, Clock, LinkMarkers, Markers, ReadError, Recording, Table, TableOptions,
    read_angles,
};

use findings::{outliers, reported};

fn table(text: &str) -> Table {
    parse(text).unwrap()
}

fn parse(text: &str) -> Result<Table, ReadError> {
    Table::parse("swing.csv", text, &TableOptions::default())
}

/// What is read where nothing is said but the names of columns.
fn by_columns(text: &str, columns: &[&str]) -> Result<Recording, String> {
    let columns = AngleColumns {
        columns: columns.iter().map(ToString::to_string).collect(),
        outliers: None,
        ..AngleColumns::default()
    };
    let table = parse(text).map_err(|error| error.to_string())?;
    read_angles(&table, &columns, &Markers::default()).map_err(|error| error.to_string())
}

/// What is read of links between points, at 10 pictures a second where rows are such.
fn by_points(text: &str, links: &[(&str, &str)]) -> Result<Recording, String> {
    let table = parse(text).map_err(|error| error.to_string())?;
    let has_time = table.columns()[0].name.starts_with('t');
    let link = |(upper, lower): &(&str, &str)| LinkMarkers {
        upper: (*upper).to_owned(),
        lower: (*lower).to_owned(),
    };
    let markers = Markers {
        clock: if has_time {
            Clock::Detect
        } else {
            Clock::FrameRate(10.0)
        },
        links: links.iter().map(link).collect(),
        outliers: None,
        ..Markers::default()
    };
    read_angles(&table, &AngleColumns::default(), &markers).map_err(|error| error.to_string())
}

/// Angles of all links, a row a time.
fn angles(recording: &Recording) -> Vec<Vec<Option<f64>>> {
    let row = |index| {
        recording
            .links
            .iter()
            .map(|link| link.angle(index))
            .collect()
    };
    (0..recording.times.len()).map(row).collect()
}

/// Asserts what was read: times and the angles of all links, to rounding.
fn assert_read(recording: &Recording, times: &[f64], expected: &[&[f64]]) {
    let close =
        |found: f64, expected: f64| (found - expected).abs() <= 4e-15 * (1.0 + expected.abs());
    assert_eq!(recording.times.len(), times.len());
    for (found, expected) in recording.times.iter().zip(times) {
        assert!(close(*found, *expected), "{found} s, not {expected} s");
    }
    for (found, expected) in angles(recording).iter().zip(expected) {
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(*expected) {
            let found = found.unwrap();
            assert!(close(found, *expected), "{found} rad, not {expected} rad");
        }
    }
}

/// Random numbers that are the same every time.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(0x2545_f491_4f6c_dd1d ^ seed)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// 2 s of two angles at 100 Hz.
fn swing() -> (Vec<f64>, [Vec<f64>; 2]) {
    let times: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i)).collect();
    let angles = [0.6, 0.9].map(|size| {
        let angle = |time: &f64| size * (4.0 * time + size).cos();
        times.iter().map(angle).collect()
    });
    (times, angles)
}

/// Camera frames of two links of 0.25 m hung on each other, 1,000 pixels a metre.
fn frames(likelihood: impl Fn(usize) -> f64) -> String {
    let (_, [one, two]) = swing();
    let mut text = String::from("scorer");
    for (row, words) in [
        ("", ["net"; 9]),
        (
            "bodyparts",
            [
                "top", "top", "top", "mid", "mid", "mid", "end", "end", "end",
            ],
        ),
        (
            "coords",
            [
                "x",
                "y",
                "likelihood",
                "x",
                "y",
                "likelihood",
                "x",
                "y",
                "likelihood",
            ],
        ),
    ] {
        text += &format!("{row},{}\n", words.join(","));
    }
    for (index, (one, two)) in one.iter().zip(&two).enumerate() {
        let middle = [300.0 + 250.0 * one.sin(), 100.0 + 250.0 * one.cos()];
        let end = [middle[0] + 250.0 * two.sin(), middle[1] + 250.0 * two.cos()];
        text += &format!(
            "{index},300,100,1,{},{},{},{},{},1\n",
            middle[0],
            middle[1],
            likelihood(index),
            end[0],
            end[1]
        );
    }
    text
}
