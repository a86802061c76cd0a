//! Estimates from a simulated camera against the truth.

mod advice;
mod bars;
mod causes;
mod eight_links;
mod faults;
mod films;
mod tables;
mod whiteness;

use branched_pendulum_data::{Table, TableOptions};

use self::bars::with_lacking_friction;
use super::arguments::Arguments;
use super::constants;
use super::estimate::{Draws, Estimate, Measured};
use super::report::{Trust, power_error};
use super::source::Source;
use super::spectrogram::Spectrogram;
use super::subject::MeasuredTree;
use crate::frame::command_line::parse_line;
use crate::measured_file::MeasuredLinks;
use crate::subject::Subject;

/// A camera before the paper's pendulum with these options.
pub(super) fn paper(options: &str) -> Arguments {
    parse_line(&format!("--start parent=47.8 {options}")).unwrap()
}

/// The real tree of a camera, and the tree that is assumed.
pub(super) fn tree(arguments: &Arguments) -> (Subject, MeasuredTree) {
    let described = arguments.tree.described().unwrap();
    let (assumed, _) = constants::assumed(&described).unwrap();
    let subject = MeasuredTree::new(&assumed, arguments.sector.as_deref()).unwrap();
    let real = constants::real(&described, &arguments.real.concat()).unwrap();
    (real, subject)
}

/// The links whose angles are read.
pub(super) fn hung(arguments: &Arguments) -> MeasuredLinks {
    let described = arguments.tree.described().unwrap();
    let (assumed, _) = constants::assumed(&described).unwrap();
    MeasuredLinks::new(&assumed, &described.offsets, &arguments.measured).unwrap()
}

const DRAWS: Draws = Draws { count: 50, seed: 7 };

/// Ways to an estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Smoothness,
    Polynomials,
    Model,
}

/// Looks with the simulated camera at an apparatus, and analyses it with the friction that is
/// assumed.
fn estimate(arguments: &Arguments, draws: Draws, ways: &[Way]) -> (Source, Vec<Estimate>) {
    let (real, subject) = tree(arguments);
    let source = Source::simulate(arguments, &real).unwrap();
    let measured = Measured {
        subject: &subject,
        record: source.record(),
    };
    let few = Draws { count: 2, ..draws };
    let estimates = ways.iter().map(|way| match way {
        Way::Smoothness => measured.by_smoothness(draws).unwrap(),
        Way::Polynomials => measured.by_polynomials(draws).unwrap(),
        Way::Model => {
            let guess = measured.by_smoothness(few).unwrap();
            measured.by_model(&guess, draws).unwrap()
        }
    });
    let estimates = estimates.collect();
    (source, estimates)
}

fn errors(arguments: &Arguments, ways: &[Way]) -> Vec<f64> {
    let (source, all) = estimate(arguments, DRAWS, ways);
    all.iter()
        .map(|one| power_error(&source, one).unwrap())
        .collect()
}

/// The median of five cameras.
fn median(mut of: impl FnMut(u64) -> [f64; 2]) -> [f64; 2] {
    let mut all: Vec<[f64; 2]> = (0..5).map(&mut of).collect();
    [0, 1].map(|index| {
        all.sort_by(|a, b| a[index].total_cmp(&b[index]));
        all[2][index]
    })
}

#[test]
fn transfer_from_smoothness() {
    for (difference, rate, bounds) in [
        (1e-2, 240.0, [0.015, 0.02]),
        (1e-2, 60.0, [0.025, 0.03]),
        (1e-3, 240.0, [0.05, 0.05]),
    ] {
        let [transfer, closure] = median(|seed| {
            let arguments = Arguments {
                difference,
                rate,
                seed,
                ..paper("")
            };
            let (source, all) = estimate(&arguments, DRAWS, &[Way::Smoothness]);
            [
                power_error(&source, &all[0]).unwrap(),
                Trust::of(&all[0]).closure,
            ]
        });
        assert!(
            transfer < bounds[0] && closure < bounds[1],
            "{rate} {transfer} {closure}"
        );
        // Not by far, or the bounds would tell nothing.
        assert!(3.0 * transfer > bounds[0], "{rate} {transfer}");
    }
}

/// Polynomials know less, and come near.
#[test]
fn polynomials_agree_with_smoothness() {
    let all = errors(&paper(""), &[Way::Smoothness, Way::Polynomials]);
    assert!(all[1] < 3.0 * all[0] && all[1] < 0.04, "{all:?}");
}

#[test]
fn the_right_model_is_worth_a_factor_ten_and_a_wrong_one_is_no_loss() {
    let all = errors(&paper("--rate 60"), &[Way::Smoothness, Way::Model]);
    assert!(all[1] < 1e-3 && all[1] < 0.1 * all[0], "{all:?}");
    for unmodelled in [1e-5, 3.5e-5, 1e-4] {
        let arguments = Arguments {
            rate: 60.0,
            ..with_lacking_friction(unmodelled)
        };
        let all = errors(&arguments, &[Way::Smoothness, Way::Model]);
        assert!(all[1] < all[0] && all[1] < 0.025, "{unmodelled} {all:?}");
    }
}

/// The measured double pendulum, 16 s of it, every 10 ms: encoders of some 0.1 mrad, and an
/// energy that falls by friction. That is not viscous alone, as is assumed, and the closure
/// says so.
#[test]
fn a_measured_chain_is_read_and_its_energy_falls() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../measure/tests/measure/identification/double-pendulum.csv"
    );
    let line = format!("{file} --tree double-pendulum");
    let arguments: Arguments = parse_line(&line).unwrap();
    let (_, chain) = tree(&arguments);
    let table = Table::read(file, &TableOptions::default()).unwrap();
    let mut source = Source::read(&table, &arguments, &hung(&arguments)).unwrap();
    let count = source.times.partition_point(|time| *time < 16.0);
    source.times.truncate(count);
    source.angles.truncate(count);
    let mut findings = source.findings.iter();
    assert!(findings.any(|f| f.to_string() == "detected: angles from the upward vertical"));
    let measured = Measured {
        subject: &chain,
        record: source.record(),
    };
    let estimate = measured.by_smoothness(DRAWS).unwrap();
    let energies: Vec<f64> = estimate.energies.means.iter().map(|row| row[0]).collect();
    let (first, last) = (energies[0], energies[energies.len() - 1]);
    assert!((0.4..0.7).contains(&(last / first)), "{first} {last}");
    let trust = Trust::of(&estimate);
    assert!(estimate.noise < 1e-4 && trust.power < 0.01);
    assert!((0.02..0.1).contains(&trust.closure) && trust.closure > 3.0 * trust.closure_deviation);
    let spectrogram = Spectrogram::of(chain.names(), &source, &estimate);
    assert!(spectrogram.unwrap().is_none(), "the record is too short");
    // The model lacks something, and is not trusted beyond that.
    let model = measured.by_model(&estimate, DRAWS).unwrap();
    assert!(model.noise < 2e-4 && model.whiteness > 3.0);
    assert!(Trust::of(&model).closure > 3.0 * Trust::of(&model).closure_deviation);
    let paper = hung(&paper(""));
    let refused = Source::read(&table, &arguments, &paper).unwrap_err();
    assert!(
        refused
            .to_string()
            .contains("angles of 2 links, but the pendulum has 3")
    );
}

/// Power as the derivative of the energy along the motion, and by the laws of friction
/// (physics §17).
#[test]
fn friction_of_the_chain_by_all_laws() {
    let set = "coulomb_1=3e-4,coulomb_2=1e-4,quadratic_1=2e-5,quadratic_2=4e-5";
    let line = format!("--tree double-pendulum --set {set}");
    let arguments: Arguments = parse_line(&line).unwrap();
    let (described, chain) = tree(&arguments);
    let of = |name: &str| described.tree.value(name).unwrap();
    let lost = |[viscous, coulomb, quadratic]: [f64; 3], rate: f64| {
        let size = rate.hypot(0.05);
        viscous * rate * rate + (coulomb / size + quadratic * size) * rate * rate
    };
    for (angles, rates) in [
        ([0.3, -0.8], [2.0, -5.0]),
        ([2.0, 1.0], [-0.03, 0.01]),
        ([1.0, 4.0], [9.0, 12.0]),
    ] {
        let [upper, lower] = rates;
        let expected = -lost([of("viscous_1"), of("coulomb_1"), 0.0], upper)
            - lost([of("viscous_2"), of("coulomb_2"), 0.0], lower - upper)
            - lost([0.0, 0.0, of("quadratic_1")], upper)
            - lost([0.0, 0.0, of("quadratic_2")], lower);
        let found = chain
            .powers(0.0, &[angles, rates].map(Vec::from), &[])
            .whole;
        assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
    }
}
