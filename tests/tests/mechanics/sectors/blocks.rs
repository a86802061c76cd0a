//! The block structure at the in-phase motion.

use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::generator::{Recipe, sample};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use super::oracle::Basis;
use crate::support::{Worst, compile};

const TREES: u64 = 30;

/// λ with K v = λ M v, in order.
fn spectrum(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Vec<f64> {
    let factor = Cholesky::new(mass.clone()).expect("a positive definite mass matrix");
    let inverse = factor.l().try_inverse().expect("a regular factor");
    let standard = &inverse * stiffness * inverse.transpose();
    let eigen = SymmetricEigen::new(0.5 * (&standard + standard.transpose()));
    let mut values: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

#[test]
fn off_blocks_vanish_and_spectra_of_blocks_are_the_spectrum() {
    let (mut off_blocks, mut spectra) = (Worst::default(), Worst::default());
    let (mut largest, mut most_sectors) = (0, 0);
    for seed in 0..TREES {
        let recipe = Recipe {
            links: 12 + (seed % 9) as usize,
            copies: &[2, 2, 3, 4],
            nested: true,
            requests: "modes, budget(rest)",
        };
        let sample = sample(&recipe, 7_000 + seed);
        let compiled = compile(&sample.text);
        let basis = Basis::new(&compiled);
        let n = sample.tree.links.len();
        largest = largest.max(n);
        most_sectors = most_sectors.max(basis.sectors.len());
        let mut random = Random::new(seed);
        let means = &basis.sectors[0];
        let mut q = DVector::zeros(n);
        for &mean in means {
            q[mean] = random.between(-3.0, 3.0);
        }
        let theta = &basis.j * q;
        let [mass, stiffness] = ["mass_matrix", "stiffness_matrix"].map(|entry| {
            DMatrix::from_row_slice(n, n, &compiled.evaluate(entry, &[theta.as_slice()]))
        });
        // Orthonormal coordinates, so that entries of all blocks compare.
        let mut unit = basis.j.clone();
        for mut column in unit.column_iter_mut() {
            let norm = column.norm();
            column /= norm;
        }
        let mut blockwise = Vec::new();
        for matrix in [&mass, &stiffness] {
            let whole = unit.transpose() * matrix * &unit;
            let scale = matrix.amax();
            for (r, rows) in basis.sectors.iter().enumerate() {
                for columns in &basis.sectors[..r] {
                    for &row in rows {
                        for &column in columns {
                            off_blocks.note(whole[(row, column)], scale, || format!("seed {seed}"));
                        }
                    }
                }
            }
        }
        for sector in 0..basis.sectors.len() {
            blockwise.extend(spectrum(
                &basis.block(&mass, sector),
                &basis.block(&stiffness, sector),
            ));
        }
        blockwise.sort_by(f64::total_cmp);
        let full = spectrum(&mass, &stiffness);
        assert_eq!(full.len(), blockwise.len());
        let scale = full
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (full, block) in full.iter().zip(&blockwise) {
            spectra.note(full - block, scale, || format!("seed {seed}"));
        }
    }
    println!("trees to {largest} links with up to {most_sectors} sectors");
    assert!(largest >= 18 && most_sectors >= 6);
    off_blocks.assert_below(1e-14, "off-diagonal blocks at in-phase angles");
    spectra.assert_below(1e-10, "spectra of the blocks against the whole");
}

#[test]
fn a_full_binary_tree_has_a_sector_for_every_branching() {
    let compiled = compile(
        "gravity = 9.8, arm: generations(count = 3, branching = 2, shape = rod, mass = 0.12, \
         length = 0.3, mass_ratio = 0.5, length_ratio = 0.7), emit(budget(rest))",
    );
    let sectors = compiled.mechanics.sectors.expect("asked for").sectors;
    let sizes: Vec<(&str, usize)> = sectors
        .iter()
        .map(|sector| (sector.name.as_str(), sector.coordinates.len()))
        .collect();
    assert_eq!(
        sizes,
        [
            ("in_phase", 3),
            ("arm_2_d", 2),
            ("arm_3_1_d", 1),
            ("arm_3_2_d", 1)
        ]
    );
}
