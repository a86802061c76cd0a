//! The program `branched-double`: its command line, its text and its files. The physics is tested in
//! `experiment.rs`.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use branched_pendulum_examples::branched_double::Arguments;
use branched_pendulum_examples::branched_double::findings::{PEAK_REACH, SMALL_ANGLE};
use branched_pendulum_frame::command_line::{parse, parse_line};

use super::{folder, text};

fn read(line: &str) -> Arguments {
    parse_line(line).unwrap()
}

#[test]
fn every_option_is_read() {
    let arguments = read(
        "--angles 50,-30.5 --disturbance=-1e-3 --duration 5 --friction-root 1e-4 \
         --friction-children 3e-5 --animate",
    );
    assert_eq!(arguments.angles_deg, [-30.5, 50.0]);
    assert_eq!(arguments.disturbance, -1e-3);
    assert_eq!(arguments.duration, 5.0);
    assert_eq!(arguments.friction_root, 1e-4);
    assert_eq!(arguments.friction_children, 3e-5);
    assert!(arguments.animate);
    assert_eq!(arguments.times().len(), 501);
    let range = read("--angles 40:40.3:0.1,39.5");
    assert_eq!(range.angles_deg, [39.5, 40.0, 40.1, 40.2, 40.3]);
    assert_eq!(read("--angles -3:-2:1").angles_deg, [-3.0, -2.0]);
}

#[test]
fn options_that_are_not_given_have_their_defaults() {
    assert_eq!(read(""), Arguments::default());
    let folder = |words: &[&str]| {
        let words = ["branched-double"].iter().chain(words).map(Into::into);
        parse::<Arguments>(words).unwrap().output
    };
    assert_eq!(folder(&[]), Some("branched-double-output".into()));
    assert_eq!(folder(&["--output", "elsewhere"]), Some("elsewhere".into()));
}

#[test]
fn the_last_sample_is_not_lost_to_rounding() {
    for tenths in 10..1000_u32 {
        let arguments = Arguments {
            duration: f64::from(tenths) / 10.0,
            ..Arguments::default()
        };
        assert_eq!(arguments.times().len(), 10 * tenths as usize + 1);
    }
}

#[test]
fn mistakes_are_named() {
    for (line, message) in [
        ("--Angels 3", "unexpected argument '--Angels' found"),
        ("--angels 3", "a similar argument exists: '--angles'"),
        ("surprise", "unexpected argument 'surprise' found"),
        ("--duration", "a value is required for '--duration <S>'"),
        (
            "--duration --disturbance 3",
            "a value is required for '--duration <S>'",
        ),
        ("--output=", "a value is required for '--output <FOLDER>'"),
        (
            "--duration 50 --duration 50",
            "cannot be used multiple times",
        ),
        ("--angles 3,4,3", "3 degrees stand there twice"),
        ("--angles 3,,4", "`` is not a number; a range is written"),
        (
            "--angles 40-47",
            "`40-47` is not a number; a range is written",
        ),
        ("--angles 40:48", "write `FROM:TO:STEP`, as in `40:48:0.1`"),
        ("--angles 40:48:-1", "with at most 10000 steps"),
        (
            "--duration soon",
            "not a number; it must be from 1 to 10000 s",
        ),
        (
            "--duration inf",
            "not a number; it must be from 1 to 10000 s",
        ),
        ("--duration 1e5", "must be from 1 to 10000 s"),
        ("--angles 200", "200 must be from -180 to 180 degrees"),
        ("--friction-children=-1e-5", "must be from 0 to 1 N m s"),
    ] {
        let error = parse_line::<Arguments>(line).unwrap_err();
        assert!(error.contains(message), "{line}: {error}");
        assert!(error.contains("'--help'"), "{line}: {error}");
    }
}

#[test]
fn friction_is_written_as_one_writes_it_or_refused() {
    let arguments = read("--friction-children 3.5e-5");
    let conditions = "θ_d(0) = 0.01 rad, friction 0 (root), 3.5e-5 (children) N·m·s";
    assert_eq!(arguments.conditions(), conditions);
    assert_eq!(read("").conditions(), "θ_d(0) = 0.01 rad, no friction");
    let impossible = Arguments {
        friction_children: -1e-5,
        ..arguments
    };
    let error = impossible.model().unwrap_err();
    let cause = std::error::Error::source(&error).unwrap().to_string();
    assert!(
        cause.contains("child") && cause.contains("-0.00001"),
        "{cause}"
    );
}

fn program(arguments: &[&str]) -> Output {
    super::run(env!("CARGO_BIN_EXE_branched-double"), arguments)
}

#[test]
fn the_program_prints_the_table_and_writes_what_it_says() {
    let folder = folder("branched-double");
    let output = program(&[
        "--angles",
        "47.8,39.5",
        "--duration",
        "1",
        "--friction-root=1e-3",
        "--animate",
        "--output",
        folder.to_str().unwrap(),
    ]);
    assert!(output.status.success());
    assert_eq!(text(&output.stderr), "", "quiet where there is no terminal");
    let stdout = text(&output.stdout);
    for part in [
        "0.8731696   0.88",
        "θ_1(0)",
        "\n    39.5 ",
        "\n    47.8 ",
        &format!("within {PEAK_REACH} s on either side"),
        &format!("until |θ_d| exceeds {SMALL_ANGLE} rad"),
    ] {
        assert!(stdout.contains(part), "{part}\n{stdout}");
    }

    let listed = stdout.split("Files written:\n").nth(1).unwrap();
    let listed: Vec<PathBuf> = listed.lines().map(|l| PathBuf::from(l.trim())).collect();
    let mut present: Vec<PathBuf> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    let mut sorted = listed.clone();
    sorted.sort();
    present.sort();
    assert_eq!(sorted, present);
    let mut kinds = [0; 4];
    for file in &listed {
        let bytes = fs::read(file).unwrap();
        match file.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => {
                kinds[0] += 1;
                check_csv(text(&bytes));
            }
            Some("json") => assert!(text(&bytes).contains("\"ended\": \"finished\"")),
            Some("svg") => {
                kinds[1] += 1;
                assert!(text(&bytes).contains("</svg>"));
            }
            Some("pdf") => {
                kinds[2] += 1;
                assert!(bytes.starts_with(b"%PDF-"));
            }
            _ => {
                kinds[3] += 1;
                assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"));
            }
        }
    }
    // A film has no page.
    assert_eq!(kinds, [2, 5, 4, 5]);
}

fn check_csv(text: &str) {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert!(header.iter().all(|name| name.ends_with(']')));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 101);
    assert!(rows.iter().all(|row| row.len() == header.len()));
    assert!(rows.iter().flatten().all(|value| value.is_finite()));
    let column = |name: &str| {
        let starts = |own: &&str| own.split_once(" [").is_some_and(|(own, _)| own == name);
        header.iter().position(starts).unwrap()
    };
    for (index, row) in rows.iter().enumerate() {
        let value = |name: &str| row[column(name)];
        assert_eq!(value("time"), index as f64 / 100.0);
        for angle in ["theta", "omega"] {
            let link = |link| value(&format!("{angle}_{link}"));
            assert_eq!(link("2"), link("m") + link("d"));
            assert_eq!(link("3"), link("m") - link("d"));
        }
        for form in ["angle_1", "amplitude_2", "exact"] {
            let part = |part| value(&format!("{part}_{form}"));
            assert_eq!(part("W"), part("W_K") + part("W_P"));
        }
        assert!(value("H_d") > 0.0 && value("H") > value("H_d"));
    }
}

/// A scan also has bands, a table and a chart of growth; its charts over time show few of its angles.
#[test]
fn a_scan_reports_its_bands() {
    let folder = folder("branched-double-scan");
    let path = folder.to_str().unwrap();
    let output = program(&["--angles", "1:9:1", "--duration", "1", "--output", path]);
    assert!(output.status.success());
    let stdout = text(&output.stdout);
    assert!(stdout.contains("\n  less than 10-fold   from 1°\n"));
    let growth = fs::read_to_string(folder.join("growth.csv")).unwrap();
    assert_eq!(growth.lines().count(), 10);
    assert!(folder.join("growth.png").exists());
    let chart = fs::read_to_string(folder.join("antiphase-angle.svg")).unwrap();
    assert!(chart.contains("(5 of 9 angles)"));
}

/// A pendulum that stays at rest has a report, in which dashes replace the findings.
#[test]
fn a_pendulum_at_rest_has_a_report() {
    let folder = folder("branched-double-rest");
    let path = folder.to_str().unwrap();
    let line = [
        "--angles=0",
        "--disturbance=0",
        "--duration=1",
        "--output",
        path,
    ];
    let output = program(&line);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let stdout = text(&output.stdout);
    assert!(
        stdout.contains("\n     0.0       —         —     —        —           —           —\n")
    );
    assert!(!stdout.contains("not determined"), "{stdout}");
}

#[test]
fn the_help_names_every_option_with_its_default() {
    let output = program(&["--help"]);
    assert!(output.status.success());
    let help = text(&output.stdout);
    for option in [
        "--angles",
        "--disturbance",
        "--duration",
        "--friction-root",
        "--friction-children",
        "--animate",
        "--output",
        "--repeat",
        "--figure-width",
        "--show",
        "--help",
        "--version",
    ] {
        assert!(help.contains(option), "{option}");
    }
    for default in ["39.5,45,46.4", "0.01", "32", "0]"] {
        assert!(help.contains(&format!("[default: {default}")), "{default}");
    }
    let wide = help.lines().find(|line| line.chars().count() > 80);
    assert_eq!(wide, None, "fits a terminal of 80 columns");
}

#[test]
fn a_wrong_command_line_is_explained() {
    let output = program(&["--frictoin-children", "1e-5"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let stderr = text(&output.stderr);
    assert!(stderr.contains("unexpected argument '--frictoin-children' found"));
    assert!(stderr.contains("a similar argument exists: '--friction-children'"));
}

#[test]
fn an_output_folder_that_cannot_be_made_is_explained() {
    let folder = folder("not-a-folder");
    fs::write(&folder, "a file").unwrap();
    let output = program(&["--output", folder.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let stderr = text(&output.stderr);
    assert!(stderr.starts_with("branched-double: cannot create the output folder"));
    assert!(stderr.contains("not-a-folder: "), "{stderr}");
    fs::remove_file(&folder).unwrap();
}
