//! Names above the numbers, as programs and people write them.

use branched_pendulum_data::{AngleColumns, Clock, FileKind, Recording, Repeated};

use super::{assert_read, by_columns, by_points, parse, table};

const TIMES: [f64; 3] = [0.0, 0.25, 0.5];

fn names(text: &str) -> Vec<String> {
    let table = table(text);
    table
        .columns()
        .iter()
        .map(|column| column.name.clone())
        .collect()
}

/// Lines above the names that are no names: of the separator, titles, notes.
#[test]
fn lines_above_the_names_name_no_track() {
    for text in [
        "sep=;\r\nt;theta1;theta2\r\n0,0;0,81;0,52\r\n0,25;0,71;0,42\r\n0,5;0,61;0,32\r\n",
        "sep=,\nt,theta1,theta2\n0,0.81,0.52\n0.25,0.71,0.42\n0.5,0.61,0.32\n",
        "\u{feff}SEP=\t\nt\ttheta1\ttheta2\n0\t0.81\t0.52\n0.25\t0.71\t0.42\n0.5\t0.61\t0.32\n",
        "\"sep=;\"\nt;theta1;theta2\n0;0.81;0.52\n0.25;0.71;0.42\n0.5;0.61;0.32\n",
        "My experiment\nt,theta1,theta2\n0,0.81,0.52\n0.25,0.71,0.42\n0.5,0.61,0.32\n",
        "Release 3;;\nt;theta1;theta2\n0;0.81;0.52\n0.25;0.71;0.42\n0.5;0.61;0.32\n",
        "sep=;\nswing\n\nt;theta1;theta2\n0;0.81;0.52\n0.25;0.71;0.42\n0.5;0.61;0.32\n",
    ] {
        let table = table(text);
        assert_eq!(table.kind(), FileKind::Wide, "{text}");
        assert!(table.tracks().is_empty(), "{text}");
        assert_eq!(names(text), ["t", "theta1", "theta2"], "{text}");
        let read = by_columns(text, &["theta1", "theta2"]).expect(text);
        assert_read(
            &read,
            &TIMES,
            &[&[0.81, 0.52], &[0.71, 0.42], &[0.61, 0.32]],
        );
    }
}

/// A name is one as the header has it, and without its unit.
#[test]
fn names_are_those_of_the_header() {
    for (header, wanted, name) in [
        (
            "t,theta1_deg,theta2_deg",
            ["theta1_deg", "theta1"],
            "theta1",
        ),
        (
            "t,theta1_mesure_deg,b_deg",
            ["theta1_mesure_deg", "theta1_mesure"],
            "theta1_mesure",
        ),
        (
            "Time/s,Angle/deg,AngVel/rad/s",
            ["Angle/deg", "Angle"],
            "Angle",
        ),
        ("t [s],a [deg],omega [rad/s]", ["a [deg]", "a"], "a"),
        ("t (s),left a (deg),b (deg)", ["left_a", "left a"], "left a"),
        ("t,left_a_deg,b_deg", ["left a", "left_a"], "left_a"),
        ("t,θ_{1} (deg),θ_{2} (deg)", ["θ_{1} (deg)", "θ_1"], "θ_1"),
        (
            "t,theta (left) [deg],theta (right) [deg]",
            ["theta (left)", "theta (left) [deg]"],
            "theta (left)",
        ),
        (
            "t,theta_deg,theta_rad",
            ["theta_deg", "theta_deg"],
            "theta_deg",
        ),
    ] {
        let text = format!("{header}\n0.0,9,1\n0.25,18,1\n0.5,27,1\n");
        for wanted in wanted {
            let read = by_columns(&text, &[wanted]).expect(wanted);
            assert_eq!(read.links[0].name, name);
            let rows = [9.0_f64, 18.0, 27.0].map(f64::to_radians);
            let rows: Vec<&[f64]> = rows.iter().map(std::slice::from_ref).collect();
            assert_read(&read, &TIMES, &rows);
        }
    }
    let error = by_columns("t,a_b,a b\n0.0,1,2\n0.1,1,2\n0.2,1,2\n", &["a__b"]).unwrap_err();
    assert_eq!(
        error,
        "swing.csv: there is no column `a__b` (did you mean `a_b`?); there are: t, a_b, a b"
    );
}

/// A time is found by its name, with a unit of one letter as well, or named.
#[test]
fn the_time_is_found_or_named() {
    for header in [
        "time_s",
        "t_s",
        "temps_s",
        "Zeit / s",
        "Elapsed time (s)",
        "sim_time",
        "t",
    ] {
        let text = format!("{header},a [rad]\n0,0.81\n0.25,0.71\n0.5,0.61\n");
        assert_read(
            &by_columns(&text, &[]).expect(header),
            &TIMES,
            &[&[0.81], &[0.71], &[0.61]],
        );
    }
    for (header, name) in [
        ("clock", "clock"),
        ("when_ms", "when"),
        ("stamp [s]", "stamp [s]"),
    ] {
        let scale = if header.ends_with("ms") { 1000.0 } else { 1.0 };
        let rows = [(0.0, 0.81), (0.25, 0.71), (0.5, 0.61)];
        let rows = rows.map(|(time, angle)| format!("{angle},{}\n", time * scale));
        let text = format!("a [rad],{header}\n{}", rows.concat());
        let columns = AngleColumns {
            clock: Clock::Column(name.to_owned()),
            ..AngleColumns::default()
        };
        let read = columns.read(&table(&text)).unwrap();
        assert_read(&read, &TIMES, &[&[0.81], &[0.71], &[0.61]]);
    }
}

/// Pictures at a rate leave the time of the file aside, and say so.
#[test]
fn a_frame_rate_leaves_times_aside() {
    for header in [
        "time (s),a (rad)",
        "t [ms],a [rad]",
        "frame,time (s),a (rad)",
    ] {
        let lead = if header.starts_with("frame") {
            "7,"
        } else {
            ""
        };
        let mut text = format!("{header}\n");
        for (row, angle) in ["0.81", "0.71", "0.61"].iter().enumerate() {
            let lead = lead.replace('7', &(row + 7).to_string());
            text += &format!("{lead}{},{angle}\n", row * 3);
        }
        let columns = AngleColumns {
            clock: Clock::FrameRate(4.0),
            ..AngleColumns::default()
        };
        let read = columns.read(&table(&text)).expect(header);
        let start = if lead.is_empty() { 0.0 } else { 7.0 / 4.0 };
        assert_read(
            &read,
            &TIMES.map(|time| time + start),
            &[&[0.81], &[0.71], &[0.61]],
        );
        let reported = read
            .findings
            .iter()
            .any(|f| f.text.contains("4 a second, whatever `t"));
        assert!(reported, "{:?}", read.findings);
    }
}

/// What stands in columns that nobody asked for decides nothing.
#[test]
fn columns_that_nobody_asked_for_do_not_decide() {
    for (header, others) in [
        ("note", ["released", "", "turns"]),
        ("note", ["released", "left", "right"]),
        ("score", ["Infinity", "120.5", "119"]),
        ("score", ["-inf", "nan", "1e999"]),
        ("pressure", ["\"1013,2\"", "\"1013,3\"", "\"1013,1\""]),
        ("empty", ["", "", ""]),
        (
            "when",
            [
                "2024-05-01 12:03:04",
                "2024-05-01 12:03:05",
                "2024-05-01 12:03:06",
            ],
        ),
        ("count", ["1", "two", "3"]),
        ("level", ["0.5 m", "0.6 m", "700 mm"]),
    ] {
        for place in 0..3 {
            let line = |words: [&str; 3], other: &str| {
                let mut words = words.to_vec();
                words.insert(place, other);
                words.join(",") + "\n"
            };
            let text = line(["t", "theta1", "theta2"], header)
                + &line(["0", "0.81", "0.52"], others[0])
                + &line(["0.25", "0.71", "0.42"], others[1])
                + &line(["0.5", "0.61", "0.32"], others[2]);
            let read = by_columns(&text, &["theta1", "theta2"]).expect(&text);
            assert_read(
                &read,
                &TIMES,
                &[&[0.81, 0.52], &[0.71, 0.42], &[0.61, 0.32]],
            );
        }
    }
    // Columns of text, of nothing and of other units are no angles, and said to be none.
    let text = "t,a,note,omega [rad/s],b,gap\n0.0,0.81,go,7,0.52,\n0.25,0.71,,7,0.42,\n0.5,0.61,on,7,0.32,\n";
    let read = by_columns(text, &[]).unwrap();
    assert_read(
        &read,
        &TIMES,
        &[&[0.81, 0.52], &[0.71, 0.42], &[0.61, 0.32]],
    );
    let reported: Vec<String> = read.findings.iter().map(ToString::to_string).collect();
    let expected = "detected: no angles, by units or as text: `note`, `omega`, `gap`";
    assert!(reported.contains(&expected.to_owned()), "{reported:?}");
}

/// Of rows with one time the first counts, or the last.
#[test]
fn repeated_times_leave_the_row_that_counts() {
    let starts = "t,a [rad]\n0,0.81\n0,0.82\n0.25,0.71\n0.5,0.61\n";
    let between = "t,a [rad]\n0,0.81\n0.25,0.71\n0.25,0.72\n0.25,0.73\n0.5,0.61\n";
    let ends = "t [ms],a [rad]\n0,0.81\n250,0.71\n500,0.61\n500,0.62\n";
    for (text, first, last, line) in [
        (starts, [0.81, 0.71, 0.61], [0.82, 0.71, 0.61], 3),
        (between, [0.81, 0.71, 0.61], [0.81, 0.73, 0.61], 4),
        (ends, [0.81, 0.71, 0.61], [0.81, 0.71, 0.62], 5),
    ] {
        for (counts, expected) in [(Repeated::First, first), (Repeated::Last, last)] {
            let table = table(text)
                .without_repeated_times(&Clock::Detect, counts)
                .unwrap();
            let read = AngleColumns::default().read(&table).unwrap();
            let rows: Vec<&[f64]> = expected.iter().map(std::slice::from_ref).collect();
            assert_read(&read, &TIMES, &rows);
            assert!(
                read.findings
                    .iter()
                    .any(|f| f.text.contains("dropped that repeat a time"))
            );
        }
        let error = by_columns(text, &[]).unwrap_err();
        assert!(
            error.starts_with(&format!("swing.csv, line {line}, column 1 (`t`): time")),
            "{error}"
        );
        assert!(
            error.ends_with("say which row of one time counts, the first or the last"),
            "{error}"
        );
    }
    // Places in later errors are those of the file.
    let late = format!("{starts}0.75,1e9\n");
    let table = parse(&late).unwrap();
    let table = table
        .without_repeated_times(&Clock::Detect, Repeated::First)
        .unwrap();
    let error = AngleColumns::default().read(&table).unwrap_err();
    assert_eq!(error.place.unwrap().line, 6);
}

/// Stretches of time are left out, wherever they lie and whatever gives the times.
#[test]
fn stretches_are_left_out() {
    let rows = "0,0.81,0.4\n0.25,0.71,0.3\n0.5,0.61,0.2\n0.75,0.51,0.1\n1,0.41,0\n";
    let by_time = format!("t,a [rad],b [rad]\n{rows}");
    let rate = Clock::FrameRate(4.0);
    let read = |text: &str, clock: &Clock, stretches: &[[f64; 2]]| {
        let table = table(text).leaving_out(clock, stretches)?;
        let columns = AngleColumns {
            clock: clock.clone(),
            columns: vec!["a".into(), "b".into()],
            ..AngleColumns::default()
        };
        columns.read(&table)
    };
    let left = |recording: &Recording| -> Vec<bool> {
        let rows = 0..recording.times.len();
        rows.map(|row| recording.links.iter().all(|link| link.angle(row).is_some()))
            .collect()
    };
    for (clock, stretches, expected) in [
        (
            &Clock::Detect,
            &[[0.2, 0.6]][..],
            [true, false, false, true, true],
        ),
        (
            &Clock::Detect,
            &[[0.0, 0.0], [0.75, 9.0]],
            [false, true, true, false, false],
        ),
        (&rate, &[[-1.0, 0.25]], [false, false, true, true, true]),
        (&rate, &[[1.0, 1.0]], [true, true, true, true, false]),
    ] {
        let recording = read(&by_time, clock, stretches).unwrap();
        assert_eq!(recording.times, [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(left(&recording), expected, "{stretches:?}");
        let reported = recording
            .findings
            .iter()
            .filter(|f| f.text.contains("left out, from"));
        assert_eq!(reported.count(), stretches.len());
    }
    for empty in [[1.5, 2.0], [0.3, 0.4], [0.6, 0.4]] {
        let error = read(&by_time, &Clock::Detect, &[empty])
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("to be left out, in a record from 0 s to 1 s"),
            "{error}"
        );
    }
}

/// Labels of DeepLabCut, whose rows are named by their pictures.
#[test]
fn labels_name_their_pictures() {
    let data = ["0,0,0.3,0.4", "0,0,0.4,0.3", "0,0,0.5,0"];
    let heads = |lead: &str| {
        format!("scorer{lead},me,me,me,me\nbodyparts{lead},top,top,end,end\ncoords{lead},x,y,x,y\n")
    };
    let angles = [0.3_f64.atan2(0.4), 0.4_f64.atan2(0.3), 0.5_f64.atan2(0.0)];
    let rows: Vec<&[f64]> = angles.iter().map(std::slice::from_ref).collect();
    for (lead, pictures, times) in [
        (
            "",
            [
                "labeled-data/v/img003.png",
                "labeled-data/v/img004.png",
                "labeled-data/v/img007.png",
            ],
            [0.3, 0.4, 0.7],
        ),
        (
            ",,",
            [
                "labeled-data,v,img0.jpg",
                "labeled-data,v,img1.jpg",
                "labeled-data,v,img2.jpg",
            ],
            [0.0, 0.1, 0.2],
        ),
        (
            "",
            ["first.png", "second.png", "third.png"],
            [0.0, 0.1, 0.2],
        ),
    ] {
        let lines = pictures
            .iter()
            .zip(data)
            .map(|(picture, data)| format!("{picture},{data}\n"));
        let text = heads(lead) + &lines.collect::<String>();
        assert_eq!(table(&text).kind(), FileKind::DeepLabCut);
        assert_read(
            &by_points(&text, &[("top", "end")]).expect(&text),
            &times,
            &rows,
        );
    }
}
