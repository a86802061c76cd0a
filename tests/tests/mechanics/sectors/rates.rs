//! Transfers, powers and the transfer matrix against finite differences.

use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;

use super::energies::{SAMPLES, states};
use super::oracle::{Basis, DEFINITIONS, Definition, conservative, derivative, energies};
use crate::support::Worst;

/// dE_s/dt along the motion of `mover`, by differences of the oracle's
/// energies.
fn rates(
    tree: &Tree,
    mover: &Tree,
    basis: &Basis,
    definition: Definition,
    theta: &[f64],
    omega: &[f64],
) -> Vec<f64> {
    let alpha = Motion::new(mover, theta, omega).accelerations();
    derivative(2e-4, |h| {
        let moved: Vec<f64> = theta.iter().zip(omega).map(|(a, b)| a + h * b).collect();
        let faster: Vec<f64> = omega.iter().zip(&alpha).map(|(a, b)| a + h * b).collect();
        energies(tree, basis, definition, &moved, &faster)
    })
}

#[test]
fn transfers_and_powers_are_rates_of_the_energies() {
    let (mut transfers, mut powers) = (Worst::default(), Worst::default());
    for (number, sample) in SAMPLES.iter().enumerate() {
        let (tree, basis) = (&sample.tree, &sample.basis);
        let count = basis.sectors.len();
        let frictionless = conservative(tree);
        for [theta, omega] in states(tree.links.len(), 4, 200 + number as u64) {
            for (definition, entry) in DEFINITIONS {
                let got = sample.compiled.evaluate(entry, &[&theta, &omega]);
                let with = rates(tree, tree, basis, definition, &theta, &omega);
                let without = rates(tree, &frictionless, basis, definition, &theta, &omega);
                let scale: f64 = with.iter().chain(&without).map(|rate| rate.abs()).sum();
                for sector in 0..count {
                    let place = || format!("{entry} of tree {number}, sector {sector}");
                    let (transfer, power) = (got[count + sector], got[2 * count + sector]);
                    transfers.note(transfer - without[sector], scale, place);
                    powers.note(power - (with[sector] - without[sector]), scale, place);
                }
            }
        }
    }
    transfers.assert_below(1e-8, "transfers against differences");
    powers.assert_below(1e-8, "powers against differences");
}

#[test]
fn parts_of_the_transfer_sum_to_it() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate() {
        let count = sample.basis.sectors.len();
        for [theta, omega] in states(sample.tree.links.len(), 5, 300 + number as u64) {
            let inputs: [&[f64]; 2] = [&theta, &omega];
            let budget = sample.compiled.evaluate("budget_canonical", &inputs);
            let parts = sample.compiled.evaluate("sector_transfers", &inputs);
            let scale: f64 = parts.iter().map(|part| part.abs()).sum();
            for sector in 0..count {
                let sum = parts[2 * sector] + parts[2 * sector + 1];
                let place = || format!("tree {number}, sector {sector}");
                worst.note(sum - budget[count + sector], scale, place);
            }
        }
    }
    worst.assert_below(1e-13, "kinetic and potential part against the whole");
}

/// The potential part is what gravity does: nothing is left of it where
/// gravity (and springs) are weak and the motion is the same.
#[test]
fn the_potential_part_is_the_potential_energys() {
    let sample = &SAMPLES[0];
    let (tree, basis) = (&sample.tree, &sample.basis);
    let count = basis.sectors.len();
    for [theta, omega] in states(tree.links.len(), 4, 350) {
        let parts = sample
            .compiled
            .evaluate("sector_transfers", &[&theta, &omega]);
        // {E_s, U − V_s} = −∂T_s/∂p · ∂(U − V_s)/∂q, with ∂T_s/∂p = B⁻¹ p.
        let mass = Motion::new(tree, &theta, &omega).mass;
        let momenta = basis.j.transpose() * (&mass * nalgebra::DVector::from_row_slice(&omega));
        for sector in 0..count {
            let block = basis.block(&mass, sector);
            let own = momenta.select_rows(&basis.sectors[sector]);
            let speed = nalgebra::Cholesky::new(block)
                .expect("positive definite")
                .solve(&own);
            let along = |h: f64| {
                let mut moved = theta.clone();
                for (&coordinate, speed) in basis.sectors[sector].iter().zip(&speed) {
                    for (link, angle) in moved.iter_mut().enumerate() {
                        *angle += h * speed * basis.j[(link, coordinate)];
                    }
                }
                let all = super::oracle::potentials(tree, basis, &moved);
                let rest = all.iter().sum::<f64>() - all[sector];
                vec![rest]
            };
            let expected = -derivative(1e-4, along)[0];
            let scale = parts.iter().map(|part| part.abs()).sum::<f64>();
            let error = (parts[2 * sector + 1] - expected).abs();
            assert!(
                error <= 1e-8 * scale,
                "sector {sector}: {error:e} of {scale:e}"
            );
        }
    }
}

#[test]
fn the_transfer_matrix_is_antisymmetric_and_sums_to_the_transfers() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate() {
        let count = sample.basis.sectors.len();
        for [theta, omega] in states(sample.tree.links.len(), 10, 400 + number as u64) {
            let inputs: [&[f64]; 2] = [&theta, &omega];
            let matrix = sample.compiled.evaluate("sector_transfer_matrix", &inputs);
            let budget = sample.compiled.evaluate("budget_parseval", &inputs);
            let scale = matrix
                .iter()
                .fold(0.0_f64, |most, entry| most.max(entry.abs()));
            for into in 0..count {
                let row = &matrix[into * count..][..count];
                for from in 0..count {
                    assert_eq!(row[from], -matrix[from * count + into]);
                }
                let sum: f64 = row.iter().sum();
                let place = || format!("tree {number}, sector {into}");
                worst.note(sum - budget[count + into], scale, place);
            }
        }
    }
    worst.assert_below(1e-12, "rows of the transfer matrix");
}

/// Each entry by itself: Poisson brackets from differences in angles and
/// momenta.
#[test]
fn entries_of_the_transfer_matrix_are_poisson_brackets() {
    let mut worst = Worst::default();
    for (number, sample) in SAMPLES.iter().enumerate().take(4) {
        let (tree, basis) = (&sample.tree, &sample.basis);
        let (n, count) = (tree.links.len(), basis.sectors.len());
        for [theta, omega] in states(n, 2, 500 + number as u64) {
            let matrix = sample
                .compiled
                .evaluate("sector_transfer_matrix", &[&theta, &omega]);
            let mass = Motion::new(tree, &theta, &omega).mass;
            let momenta = &mass * nalgebra::DVector::from_row_slice(&omega);
            let energies_at = |theta: &[f64], momenta: &nalgebra::DVector<f64>| {
                let mass = Motion::new(tree, theta, &omega).mass;
                let factor = nalgebra::Cholesky::new(mass).expect("positive definite");
                let omega = factor.solve(momenta);
                energies(tree, basis, Definition::Parseval, theta, omega.as_slice())
            };
            let by_angles: Vec<Vec<f64>> = (0..n)
                .map(|link| {
                    derivative(2e-4, |h| {
                        let mut moved = theta.clone();
                        moved[link] += h;
                        energies_at(&moved, &momenta)
                    })
                })
                .collect();
            let by_momenta: Vec<Vec<f64>> = (0..n)
                .map(|link| {
                    derivative(1e-4, |h| {
                        let mut pushed = momenta.clone();
                        pushed[link] += h;
                        energies_at(&theta, &pushed)
                    })
                })
                .collect();
            let scale = matrix
                .iter()
                .fold(0.0_f64, |most, entry| most.max(entry.abs()));
            for s in 0..count {
                for r in 0..count {
                    let bracket: f64 = (0..n)
                        .map(|i| {
                            by_angles[i][s] * by_momenta[i][r] - by_momenta[i][s] * by_angles[i][r]
                        })
                        .sum();
                    let place = || format!("tree {number}, {s} from {r}");
                    worst.note(matrix[s * count + r] - bracket, scale, place);
                }
            }
        }
    }
    worst.assert_below(1e-7, "transfer matrix against brackets by differences");
}
