//! W as the rate of an energy along motions under Cartesian lines.

use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::PendulumTree;

use super::super::sectors::{DEFINITIONS, at_run_time, largest};
use super::{NESTED, ONE_FAMILY, SIBLINGS, apparatus, ending};
use crate::support::{Worst, compile};

/// A curve through a state that has the motion's tangent there, under Cartesian lines.
fn moved(tree: &PendulumTree, theta: &[f64], omega: &[f64], time: f64) -> [Vec<f64>; 2] {
    let alpha = tree.accelerations(0.0, theta, omega);
    let angles = theta.iter().zip(omega).zip(&alpha);
    let angles = angles.map(|((angle, rate), alpha)| angle + time * (rate + 0.5 * time * alpha));
    let rates = omega.iter().zip(&alpha);
    let rates = rates.map(|(rate, alpha)| rate + time * alpha);
    [angles.collect(), rates.collect()]
}

/// The rate of a function of (θ, ω) along the motion, by differences of fourth order.
fn rate_along(
    tree: &PendulumTree,
    [theta, omega]: [&[f64]; 2],
    value: impl Fn(&[f64], &[f64]) -> f64,
) -> f64 {
    let step = 2.5e-4;
    let at = |time: f64| {
        let [theta, omega] = moved(tree, theta, omega, time);
        value(&theta, &omega)
    };
    let slope = |step: f64| (at(step) - at(-step)) / (2.0 * step);
    (4.0 * slope(0.5 * step) - slope(step)) / 3.0
}

/// W is the rate of H_d along motions under Cartesian lines.
#[test]
fn exact_transfers_are_rates_along_motions() {
    let mut worst = Worst::default();
    for copies in [2, 3] {
        let text = apparatus(copies, SIBLINGS, "transfer(exact)");
        let (compiled, tree) = (compile(&text), at_run_time(&text));
        let n = tree.links();
        let canonical = |theta: &[f64], omega: &[f64]| {
            let [mut q, mut v] = [(); 2].map(|()| vec![0.0; n]);
            tree.symmetric_from_absolute(Normalisation::Plain, theta, &mut q);
            tree.symmetric_from_absolute(Normalisation::Plain, omega, &mut v);
            let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
            [q, p]
        };
        let mut random = Random::new(5);
        for state in 0..20 {
            let (theta, omega) = (random.around_zero(n, 0.8), random.around_zero(n, 2.0));
            let [q, p] = canonical(&theta, &omega);
            for difference in 1..copies {
                let end = ending(copies, &format!("d{difference}"));
                let rate = rate_along(&tree, [&theta, &omega], |theta, omega| {
                    let [q, p] = canonical(theta, omega);
                    compiled.evaluate(&format!("antiphase_energy{end}"), &[&q, &p])[0]
                });
                let own = compiled.evaluate(&format!("transfer_exact{end}"), &[&q, &p]);
                let size = own.iter().fold(rate.abs(), |size, w| size.max(w.abs()));
                worst.note(own.iter().sum::<f64>() - rate, size, || {
                    format!("{copies} copies{end}, state {state}")
                });
            }
        }
    }
    worst.assert_below(1e-8, "rates of H_d");
}

/// The energies by Parseval change at the rates of their transfers, along motions under Cartesian lines.
#[test]
fn transfers_by_parseval_are_rates_along_motions() {
    let mut worst = Worst::default();
    for text in [NESTED, ONE_FAMILY] {
        let text = format!("{text}, emit(budget(parseval, canonical))");
        let (compiled, tree) = (compile(&text), at_run_time(&text));
        let (n, count) = (
            tree.links(),
            compiled
                .mechanics
                .sectors
                .as_ref()
                .map_or(0, |own| own.sectors.len()),
        );
        let mut random = Random::new(31);
        for (_, entry) in DEFINITIONS
            .iter()
            .filter(|(_, entry)| ["budget_parseval", "budget_canonical"].contains(entry))
        {
            for _ in 0..3 {
                let (theta, omega) = (random.around_zero(n, 1.0), random.around_zero(n, 2.0));
                let own = compiled.evaluate(entry, &[&theta, &omega]);
                for sector in 0..count {
                    let rate = rate_along(&tree, [&theta, &omega], |theta, omega| {
                        compiled.evaluate(entry, &[theta, omega])[sector]
                    });
                    let transfers = &own[count..2 * count];
                    worst.note(transfers[sector] - rate, largest(transfers), || {
                        format!("{entry}, sector {sector} of {text}")
                    });
                }
            }
        }
    }
    worst.assert_below(1e-8, "rates of energies");
}
