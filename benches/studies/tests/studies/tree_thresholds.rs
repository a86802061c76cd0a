//! Thresholds of trees by rule, and what they depend on.

use branched_pendulum::prelude::*;
use branched_pendulum_frame::command_line::parse_line;
use branched_pendulum_studies::tree_thresholds::Arguments;
use branched_pendulum_studies::tree_thresholds::trees::{Rule, threshold};
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree};

/// Checks that a whole tree with all copies has the growth of the two chains of the study, and that
/// the number of copies counts by its product with the ratio of masses.
#[test]
fn chains_grow_like_whole_trees() {
    let rule = Rule {
        generations: 3,
        copies: 3,
        mass_ratio: 0.4,
        length_ratio: 0.7,
    };
    let triples = "gravity = 9.80665, tree: generations(count = 3, branching = 3, shape = rod,
        mass = 0.12, length = 0.3, mass_ratio = 0.4, length_ratio = 0.7)";
    let factor = |text: &str| {
        let tree = PendulumTree::parse(text).unwrap();
        let mut angles = vec![0.0; tree.links()];
        angles[0] = 0.9;
        let growth = DifferenceGrowth::new(&tree, &tree.all_copies(), vec![5.0], 1e-10);
        let starts = [State::at_rest(0.0, &angles)];
        let grown = growth.unwrap().in_lanes(&Ensemble::new(), &starts).unwrap();
        grown[0].as_ref().unwrap().factors[0].value
    };
    let ratio = factor(triples) / factor(&rule.description());
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
    let line = "--angles 20:100:40 --tolerance 1e-7";
    let arguments = parse_line::<Arguments>(line).unwrap();
    let found = threshold(rule, &arguments).unwrap();
    let of_pairs = Rule {
        copies: 2,
        mass_ratio: 0.6,
        ..rule
    };
    let pairs = threshold(of_pairs, &arguments).unwrap();
    assert_eq!(found.angle_deg, pairs.angle_deg);
    assert!(found.angle_deg.is_some_and(|angle| angle > 20.0));
}
