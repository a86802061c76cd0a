//! Thresholds of trees by rule, and what they depend on.

use branched_pendulum::analysis::growth::{Growth, frequency_at_rest};
use branched_pendulum::prelude::*;
use branched_pendulum::system::TransverseOde;
use branched_pendulum_frame::command_line::parse_line;
use branched_pendulum_studies::tree_thresholds::Arguments;
use branched_pendulum_studies::tree_thresholds::theory::predicted;
use branched_pendulum_studies::tree_thresholds::trees::{Rule, Three, ThreeParameters, threshold};

/// Three rods on each.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 3, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.7),
    in_phase(tree),
    emit(transverse),
)]
struct Triples;

/// Thresholds know the number of copies by the product with the ratio of masses alone.
#[test]
fn copies_count_by_their_mass() {
    let rule = Rule {
        generations: 3,
        copies: 3,
        mass_ratio: 0.4,
        length_ratio: 0.7,
    };
    let pairs = Three::new(ThreeParameters {
        mass_ratio: rule.pair_ratio(),
        length_ratio: rule.length_ratio,
    });
    let (pairs, triples) = (pairs.unwrap(), Triples::new());
    let start = State::at_rest(0.0, &[0.9, 0.2, 0.0, 1.0, 0.5]);
    let growth = Growth {
        frequency_hz: frequency_at_rest(&TransverseOde::new(&pairs, 0).unwrap()),
        horizons: vec![5.0],
        tolerance: 1e-10,
    };
    let one = [(TransverseOde::new(&pairs, 0).unwrap(), start.clone())];
    let other = [(TransverseOde::new(&triples, 0).unwrap(), start)];
    let one = growth.in_lanes(&Ensemble::new(), &one).remove(0).unwrap();
    let other = growth.in_lanes(&Ensemble::new(), &other).remove(0).unwrap();
    let line = "--angles 20:100:40 --tolerance 1e-7";
    let arguments = parse_line::<Arguments>(line).unwrap();
    let found = threshold(rule, &arguments).unwrap();
    let of_pairs = Rule {
        copies: 2,
        mass_ratio: rule.pair_ratio(),
        ..rule
    };
    assert_eq!(
        found.angle_deg,
        threshold(of_pairs, &arguments).unwrap().angle_deg
    );
    assert!(found.angle_deg.is_some_and(|angle| angle > 20.0));
    let ratio = one.factors[0].value / other.factors[0].value;
    assert!((ratio - 1.0).abs() < 1e-6, "{one:?} {other:?}");
}

/// Theory finds a tongue at a fifth of the scan's threshold, and simulation has its rate.
#[test]
fn theory_finds_slow_growth() {
    let found = predicted(Rule {
        generations: 3,
        copies: 2,
        mass_ratio: 0.5,
        length_ratio: 0.7,
    });
    let found = found.unwrap();
    assert!(
        found.limit_deg > 8.0 && found.refusal.is_some(),
        "{found:?}"
    );
    let [(tongue, simulated)] = found.tongues.as_slice() else {
        panic!("{found:?}");
    };
    assert!(tongue.at > 4.0 && tongue.at < 8.0);
    let rate = tongue.largest.growth_rate;
    assert!(
        (rate.value - simulated).abs() < rate.error(),
        "{rate:?} {simulated}"
    );
}
