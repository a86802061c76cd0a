//! The tables of docs/measured.md.

use branched_pendulum::prelude::Ensemble;

use super::bars::with_lacking_friction;
use super::{Arguments, Way, errors, paper};

/// Errors of W in per cent: medians of three cameras.
fn median_errors(arguments: &Arguments, ways: &[Way]) -> Vec<f64> {
    let cameras = Ensemble::new().map(&[1, 2, 3], |_, &seed| {
        let arguments = Arguments {
            seed,
            ..arguments.clone()
        };
        errors(&arguments, ways)
    });
    let of = |way: usize| {
        let mut all: Vec<f64> = cameras.iter().map(|errors| 100.0 * errors[way]).collect();
        all.sort_by(f64::total_cmp);
        all[1]
    };
    (0..ways.len()).map(of).collect()
}

/// The tables of docs/measured.md:
/// `cargo test -p branched-pendulum-program --lib tables_of --config 'profile.dev.package.branched-pendulum-program.opt-level=2' -- --ignored --nocapture`
#[test]
#[ignore = "some minutes"]
fn tables_of_noise_and_geometry() {
    let ways = &[Way::Smoothness, Way::Polynomials, Way::Model];
    for rate in [60.0, 240.0, 1000.0] {
        for noise in [2e-4, 5e-4, 1e-3] {
            let with = |options: &str| Arguments {
                rate,
                noise,
                ..paper(options)
            };
            let usual = with("");
            let small = with("--difference 1e-3");
            let longer =
                with("--tree apparatus --set viscous_1=0,viscous_2=0 --real joint_1=0.2705");
            let turned = with("--turned 0.5");
            let millimetres = 1e3 * noise;
            println!(
                "| {rate} | {millimetres} | {:.2?} | small {:.2?} | longer {:.2?} | turned {:.2?} |",
                median_errors(&usual, ways),
                median_errors(&small, ways),
                median_errors(&longer, ways),
                median_errors(&turned, ways),
            );
        }
    }
}

/// The table of docs/measured.md for friction that the equations lack; see
/// [`tables_of_noise_and_geometry`].
#[test]
#[ignore = "half a minute"]
fn tables_of_friction() {
    for unmodelled in [1e-5, 3.5e-5, 1e-4] {
        for rate in [60.0, 240.0] {
            let arguments = Arguments {
                rate,
                ..with_lacking_friction(unmodelled)
            };
            let ways = [Way::Smoothness, Way::Model];
            println!(
                "| {unmodelled} | {rate} | {:.2?} |",
                median_errors(&arguments, &ways)
            );
        }
    }
}
