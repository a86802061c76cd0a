//! Times as others write them: recordings behind each other, few digits, stamps of computers.

use branched_pendulum_data::{
    AngleColumns, Clock, ReadErrorKind, Recording, Repeated, Table, Timing,
};

use super::{parse, reported, table};

fn swing(time: f64) -> f64 {
    0.6 * (4.0 * time).cos() + 0.1 * (9.0 * time).sin()
}

fn read(text: &str, clock: Clock) -> Result<Recording, String> {
    let table = parse(text).map_err(|error| error.to_string())?;
    of_table(&table, clock)
}

fn of_table(table: &Table, clock: Clock) -> Result<Recording, String> {
    let columns = AngleColumns {
        clock,
        columns: vec!["a".to_owned()],
        ..AngleColumns::default()
    };
    columns.read(table).map_err(|error| error.to_string())
}

/// Asserts times from the first on, in s, and that no more than rounding is lost of them.
fn assert_times(recording: &Recording, expected: impl Fn(usize) -> f64, rounding: f64) {
    let start = recording.times[0];
    for (row, time) in recording.times.iter().enumerate() {
        let error = (time - start - expected(row)).abs();
        assert!(error <= rounding, "{row}: {time} {error:e}");
    }
}

/// Two or more recordings behind each other are refused together, and each is read by its number.
#[test]
fn the_time_starts_again() {
    let rows = |count: usize, from: f64, trial: usize| -> String {
        let row = |row: usize| {
            let time = from + 0.01 * row as f64;
            format!("{trial},{time:.3},{:.6}\n", swing(time + trial as f64))
        };
        (0..count).map(row).collect()
    };
    for (header, lengths, from) in [
        ("trial,time,a\n", &[80, 60][..], 0.0),
        ("trial,time,a\n", &[40, 41, 42], 3.0),
        ("", &[30, 30], 0.5),
        ("run,t (s),a\n", &[12, 200, 5], 0.0),
    ] {
        let parts = lengths.iter().enumerate();
        let parts = parts.map(|(trial, count)| rows(*count, from, trial));
        let mut text = header.to_owned();
        text.extend(parts);
        let name = if header.is_empty() { "column 3" } else { "a" };
        let columns = AngleColumns {
            columns: vec![name.to_owned()],
            ..AngleColumns::default()
        };
        let whole = table(&text);
        let error = columns.read(&whole).unwrap_err();
        let ReadErrorKind::Recordings { count, time, .. } = &*error.kind else {
            panic!("{error}");
        };
        assert_eq!((*count, *time), (lengths.len(), from), "{error}");
        let line = lengths[0] + 1 + usize::from(!header.is_empty());
        assert_eq!(error.place.as_ref().unwrap().line, line as u64, "{error}");
        for (index, count) in lengths.iter().enumerate() {
            let one = whole.clone().recording(&Clock::Detect, index + 1).unwrap();
            let recording = columns.read(&one).unwrap();
            assert_eq!(recording.times.len(), *count);
            assert_times(&recording, |row| 0.01 * row as f64, 1e-12);
        }
        let beyond = whole.recording(&Clock::Detect, lengths.len() + 1);
        let error = beyond.unwrap_err().to_string();
        let held = format!("the table holds {} recordings", lengths.len());
        assert!(error.ends_with(&held), "{error}");
    }
    // A frame rate joins no recordings.
    let text = "trial,time,a\n".to_owned() + &rows(40, 0.0, 0) + &rows(40, 0.0, 1);
    let error = read(&text, Clock::FrameRate(100.0)).unwrap_err();
    assert!(error.contains("2 recordings behind each other"), "{error}");
    let rate = Clock::FrameRate(100.0);
    let second = table(&text).recording(&rate, 2).unwrap();
    assert_times(
        &of_table(&second, rate).unwrap(),
        |row| 0.01 * row as f64,
        1e-12,
    );
    // One or two rows that are out of order are no recording.
    for (wrong, times) in [
        (3, &[0.0, 0.1, 0.2, 0.15, 0.3, 0.4][..]),
        (5, &[10.0, 10.1, 10.2, 10.3, 10.4, 0.0, 10.6, 10.7, 10.8]),
        (
            4,
            &[
                1.69e9 + 0.5,
                1.69e9 + 1.0,
                1.69e9 + 2.0,
                1.69e9 + 3.0,
                -1.0,
                0.0,
                1.69e9 + 6.0,
                1.69e9 + 7.0,
            ],
        ),
    ] {
        let rows = times
            .iter()
            .map(|time| format!("{time},{:.4}\n", swing(*time)));
        let text = format!("time,a\n{}", rows.collect::<String>());
        let error = read(&text, Clock::Detect).unwrap_err();
        let expected = format!(
            "time {} s does not come after {} s; correct this time, or remove the row",
            times[wrong],
            times[wrong - 1]
        );
        assert!(error.ends_with(&expected), "{error}");
    }
}

/// Times without repetition that are rounded too much are reported, with the frame rate.
#[test]
fn times_of_few_digits_are_reported() {
    let text = |rate: f64, digits: usize, jitter: f64| {
        let rows = (0..150).map(|row: u32| {
            let noise = jitter * (f64::from(row * row % 17) / 8.0 - 1.0);
            let time = f64::from(row) / rate + noise;
            format!("{time:.digits$},{:.6}\n", swing(time))
        });
        format!("t (s),a (rad)\n{}", rows.collect::<String>())
    };
    for (rate, digits, jitter, reported_rate) in [
        (60.0, 2, 0.0, Some("60")),
        (240.0, 3, 0.0, Some("240")),
        (29.97, 2, 0.0, Some("29.97")),
        // Multiples of the step, many steps, and times that are not even.
        (100.0, 2, 0.0, None),
        (60.0, 4, 0.0, None),
        (60.0, 2, 4e-3, None),
    ] {
        let recording = read(&text(rate, digits, jitter), Clock::Detect).unwrap();
        assert_eq!(
            reported(&recording, "times are rounded to "),
            reported_rate.is_some(),
            "{rate} {:?}",
            recording.findings
        );
        let rate = reported_rate.unwrap_or_default();
        assert!(reported(&recording, rate));
    }
}

/// A column that is called like a unit of time is the time.
#[test]
fn units_are_names_of_times() {
    for (name, size) in [
        ("ms", 1e-3),
        ("µs", 1e-6),
        ("msec", 1e-3),
        ("ns", 1e-9),
        ("sec", 1.0),
    ] {
        let rows = (0..60).map(|row| {
            let time = 0.01 * f64::from(row);
            format!("{:.3},{:.6}\n", time / size, swing(time))
        });
        let text = format!("{name},a (rad)\n{}", rows.collect::<String>());
        let recording = read(&text, Clock::Detect).unwrap();
        assert_times(&recording, |row| 0.01 * row as f64, 1e-9);
    }
    // Where a column is called time, another one is not.
    let text = "ms,time,a (rad)\n7,0.0,0.1\n9,0.1,0.2\n8,0.2,0.3\n";
    assert_times(
        &read(text, Clock::Detect).unwrap(),
        |row| 0.1 * row as f64,
        1e-12,
    );
}

/// Tracks whose rows take turns under equal times are told apart by the column that numbers them.
#[test]
fn tracks_take_turns() {
    for (count, header) in [(2, "time,track,a"), (3, "time,id,a"), (4, "time,bob,a")] {
        let mut text = format!("{header}\n");
        for row in 0..30 {
            let time = 0.02 * f64::from(row);
            for track in 0..count {
                let angle = swing(time + f64::from(track));
                text += &format!("{time:.2},{track},{angle:.6}\n");
            }
        }
        let error = read(&text, Clock::Detect).unwrap_err();
        let name = header.split(',').nth(1).unwrap();
        let expected = format!("the table holds {count} tracks, numbered by `{name}`");
        assert!(error.contains(&expected), "{error}");
        for track in 0..count {
            let one = table(&text).recording(&Clock::Detect, track as usize + 1);
            let recording = of_table(&one.unwrap(), Clock::Detect).unwrap();
            assert_eq!(recording.times.len(), 30);
            let angle = recording.links[0].angle(7).unwrap();
            assert!((angle - swing(0.14 + f64::from(track))).abs() < 1e-6);
        }
    }
}

/// Times with too few digits lead to the frame rate; rows that were written twice do not.
#[test]
fn rounded_times_and_repeated_rows() {
    let text = |rate: f64, count: usize, from: f64, written: &dyn Fn(f64) -> String| {
        let row = |row: usize| {
            let time = row as f64 / rate;
            format!("{},{:.5}\n", written(from + time), swing(time))
        };
        let rows: String = (0..count).map(row).collect();
        format!("time (s),a (rad)\n{rows}")
    };
    let digits = |time: f64| format!("{time:.2e}");
    let tenths = |time: f64| format!("{time:.1}");
    let floored = |time: f64| format!("{}", (10.0 * time).floor() / 10.0);
    let whole = |time: f64| format!("{}", time.floor());
    for (rate, count, from, written) in [
        (30.0, 320, 7.93, &digits as &dyn Fn(f64) -> String),
        (60.0, 400, 0.0, &tenths),
        (25.0, 500, 2.5, &floored),
        (30.0, 900, 1.69e9, &whole),
    ] {
        let text = text(rate, count, from, written);
        let error = parse(&text).unwrap();
        let columns = AngleColumns::default();
        let error = columns.read(&error).unwrap_err();
        let ReadErrorKind::RoundedTimes { rate: found, .. } = &*error.kind else {
            panic!("{rate}: {error}");
        };
        let found: f64 = found.parse().unwrap();
        assert!((found / rate - 1.0).abs() < 5e-3, "{found} for {rate}");
    }
    // A row in three that was written twice.
    for part in [2, 3, 1] {
        let mut text = "time,a\n".to_owned();
        for row in 0..60 {
            let time = 0.01 * f64::from(row);
            let line = format!("{time:.2},{:.5}\n", swing(time));
            text += &line;
            if row % part == 0 {
                text += &line;
            }
        }
        let error = read(&text, Clock::Detect).unwrap_err();
        assert!(
            error.contains("say which row of one time counts"),
            "{error}"
        );
        let once = table(&text).without_repeated_times(&Clock::Detect, Repeated::First);
        let recording = of_table(&once.unwrap(), Clock::Detect).unwrap();
        assert_eq!(recording.times.len(), 60);
    }
}

/// Stamps of computers: whole numbers that can only be dates, clocks of microcontrollers, seconds and
/// nanoseconds in two columns, and units that are given with the name.
#[test]
fn stamps_of_computers() {
    let rows = |header: &str, row: &dyn Fn(u64) -> String| -> String {
        let rows = (0..40).map(|index| {
            let angle = swing(0.008 * index as f64);
            format!("{},{angle:.6}\n", row(index))
        });
        format!("{header}\n{}", rows.collect::<String>())
    };
    let start = 1_690_000_000_123_456_789_u64;
    let nano = |index: u64| start + 8_000_000 * index;
    let stamp = |size: u64| move |index: u64| format!("{}", nano(index) / size);
    let (ns, us, ms) = (stamp(1), stamp(1_000), stamp(1_000_000));
    let parts = |unit: u64| {
        move |index: u64| {
            let nano = nano(index);
            format!("{},{}", nano / 1_000_000_000, nano % 1_000_000_000 / unit)
        }
    };
    let (sec_nanosec, sec_usec) = (parts(1), parts(1_000));
    let millis = |index: u64| format!("{}", 15_321 + 8 * index);
    let micros = |index: u64| format!("{}", 8_000 * index);
    for (header, row, words) in [
        (
            "%time,a",
            &ns as &dyn Fn(u64) -> String,
            "in nanoseconds since 1970",
        ),
        ("timestamp,a", &us, "in microseconds since 1970"),
        ("time,a", &ms, "in milliseconds since 1970"),
        (
            "sec,nanosec,a",
            &sec_nanosec,
            "`sec` and `nanosec` together are the time",
        ),
        (
            "stamp.secs,stamp.nsecs,a",
            &sec_nanosec,
            "together are the time",
        ),
        (
            "tv_sec,tv_usec,a",
            &sec_usec,
            "`tv_sec` and `tv_usec` together are the time",
        ),
        (
            "stamp_sec,stamp_nanosec,a",
            &sec_nanosec,
            "together are the time",
        ),
        ("millis,a", &millis, "in milliseconds"),
        ("micros,a", &micros, "in microseconds"),
    ] {
        let recording =
            read(&rows(header, row), Clock::Detect).unwrap_or_else(|error| panic!("{error}"));
        assert_times(&recording, |row| 0.008 * row as f64, 1e-6);
        assert!(
            reported(&recording, words),
            "{header}: {:?}",
            recording.findings
        );
        // Neither column of the time is an angle.
        let all = AngleColumns::default().read(&table(&rows(header, row)));
        let names = all.map(|all| all.links.len());
        assert!(names.is_ok_and(|count| count == 1), "{header}");
    }
    for (header, row, name) in [
        ("count,a", &micros as &dyn Fn(u64) -> String, "count [us]"),
        ("clock,a", &ns, "clock (ns)"),
        ("ticks,a", &millis, "ticks [ms]"),
    ] {
        let clock = Clock::Column(name.to_owned());
        let recording = read(&rows(header, row), clock).unwrap();
        assert_times(&recording, |row| 0.008 * row as f64, 1e-6);
    }
    // Of other whole numbers nothing is assumed.
    for (header, row) in [
        ("t,a", &millis as &dyn Fn(u64) -> String),
        ("time,a", &micros),
    ] {
        let error = read(&rows(header, row), Clock::Detect).unwrap_err();
        assert!(
            error.contains("holds whole numbers and names no unit"),
            "{error}"
        );
        assert!(error.contains(" [ms]`"), "{error}");
    }
}

/// A clock that jumps is named, and its stretches are separate; a long gap is none.
#[test]
fn a_clock_that_jumps_is_named() {
    let text = |first: &[f64], second: &[f64]| {
        let rows = first.iter().chain(second).enumerate();
        let rows = rows.map(|(row, time)| format!("{time},{:.6}\n", swing(0.01 * row as f64)));
        format!("time (s),a (rad)\n{}", rows.collect::<String>())
    };
    let from = |start: f64, count: u32| -> Vec<f64> {
        (0..count)
            .map(|row| start + 0.01 * f64::from(row))
            .collect()
    };
    for (first, second, jumps) in [
        (from(0.0, 1), from(1.69e9, 100), true),
        (from(0.0, 50), from(1.7e9, 50), true),
        (from(-1e5, 90), from(0.0, 20), true),
        (from(0.0, 500), from(20.0, 500), false),
        (from(0.0, 5), from(30.0, 50), false),
    ] {
        let recording = read(&text(&first, &second), Clock::Detect).unwrap();
        assert_eq!(
            reported(&recording, "the clock jumps from"),
            jumps,
            "{:?}",
            recording.findings
        );
        let stretches = Timing::stretches(&recording.times);
        let rows = [first.len(), first.len() + second.len()];
        assert_eq!(stretches, [0..rows[0], rows[0]..rows[1]]);
    }
    // Lost pictures and slow rates leave one stretch.
    for times in [
        from(0.0, 200)
            .into_iter()
            .filter(|t| !(0.5..1.4).contains(t))
            .collect(),
        (0..50)
            .map(|row| 3.0 * f64::from(row))
            .collect::<Vec<f64>>(),
    ] {
        let count = times.len();
        let all = 0..count;
        assert_eq!(Timing::stretches(&times), [all]);
    }
}
