//! Tables that show no motion, are wide or large, or have names and cells apart.

use std::fmt::Write;

use branched_pendulum_data::{
    AngleColumns, AngleUnit, LinkMarkers, Markers, ReadErrorKind, read_angles,
};

use super::{by_columns, outliers, parse, reported, table};

fn swing(row: usize) -> f64 {
    0.6 * (0.05 * row as f64).cos() + 0.07
}

/// Angles without variance are refused by their name, whatever the value is and wherever it comes from.
#[test]
fn links_without_motion_are_refused() {
    let text = |still: &dyn Fn(usize) -> String| {
        let rows =
            (0..60).map(|row| format!("{},{:.5},{}\n", 0.01 * row as f64, swing(row), still(row)));
        format!("t,a (rad),b (rad)\n{}", rows.collect::<String>())
    };
    let zero = |_: usize| "0.0".to_owned();
    let other = |_: usize| "-1.2345".to_owned();
    let holes = |row: usize| match row % 3 {
        0 => String::new(),
        _ => "0.25".to_owned(),
    };
    for still in [&zero as &dyn Fn(usize) -> String, &other, &holes] {
        for columns in [&["b"][..], &["a", "b"], &[]] {
            let error = by_columns(&text(still), columns).unwrap_err();
            let start = "swing.csv: the angles of `b` never change: all ";
            assert!(error.starts_with(start), "{error}");
        }
        assert!(by_columns(&text(still), &["a"]).is_ok());
        // A dead encoder on a link that moves.
        let relative = AngleColumns {
            relative_to: vec![None, Some(0)],
            ..AngleColumns::default()
        };
        let error = relative.read(&table(&text(still))).unwrap_err();
        assert!(matches!(&*error.kind, ReadErrorKind::Still { name, .. } if name == "b"));
    }
    // Angles that change by the rounding of `f64`.
    for [low, high] in [
        ["-0.3", "-0.30000000000000004"],
        ["1.5707963267948966", "1.5707963267948968"],
        ["0.1", "0.10000000000000002"],
    ] {
        let rounding = |row: usize| [low, high][row * row % 7 % 2].to_owned();
        let error = by_columns(&text(&rounding), &["b"]).unwrap_err();
        assert!(error.contains("never change: all 60 are"), "{error}");
        // In few digits.
        assert!(
            error.contains(" rad, so") && !error.contains("0000"),
            "{error}"
        );
    }
    // Angles that flicker between neighbouring values of a format or an encoder are doubtful; a
    // small motion is not.
    let steps: [fn(usize) -> usize; 2] = [|row| row * row % 7 % 2, |row| row * 7 % 11 % 3];
    for (value, step, digits) in [(0.1, 1e-6, 6), (-1.2345, 0.00614, 6), (2.0, 0.1, 1)] {
        for count in steps {
            let flickering = |row: usize| format!("{:.digits$}", value + step * count(row) as f64);
            let recording = by_columns(&text(&flickering), &["b"]).unwrap();
            let expected = "the angles of `b` change by ";
            assert!(reported(&recording, expected), "{:?}", recording.findings);
        }
        let moving = |row: usize| format!("{}", value + 1e-3 * swing(row));
        let recording = by_columns(&text(&moving), &["b"]).unwrap();
        assert!(
            !reported(&recording, "show no motion"),
            "{:?}",
            recording.findings
        );
    }
    // Two dots that do not move against each other.
    let rows = (0..60).map(|row| {
        let [x, y] = [0.3 + 0.01 * row as f64, swing(row)];
        format!("{},{x},{y},{},{y}\n", 0.01 * row as f64, x + 0.5)
    });
    let text = format!("t,p_x,p_y,q_x,q_y\n{}", rows.collect::<String>());
    let markers = Markers {
        links: vec![LinkMarkers {
            upper: "p".to_owned(),
            lower: "q".to_owned(),
        }],
        ..Markers::default()
    };
    let error = read_angles(&table(&text), &AngleColumns::default(), &markers).unwrap_err();
    assert!(error.to_string().contains("never change"), "{error}");
}

/// Counts of encoders, from 0 on or about it, wrapping or not.
#[test]
fn counts_of_encoders() {
    for (counts, about, wraps) in [(4096, 0.0, true), (1024, 2.0, true), (600, 0.0, false)] {
        let turn = f64::from(counts);
        let count = |row: usize| {
            let count = (turn * (swing(row) + about) / std::f64::consts::TAU).round();
            if wraps { count.rem_euclid(turn) } else { count }
        };
        let rows = (0..80).map(|row| format!("{:.3},{}\n", 0.01 * row as f64, count(row)));
        let text = format!("t,raw\n{}", rows.collect::<String>());
        let unit = AngleUnit::named(&format!("counts:{counts}"));
        let columns = AngleColumns {
            unit,
            zero: Some(branched_pendulum_data::AngleZero::Down),
            ..AngleColumns::default()
        };
        let recording = columns.read(&table(&text)).unwrap();
        assert!(reported(
            &recording,
            &format!("angles in counts, {counts} a turn")
        ));
        let start = recording.links[0].angle(0).unwrap() - swing(0);
        for row in 0..80 {
            let error = recording.links[0].angle(row).unwrap() - swing(row) - start;
            assert!(
                error.abs() < 1.1 * std::f64::consts::TAU / turn,
                "{row} {error}"
            );
        }
        let error = AngleColumns::default().read(&table(&text)).unwrap_err();
        let ReadErrorKind::AngleUnit { counts: found, .. } = &*error.kind else {
            panic!("{error}");
        };
        assert!(found.is_some() || !wraps, "{error}");
        assert_eq!(found.unwrap_or(counts).is_power_of_two(), counts != 600);
    }
    assert_eq!(AngleUnit::named("counts:0"), None);
    assert_eq!(AngleUnit::named("counts:-4"), None);
    assert_eq!(AngleUnit::named("counts"), None);
}

/// Names that other characters separate than the cells below.
#[test]
fn names_and_cells_with_different_separators() {
    for (names, cell) in [
        ("time a b", ","),
        ("time,a,b", "\t"),
        ("time;a;b", ","),
        ("time, a, b", " "),
        ("time\ta\tb", ";"),
        ("time (s),a (rad),b (rad)", " "),
        ("time (s);a (rad);b (rad)", "\t"),
    ] {
        let mut text = format!("{names}\n");
        for row in 0..20 {
            let cells = [0.01 * row as f64, swing(row), 0.4 * swing(2 * row)];
            let cells = cells.map(|cell| format!("{cell:.5}"));
            writeln!(text, "{}", cells.join(cell)).unwrap();
        }
        let recording =
            by_columns(&text, &["b", "a"]).unwrap_or_else(|error| panic!("{names}: {error}"));
        let angle = recording.links[1].angle(7).unwrap();
        assert!((angle - swing(7)).abs() < 1e-5, "{names}");
        assert!(reported(&recording, "unlike the cells"), "{names}");
    }
    // Fewer names than cells stay refused, and a title is no row of names.
    for names in ["time,a", "Run of 3", "measured on 3 May"] {
        let text = format!("{names}\n0.0\t0.1\t0.2\n0.1\t0.2\t0.4\n0.2\t0.1\t0.3\n");
        let error = parse(&text).unwrap_err().to_string();
        assert!(
            error.contains("names above rows of 3 cells"),
            "{names}: {error}"
        );
    }
}

/// Tables with tens of thousands of columns are refused at once: the work grows with the cells alone.
#[test]
fn wide_tables_are_refused_at_once() {
    let width = 50_000;
    for name in [
        |column: usize| format!("angle {column}"),
        |column: usize| format!("p{}_{}", column / 2, ["x", "y"][column % 2]),
        |column: usize| format!("q{column} (rad)"),
    ] {
        let names: Vec<String> = (0..width).map(name).collect();
        let mut text = format!("t,{}\n", names.join(","));
        for row in 0..4 {
            write!(text, "{}", 0.1 * row as f64).unwrap();
            for column in 0..width {
                write!(text, ",{}", (row + column) % 7).unwrap();
            }
            text.push('\n');
        }
        let table = parse(&text).unwrap();
        let read = read_angles(&table, &AngleColumns::default(), &Markers::default());
        let error = read.unwrap_err();
        let ReadErrorKind::TooWide { found, .. } = &*error.kind else {
            panic!("{error}");
        };
        assert!(*found >= width / 2 - 1, "{error}");
    }
}

/// Rounded angles at rest have no outliers: a last digit that changes now and then is none.
#[test]
fn rounded_angles_at_rest_have_no_outliers() {
    for (step, every, moves) in [
        (1e-3, 17, false),
        (0.01, 23, true),
        (0.0015339808, 11, false),
    ] {
        let rows = (0..300).map(|row| {
            let digit = f64::from(u8::from(row % every == 5));
            let swings = if moves && row > 200 {
                swing(row) - swing(200)
            } else {
                0.0
            };
            let angle = ((0.12 + swings) / step).round() * step + digit * step;
            format!("{:.3},{angle:.9}\n", 0.004 * row as f64)
        });
        let text = format!("t,a (rad)\n{}", rows.collect::<String>());
        let recording = AngleColumns::default().read(&table(&text)).unwrap();
        assert_eq!(
            outliers(&recording, 0),
            [0; 0],
            "{step}: {:?}",
            recording.findings
        );
    }
}
