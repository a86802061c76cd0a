//! Numbers as programs write them, with their units.

use std::f64::consts::{PI, TAU};

use super::{assert_read, by_columns, parse};

/// Each unit of time is its seconds, wherever it stands.
#[test]
fn units_of_time_are_seconds() {
    for (unit, seconds) in [
        ("s", 1.0),
        ("sec", 1.0),
        ("seconds", 1.0),
        ("Seconds", 1.0),
        ("ms", 1e-3),
        ("msec", 1e-3),
        ("milliseconds", 1e-3),
        ("µs", 1e-6),
        ("μs", 1e-6),
        ("us", 1e-6),
        ("ns", 1e-9),
        ("min", 60.0),
        ("minutes", 60.0),
    ] {
        let times = [0.0, 3.0 * seconds, 6.0 * seconds, 7.0 * seconds];
        for header in [
            format!("t [{unit}],a [rad]"),
            format!("time ({unit}),a (rad)"),
            format!("Zeit/{unit},a/rad"),
            format!("t_{unit},a_rad"),
            format!("temps_{unit},a_rad"),
            format!("t,a\n{unit},rad"),
        ] {
            let text = format!("{header}\n0,0.25\n3,0.5\n6,0.75\n7,1\n");
            let read = by_columns(&text, &[]).expect(&header);
            assert_read(&read, &times, &[&[0.25], &[0.5], &[0.75], &[1.0]]);
        }
        let text =
            format!("t,a\n0 {unit},0.25 rad\n3 {unit},0.5 rad\n6 {unit},0.75 rad\n7{unit},1rad\n");
        assert_read(
            &by_columns(&text, &[]).expect(unit),
            &times,
            &[&[0.25], &[0.5], &[0.75], &[1.0]],
        );
    }
}

/// Each unit of angles is its radians, wherever it stands.
#[test]
fn units_of_angles_are_radians() {
    for (unit, radians) in [
        ("rad", 1.0),
        ("radians", 1.0),
        ("mrad", 1e-3),
        ("deg", PI / 180.0),
        ("Degrees", PI / 180.0),
        ("°", PI / 180.0),
        ("º", PI / 180.0),
        ("Grad", PI / 180.0),
        ("arcmin", PI / 180.0 / 60.0),
        ("arcsec", PI / 180.0 / 3600.0),
        ("gon", PI / 200.0),
        ("turns", TAU),
        ("rev", TAU),
    ] {
        let rows = [0.0625, 0.125, 0.1875].map(|value| [value * radians]);
        let rows: Vec<&[f64]> = rows.iter().map(|row| &row[..]).collect();
        for header in [
            format!("t,a [{unit}]"),
            format!("t,a ({unit})"),
            format!("t,a/{unit}"),
        ] {
            let text = format!("{header}\n0.0,0.0625\n0.1,0.125\n0.2,0.1875\n");
            assert_read(
                &by_columns(&text, &[]).expect(&header),
                &[0.0, 0.1, 0.2],
                &rows,
            );
        }
        let text = format!("t,a\n0.0,0.0625 {unit}\n0.1,0.125{unit}\n0.2,0.1875 {unit}\n");
        assert_read(
            &by_columns(&text, &[]).expect(unit),
            &[0.0, 0.1, 0.2],
            &rows,
        );
    }
    let names = ["theta1_deg", "theta1_mrad", "theta 1 deg"];
    for (name, radians) in names.into_iter().zip([PI / 180.0, 1e-3, PI / 180.0]) {
        let text = format!("t,{name}\n0.0,8\n0.1,16\n0.2,24\n");
        let rows = [8.0 * radians, 16.0 * radians, 24.0 * radians];
        let rows: Vec<&[f64]> = rows.iter().map(std::slice::from_ref).collect();
        assert_read(
            &by_columns(&text, &[]).expect(name),
            &[0.0, 0.1, 0.2],
            &rows,
        );
    }
}

/// Ways of writing numbers that leave no doubt.
#[test]
fn numbers_are_read_as_they_are_written() {
    let (times, rows): ([f64; 3], [&[f64]; 3]) = ([0.0, 0.5, 1.0], [&[0.15], &[-1.25], &[0.0125]]);
    for text in [
        // Fortran's exponents.
        "t,a [rad]\n0.0D+00,1.5D-01\n0.5D+00,-1.25D+00\n1.0D+00,1.25D-02\n",
        "t;a [rad]\n0,0d0;1,5d-1\n0,5d0;-1,25d0\n1,0d0;1,25d-2\n",
        "  t   a_rad\n 0.000D+00  0.150D+00\n 0.500D+00 -0.125D+01\n 0.100D+01  0.125D-01\n",
        // Units in the cells.
        "t,a\n0.0 s,0.15 rad\n0.5 s,-1.25 rad\n1.0 s,0.0125 rad\n",
        "t\ta\n0,0 s\t150 mrad\n0,5 s\t-1250 mrad\n1,0 s\t12,5 mrad\n",
        "t [s],a [rad]\n0.0s,0.15rad\n0.5s,-1.25\n1.0,0.0125 rad\n",
        // Thousands.
        "t [ms],a [mrad]\n0,150\n500,\"-1,250.0\"\n\"1,000.0\",12.5\n",
        "t [ms];a [mrad]\n0,0;150,0\n500,0;-1.250,0\n1.000,0;12,5\n",
        "t [ms];a [mrad]\n0;150\n500;-1\u{202f}250\n1'000;12.5\n",
        "t [µs];a [mrad]\n0;150\n500,000.0;-1,250.0\n1,000,000;12.5\n",
        // Times of the day.
        "time,a [rad]\n12:03:04.0,0.15\n12:03:04.5,-1.25\n12:03:05.0,0.0125\n",
        "time;a [rad]\n23:59:58,5;0,15\n23:59:59,0;-1,25\n23:59:59,5;0,0125\n",
        "time a_rad\n03:59.5 0.15\n04:00.0 -1.25\n04:00.5 0.0125\n",
        // Ends of lines.
        "t [s],a [rad]\r0.0,0.15\r0.5,-1.25\r1.0,0.0125\r",
        "t [s];a [rad]\r\n0,0;0,15\r\n0,5;-1,25\r\n1,0;0,0125\r\n",
        "\u{feff}t a_rad\r0.0 0.15\r0.5 -1.25\r1.0 0.0125",
        // Minus signs of typography, cells that say that they are empty.
        "t,a [rad],b [rad]\n0.0,0.15,#N/A\n0.5,−1.25,n/a\n1.0,0.0125,\n",
    ] {
        let mut read = by_columns(text, &[]).expect(text);
        let start = read.times[0];
        read.times
            .iter_mut()
            .for_each(|time| *time = ((*time - start) * 1e6).round() / 1e6);
        assert_read(&read, &times, &rows);
    }
    let clock = "time,a [rad]\n12:03:04.5,0\n12:03:05,1\n12:03:06,0\n";
    assert_eq!(
        by_columns(clock, &[]).unwrap().times,
        [43384.5, 43385.0, 43386.0]
    );
}

/// A cell that may be one number or another is refused, and named.
#[test]
fn cells_that_are_doubtful_name_their_place() {
    for (text, expected) in [
        (
            "t,a\n\"1,234\",\"2,345\"\n\"1,235\",\"2,346\"\n",
            "line 2, column 1: `1,234` is not a number (decimal commas in a file of decimal points?)",
        ),
        (
            "when,a\n2024-05-01T12:03:04.5,0.8\n2024-05-01T12:03:04.6,0.7\n",
            "line 2, column 1: `2024-05-01T12:03:04.5` is not a number (a date; write the time in seconds)",
        ),
        (
            "t,a,b\n01/05/2024 12:03,0.8,0.7\n01/05/2024 12:04,0.7,0.7\n01/05/2024 12:05,0.7,0.7\n",
            "line 2, column 1 (`t`): `01/05/2024 12:03` is not a number (a date; write the time in seconds)",
        ),
        (
            "t,a,b\n12:03,0.8,0.7\n12:04,0.7,0.7\n12:05,0.7,0.7\n",
            "line 2, column 1 (`t`): `12:03` is not a number (a time of day? write hours:minutes:seconds, or seconds)",
        ),
        (
            "t;a\n0.0;0.8 about\n0.1;0.7 about\n",
            "line 2, column 2: `0.8 about` is not a number",
        ),
        (
            "note\nt;a\n1 000.5;0.5 x\n1 000.6;0.6 x\n",
            "line 3, column 1: `1 000.5` is not a number (are thousands separated?)",
        ),
        (
            "t,a\n0.0 s,45.8°\n0.1 s,0.8 rad\n0.2 s,45.9°\n",
            "line 3, column 2 (`a`): `0.8 rad` has another unit than its column (unit of the column: °)",
        ),
        (
            "t [s],a [deg]\n0.0,45.8\n0.1,0.8 rad\n0.2,45.9\n",
            "line 3, column 2 (`a`): `0.8 rad` has another unit than its column (unit of the column: deg)",
        ),
        (
            "t,a\n0.0,0.8\n0.1,45.8°\n0.2,0.9\n",
            "line 3, column 2 (`a`): `45.8°` has another unit than its column (unit of the column: none)",
        ),
        (
            "t,a,b\n0.0,x1,0.5\n0.1,0.4,0.5\n0.2,0.4,0.6\n",
            "line 2, column 2 (`a`): `x1` is not a number",
        ),
    ] {
        assert_eq!(
            by_columns(text, &[]).unwrap_err(),
            format!("swing.csv, {expected}")
        );
    }
}

/// Files that are no tables are told by what they are, and what to do.
#[test]
fn texts_that_are_no_tables_are_named() {
    for (text, expected) in [
        (
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<object class=\"org.opensourcephysics.cabrillo.tracker.TrackerPanel\">\n<property name=\"x\" type=\"double\">0.5</property>\n",
            "is not a table of numbers but a project of Tracker; open it in Tracker and export the data of its tracks (File, Export)",
        ),
        (
            "\u{feff}<?xml version='1.0'?>\n<rows><row>1 2</row></rows>\n",
            "is not a table of numbers but XML; export the table from the program that wrote it",
        ),
        (
            "<!DOCTYPE html>\n<HTML><body>1, 2</body></HTML>\n",
            "is not a table of numbers but a page of the web; save the table itself as text",
        ),
        (
            "{\"t\": [0.0, 0.1], \"a\": [1, 2]}",
            "is not a table of numbers but JSON; write a line for each time, with commas between its numbers",
        ),
        (
            "[[0.0, 0.1],\n[0.1, 0.2]]\n",
            "is not a table of numbers but JSON; write a line for each time, with commas between its numbers",
        ),
    ] {
        assert_eq!(
            parse(text).unwrap_err().to_string(),
            format!("swing.csv: {expected}")
        );
    }
}
