//! Fuzz test of descriptions: any text gives either a tree that can be computed, or mistakes with
//! their positions.

#![no_main]

use branched_pendulum::prelude::*;
use branched_pendulum_trees::TreeDescription;
use libfuzzer_sys::{Corpus, fuzz_target};

/// Largest number of links. Larger trees take more time but use the same code.
const LINKS: usize = 100;

/// The value of all parameters.
const VALUE: f64 = 0.3;

fuzz_target!(|bytes: &[u8]| -> Corpus {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Corpus::Reject;
    };
    match TreeDescription::parse(text) {
        Ok(description) => compute(&description),
        Err(error) => {
            let lines = text.lines().count().max(1);
            assert!(!error.mistakes().is_empty());
            assert!(error.to_string().starts_with("error: "));
            for mistake in error.mistakes() {
                assert!((1..=lines + 1).contains(&mistake.line));
                assert!(!mistake.message.is_empty() && !mistake.help.is_empty());
            }
        }
    }
    Corpus::Keep
});

/// Calls all functions that a program may call on a description from its user.
fn compute(description: &TreeDescription) {
    let names: Vec<String> = description.parameters().map(str::to_owned).collect();
    for name in &names {
        assert!(description.parameter_use(name).is_some());
    }
    let links = description.links().len();
    if links > LINKS {
        return;
    }
    assert_eq!(description.parents().len(), links);
    let in_nodes = description.nodes().into_iter().map(|node| node.links.len());
    assert_eq!(in_nodes.sum::<usize>(), links);
    let values: Vec<(&str, f64)> = names.iter().map(|name| (&**name, VALUE)).collect();
    let tree = match description.tree::<f64>(&values) {
        Ok(tree) => tree,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert_eq!(tree.names().len(), tree.links());
    let angles: Vec<f64> = (0..tree.links())
        .map(|link| 0.1 + 0.01 * link as f64)
        .collect();
    let alpha = tree.accelerations(0.2, &angles, &angles);
    assert_eq!(alpha.len(), tree.links());
    let energy = tree.energy_of(&angles, &angles);
    // Points at the ends of a line may meet, where a repulsion and a length at rest have no bound.
    if tree.translational_spring_dampers().iter().next().is_none() {
        assert!(alpha.iter().all(|alpha| alpha.is_finite()), "{alpha:?}");
        assert!(energy.is_finite());
    }
    if let Ok(symmetric) = tree.symmetric() {
        drop(symmetric);
    }
    for name in tree.observable_names() {
        assert!(tree.observable(name).is_ok());
    }
}
