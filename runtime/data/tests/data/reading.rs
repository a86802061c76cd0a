//! Files as encoders, cameras and spreadsheets leave them.

use std::f64::consts::{PI, TAU};

use branched_pendulum_data::{
    AngleColumns, AngleUnit, AngleZero, Clock, FileKind, Gravity, LinkMarkers, Markers, Recording,
    Sample, Table, TableOptions,
};

use super::{frames, swing, table};

fn reported(recording: &Recording) -> Vec<String> {
    recording.findings.iter().map(ToString::to_string).collect()
}

fn close(found: Option<f64>, expected: f64, tolerance: f64) {
    assert!(
        (found.unwrap() - expected).abs() <= tolerance,
        "{found:?} {expected}"
    );
}

/// Two angles, written in every way that is understood.
#[test]
fn wide_tables_read_without_an_option() {
    let (times, [one, two]) = swing();
    let write = |delimiter: &str, comma: bool, header: &str| {
        let mut text = header.to_owned();
        for ((time, one), two) in times.iter().zip(&one).zip(&two) {
            let row = [time, one, two].map(|value| {
                let digits = format!("{value:.12}");
                if comma {
                    digits.replace('.', ",")
                } else {
                    digits
                }
            });
            text += &row.join(delimiter);
            text += "\r\n";
        }
        text
    };
    let cases = [
        write(",", false, "t,a,b\n"),
        write(
            ", ",
            false,
            "# made by a program, with care\nt [s], a [rad], b [rad]\n",
        ),
        write(";", false, "t;a;b\n"),
        write(";", true, "\u{feff}t;a;b\n"),
        write("\t", true, "t\ta\tb\ns\trad\trad\n"),
        write("\t", false, ""),
        write("  ", false, "# t a b\n"),
        write(" ", true, "t a b\n"),
        write(
            ";",
            true,
            "Versuch 3;;\nvom Dienstag;;\n\nZeit / s;a / rad;b / rad\n",
        ),
    ];
    for text in cases {
        let head = text.lines().take(3).collect::<Vec<_>>().join(" | ");
        let recording = AngleColumns::default().read(&table(&text)).expect(&head);
        assert_eq!(recording.links.len(), 2, "{head}");
        for (index, time) in times.iter().enumerate() {
            assert!((recording.times[index] - time).abs() < 1e-11, "{head}");
            close(recording.links[0].angle(index), one[index], 1e-11);
            close(recording.links[1].angle(index), two[index], 1e-11);
        }
        assert!(recording.timing.gaps.is_empty(), "{head}");
        assert!(recording.timing.jitter < 1e-12, "{head}");
    }
}

#[test]
fn units_come_from_headers() {
    let text = "time (ms),a (deg)\n0,10\n10,11\n20,12\n40,14\n";
    let recording = AngleColumns::default().read(&table(text)).unwrap();
    assert_eq!(recording.times, [0.0, 0.01, 0.02, 0.04]);
    close(recording.links[0].angle(3), 14.0_f64.to_radians(), 1e-15);
    assert_eq!(recording.timing.gaps.len(), 1);
    let reported = reported(&recording);
    assert!(
        reported.contains(&"detected: `time` is the time, in ms".to_owned()),
        "{reported:?}"
    );
    assert!(
        reported.contains(&"detected: angles in degrees".to_owned()),
        "{reported:?}"
    );
    assert!(
        reported.contains(&"detected: no rows between 0.02 s and 0.04 s".to_owned()),
        "{reported:?}"
    );
}

#[test]
fn angles_from_above_and_from_other_links() {
    let (times, [one, two]) = swing();
    let mut text = "t,phi1,phi2\n".to_owned();
    for ((time, one), two) in times.iter().zip(&one).zip(&two) {
        text += &format!("{time},{},{}\n", one + PI, two + PI);
    }
    let recording = AngleColumns::default().read(&table(&text)).unwrap();
    close(recording.links[1].angle(7), two[7], 1e-14);
    assert!(reported(&recording).contains(&"detected: angles from the upward vertical".to_owned()));

    let mut text = "t,first,second\n".to_owned();
    for ((time, one), two) in times.iter().zip(&one).zip(&two) {
        text += &format!(
            "{time},{},{}\n",
            -one.to_degrees(),
            (one - two).to_degrees()
        );
    }
    let columns = AngleColumns {
        unit: Some(AngleUnit::Degrees),
        zero: Some(AngleZero::Down),
        relative_to: vec![None, Some(0)],
        mirrored: true,
        ..AngleColumns::default()
    };
    let recording = columns.read(&table(&text)).unwrap();
    for index in 0..times.len() {
        close(recording.links[0].angle(index), one[index], 1e-14);
        close(recording.links[1].angle(index), two[index], 1e-14);
    }
}

fn two_links() -> Markers {
    let link = |upper: &str, lower: &str| LinkMarkers {
        upper: upper.to_owned(),
        lower: lower.to_owned(),
    };
    Markers {
        clock: Clock::FrameRate(100.0),
        links: vec![link("top", "mid"), link("mid", "end")],
        ..Markers::default()
    }
}

#[test]
fn deep_lab_cut() {
    let (times, [one, two]) = swing();
    let table = table(&frames(|index| if index == 5 { 0.3 } else { 0.99 }));
    assert_eq!(table.kind(), FileKind::DeepLabCut);
    let recording = two_links().read(&table).unwrap();
    for index in (0..times.len()).filter(|index| *index != 5) {
        assert!((recording.times[index] - times[index]).abs() < 1e-12);
        close(recording.links[0].angle(index), one[index], 1e-12);
        close(recording.links[1].angle(index), two[index], 1e-12);
    }
    assert!(matches!(recording.links[0].samples[5], Sample::Unlikely(_)));
    assert!(matches!(recording.links[1].samples[5], Sample::Unlikely(_)));
    let [mean, deviation] = recording.links[0].marker_distance.unwrap();
    assert!((mean - 250.0).abs() < 1e-9 && deviation < 1e-9);

    // Frames are never seconds.
    let markers = Markers {
        clock: Clock::Detect,
        ..two_links()
    };
    let error = markers.read(&table).unwrap_err().to_string();
    assert_eq!(
        error,
        "swing.csv: column `frame` counts frames; give the frame rate (frames are never taken \
         for seconds)"
    );
}

#[test]
fn several_animals_are_several_names() {
    let text = "scorer,n,n,n,n,n,n\nindividuals,a,a,a,b,b,b\nbodyparts,dot,dot,dot,dot,dot,dot\n\
        coords,x,y,likelihood,x,y,likelihood\n0,1,2,1,3,4,1\n1,1,2,1,3,4,1\n2,1,2,1,,,0\n";
    let table = table(text);
    let names: Vec<&str> = table
        .tracks()
        .iter()
        .map(|track| track.name.as_str())
        .collect();
    assert_eq!(names, ["a dot", "b dot"]);
    let markers = Markers {
        clock: Clock::FrameRate(10.0),
        ..Markers::default()
    };
    let recording = markers.read(&table).unwrap();
    assert_eq!(recording.links[0].samples[2], Sample::Missing);
    close(recording.links[0].angle(0), PI / 4.0, 1e-15);
}

#[test]
fn exports_of_tracker() {
    let (times, [one, _]) = swing();
    let mut multi = "#multi:\n\tmass A\t\tmass B\t\t\nt\tx\ty\tx\ty\t\n".to_owned();
    let mut single = "mass_A\nt\tx\ty\n".to_owned();
    for (time, one) in times.iter().zip(&one) {
        let [x, y] = [0.25 * one.sin(), -0.25 * one.cos()];
        multi += &format!("{time:e}\t0.0\t0.0\t{x:e}\t{y:e}\t\n");
        single += &format!("{time:e}\t{x:e}\t{y:e}\n");
    }
    let table = table(&multi);
    assert_eq!(table.kind(), FileKind::Tracker);
    let recording = Markers::default().read(&table).unwrap();
    assert_eq!(recording.links[0].name, "mass A to mass B");
    for (index, one) in one.iter().enumerate() {
        close(recording.links[0].angle(index), *one, 1e-14);
    }
    let single = self::table(&single);
    assert_eq!(
        (single.kind(), single.tracks()[0].name.as_str()),
        (FileKind::Tracker, "mass A")
    );
}

/// Gravity along a plumb line, along the mean of a link, and against the axis.
#[test]
fn gravity_in_a_tilted_picture() {
    let tilt = 0.02_f64;
    let (times, [one, _]) = swing();
    let mut text = "t,a x,a y,b x,b y\n".to_owned();
    for (time, one) in times.iter().zip(&one) {
        let angle = one + tilt;
        text += &format!("{time},0,0,{},{}\n", angle.sin(), -angle.cos());
    }
    let table = table(&text);
    let line = [tilt.sin(), -tilt.cos()];
    let plumb = Markers {
        gravity: Gravity::Along(line),
        ..Markers::default()
    };
    let level = Markers::default();
    let turned = Markers {
        mirrored: true,
        ..plumb.clone()
    };
    close(plumb.read(&table).unwrap().links[0].angle(3), one[3], 1e-14);
    close(
        level.read(&table).unwrap().links[0].angle(3),
        one[3] + tilt,
        1e-14,
    );
    close(
        turned.read(&table).unwrap().links[0].angle(3),
        -one[3],
        1e-14,
    );
    let mean = Markers {
        gravity: Gravity::FirstLink,
        ..Markers::default()
    };
    let recording = mean.read(&table).unwrap();
    let mean = (0..times.len())
        .map(|i| recording.links[0].angle(i).unwrap().sin())
        .sum::<f64>();
    assert!(mean.abs() < 1e-9, "{mean}");
}

/// A link that turns over, its angles between −π and π, with a gap and three bad frames.
#[test]
fn turns_and_outliers() {
    let angle = |time: f64| 2.0 * time + 1.3 * (3.0 * time).sin();
    let mut text = "t,a\n".to_owned();
    let mut noise = 0.3_f64;
    for index in (0..600).filter(|index| !(100..104).contains(index)) {
        let time = 0.01 * f64::from(index);
        // A logistic map, as a noise of 1 mrad.
        noise = 3.99 * noise * (1.0 - noise);
        let bad = match index {
            250 => 0.05,
            400 => -0.3,
            402 => 0.2,
            _ => 0.002 * (noise - 0.5),
        };
        let value = angle(time) + bad;
        text += &format!("{time},{}\n", value - TAU * (value / TAU).round());
    }
    let recording = AngleColumns {
        zero: Some(AngleZero::Down),
        ..AngleColumns::default()
    };
    let recording = recording.read(&table(&text)).unwrap();
    let link = &recording.links[0];
    let mut outliers = Vec::new();
    for (index, time) in recording.times.iter().enumerate() {
        match link.samples[index] {
            Sample::Outlier(_) => outliers.push((time * 100.0).round()),
            _ => close(link.angle(index), angle(*time), 0.0011),
        }
    }
    assert_eq!(outliers, [250.0, 400.0, 402.0]);
    let reported = reported(&recording);
    assert!(
        reported
            .iter()
            .any(|text| text.contains("jumps of a turn were taken out")),
        "{reported:?}"
    );
    assert!(
        reported.iter().any(|text| text.contains("`a`: 3 outliers")),
        "{reported:?}"
    );
}

/// Noise of a normal kind and fast smooth motion are no outliers.
#[test]
fn smooth_motion_has_no_outliers() {
    for (rate, period) in [(60.0, 0.25), (240.0, 0.25), (1000.0, 2.0)] {
        let mut text = "t,a\n".to_owned();
        for index in 0..1000 {
            let time = f64::from(index) / rate;
            // A collision-like motion: fast once in a period.
            let phase = (TAU * time / period).sin();
            text += &format!("{time},{}\n", (4.0 * phase).tanh());
        }
        let recording = AngleColumns::default().read(&table(&text)).unwrap();
        let used = (0..1000).filter(|&index| recording.links[0].angle(index).is_some());
        assert_eq!(used.count(), 1000, "{rate} Hz");
    }
}

/// The measured double pendulum, as its file is: angles from above in radians.
#[test]
fn the_measured_double_pendulum() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../measure/tests/measure/identification/double-pendulum.csv"
    );
    let table = Table::read(path, &TableOptions::default()).unwrap();
    let recording = AngleColumns::default().read(&table).unwrap();
    assert_eq!(recording.links.len(), 2);
    assert!((recording.timing.interval - 0.01).abs() < 1e-12);
    close(recording.links[0].angle(0), 2.615775 - PI, 1e-15);
    let reported = reported(&recording);
    assert!(
        reported.contains(&"detected: angles from the upward vertical".to_owned()),
        "{reported:?}"
    );
    let samples = recording.links.iter().flat_map(|link| &link.samples);
    let marked = samples
        .filter(|sample| !matches!(sample, Sample::Measured(_)))
        .count();
    assert_eq!(marked, 0, "{reported:?}");
}
