//! The program `transfer-orders`, and the errors that it reports, for its own
//! trees and for others.

use branched_pendulum::TransferForms;
use branched_pendulum::analysis::truncation::{
    Background, ErrorCurve, LevelCrossing, PhaseAverage, TruncationError, sector_frequencies,
};
use branched_pendulum::analysis::{Modes, SectorModes};
use branched_pendulum::prelude::*;
use branched_pendulum_frame::{Job, Progress};
use branched_pendulum_studies::scenes::BranchedDouble;
use branched_pendulum_studies::transfer_orders::scenes::{apparatus, arms};
use branched_pendulum_studies::transfer_orders::{Arms, Settings, Study, output};

/// A tree of a user's own: three leaves and a drive, with a name for a mass.
#[branched_pendulum(
    gravity = 9.80665,
    beam: rod(mass = 0.2, length = 0.4, friction = 1e-4) [
        bell: rod(mass = weight, length = 0.15) * 3
    ],
    drive(torque = 0.05 * sin(3 * t)),
    emit(modes, transfer(amplitude = 2, amplitude = 3, exact), budget(rest)),
)]
pub struct Bells;

/// A nested tree of which one branching counts as small.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.12, length = 0.3) [
        limb: rod(mass = 0.06, length = 0.2) [twig: rod(mass = 0.03, length = 0.15) * 2] * 2
    ],
    emit(modes, budget(canonical, amplitude = 2, amplitude = 4, small(twig_1_d, twig_2_d))),
)]
pub struct Twigs;

fn bells() -> Bells {
    Bells::new(BellsParameters { weight: 0.05 }).unwrap()
}

/// Slopes of the errors of each form of W into a sector between two amplitudes.
fn slopes<M: TransferForms<f64>>(model: &M, receiver: &str, amplitudes: [f64; 2]) -> Vec<f64> {
    let average = PhaseAverage {
        amplitudes: amplitudes.to_vec(),
        states: 300,
        seed: 0,
        background: Background::uniform(model, 1.0, 5.0),
    };
    let curves = average.curves(model).unwrap();
    let curve = curves.iter().find(|curve| curve.receiver == receiver);
    let curve = curve.expect("a receiver of that name");
    let ratio = (amplitudes[1] / amplitudes[0]).ln();
    let slope = |form| {
        let errors = curve.errors(form);
        (errors[1] / errors[0]).ln() / ratio
    };
    (0..curve.forms.len()).map(slope).collect()
}

fn assert_slopes(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 0.2, "{found} for {expected}");
    }
}

/// W begins with the square of the amplitude. Between two copies it is even:
/// what a form of order N leaves out is of order N + 2, and its relative error
/// of order N; otherwise of order N − 1.
#[test]
fn the_relative_error_falls_with_the_order_of_the_amplitude() {
    let found = slopes(&BranchedDouble::new(), "d", [0.05, 0.1]);
    assert_slopes(&found, &[0.0, 2.0, 4.0, 6.0, 8.0]);
    let found = slopes(&Arms::new(), "arm_d", [0.02, 0.04]);
    assert_slopes(&found[..4], &[0.0, 2.0, 4.0, 6.0]);
    assert_slopes(&slopes(&bells(), "d1", [0.01, 0.02]), &[1.0, 2.0]);
}

/// The published form leaves out terms that are quadratic in the amplitude, as
/// those that it holds: no amplitude is small enough for it.
#[test]
fn the_relative_error_of_the_published_form_does_not_fall() {
    let mut average = apparatus(300).unwrap().phase_average;
    average.amplitudes = vec![1e-3, 1e-2, 1e-1];
    let errors = average.curves(&BranchedDouble::new()).unwrap()[0].errors(0);
    for error in &errors {
        assert!(*error > 0.3 && (error / errors[0] - 1.0).abs() < 0.02);
    }
}

fn crossing(curve: &ErrorCurve, form: usize, level: f64) -> f64 {
    match curve.crossing(form, level) {
        Some(LevelCrossing::At(amplitude)) => amplitude,
        other => panic!("{other:?}"),
    }
}

/// 1 % at about 0.16, 0.55, 0.81 and 0.94 rad, both ways: along trajectories
/// after fewer and shorter releases than the program follows.
#[test]
fn amplitudes_at_one_per_cent_are_those_of_the_paper_s_pendulum() {
    let model = BranchedDouble::new();
    let mut settings = apparatus(2000).unwrap();
    let trajectories = &mut settings.trajectories;
    trajectories.disturbances =
        branched_pendulum::analysis::truncation::logarithmic([0.01, 1.0], 24);
    (trajectories.duration, trajectories.sampling) = (12.0, 200.0);
    let average = &settings.phase_average.curves(&model).unwrap()[0];
    let along = &settings.trajectories.curves(&model).unwrap()[0];
    for (form, expected) in [(1, 0.16), (2, 0.55), (3, 0.81), (4, 0.94)] {
        let found = crossing(average, form, 0.01);
        assert!((found / expected - 1.0).abs() < 0.05, "{form}: {found}");
        let found = crossing(along, form, 0.01);
        assert!((found / expected - 1.0).abs() < 0.15, "{form}: {found}");
    }
}

/// Of one coordinate the sector's frequency, of several the mean square of its
/// modes.
#[test]
fn frequencies_are_those_of_the_modes() {
    let hertz = sector_frequencies(&BranchedDouble::new()).unwrap()[0] / std::f64::consts::TAU;
    assert_eq!(format!("{hertz:.7}"), "1.2580584");

    let model = Twigs::new();
    let (mass, stiffness) = (
        model.mass_matrix(&[0.0; 7]),
        model.stiffness_matrix(&[0.0; 7]),
    );
    let modes = SectorModes::new(Twigs::<f64>::SECTORS, &mass, &stiffness).unwrap();
    let found = sector_frequencies(&model).unwrap();
    assert_eq!(found.len(), 2);
    for (found, block) in found.iter().zip(&modes.blocks[2..]) {
        let expected = block.modes.frequencies_hz[0] * std::f64::consts::TAU;
        assert!((found / expected - 1.0).abs() < 1e-9, "{found}, {expected}");
    }

    let model = Arms::new();
    let found = sector_frequencies(&model).unwrap()[0];
    // One arm with its hand on a pivot at rest.
    let (m, l, n, k) = (0.1, 0.2, 0.05, 0.15);
    let (own, coupling, hand) = (
        m * l * l / 3.0 + n * l * l,
        n * l * k / 2.0,
        n * k * k / 3.0,
    );
    let mass = [[own, coupling], [coupling, hand]];
    let weight = 9.80665 * (m * l / 2.0 + n * l);
    let stiffness = [[weight, 0.0], [0.0, 9.80665 * n * k / 2.0]];
    let modes = Modes::new(&mass, &stiffness).unwrap().frequencies_hz;
    let square = modes
        .iter()
        .map(|f| (f * std::f64::consts::TAU).powi(2))
        .sum::<f64>()
        / 2.0;
    assert!((found / square.sqrt() - 1.0).abs() < 1e-9, "{found}");
}

/// Differences that are not small belong to the background: they stay what they
/// are, and W into them is not small either.
#[test]
fn sectors_that_keep_any_size_are_part_of_the_background() {
    let found = slopes(&Twigs::new(), "twig_1_d", [0.02, 0.04]);
    assert!(found[0] > 0.9 && found[1] > found[0] + 1.5, "{found:?}");
}

#[test]
fn impossible_settings_are_refused() {
    let model = BranchedDouble::new();
    let good = apparatus(10).unwrap();
    let error = |change: fn(&mut Settings)| {
        let mut settings = good.clone();
        change(&mut settings);
        let average = settings.phase_average.curves(&model).err();
        average
            .or_else(|| settings.trajectories.curves(&model).err())
            .unwrap()
    };
    assert!(matches!(
        error(|s| s.phase_average.amplitudes = vec![0.2, 0.1]),
        TruncationError::Order { .. }
    ));
    assert!(matches!(
        error(|s| s.phase_average.amplitudes = vec![f64::NAN]),
        TruncationError::Value { .. }
    ));
    assert!(matches!(
        error(|s| s.phase_average.background.rates.truncate(2)),
        TruncationError::Length {
            expected: 3,
            found: 2,
            ..
        }
    ));
    assert!(matches!(
        error(|s| s.trajectories.release.clear()),
        TruncationError::Length { found: 0, .. }
    ));
    assert!(matches!(
        error(|s| s.trajectories.duration = -1.0),
        TruncationError::Value { .. }
    ));
}

/// The whole way for a tree that the program does not know.
#[test]
fn a_tree_of_one_s_own_gets_table_csv_and_chart() {
    let model = bells();
    let mut settings =
        Settings::released("bells", "bells", &model, &[0.8, 0.0, 0.0, 0.0], 50).unwrap();
    settings.trajectories.disturbances.truncate(3);
    settings.trajectories.duration = 2.0;
    let study = Study::of(&model, settings, &Progress::default()).unwrap();
    assert_eq!(study.costs.ratios.len(), 2);
    let table = output::table(&study);
    assert!(
        table.contains("into `d1`") && table.contains("into `d2`"),
        "{table}"
    );
    assert!(table.contains("amplitude order 3"));
    let folder = std::env::temp_dir().join(format!("transfer-orders-{}", std::process::id()));
    let job = Job::quiet(&folder).unwrap();
    output::write(&job, &study).unwrap();
    let files = job.files();
    assert_eq!(files.len(), 7);
    for ending in ["csv", "svg", "png", "pdf"] {
        assert!(files.iter().any(|file| file.ends_with(ending)), "{ending}");
    }
    let csv = std::fs::read_to_string(folder.join(&files[0])).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(csv.starts_with("amplitude"), "{csv}");
    assert_eq!(
        csv.lines().filter(|line| !line.starts_with('#')).count() - 1,
        45
    );
}

#[test]
fn settings_of_the_arms_cover_their_motion() {
    let background = arms(10).unwrap().phase_average.background;
    // Released at 45°, the body does not swing higher; what hangs on it does.
    assert!(background.angles[0] >= 45.0_f64.to_radians() && background.angles[1] > 0.5);
    assert_eq!(background.angles[3..], [0.0, 0.0]);
}
