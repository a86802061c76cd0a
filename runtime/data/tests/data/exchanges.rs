//! Dots and angles that a tracker took for each other in some pictures.

use std::fmt::Write;

use branched_pendulum_data::{AngleColumns, AngleUnit, Clock, Markers, Recording};

use super::findings::{outliers, reported};
use super::table;

/// Degrees that are exchanged between columns come back to their own.
#[test]
fn exchanged_columns_are_changed_back() {
    for (from, count) in [(50, 1), (120, 4), (80, 60)] {
        let angles = |row: i32| {
            let time = 0.01 * f64::from(row);
            [
                40.0 * (6.0 * time).cos(),
                70.0 * (5.0 * time).sin() + 5.0 * (13.0 * time).cos(),
            ]
        };
        let mut text = "t [s],a [deg],b [deg]\n".to_owned();
        for row in 0..300 {
            let [a, b] = angles(row);
            let is_exchanged = (from..from + count).contains(&row);
            let [a, b] = if is_exchanged { [b, a] } else { [a, b] };
            writeln!(text, "{},{a},{b}", 0.01 * f64::from(row)).unwrap();
        }
        let unit = Some(AngleUnit::Degrees);
        let recording = AngleColumns {
            unit,
            ..AngleColumns::default()
        };
        let recording = recording.read(&table(&text)).unwrap();
        for row in 0..300 {
            for (link, angle) in recording.links.iter().zip(angles(row)) {
                let found = link.angle(row as usize).unwrap();
                assert!(
                    (found - angle.to_radians()).abs() < 1e-12,
                    "{from} {count} {row}"
                );
            }
        }
        let words = format!("exchanged, and changed back: `a` and `b` in {count} row");
        assert!(reported(&recording, &words), "{:?}", recording.findings);
    }
}

/// Dots of two links that hang on each other or side by side, at 100 pictures a second, after a change
/// of those of a picture.
fn dots(is_chain: bool, change: impl Fn(usize, &mut [[f64; 2]; 4])) -> (Recording, [Vec<f64>; 2]) {
    let time = |row: usize| 0.01 * row as f64;
    let one = |row: usize| 0.9 * (6.0 * time(row)).cos();
    let two = |row: usize| match is_chain {
        true => 1.4 * (4.0 * time(row)).sin(),
        false => one(row) + 0.1 * (7.0 * time(row)).cos(),
    };
    let mut text = "frame,a x,a y,b x,b y,c x,c y,d x,d y\n".to_owned();
    for row in 0..200 {
        let below = |[x, y]: [f64; 2], angle: f64| [x + 0.25 * angle.sin(), y - 0.25 * angle.cos()];
        let pivot = [0.1, 0.2];
        let end = below(pivot, one(row));
        let start = if is_chain { end } else { pivot };
        let mut places = [pivot, end, start, below(start, two(row))];
        change(row, &mut places);
        let cells = places.as_flattened().iter().map(f64::to_string);
        writeln!(text, "{row},{}", cells.collect::<Vec<_>>().join(",")).unwrap();
    }
    let markers = Markers {
        clock: Clock::FrameRate(100.0),
        ..Markers::default()
    };
    let truth = [(0..200).map(one).collect(), (0..200).map(two).collect()];
    (markers.read(&table(&text)).unwrap(), truth)
}

/// Dots that changed places for some pictures: of one link, of two ends, and whole links.
#[test]
fn exchanged_dots_are_changed_back() {
    let cases: [(bool, &[[usize; 2]], usize, usize); 4] = [
        (true, &[[0, 1]], 12, 1),
        (true, &[[1, 3]], 60, 3),
        (false, &[[1, 3]], 90, 5),
        (true, &[[0, 2], [1, 3]], 140, 40),
    ];
    for (is_chain, exchanged, from, count) in cases {
        let (recording, truth) = dots(is_chain, |row, places| {
            for [one, other] in exchanged {
                if (from..from + count).contains(&row) {
                    places.swap(*one, *other);
                }
            }
        });
        assert!(
            reported(&recording, "exchanged, and changed back: "),
            "{:?}",
            recording.findings
        );
        for (link, angles) in recording.links.iter().zip(&truth) {
            for (row, angle) in angles.iter().enumerate() {
                let found = link.angle(row).unwrap();
                assert!(
                    (found - angle).abs() < 1e-9,
                    "{exchanged:?} {row}: {found} {angle}"
                );
            }
        }
    }
}

/// One dot that is as far from another as before, but on the other side, has not changed places with it.
#[test]
fn one_dot_that_is_wrong_is_no_exchange() {
    for wrong in [20, 77, 150] {
        let (recording, truth) = dots(true, |row, [pivot, end, ..]| {
            if row == wrong {
                *end = [0, 1].map(|axis| 2.0 * pivot[axis] - end[axis]);
            }
        });
        assert!(
            !reported(&recording, "exchanged"),
            "{:?}",
            recording.findings
        );
        assert_eq!(outliers(&recording, 0), [wrong]);
        for (link, angles) in recording.links.iter().zip(&truth) {
            let used = (0..200).filter_map(|row| Some((link.angle(row)?, angles[row])));
            assert!(used.clone().count() >= 199);
            for (found, angle) in used {
                assert!((found - angle).abs() < 1e-9, "{wrong}: {found} {angle}");
            }
        }
    }
}
