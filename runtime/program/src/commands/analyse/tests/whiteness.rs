//! Whether what the equations of motion leave over is white: of records whose equations hold and
//! whose noise is white, and of others.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::super::{Arguments, Draws, Measured, Source};
use super::tree;
use crate::frame::command_line::parse_line;

/// Deviations that the report allows.
const WHITE: f64 = 3.0;

/// The whiteness of a simulated record by the equations of motion. Each error remembers a part
/// `memory` of the one before it.
fn whiteness(options: &str, memory: f64, seed: u64) -> f64 {
    let line = format!("--duration 2 --rate 60 --seed {seed} {options}");
    let arguments: Arguments = parse_line(&line).unwrap();
    let (real, subject) = tree(&arguments);
    let mut source = Source::simulate(&arguments, &real).unwrap();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut errors = vec![0.0; source.angles[0].len()];
    for (row, truth) in source.angles.iter_mut().zip(&source.truth) {
        for ((angle, truth), error) in row.iter_mut().zip(&truth.links).zip(&mut errors) {
            let normal: f64 = StandardNormal.sample(&mut random);
            *error = memory * *error + (1.0_f64 - memory * memory).sqrt() * 1e-3 * normal;
            *angle = Some(truth + *error);
        }
    }
    let measured = Measured {
        subject: &subject,
        record: source.record(),
    };
    let draws = Draws { count: 2, seed: 1 };
    let guess = measured.by_smoothness(draws).unwrap();
    measured.by_model(&guess, draws).unwrap().whiteness
}

/// Releases of two trees.
fn release(seed: u64) -> String {
    let angle = 20.0 + 7.0 * (seed % 9) as f64;
    match seed % 2 {
        0 => format!("--start parent={angle}"),
        _ => format!("--tree double-pendulum --start {angle},{}", 60.0 - angle),
    }
}

fn alarms(records: u64) -> u64 {
    let is_alarm = |seed: &u64| whiteness(&release(*seed), 0.0, *seed).abs() >= WHITE;
    (1..=records).filter(is_alarm).count() as u64
}

#[test]
fn white_noise_is_white() {
    assert_eq!(alarms(6), 0);
}

/// `cargo test -p branched-pendulum-program --lib 200_records -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn white_noise_of_200_records_is_white() {
    let alarms = alarms(200);
    println!("{alarms} false alarms of 200");
    assert!(alarms <= 4);
}

#[test]
fn noise_that_goes_on_is_not() {
    for (memory, seed) in [(0.6, 1), (0.5, 2), (-0.5, 3), (0.7, 4)] {
        let white = whiteness(&release(seed), memory, seed);
        assert!(white.abs() > WHITE, "{memory}: {white}");
    }
}
