//! Symmetric coordinates of random trees with identical siblings, against the
//! absolute angles and the Cartesian derivation.

use std::sync::LazyLock;

use branched_pendulum_codegen::scene::coordinates::CoordinateKind;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, Sample, sample};
use nalgebra::{DMatrix, DVector};

use crate::fixtures::TRIPLE;
use crate::support::{Compiled, Worst, compile, compile_item, compile_paper};

const STATES: usize = 100;

/// A random tree with its transform: θ = J q, q = T θ.
struct Symmetric {
    sample: Sample,
    compiled: Compiled,
    j: DMatrix<f64>,
    t: DMatrix<f64>,
}

/// Eight trees with pairs, triples and fourfold leaves, four with nested
/// groups.
static SAMPLES: LazyLock<Vec<Symmetric>> = LazyLock::new(|| {
    (0..12)
        .map(|seed| {
            let recipe = Recipe {
                links: if seed < 8 { 9 } else { 10 },
                copies: if seed < 8 { &[1, 2, 3, 4] } else { &[2, 2, 3] },
                nested: seed >= 8,
                requests: "energies, momenta, symmetric",
            };
            let sample = sample(&recipe, 100 + seed);
            let compiled = compile(&sample.text);
            let n = sample.tree.links.len();
            let columns = |entry: &str| {
                let columns: Vec<DVector<f64>> = (0..n)
                    .map(|k| {
                        let mut unit = vec![0.0; n];
                        unit[k] = 1.0;
                        DVector::from_vec(compiled.evaluate(entry, &[&unit]))
                    })
                    .collect();
                DMatrix::from_columns(&columns)
            };
            let (j, t) = (columns("from_symmetric"), columns("to_symmetric"));
            Symmetric {
                sample,
                compiled,
                j,
                t,
            }
        })
        .collect()
});

/// A state in symmetric coordinates with what the oracles say of it.
struct State {
    q: DVector<f64>,
    v: DVector<f64>,
    motion: Motion,
    place: String,
}

impl Symmetric {
    fn state(&self, q: Vec<f64>, v: Vec<f64>, place: String) -> State {
        let (q, v) = (DVector::from_vec(q), DVector::from_vec(v));
        let (theta, omega) = (&self.j * &q, &self.j * &v);
        let motion = Motion::new(&self.sample.tree, theta.as_slice(), omega.as_slice());
        State {
            q,
            v,
            motion,
            place,
        }
    }

    /// M̃⁻¹ = T M⁻¹ Tᵀ.
    fn inverse_mass(&self, motion: &Motion) -> DMatrix<f64> {
        &self.t * motion.inverse_mass() * self.t.transpose()
    }

    /// |Jᵀ| |M| |J|, with the terms of M.
    fn mass_terms(&self, motion: &Motion) -> DMatrix<f64> {
        self.j.abs().transpose() * &motion.mass_terms * self.j.abs()
    }
}

/// Random states of all samples.
fn states(seed: u64) -> impl Iterator<Item = (&'static Symmetric, State)> {
    SAMPLES.iter().enumerate().flat_map(move |(number, tree)| {
        let mut random = Random::new(seed + number as u64);
        let n = tree.j.nrows();
        (0..STATES).map(move |count| {
            let (q, v) = (random.around_zero(n, 1.5), random.around_zero(n, 5.0));
            (
                tree,
                tree.state(q, v, format!("tree {number}, state {count}")),
            )
        })
    })
}

fn note_all(
    worst: &mut Worst,
    found: &[f64],
    expected: &DVector<f64>,
    scale: &DVector<f64>,
    place: &str,
) {
    assert_eq!(found.len(), expected.len());
    for (index, found) in found.iter().enumerate() {
        worst.note(found - expected[index], scale[index], || {
            format!("{place}, component {index}")
        });
    }
}

#[test]
fn the_samples_are_rich() {
    let sizes: Vec<usize> = SAMPLES
        .iter()
        .flat_map(|tree| tree.compiled.scene.groups.iter().map(|g| g.copies.len()))
        .collect();
    for size in 2..=4 {
        assert!(sizes.contains(&size), "no group of {size}");
    }
    let nested = SAMPLES.iter().filter(|tree| {
        let scene = &tree.compiled.scene;
        let copies = || scene.groups.iter().flat_map(|group| &group.copies);
        copies().any(|copy| scene.groups.iter().any(|group| group.parent == Some(*copy)))
    });
    assert!(nested.count() >= 2);
}

/// Physics §3, in so many words: mean and half difference of a pair, and for
/// three copies the mean and two orthogonal differences.
#[test]
fn coordinates_of_a_pair_and_of_a_triple() {
    let pair = compile_paper();
    assert_eq!(
        pair.evaluate("to_symmetric", &[&[5.0, 3.0, 1.0]]),
        [5.0, 2.0, 1.0]
    );
    let triple = compile_item(TRIPLE);
    let names: Vec<&str> = triple
        .mechanics
        .coordinates
        .iter()
        .map(|coordinate| coordinate.name.as_str())
        .collect();
    assert_eq!(names, ["parent", "m", "other", "d1", "d2"]);
    // Parent, three children, the other one; mean 6, (9 − 3)/2, (9 + 3 − 12)/6.
    let found = triple.evaluate("to_symmetric", &[&[7.0, 9.0, 3.0, 6.0, 8.0]]);
    assert_eq!(found, [7.0, 6.0, 8.0, 3.0, 0.0]);
}

/// T J = 1, and the columns of J are orthogonal integers.
#[test]
fn transforms_are_inverse_to_each_other() {
    let mut worst = Worst::default();
    for (number, tree) in SAMPLES.iter().enumerate() {
        let n = tree.j.nrows();
        let gram = tree.j.transpose() * &tree.j;
        for row in 0..n {
            for column in 0..n {
                assert!(row == column || gram[(row, column)] == 0.0);
                assert_eq!(tree.j[(row, column)].fract(), 0.0);
            }
        }
        let identity = &tree.t * &tree.j;
        let difference = identity - DMatrix::identity(n, n);
        worst.note(difference.amax(), 1.0, || format!("tree {number}"));
    }
    for (tree, state) in states(10) {
        let theta = tree
            .compiled
            .evaluate("from_symmetric", &[state.q.as_slice()]);
        let back = tree.compiled.evaluate("to_symmetric", &[&theta]);
        let scale = tree.t.abs() * (tree.j.abs() * state.q.abs());
        note_all(&mut worst, &back, &state.q, &scale, &state.place);
    }
    worst.assert_below(1e-15, "transforms");
}

/// q̈ = T θ̈ with θ̈ from the Cartesian derivation, relative to the problem's
/// conditioning in symmetric coordinates: |M̃⁻¹| |Jᵀ| (|M| |J| |q̈| + |b|).
#[test]
fn accelerations_are_transformed_ones() {
    let mut worst = Worst::default();
    for (tree, state) in states(20) {
        let expected = &tree.t * state.motion.accelerations();
        let residual =
            &state.motion.mass_terms * (tree.j.abs() * expected.abs()) + &state.motion.bias_terms;
        let scale = tree.inverse_mass(&state.motion).abs() * (tree.j.abs().transpose() * residual);
        let inputs = [state.q.as_slice(), state.v.as_slice()];
        let found = tree.compiled.evaluate("symmetric_accelerations", &inputs);
        note_all(&mut worst, &found, &expected, &scale, &state.place);
    }
    worst.assert_below(1e-12, "symmetric accelerations");
}

/// p = Jᵀ M J q̇ with M from the Cartesian derivation, and back.
#[test]
fn momenta_and_velocities() {
    let mut forth = Worst::default();
    let mut back = Worst::default();
    for (tree, state) in states(30) {
        let expected = tree.j.transpose() * (&state.motion.mass * (&tree.j * &state.v));
        let scale = tree.mass_terms(&state.motion) * state.v.abs();
        let inputs = [state.q.as_slice(), state.v.as_slice()];
        let momenta = tree.compiled.evaluate("symmetric_momenta", &inputs);
        note_all(&mut forth, &momenta, &expected, &scale, &state.place);
        let inputs = [state.q.as_slice(), momenta.as_slice()];
        let found = tree.compiled.evaluate("symmetric_velocities", &inputs);
        let scale = tree.inverse_mass(&state.motion).abs() * scale;
        note_all(&mut back, &found, &state.v, &scale, &state.place);
    }
    forth.assert_below(1e-14, "symmetric momenta");
    back.assert_below(1e-14, "symmetric velocities");
}

/// p = M ω in absolute angles, and back.
#[test]
fn absolute_momenta_and_velocities() {
    let mut forth = Worst::default();
    let mut back = Worst::default();
    for (tree, state) in states(40) {
        let (theta, omega) = (&tree.j * &state.q, &tree.j * &state.v);
        let expected = &state.motion.mass * &omega;
        let scale = &state.motion.mass_terms * omega.abs();
        let inputs = [theta.as_slice(), omega.as_slice()];
        let momenta = tree.compiled.evaluate("momenta", &inputs);
        note_all(&mut forth, &momenta, &expected, &scale, &state.place);
        let inputs = [theta.as_slice(), momenta.as_slice()];
        let found = tree.compiled.evaluate("velocities", &inputs);
        let scale = state.motion.inverse_mass().abs() * scale;
        note_all(&mut back, &found, &omega, &scale, &state.place);
    }
    forth.assert_below(1e-14, "momenta");
    back.assert_below(1e-14, "velocities");
}

/// H = K + U, with both from Cartesian velocities and heights. Momenta carry
/// the rounding of all terms of M̃ q̇, and H that of q̇ᵀ p.
#[test]
fn hamiltonian_is_the_energy() {
    let mut worst = Worst::default();
    for (tree, state) in states(50) {
        let inputs = [state.q.as_slice(), state.v.as_slice()];
        let momenta = tree.compiled.evaluate("symmetric_momenta", &inputs);
        let inputs = [state.q.as_slice(), momenta.as_slice()];
        let found = tree.compiled.evaluate("hamiltonian", &inputs)[0];
        let expected = state.motion.kinetic + state.motion.potential;
        let kinetic = state
            .v
            .abs()
            .dot(&(tree.mass_terms(&state.motion) * state.v.abs()));
        let scale = kinetic + state.motion.potential_terms;
        worst.note(found - expected, scale, || state.place.clone());
    }
    worst.assert_below(1e-14, "Hamiltonian");
}

/// The sector of a coordinate: the means, or one difference of one group.
pub(crate) fn sector(kind: &CoordinateKind) -> Option<(usize, usize)> {
    match kind {
        CoordinateKind::Mean { .. } => None,
        CoordinateKind::Difference { group, index, .. } => Some((*group, *index)),
    }
}

/// In-phase states of all samples, 10 of each.
fn in_phase_states(seed: u64) -> impl Iterator<Item = (&'static Symmetric, Vec<f64>, Vec<f64>)> {
    SAMPLES.iter().enumerate().flat_map(move |(number, tree)| {
        let mut random = Random::new(seed + number as u64);
        let coordinates = &tree.compiled.mechanics.coordinates;
        (0..10).map(move |_| {
            let mut in_phase = |size: f64| -> Vec<f64> {
                coordinates
                    .iter()
                    .map(|coordinate| match sector(&coordinate.kind) {
                        None => random.between(-size, size),
                        Some(_) => 0.0,
                    })
                    .collect()
            };
            let q = in_phase(3.0);
            (tree, q, in_phase(8.0))
        })
    })
}

/// At in-phase states M̃ has exact zeros between sectors, and the differences
/// of a group have the same block up to their norms (physics §3).
#[test]
fn the_mass_matrix_is_block_diagonal_in_phase() {
    let mut worst = Worst::default();
    let mut compared = 0;
    for (tree, q, _) in in_phase_states(60) {
        let coordinates = &tree.compiled.mechanics.coordinates;
        let n = q.len();
        let rows: Vec<Vec<f64>> = (0..n)
            .map(|k| {
                let mut unit = vec![0.0; n];
                unit[k] = 1.0;
                tree.compiled.evaluate("symmetric_momenta", &[&q, &unit])
            })
            .collect();
        let members = |wanted: Option<(usize, usize)>| -> Vec<usize> {
            (0..n)
                .filter(|&i| sector(&coordinates[i].kind) == wanted)
                .collect()
        };
        for (i, row) in rows.iter().enumerate() {
            let own = sector(&coordinates[i].kind);
            for (k, &entry) in row.iter().enumerate() {
                let inside = own == sector(&coordinates[k].kind);
                assert!(
                    inside || entry == 0.0,
                    "M[{}, {}] = {entry:e} in {}",
                    coordinates[i].name,
                    coordinates[k].name,
                    tree.sample.text
                );
            }
            let Some((group, index)) = own else { continue };
            // This place in the block of the group's first difference.
            let position = members(own).iter().position(|&m| m == i);
            let position = position.expect("a coordinate is in its sector");
            let first = members(Some((group, 1)));
            let ratio = (index * (index + 1)) as f64 / 2.0;
            for (place, &k) in members(own).iter().enumerate() {
                let expected = ratio * rows[first[position]][first[place]];
                let scale = (rows[i][i] * rows[k][k]).sqrt();
                worst.note(row[k] - expected, scale, || {
                    format!("group {group}, difference {index}")
                });
                compared += usize::from(index > 1);
            }
        }
    }
    assert!(compared > 100);
    worst.assert_below(1e-15, "blocks");
}
