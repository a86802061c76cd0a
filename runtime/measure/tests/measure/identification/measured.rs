//! A real double pendulum, whose encoders' angles are MIT-licensed (`LICENSE-data`).

use branched_pendulum_measure::identification::{AngleRecord, Fit, Identification, Shooting};

use super::chain::{LAWS, Rubbing, Uniform, all_unknown};

/// 80 s, every 10 ms, angles from the downward vertical.
fn record() -> AngleRecord {
    let lines = include_str!("double-pendulum.csv").lines().skip(1);
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    let column = |index: usize| rows.iter().map(move |row| row[index]);
    let angles = |index: usize| -> Vec<Option<f64>> {
        column(index)
            .map(|angle| Some(angle - std::f64::consts::PI))
            .collect()
    };
    let times: Vec<f64> = column(0).collect();
    AngleRecord::new(&times)
        .with_link("upper", &angles(1), 1e-3)
        .with_link("lower", &angles(2), 1e-3)
}

fn viscous(start: impl FnMut(f64) -> f64) -> Identification<Rubbing> {
    let task = all_unknown(Rubbing, start).with_offsets();
    LAWS.iter().fold(task, |task, law| task.known(law, 0.0))
}

fn all_laws(start: impl FnMut(f64) -> f64) -> Identification<Rubbing> {
    let task = all_unknown(Rubbing, start).with_offsets();
    LAWS.iter()
        .fold(task, |task, law| task.unknown_from_zero(law, 1e-4))
}

/// Segments of 1 s and no longer.
fn in_windows() -> Shooting {
    Shooting {
        longest: 1.0,
        ..Shooting::default()
    }
}

/// A start 30 % off, now above and now below.
fn off() -> impl FnMut(f64) -> f64 {
    let mut sign = -1.0;
    move |value| {
        sign = -sign;
        value * (1.0 + 0.3 * sign)
    }
}

#[test]
fn laws_of_friction_are_told_apart_in_windows() {
    let record = record();
    let (fitted, later) = (record.between(0.0, 60.0), record.between(60.0, 81.0));
    let errors = |task: Identification<Rubbing>| -> (Fit, [f64; 2]) {
        let task = task.with_shooting(in_windows());
        let fit = task.fit(&fitted).unwrap();
        let error = |record| task.window_errors(&fit, record, 1.0).unwrap().rms();
        let errors = [error(&fitted), error(&later)];
        (fit, errors)
    };
    let (fit, [first, then]) = errors(viscous(off()));
    assert!(first < 1.35e-3 && then < 1.05e-3, "{first} {then}");
    // Six ratios of nine parameters, and two offsets.
    let found = &fit.identifiability;
    assert_eq!((found.unknown, found.determined()), (11, 8), "{found}");
    let joint = fit.determined("joint_1").unwrap();
    assert!((joint.value / 0.1727 - 1.0).abs() < 0.01, "{joint:?}");
    assert!(fit.determined("mass_1").is_err());
    // What is left over is not white: the naive bar is too small.
    assert!(
        joint.by_blocks.unwrap() > 3.0 * joint.naive.unwrap(),
        "{joint:?}"
    );

    let (_, [first, then]) = errors(all_laws(off()));
    assert!(first < 0.45e-3 && then < 0.32e-3, "{first} {then}");
}

/// Half a minute: `cargo test -p branched-pendulum-measure --test measure -- --ignored one_motion`.
#[test]
#[ignore = "half a minute"]
fn one_motion_over_the_record_and_beyond() {
    let record = record();
    let task = all_laws(off());
    let fit = task.fit(&record.between(0.0, 60.0)).unwrap();
    let errors = task.errors(&fit, &record).unwrap();
    let (fitted, later) = (
        errors.rms_between(0.0, 60.0),
        errors.rms_between(60.0, 81.0),
    );
    assert!(fitted < 3.5e-3 && later < 6e-3, "{fitted} {later}");
}

/// Some minutes: `cargo test -p branched-pendulum-measure --test measure -- --ignored --nocapture random_starts`.
#[test]
#[ignore = "some minutes"]
fn random_starts_reach_one_minimum() {
    let record = record().between(0.0, 60.0);
    let mut random = Uniform(7);
    let rms = |_| {
        let task = all_laws(|value| value * (1.0 + 0.3 * random.next()));
        let Ok(fit) = task.fit(&record) else {
            return f64::INFINITY;
        };
        let steps: Vec<_> = fit
            .stages
            .iter()
            .map(|stage| (stage.rms, stage.steps))
            .collect();
        println!("{steps:?}");
        fit.rms()
    };
    let all: Vec<f64> = (0..20).map(rms).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let reached = all.iter().filter(|&&rms| rms < 1.001 * least).count();
    assert!(reached >= 19, "{all:?}");
}
