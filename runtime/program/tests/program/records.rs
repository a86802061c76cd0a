//! Records that show no motion, hold several motions, or leap: what `analyse` and `identify` say of
//! them.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use super::{folder, run, text};

/// Angles of a damped rod, in degrees: close enough to a motion for a reader.
fn angle(time: f64) -> f64 {
    20.0 * (-0.05 * time).exp() * (6.05 * time).cos()
}

/// Writes rows under a header.
fn file(name: &str, header: &str, rows: impl IntoIterator<Item = String>) -> PathBuf {
    let folder = folder(&format!("records-{name}"));
    fs::create_dir_all(&folder).unwrap();
    let mut written = format!("{header}\n");
    for row in rows {
        writeln!(written, "{row}").unwrap();
    }
    let path = folder.join("rod.csv");
    fs::write(&path, written).unwrap();
    fs::write(
        folder.join("rod.txt"),
        "gravity = 9.80665, bar: rod(mass = 0.2, length = 0.4, friction = c)",
    )
    .unwrap();
    path
}

/// Runs a command on a file; its exit code and what it prints.
fn command(command: &str, file: &std::path::Path, options: &[&str]) -> (Option<i32>, String) {
    let tree = file.with_file_name("rod.txt");
    let output = file.with_file_name("output");
    let mut words = vec![command, file.to_str().unwrap()];
    words.extend(["--tree", tree.to_str().unwrap()]);
    words.extend(["--output", output.to_str().unwrap()]);
    words.extend(options);
    let done = run(&words);
    let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
    (done.status.code(), printed)
}

const ANALYSE: [&str; 4] = ["--set", "c=3e-4", "--draws", "20"];

/// A column without variance is refused by name, in either command, and nothing is written as NaN.
#[test]
fn a_dead_column_is_refused() {
    for value in ["0.0", "-12.5", "180"] {
        let rows = (0..80).map(|row| format!("{:.2},{value}", 0.02 * f64::from(row)));
        let file = file("dead", "time (s),theta (deg)", rows);
        let of_identify = ["--unknown", "c"];
        for (name, options) in [("analyse", &ANALYSE[..]), ("identify", &of_identify)] {
            let (code, printed) = command(name, &file, options);
            assert_eq!(code, Some(1), "{printed}");
            assert!(
                printed.contains("the angles of `theta` never change"),
                "{printed}"
            );
            assert!(!printed.contains("NaN"), "{printed}");
        }
    }
}

/// Of two recordings each is taken by its number.
#[test]
fn recordings_are_taken_by_number() {
    let rows = [0.0, 1.3].map(|phase| {
        let row = move |row: i32| {
            let time = 0.02 * f64::from(row);
            format!("{time:.2},{:.4}", angle(time + phase))
        };
        (0..60).map(row)
    });
    let file = file("two", "time (s),theta (deg)", rows.into_iter().flatten());
    let (code, printed) = command("analyse", &file, &ANALYSE);
    assert_eq!(code, Some(1), "{printed}");
    assert!(
        printed.contains("`--recording 1` takes the first"),
        "{printed}"
    );
    for number in ["1", "2"] {
        let (code, printed) = command(
            "analyse",
            &file,
            &[&ANALYSE[..], &["--recording", number]].concat(),
        );
        assert_eq!(code, Some(0), "{printed}");
        assert!(
            printed.contains(&format!("recording {number} of 2")),
            "{printed}"
        );
    }
}

/// A clock that jumps costs no memory, and the stretches before and behind a long gap are estimated
/// each by itself.
#[test]
fn a_gap_is_a_gap() {
    let row = |time: f64| format!("{time},{:.4}", angle(time % 1e6));
    let times = (0..200).map(|row| 0.02 * f64::from(row));
    for (name, first, start, is_split) in [("jump", 1, 1.69e9, false), ("hour", 200, 3600.0, true)]
    {
        let early = times.clone().take(first).map(row);
        let late = times.clone().map(|time| row(start + time));
        let file = file(name, "time (s),theta (deg)", early.chain(late));
        let (code, printed) = command("analyse", &file, &ANALYSE);
        assert_eq!(code, Some(0), "{printed}");
        assert!(printed.contains("the clock jumps from"), "{printed}");
        assert_eq!(
            printed.contains("2 stretches between long gaps"),
            is_split,
            "{printed}"
        );
        let rows = fs::read_to_string(file.with_file_name("output").join("estimate.csv")).unwrap();
        assert_eq!(rows.lines().count(), if is_split { 401 } else { 201 });
        let (_, printed) = command("identify", &file, &["--unknown", "c"]);
        assert!(!printed.contains("memory allocation"), "{printed}");
    }
}

/// A step that stays is reported with its time.
#[test]
fn a_leap_is_reported() {
    let rows = (0..200).map(|row| {
        let time = 0.02 * f64::from(row);
        let step = if row < 120 { 0.0 } else { 15.0 };
        format!("{time:.2},{:.4}", angle(time) + step)
    });
    let file = file("leap", "time (s),theta (deg)", rows);
    let (_, printed) = command("analyse", &file, &ANALYSE);
    let finding = printed
        .lines()
        .find(|line| line.contains("the record leaps where"));
    let finding = finding.unwrap_or_else(|| panic!("{printed}"));
    assert!(
        finding.contains("2.3") || finding.contains("2.4"),
        "{finding}"
    );
}

/// Angles that are read in a wrong way are named; their rows do not leap.
#[test]
fn no_leap_is_reported_of_misread_angles() {
    for (name, side, tilt) in [
        ("left", -90.0, -90),
        ("right", 90.0, 90),
        ("below", 270.0, -90),
    ] {
        let rows = (0..120).map(|row| {
            let time = 0.02 * f64::from(row);
            format!("{time:.2},{:.4}", angle(time) + side)
        });
        let file = file(name, "time (s),theta (deg)", rows);
        let (_, printed) = command("analyse", &file, &ANALYSE);
        assert!(printed.contains(&format!("--tilt {tilt}")), "{printed}");
        assert!(!printed.contains("the record leaps where"), "{printed}");
    }
}
