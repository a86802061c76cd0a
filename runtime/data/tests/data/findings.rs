//! What is told of a file: few lines, in the right order, of what is there and nothing else.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use branched_pendulum_data::{
    AngleColumns, AngleZero, Basis, Clock, Markers, ReadErrorKind, Recording, Sample,
};

use super::{Random, table};

fn columns(rows: impl IntoIterator<Item = (f64, f64)>) -> String {
    let mut text = "time (s),a (rad)\n".to_owned();
    for (time, angle) in rows {
        writeln!(text, "{time},{angle}").unwrap();
    }
    text
}

fn read(text: &str) -> Recording {
    let zero = Some(AngleZero::Down);
    let columns = AngleColumns {
        zero,
        ..AngleColumns::default()
    };
    columns.read(&table(text)).unwrap()
}

pub(crate) fn reported(recording: &Recording, part: &str) -> bool {
    recording
        .findings
        .iter()
        .any(|finding| finding.text.contains(part))
}

pub(crate) fn outliers(recording: &Recording, link: usize) -> Vec<usize> {
    let samples = recording.links[link].samples.iter().enumerate();
    let outliers = samples.filter(|(_, sample)| matches!(sample, Sample::Outlier(_)));
    outliers.map(|(row, _)| row).collect()
}

/// A glitch is marked, and the turns behind it are those before it.
#[test]
fn a_glitch_adds_no_turn() {
    let still = |_: f64| 0.0;
    let swing = |time: f64| 2.5 * (6.0 * time).cos();
    let whirl = |time: f64| 90.0 * time + (9.0 * time).sin();
    let motions: [&dyn Fn(f64) -> f64; 3] = [&still, &swing, &whirl];
    for (motion, rate) in motions.into_iter().zip([60.0, 60.0, 100.0]) {
        for wrong in [PI, 3.0, -2.0] {
            let rows = (0..60).map(|row| {
                let time = f64::from(row) / rate;
                let bad = if row == 26 { wrong } else { 0.0 };
                let angle = motion(time) + bad;
                (time, angle - TAU * (angle / TAU).round())
            });
            let recording = read(&columns(rows));
            assert_eq!(
                outliers(&recording, 0),
                [26],
                "{wrong}: {:?}",
                recording.findings
            );
            for row in (0..60).filter(|row| *row != 26) {
                let expected = motion(f64::from(row) / rate) - TAU * (motion(0.0) / TAU).round();
                let found = recording.links[0].angle(row as usize).unwrap();
                assert!((found - expected).abs() < 1e-9, "{row}: {found} {expected}");
            }
        }
    }
}

/// Behind lost rows a whirl is where its rate leads, not at the nearest turn.
#[test]
fn turns_are_counted_ahead() {
    for (rate, lost) in [(1.2, 3), (-1.0, 4), (0.8, 5)] {
        let rows = (0..60).filter(|row| !(30..30 + lost).contains(row));
        let angle = |row: i32| 0.5 + rate * f64::from(row) + 0.2 * (0.3 * f64::from(row)).sin();
        let rows = rows.map(|row| {
            let angle = angle(row);
            (0.01 * f64::from(row), angle - TAU * (angle / TAU).round())
        });
        let recording = read(&columns(rows));
        for (index, time) in recording.times.iter().enumerate() {
            let expected = angle((100.0 * time).round() as i32);
            let found = recording.links[0].angle(index).unwrap();
            assert!(
                (found - expected).abs() < 1e-9,
                "{rate} {time}: {found} {expected}"
            );
        }
        assert!(reported(&recording, "no rows between"));
    }
}

/// Smooth motions written in steps have no outliers, and one that is off by fifty steps is one.
#[test]
fn rounding_makes_no_outliers() {
    for (rate, count, step) in [
        (1000.0, 3000, 1e-5),
        (240.0, 2000, 1e-3),
        (1000.0, 4000, 0.01_f64.to_radians()),
        (500.0, 3000, TAU / 4096.0),
    ] {
        for wrong in [None, Some(count / 3)] {
            let rows = (0..count).map(|row| {
                let time = f64::from(row) / rate;
                let angle = 0.5 * (5.0 * time).cos() + 0.3 * (7.7 * time).sin();
                let steps = (angle / step).round() + if wrong == Some(row) { 50.0 } else { 0.0 };
                (time, steps * step)
            });
            let recording = read(&columns(rows));
            let expected: Vec<usize> = wrong.iter().map(|row| *row as usize).collect();
            assert_eq!(
                outliers(&recording, 0),
                expected,
                "{step} {:?}",
                recording.findings
            );
        }
    }
}

/// A row for each count of an encoder: uneven times are told once, and a place where rows are lost
/// is something else.
#[test]
fn rows_at_the_edges_of_an_encoder() {
    for (size, counts, lost) in [
        (0.5, 600.0, None),
        (1.2, 1024.0, None),
        (0.8, 600.0, Some(4.0)),
    ] {
        let mut rows = Vec::new();
        let mut last = f64::NAN;
        for tick in 0..100_000 {
            let time = 1e-4 * f64::from(tick);
            let count = (size * (5.0 * time).cos() * counts / TAU).floor();
            let is_lost = lost.is_some_and(|from| (from..from + 0.7).contains(&time));
            if count != last && !is_lost {
                rows.push((time, count * TAU / counts));
            }
            last = count;
        }
        let recording = read(&columns(rows));
        assert!(
            reported(&recording, "uneven times"),
            "{:?}",
            recording.findings
        );
        assert!(!reported(&recording, "samples a second"));
        assert!(recording.findings.len() <= 10, "{:?}", recording.findings);
        let gaps = &recording.timing.gaps;
        assert_eq!(gaps.len(), usize::from(lost.is_some()), "{gaps:?}");
        assert_eq!(reported(&recording, "no rows between"), lost.is_some());
        // In 0.7 s it may have turned over.
        let is_doubtful = recording
            .findings
            .iter()
            .any(|f| f.basis == Basis::Doubtful);
        assert_eq!(is_doubtful, lost.is_some());
        assert_eq!(outliers(&recording, 0), [0; 0]);
    }
}

/// A record about half a turn is turned over, and the doubt is told first.
#[test]
fn a_record_about_half_a_turn_is_doubtful() {
    let swing = |time: f64| PI + 0.3 * (5.0 * time).cos();
    let large = |time: f64| PI + 1.2 * (3.0 * time).sin() + 0.2 * (8.0 * time).cos();
    let slow = |time: f64| -PI + 0.05 * (4.0 * time).cos();
    let motions: [&dyn Fn(f64) -> f64; 3] = [&swing, &large, &slow];
    for motion in motions {
        let rows = (0..300).map(|row| {
            let time = 0.01 * f64::from(row);
            (time, motion(time))
        });
        let text = columns(rows);
        let recording = AngleColumns::default().read(&table(&text)).unwrap();
        let first = &recording.findings[0];
        assert_eq!(first.basis, Basis::Doubtful, "{first}");
        assert!(first.text.contains("say so (zero: down)"), "{first}");
        assert!(
            (recording.links[0].angle(0).unwrap().rem_euclid(TAU)
                - (motion(0.0) + PI).rem_euclid(TAU))
            .abs()
                < 1e-9
        );
        for zero in [AngleZero::Down, AngleZero::Up] {
            let zero = Some(zero);
            let given = AngleColumns {
                zero,
                ..AngleColumns::default()
            };
            let given = given.read(&table(&text)).unwrap();
            assert!(!reported(&given, "half a turn"), "{:?}", given.findings);
        }
    }
}

/// What jumps too often is refused, with the first place and what may be done.
#[test]
fn what_jumps_too_often_is_refused() {
    let mut random = Random::new(5);
    let mut noise = || TAU * random.unit();
    let chance: Vec<f64> = (0..200).map(|_| noise()).collect();
    let slow_camera: Vec<f64> = (0..200)
        .map(|row| 9.0 * (0.9 * f64::from(row)).sin() + 4.0 * (2.1 * f64::from(row)).cos())
        .collect();
    let two_dots: Vec<f64> = (0..200)
        .map(|row| if row % 5 < 3 { 0.2 } else { 0.2 + PI })
        .collect();
    for angles in [chance, slow_camera, two_dots] {
        let rows = angles.iter().enumerate();
        let text = columns(
            rows.map(|(row, angle)| (0.1 * row as f64, angle - TAU * (angle / TAU).round())),
        );
        let error = AngleColumns::default().read(&table(&text)).unwrap_err();
        let place = error.place.as_ref().unwrap();
        assert!(place.line < 20, "{place}");
        let ReadErrorKind::Jumps {
            count,
            measured: 200,
            ..
        } = *error.kind
        else {
            panic!("{error}");
        };
        assert!(count > 10, "{error}");
        let words = error.to_string();
        assert!(
            words.contains("the frame rate is too low for this motion"),
            "{words}"
        );
    }
}

/// The rate is that of all times, rounded as they are.
#[test]
fn the_rate_of_rounded_times() {
    for (rate, digits, text) in [
        (60.0, 5, "60 samples a second"),
        (24.0, 3, "24 samples a second"),
        (120.0, 4, "120 samples a second"),
        (59.94, 6, "59.94 samples a second"),
    ] {
        // A whole number of steps of rounding from the first to the last.
        let rows = (0..1201).map(|row| {
            let time = format!("{:.digits$}", f64::from(row) / rate);
            (
                time.parse().unwrap(),
                0.3 * (5.0 * f64::from(row) / rate).cos(),
            )
        });
        let recording = read(&columns(rows));
        assert!(reported(&recording, text), "{:?}", recording.findings);
    }
}

/// A line for each kind of finding, whatever the number of columns and of places.
#[test]
fn findings_are_grouped() {
    for animals in [2, 9, 40] {
        let mut text = "frame".to_owned();
        for animal in 0..animals {
            write!(text, ",p{animal} x,p{animal} y").unwrap();
        }
        text.push('\n');
        for row in (0..400).filter(|row| row % 37 != 5) {
            write!(text, "{row}").unwrap();
            for animal in 0..animals {
                let angle = 0.4 * (0.1 * f64::from(row) + f64::from(animal / 2)).cos();
                let [x, y] = match (animal % 2, (row + animal) % 50) {
                    (_, 7) => ["".to_owned(), "".to_owned()],
                    (0, _) => [format!("{animal}"), "0".to_owned()],
                    _ => [
                        format!("{}", f64::from(animal - 1) + 0.1 * angle.sin()),
                        format!("{}", -0.1 * angle.cos()),
                    ],
                };
                write!(text, ",{x},{y}").unwrap();
            }
            text.push('\n');
        }
        let markers = Markers {
            clock: Clock::FrameRate(100.0),
            ..Markers::default()
        };
        let recording = markers.read(&table(&text));
        let links = animals / 2;
        if animals % 2 == 1 {
            assert!(recording.is_err());
            continue;
        }
        let recording = recording.unwrap();
        assert_eq!(recording.links.len(), links as usize);
        let all: Vec<String> = recording.findings.iter().map(ToString::to_string).collect();
        let longest = all.iter().map(String::len).max().unwrap();
        assert!(all.len() <= 9 && longest < 250, "{all:?}");
        assert!(
            reported(
                &recording,
                "values missing in 389 rows: 8 of `p0`, 8 of `p1`"
            ),
            "{all:?}"
        );
        assert!(
            reported(
                &recording,
                "no rows between 0.04 s and 0.06 s, 0.41 s and 0.43 s"
            ),
            "{all:?}"
        );
    }
}
