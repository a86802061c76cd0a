//! The program `branched-double` and the physics that it reports.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use branched_pendulum_examples::branched_double::apparatus::{EXACT, PUBLISHED};
use branched_pendulum_examples::branched_double::scenes::BranchedDouble;
use branched_pendulum_examples::branched_double::{
    Arguments, Findings, Frequencies, Friction, Precision, Run,
};

use super::{folder, text};

fn run(angle_deg: f64, duration: f64, arguments: Arguments) -> Run {
    let arguments = Arguments {
        duration,
        ..arguments
    };
    Run::new(angle_deg, &arguments, |_| ()).unwrap()
}

#[test]
fn eigenfrequencies_to_seven_digits() {
    let Frequencies {
        plus,
        minus,
        antiphase,
    } = Frequencies::of(&BranchedDouble::new()).unwrap();
    assert_eq!(format!("{plus:.7}"), "0.8731696");
    assert_eq!(format!("{minus:.7}"), "1.5825567");
    assert_eq!(format!("{antiphase:.7}"), "1.2580584");
}

/// Growth comes in bands of angles, with a gap about 45°.
#[test]
fn the_antiphase_mode_grows_in_bands() {
    let growth = |angle_deg| {
        let run = run(angle_deg, 10.0, Arguments::default());
        Findings::new(&run).growth.unwrap()
    };
    for (angle, low, high) in [
        (39.5, 1.0, 1.5),
        (42.5, 1.0, 10.0),
        (44.0, 10.0, f64::INFINITY),
        (45.0, 1.0, 10.0),
        (45.5, 1.0, 10.0),
        (47.8, 50.0, f64::INFINITY),
    ] {
        let growth = growth(angle);
        assert!(growth > low && growth < high, "{angle}: {growth}");
    }
}

#[test]
fn while_small_the_growth_does_not_depend_on_the_disturbance() {
    let growth = |disturbance| {
        let arguments = Arguments {
            disturbance,
            ..Arguments::default()
        };
        Findings::new(&run(45.0, 6.0, arguments)).growth.unwrap()
    };
    let (small, tiny) = (growth(1e-4), growth(1e-12));
    assert!(small > 5.0);
    assert!((small / tiny - 1.0).abs() < 1e-5, "{small} {tiny}");
}

#[test]
fn the_exact_transfer_explains_every_change_of_the_antiphase_energy() {
    for friction in [
        Friction::default(),
        Friction {
            root: 1e-4,
            children: 3.5e-5,
        },
    ] {
        let arguments = Arguments {
            friction,
            ..Arguments::default()
        };
        let run = run(48.6, 6.0, arguments);
        let energies = run.samples.iter().map(|sample| sample.antiphase_energy);
        let largest = energies.fold(0.0, f64::max);
        assert!(largest > 1e-3);
        let initial = run.samples[0].antiphase_energy;
        let (mut transferred, mut lost) = (0.0, 0.0);
        for (sample, flow) in run.samples[1..].iter().zip(&run.intervals) {
            transferred += flow.transfer[EXACT].total();
            lost += flow.antiphase_friction;
            let expected = initial + transferred + lost;
            assert!((sample.antiphase_energy - expected).abs() < 1e-9 * largest);
        }
        assert_eq!(lost < -0.1 * transferred.abs(), !friction.is_zero());
        let findings = Findings::new(&run);
        assert!(findings.energy_error.unwrap() < 1e-11);
        assert!(findings.deviations[EXACT].unwrap() < 1e-9);
    }
}

#[test]
fn the_complete_quadratic_form_holds_for_small_angles_and_the_published_does_not() {
    let [published, quadratic, exact] =
        Findings::new(&run(39.5, 5.0, Arguments::default())).deviations;
    assert!(published.unwrap() > 0.5);
    assert!(quadratic.unwrap() < 1e-3);
    assert!(exact.unwrap() < 1e-3 * quadratic.unwrap());
}

#[test]
fn friction_in_the_childrens_joints_brings_onset_and_peak_near_the_papers() {
    let arguments = Arguments {
        friction: Friction {
            root: 0.0,
            children: 3.5e-5,
        },
        ..Arguments::default()
    };
    let peak = |angle_deg| {
        let findings = Findings::new(&run(angle_deg, 6.5, arguments.clone()));
        findings.peak.unwrap()
    };
    let (below, above) = (peak(47.6), peak(47.8));
    assert!(above.energy > 4.0 * below.energy);
    // The paper: at 3.8 s, θ_m beyond 2 rad, W_P dominant but not overwhelming.
    assert!((above.time - 3.8).abs() < 0.2, "{}", above.time);
    assert!(above.largest_mean > 2.0);
    let (kinetic, potential) = above.shares(PUBLISHED).unwrap();
    assert!(potential > 0.75 && kinetic > 0.05);
}

#[test]
fn single_precision_follows_double_precision_for_a_while() {
    let single = Arguments {
        precision: Precision::Single,
        tolerance: 1e-5,
        ..Arguments::default()
    };
    let (single, double) = (run(39.5, 2.0, single), run(39.5, 2.0, Arguments::default()));
    let difference = |i: usize| {
        let (a, b) = (&single.samples[i], &double.samples[i]);
        (0..3).fold(0.0_f64, |most, k| most.max((a.theta[k] - b.theta[k]).abs()))
    };
    let largest = (0..single.samples.len())
        .map(difference)
        .fold(0.0, f64::max);
    assert!(largest > 1e-9 && largest < 1e-3, "{largest}");
    assert!(single.work.evaluations < double.work.evaluations);
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
        "2",
        "--rate=50",
        "--animate",
        "--output",
        folder.to_str().unwrap(),
    ]);
    assert!(output.status.success());
    assert_eq!(text(&output.stderr), "", "quiet where there is no terminal");
    let stdout = text(&output.stdout);
    for part in ["0.8731696   0.88", "θ_1(0)", "\n    39.5 ", "\n    47.8 "] {
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
    assert!(header[0] == "time [s]" && header.contains(&"theta_d [rad]"));
    assert!(header.iter().all(|name| name.ends_with(']')));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 101);
    assert!(rows.iter().all(|row| row.len() == header.len()));
    assert!(rows.iter().flatten().all(|value| value.is_finite()));
    assert_eq!(rows[100][0], 2.0);
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
        "--rate",
        "--precision",
        "--tolerance",
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
    for default in ["39.5,45,46.4", "0.01", "32", "100", "f64", "1e-12"] {
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
