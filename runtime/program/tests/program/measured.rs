//! Files of measurements as `analyse` and `identify` take them: options, refusals, and where
//! both lead.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use super::{Folder, folder, run, text};

/// Angles of a chain of two links in a small swing, at 40 times.
fn swing() -> Vec<(f64, [f64; 2])> {
    let times = (0..40).map(|row| 0.02 * f64::from(row));
    let angles = |time: f64| [0.3, 0.21].map(|size| size * (6.0 * time + size).cos());
    times.map(|time| (time, angles(time))).collect()
}

/// Ends of two links of 0.25 and 0.2 m under a place.
fn ends([x, y]: [f64; 2], [one, two]: [f64; 2]) -> [f64; 4] {
    let a = [x + 0.25 * one.sin(), y - 0.25 * one.cos()];
    [a[0], a[1], a[0] + 0.2 * two.sin(), a[1] - 0.2 * two.cos()]
}

/// Writes a file whose rows are those of the swing.
fn file(name: &str, header: &str, row: impl Fn(f64, [f64; 2]) -> String) -> PathBuf {
    let folder = folder(&format!("measured-{name}"));
    fs::create_dir_all(&folder).unwrap();
    let mut written = format!("{header}\n");
    for (time, angles) in swing() {
        writeln!(written, "{}", row(time, angles)).unwrap();
    }
    let path = folder.join("swing.csv");
    fs::write(&path, written).unwrap();
    path
}

/// Runs `analyse` on a chain; its exit code and what it prints.
fn analyse(file: &std::path::Path, options: &[&str]) -> (Option<i32>, String) {
    let output = file.with_file_name("output");
    let mut words = vec!["analyse", file.to_str().unwrap()];
    words.extend(["--tree", "double-pendulum", "--draws", "20"]);
    words.extend(["--output", output.to_str().unwrap()]);
    words.extend(options);
    let done = run(&words);
    let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
    (done.status.code(), printed)
}

/// Asserts that the estimate of a run begins with the angles of the swing.
fn assert_estimated(file: &std::path::Path) {
    let estimate = fs::read_to_string(file.with_file_name("output").join("estimate.csv")).unwrap();
    let row = estimate.lines().nth(10).unwrap();
    let values: Vec<f64> = row
        .split(',')
        .take(3)
        .map(|cell| cell.parse().unwrap())
        .collect();
    let (time, angles) = swing()[9];
    assert!((values[0] - time).abs() < 1e-9, "{row}");
    for (found, expected) in values[1..].iter().zip(angles) {
        assert!((found - expected).abs() < 1e-3, "{row}: {expected}");
    }
}

#[test]
fn named_columns_win_over_points() {
    let points = file(
        "columns",
        "t,theta1,theta2,wall_x,wall_y,door_x,door_y,note",
        |time, [one, two]| {
            format!(
                "{time},{one},{two},0.1,0.2,0.3,{},Infinity",
                0.4 + 0.01 * one
            )
        },
    );
    let (code, printed) = analyse(&points, &["--columns", "theta1,theta2"]);
    assert_eq!(code, Some(0), "{printed}");
    // The verdict comes first, and of the findings the doubt.
    assert!(printed.starts_with("The energy budget "), "{printed}");
    let findings = printed
        .lines()
        .skip_while(|line| !line.ends_with(": 40 times"));
    let mut doubts = findings
        .skip(1)
        .take_while(|line| line.contains("doubtful: "));
    let unit = "doubtful: angles in radians, since no column names a unit";
    assert!(doubts.any(|line| line.contains(unit)), "{printed}");
    assert_estimated(&points);
    let (code, printed) = analyse(&points, &[]);
    assert_eq!(code, Some(1), "{printed}");
    assert!(
        printed.contains("there are columns of angles (`theta1`, `theta2`) and points"),
        "{printed}"
    );
}

#[test]
fn a_pivot_without_a_dot_is_named() {
    for (name, header, pivot, options) in [
        (
            "origin",
            "#multi:\n,mass A,,mass B,\nt,x,y,x,y",
            [0.0, 0.0],
            &["--pivot", "origin"][..],
        ),
        (
            "place",
            "t,x1,y1,x2,y2",
            [-1.5, 0.5],
            &["--pivot", "-1.5,0.5"],
        ),
        (
            "dots",
            "t;x_m1;y_m1;x_m2;y_m2",
            [0.25, 2.0],
            &["--dots", "0.25,2:m1,m1:m2"],
        ),
    ] {
        let file = file(name, header, |time, angles| {
            let row = [time].into_iter().chain(ends(pivot, angles));
            let row: Vec<String> = row.map(|value| value.to_string()).collect();
            row.join(if header.contains(';') { ";" } else { "," })
        });
        let (code, printed) = analyse(&file, options);
        assert_eq!(code, Some(0), "{printed}");
        assert_estimated(&file);
        let (code, printed) = analyse(&file, &[]);
        assert_eq!(code, Some(1), "{printed}");
        assert!(printed.contains("--pivot"), "{printed}");
    }
}

#[test]
fn times_are_named_and_repeated_ones_dropped() {
    let clock = file("time", "clock,a [mrad],b [mrad]", |time, [one, two]| {
        let row = format!("{time},{},{}", 1e3 * one, 1e3 * two);
        // The first row stands there twice, the second time without its angles.
        if time == 0.0 {
            format!("{row}\n{time},,")
        } else {
            row
        }
    });
    let (code, printed) = analyse(&clock, &[]);
    assert_eq!(code, Some(1), "{printed}");
    assert!(
        printed.contains("found no column of times; name"),
        "{printed}"
    );
    let (code, printed) = analyse(&clock, &["--time", "clock"]);
    assert_eq!(code, Some(1), "{printed}");
    assert!(
        printed.contains("line 3, column 1 (`clock`): time 0 s does not come after 0 s"),
        "{printed}"
    );
    for counts in [&["--drop-repeated"][..], &["--drop-repeated", "first"]] {
        let options = [&["--time", "clock"], counts].concat();
        let (code, printed) = analyse(&clock, &options);
        assert_eq!(code, Some(0), "{printed}");
        assert!(
            printed.contains("given: 1 row dropped that repeat"),
            "{printed}"
        );
        assert_estimated(&clock);
    }
}

/// Both read alike: what one refuses the other does, in the same words.
#[test]
fn both_refuse_alike() {
    let of_points = file("positions", "t,x,y", |time, [one, _]| {
        format!("{time},{},{}", 0.25 * one.sin(), -0.25 * one.cos())
    });
    let of_rates = file(
        "rates",
        "t,pos1,pos2,vel1,vel2,tau1,tau2",
        |time, [one, two]| format!("{time},{one},{two},{two},{one},{two},{one}"),
    );
    let of_degrees = file("degrees", "t,a,b", |time, [one, two]| {
        format!("{time},{:.3},{:.3}", one.to_degrees(), two.to_degrees())
    });
    for (file, options, expected) in [
        (&of_points, &[][..], "1 track; a link needs two"),
        (
            &of_rates,
            &[],
            "the name of column `vel1` suggests a velocity",
        ),
        (&of_degrees, &[], "may be degrees or radians; give the unit"),
        (
            &of_degrees,
            &["--columns", "a,a", "--unit", "deg"],
            "column `a` is named twice",
        ),
        (
            &of_degrees,
            &["--columns", "a,t", "--unit", "deg"],
            "column `t` is the time",
        ),
        (&of_rates, &["--y-down"], "0 tracks; a link needs two"),
        (
            &of_rates,
            &["--columns", "pos1"],
            "angles of 1 links, but the pendulum has 2",
        ),
    ] {
        for command in ["analyse", "identify"] {
            let output = file.with_file_name("refused");
            let mut words = vec![command, file.to_str().unwrap()];
            words.extend(["--tree", "double-pendulum"]);
            words.extend(["--output", output.to_str().unwrap()]);
            words.extend(options);
            let done = run(&words);
            let error = text(&done.stderr);
            assert_eq!(done.status.code(), Some(1), "{options:?}: {error}");
            assert!(error.contains(expected), "{options:?}: {error}");
        }
    }
    for (line, expected) in [
        (
            "a.csv --columns a --dots a:b",
            "angles come from one of them",
        ),
        ("a.csv --time t --frame-rate 60", "cannot be used with"),
        ("a.csv --pivot 1", "X,Y, or `origin`"),
        (
            "--columns a,b",
            "--columns applies to a file of measurements",
        ),
        ("--tilt 1", "--tilt applies to a file"),
        ("--leave-out 1:2", "--leave-out applies to a file"),
        ("--y-up", "--y-up applies to a file"),
        ("--unit deg", "name the file, or leave out --unit"),
        ("a.csv --start 10", "--start applies to a simulated record"),
        ("a.csv --noise 1e-3", "leave out one of the two"),
        (
            "a.csv --duration 10 --columns a,b",
            "--duration applies to a simulated record",
        ),
        (
            "a.csv --method rk4",
            "--method applies to a simulated record",
        ),
    ] {
        for command in ["analyse", "identify"] {
            let words = std::iter::once(command).chain(line.split_whitespace());
            let done = run(&words.collect::<Vec<&str>>());
            let error = text(&done.stderr);
            assert_eq!(done.status.code(), Some(2), "{line}: {error}");
            assert!(error.contains(expected), "{line}: {error}");
        }
    }
}

/// A chain of three rods that nobody compiled, before a simulated camera: its energy budget
/// closes with the right constants, and with others the cause is told.
#[test]
fn a_tree_in_a_text_is_analysed() {
    let folder = folder("measured-triple");
    fs::create_dir_all(&folder).unwrap();
    let tree = folder.join("triple.txt");
    let rods = "gravity = 9.81,
        upper: rod(mass = 0.3, length = 0.3, friction = friction) [
            middle: rod(mass = 0.2, length = 0.25) [lower: rod(mass = 0.1, length = 0.2)]
        ]";
    fs::write(&tree, rods).unwrap();
    let analyse = |options: &str| {
        let output = folder.join("output");
        let mut words = vec!["analyse", "--tree", tree.to_str().unwrap(), "--draws", "20"];
        words.extend(["--duration", "2", "--output", output.to_str().unwrap()]);
        words.extend(options.split_whitespace());
        let done = run(&words);
        let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
        (done.status.code(), printed)
    };
    let (code, printed) = analyse("--set friction=2e-3");
    assert_eq!(code, Some(0), "{printed}");
    assert!(
        printed.starts_with("The energy budget closes: ∫ dH/dt dt is the change of H"),
        "{printed}"
    );
    let estimate = fs::read_to_string(folder.join("output").join("estimate.csv")).unwrap();
    assert!(
        estimate.starts_with("time [s],theta_upper [rad],theta_middle [rad],theta_lower [rad]"),
        "{estimate:.99}"
    );
    let lines = printed.lines();
    let error = lines.filter_map(|line| line.strip_prefix("  true error of P "));
    let error: Vec<f64> = error
        .filter_map(|line| line.split(' ').next()?.parse().ok())
        .collect();
    assert!(error.len() == 1 && error[0] < 5.0, "{printed}");
    // The friction that the equations lack is found with the motion.
    let (code, printed) = analyse("--set friction=0 --real friction=2e-3 --model");
    assert_eq!(code, Some(0), "{printed}");
    assert!(
        printed.contains("the equations lack friction of ")
            && printed.contains(" N m s in the pivot of `upper`"),
        "{printed}"
    );
}

#[test]
fn sectors_are_told_by_name_and_what_is_not_there_is_refused() {
    let folder = folder("measured-sectors");
    let analyse = |options: &str| {
        let mut words = vec!["analyse", "--duration", "1", "--draws", "20"];
        words.extend(["--output", folder.to_str().unwrap()]);
        words.extend(options.split_whitespace());
        let done = run(&words);
        let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
        (done.status.code(), printed)
    };
    for (options, energy) in [
        ("", "H_d"),
        ("--sector d", "H_d"),
        ("--sector in_phase", "H_in_phase"),
        ("--sector whole", "H"),
    ] {
        let (code, printed) = analyse(&format!("--rate 120 {options}"));
        assert_eq!(code, Some(0), "{printed}");
        assert!(
            printed.starts_with(&format!("The energy budget closes: ∫ d{energy}/dt dt")),
            "{printed}"
        );
    }
    for (options, message) in [
        (
            "--sector child",
            "`paper` has no sector `child`: `--sector` is in_phase, d or whole",
        ),
        ("--set length=1", "no parameter `length`"),
        ("--real length=1", "no parameter `length`"),
        ("--start 1,2", "2 numbers for 3 links"),
    ] {
        let (code, printed) = analyse(options);
        assert_eq!(code, Some(1), "{printed}");
        assert!(printed.contains(message), "{options}: {printed}");
    }
}

/// The budget of eight links closes, by smoothness and by the equations of motion.
#[test]
fn a_record_of_eight_links_is_analysed() {
    let folder = Folder::new("analyse-eight");
    let text = "gravity = 9.81, trunk: rod(mass = 0.3, length = 0.3) [
            arm: rod(mass = 0.1, length = 0.25) [hand: rod(mass = 0.05, length = 0.2)] * 3,
            stone: rod(mass = 0.2, length = 0.1)
        ]";
    let tree = folder.file("eight.txt", text);
    let analyse = ["analyse", "--tree", &tree, "--start", "trunk=20"];
    let usual = ["--noise", "1e-4", "--draws", "20"];
    // Equations need fewer pictures, and take longer for each.
    let smoothness = &["--rate", "500", "--duration", "2"][..];
    let equations = &["--rate", "120", "--duration", "1", "--model"];
    for way in [smoothness, equations] {
        let printed = folder.answer(&[&analyse[..], &usual, way].concat());
        assert!(
            printed.starts_with("The energy budget closes: "),
            "{way:?} {printed}"
        );
    }
    let header = folder.read("results/estimate.csv");
    let header = header.lines().next().unwrap();
    assert_eq!(header.split(',').count(), 1 + 8 + 2 * (8 + 4), "{header}");
}
