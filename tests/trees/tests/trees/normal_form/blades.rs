//! Tongues of the paper's pendulum against those that simulation finds.

use branched_pendulum::analysis::normal_form::{NormalFormOptions, Resonance, Tongues};
use branched_pendulum_trees::PendulumTree;

use super::{LEAST, PAPER, children, grid, of, release, snapped, tongues};

/// Edges by `branched-pendulum map --tongues`, docs/growth.md: parent, child at the largest rate,
/// first and last child, rate.
const BLADES: [(f64, f64, [f64; 2], f64); 8] = [
    (15.0, 56.0, [52.0, 59.0], 0.0468),
    (20.0, 1.0, [-0.5, 3.0], 0.0312),
    (20.0, 63.5, [58.0, 67.5], 0.0680),
    (25.0, 9.5, [6.5, 13.0], 0.0497),
    (25.0, 69.5, [63.0, 76.0], 0.0904),
    (30.0, 19.0, [13.5, 23.5], 0.0713),
    (40.0, 36.0, [27.5, 44.5], 0.1251),
    (50.0, 50.0, [42.5, 64.5], 0.1820),
];

#[test]
fn edges_of_the_blades_are_those_of_simulation() {
    let form = of(PAPER, 8);
    let pump = Resonance {
        in_phase: vec![1, 1],
        differences: vec![-2],
    };
    assert!(form.form().resonances().contains(&pump));
    let mut within = Vec::new();
    for (parent, child, edges, rate) in BLADES {
        let found = tongues(&form, parent, &grid(child - 25.0, child + 25.0));
        println!("{parent} {child}: {edges:?}");
        for tongue in &found.tongues {
            println!(
                "  {:?} {} {:?}",
                tongue.edges, tongue.at, tongue.largest.growth_rate
            );
        }
        for part in &found.refused {
            println!("  refused {part:?}");
        }
        let own = found
            .tongues
            .iter()
            .find(|own| own.at > edges[0] && own.at < edges[1]);
        let snapped = own.map_or([f64::NAN; 2], snapped);
        within.extend(
            snapped
                .iter()
                .zip(edges)
                .map(|(own, edge)| (own - edge).abs() <= 0.5),
        );
        if let Ok(predicted) = form.predict(&release(parent, child)) {
            let own = predicted.growth_rate.value;
            println!("  rate {own} {rate}");
            assert!(
                parent > 30.0 || (own / rate - 1.0).abs() < 0.03,
                "{parent}: {own} {rate}"
            );
        }
    }
    // The paper's line.
    let line = Tongues::along(&grid(10.0, 30.0), LEAST, |parent| {
        form.predict(&release(parent, 0.0))
    });
    let own = line.tongues.first().map_or([f64::NAN; 2], snapped);
    within.extend(
        own.iter()
            .zip([18.5, 20.5])
            .map(|(own, edge)| (own - edge).abs() <= 0.5),
    );
    println!("{line:?}");
    let count = within.iter().filter(|own| **own).count();
    println!("{count} of {}", within.len());
    assert!(count >= 15 && within.len() == 18, "{within:?}");
}

#[test]
fn nothing_grows_without_the_resonance() {
    let tree = PendulumTree::parse(PAPER).unwrap();
    let pump = Resonance {
        in_phase: vec![1, 1],
        differences: vec![-2],
    };
    let options = NormalFormOptions {
        removed: vec![pump],
        ..NormalFormOptions::default()
    };
    let form = tree.normal_form(&children(), options).unwrap();
    for (parent, child, ..) in BLADES {
        let found = tongues(&form, parent, &grid(child - 25.0, child + 25.0));
        assert!(found.tongues.is_empty(), "{found:?}");
    }
}
