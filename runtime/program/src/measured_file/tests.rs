//! Options of files.

use clap::{CommandFactory, Parser};

use super::MeasuredFile;
use crate::frame::command_line::FILE;
use branched_pendulum_data::AngleUnit;

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    measured: MeasuredFile,
}

fn read(line: &str) -> Result<MeasuredFile, String> {
    let words = ["program"].into_iter().chain(line.split_whitespace());
    let line = Line::try_parse_from(words).map_err(|error| error.to_string())?;
    line.measured.check().map(|()| line.measured)
}

#[test]
fn options_of_files_are_read() {
    let pair = |upper: &str, lower: &str| (upper.to_owned(), lower.to_owned());
    let named = read("a.csv --columns a,b,c --unit mrad --time clock --drop-repeated last");
    let named = named.unwrap();
    assert_eq!(named.columns, ["a", "b", "c"]);
    assert_eq!(named.unit, Some(AngleUnit::Milliradians));
    assert_eq!(named.time.as_deref(), Some("clock"));
    assert_eq!(named.drop_repeated, Some(super::Counts::Last));
    assert_eq!(
        read("a.csv --drop-repeated").unwrap().drop_repeated,
        Some(super::Counts::First)
    );
    let counts = read("a.csv --unit counts:4096 --recording 2").unwrap();
    assert_eq!(counts.unit, AngleUnit::named("counts:4096"));
    assert_eq!(counts.recording, Some(2));
    let dots = read("a.csv --dots 0.5,-1:m1,m1:m2,origin:m3").unwrap().dots;
    assert_eq!(
        dots,
        [pair("0.5,-1", "m1"), pair("m1", "m2"), pair("origin", "m3")]
    );
    let dots = read("a.csv --dots top:mid,left:end").unwrap().dots;
    assert_eq!(dots, [pair("top", "mid"), pair("left", "end")]);
    assert_eq!(
        read("a.csv --pivot -1.5,2").unwrap().pivot,
        Some([-1.5, 2.0])
    );
    assert_eq!(read("a.csv --pivot origin").unwrap().pivot, Some([0.0; 2]));
    let read = read("a.csv --tilt -1.5 --leave-out 0:1.25,3:3.5 --relative").unwrap();
    assert_eq!(read.tilt, Some(-1.5));
    assert_eq!(read.leave_out, [[0.0, 1.25], [3.0, 3.5]]);
    assert!(read.relative);
}

/// Checks that an option that cannot be applied is rejected, and not ignored.
#[test]
fn options_that_cannot_apply_are_refused() {
    for (line, message) in [
        (
            "a.csv --dots top,mid",
            "write two names separated by a colon",
        ),
        (
            "a.csv --dots top:mid,end",
            "write two names separated by a colon",
        ),
        ("a.csv --pivot 1", "X,Y, or `origin`"),
        ("a.csv --pivot nan,0", "X,Y, or `origin`"),
        ("a.csv --unit turns", "a unit is rad, deg, "),
        ("a.csv --unit counts:0", "or counts:N of an encoder"),
        ("a.csv --unit counts:4096.5", "or counts:N of an encoder"),
        ("a.csv --drop-repeated mean", "possible values"),
        ("a.csv --time t --frame-rate 60", "cannot be used with"),
        (
            "a.csv --columns a --dots a:b",
            "angles come from one of them",
        ),
        (
            "a.csv --columns a --pivot 0,0",
            "angles come from one of them",
        ),
        ("a.csv --unit deg --y-down", "angles come from one of them"),
        (
            "a.csv --pivot 0,0 --dots a:b",
            "give the pivot's position in --dots",
        ),
        (
            "a.csv --relative --dots a:b",
            "angles come from one of them",
        ),
        ("a.csv --y-up --y-down", "cannot be used with"),
        ("a.csv --leave-out 1", "the earlier first: FROM:TO"),
        ("a.csv --leave-out 0:1,3:2", "the earlier first: FROM:TO"),
        ("a.csv --leave-out 1:inf", "the earlier first: FROM:TO"),
        ("a.csv --tilt 181", "must be from -180 to 180"),
    ] {
        let error = read(line).unwrap_err();
        assert!(error.contains(message), "{line}: {error}");
    }
}

/// Checks that all options that describe a file are in the list of their names.
#[test]
fn options_of_files_have_names() {
    let command = Line::command();
    let all = command.get_arguments().map(|own| own.get_id().as_str());
    let mut all: Vec<&str> = all.filter(|name| *name != FILE).collect();
    let mut named = MeasuredFile::OPTIONS;
    all.sort_unstable();
    named.sort_unstable();
    assert_eq!(all, named);
}
