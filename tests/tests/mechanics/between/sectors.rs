//! Symmetric coordinates, W and budgets of trees with springs and friction between links.

use branched_pendulum::TransferForm;
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, SectorBudget, StateInput, SymmetricTree,
};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Coupling, Recipe, coupled_sample};
use branched_pendulum_tests::samples::seeds;
use branched_pendulum_trees::PendulumTree;

use crate::support::{Compiled, Worst, compile};

/// The tree at run time without what it is not asked for.
pub(super) fn at_run_time(text: &str) -> PendulumTree {
    let (text, _) = text.rsplit_once("emit(").expect("it asks for something");
    PendulumTree::parse(text).expect("the compiler takes it")
}

fn has_copies(text: &str) -> bool {
    text.contains("] * ") || text.contains(") * ")
}

/// Accelerations and energies of flat and nested trees, coupled in any way.
#[test]
fn symmetric_coordinates_describe_the_same_motion() {
    let [mut accelerations, mut energies] = [(); 2].map(|()| Worst::default());
    let (mut flat, mut nested) = (0, 0);
    let seeds = seeds(32);
    for seed in seeds.clone() {
        let recipe = Recipe {
            links: 3 + seed as usize % 6,
            copies: [&[2][..], &[1, 2, 3]][seed as usize % 2],
            nested: seed % 2 == 0,
            requests: "energies, momenta, symmetric",
        };
        let sample = coupled_sample(&recipe, 5_000 + seed, Coupling::Any);
        if !has_copies(&sample.text) {
            continue;
        }
        let compiled = compile(&sample.text);
        let is_nested = compiled.mechanics.sectors.is_some();
        nested += u64::from(is_nested);
        flat += u64::from(!is_nested);
        let tree = at_run_time(&sample.text);
        let n = tree.links();
        let mut random = Random::new(seed);
        for state in 0..20 {
            let place = || format!("tree {seed}, state {state}");
            let (q, v) = (random.around_zero(n, 2.0), random.around_zero(n, 3.0));
            let [mut theta, mut omega] = [(); 2].map(|()| vec![0.0; n]);
            for (own, absolute) in [(&q, &mut theta), (&v, &mut omega)] {
                tree.absolute_from_symmetric(Normalisation::Plain, own, absolute);
            }
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected).max();
            let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
            let mut absolute = vec![0.0; n];
            tree.absolute_from_symmetric(Normalisation::Plain, &found, &mut absolute);
            for link in 0..n {
                accelerations.note(absolute[link] - expected[link], sensitivity, place);
            }
            let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
            let energy = compiled.evaluate("hamiltonian", &[&q, &p])[0];
            let terms = motion.kinetic_terms + motion.potential_terms;
            energies.note(energy - motion.kinetic - motion.potential, terms, place);
        }
    }
    let all = seeds.end;
    assert!(8 * flat > all && 8 * nested > all, "{flat} {nested}");
    accelerations.assert_below(1e-11, "accelerations");
    energies.assert_below(1e-12, "energies");
}

pub(super) const DEFINITIONS: [(EnergyDefinition, &str); 4] = [
    (EnergyDefinition::Rest, "budget_rest"),
    (EnergyDefinition::Canonical, "budget_canonical"),
    (EnergyDefinition::Parseval, "budget_parseval"),
    (EnergyDefinition::Velocity, "budget_velocity"),
];

/// Σ κ |φ φ̇| over all springs: terms of the transfers that cancel in their sums.
fn spring_flows(tree: &PendulumTree, bodies: &Tree, [q, v]: [&[f64]; 2]) -> f64 {
    let [mut theta, mut omega] = [(); 2].map(|()| vec![0.0; q.len()]);
    tree.absolute_from_symmetric(Normalisation::Plain, q, &mut theta);
    tree.absolute_from_symmetric(Normalisation::Plain, v, &mut omega);
    let flow = |spring: f64, a: usize, b: Option<usize>| {
        let [angle, rate] = [&theta, &omega].map(|own| own[a] - b.map_or(0.0, |b| own[b]));
        spring * (angle * rate).abs()
    };
    let links = bodies.links.iter().enumerate();
    let joints = links.map(|(link, own)| flow(own.spring, link, own.parent));
    let between = bodies.between.iter();
    let between = between.map(|own| flow(own.spring, own.links[0], Some(own.links[1])));
    joints.chain(between).sum()
}

pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// Deviations of compiled budgets from those of trees at run time.
#[derive(Default)]
pub(super) struct Budgets {
    energies: Worst,
    transfers: Worst,
    powers: Worst,
}

impl Budgets {
    /// Compares all definitions of the energy, and the transfer matrix.
    pub(super) fn compare(
        &mut self,
        compiled: &Compiled,
        tree: &SymmetricTree<f64>,
        [theta, omega]: [&[f64]; 2],
        place: &str,
    ) {
        let (given, count) = (StateInput::Absolute { theta, omega }, tree.sectors().len());
        let (mut workspace, mut budget) = (Workspace::new(), SectorBudget::new());
        let mut compared = Vec::new();
        for (definition, entry) in DEFINITIONS {
            let place = || format!("{entry}, {place}");
            let derived = compiled.evaluate(entry, &[theta, omega]);
            let acting = [NonConservative::Friction];
            tree.budget(&mut workspace, definition, &acting, given, &mut budget);
            let (own, rest) = derived.split_at(count);
            let (transfers, braked) = rest.split_at(count);
            for (found, own) in budget.energies.iter().zip(own) {
                let size = largest(&budget.energies);
                self.energies.note(found - own, size, place);
            }
            compared.push((budget.transfers.clone(), transfers.to_vec()));
            let size = largest(&budget.powers);
            for (found, own) in budget.powers.iter().zip(braked) {
                self.powers.note(found - own, size, place);
            }
        }
        let derived = compiled.evaluate("sector_transfer_matrix", &[theta, omega]);
        let mut own = vec![0.0; count * count];
        tree.transfer_matrix(&mut workspace, given, &mut own);
        compared.push((own, derived));
        let size = compared
            .iter()
            .fold(0.0, |size: f64, (own, _)| size.max(largest(own)));
        for (own, derived) in &compared {
            assert_eq!(own.len(), derived.len());
            for (own, derived) in own.iter().zip(derived) {
                self.transfers
                    .note(own - derived, size, || place.to_owned());
            }
        }
    }

    pub(super) fn assert_alike(&self) {
        self.energies.assert_below(1e-13, "energies");
        self.transfers.assert_below(1e-13, "transfers");
        self.powers.assert_below(1e-12, "powers");
    }
}

/// Energies of sectors, transfers and powers, with springs between all copies of nodes and
/// friction between any links; in phase, all of every difference is exactly zero.
#[test]
fn budgets_are_those_of_trees_at_run_time() {
    let (mut budgets, mut orders) = (Budgets::default(), Worst::default());
    let (mut trees, mut nested, mut with_springs) = (0, 0, 0);
    let seeds = seeds(30);
    for seed in seeds.clone() {
        let recipe = Recipe {
            links: 3 + seed as usize % 6,
            copies: [&[2][..], &[1, 2, 3], &[2, 3]][seed as usize % 3],
            nested: true,
            requests: "budget(rest, canonical, parseval, velocity, matrix, amplitude = 2)",
        };
        let sample = coupled_sample(&recipe, 6_000 + seed, Coupling::Symmetric);
        if !has_copies(&sample.text) {
            continue;
        }
        let compiled = compile(&sample.text);
        let whole = at_run_time(&sample.text);
        let tree = whole.symmetric().expect("it has copies");
        trees += 1;
        with_springs += u64::from(sample.tree.between.iter().any(|own| own.spring > 0.0));
        let sectors = tree.sectors();
        nested += u64::from(
            sectors
                .iter()
                .skip(1)
                .any(|own| own.coordinates().len() > 1),
        );
        let (n, count) = (tree.links(), sectors.len());
        let (mut random, mut workspace) = (Random::new(seed), Workspace::new());
        for state in 0..3 {
            let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 5.0));
            let place = format!("state {state} of tree {seed}");
            budgets.compare(&compiled, &tree, [&theta, &omega], &place);
            let (q, v) = (random.around_zero(n, 0.8), random.around_zero(n, 1.0));
            let rates = StateInput::Rates {
                coordinates: &q,
                rates: &v,
            };
            let mut p = vec![0.0; n];
            tree.momenta(&mut workspace, rates, &mut p);
            let derived = compiled.evaluate("sector_transfers_amplitude_2", &[&q, &p]);
            let given = StateInput::Momenta {
                coordinates: &q,
                momenta: &p,
            };
            let mut own = vec![Transfer::default(); count];
            tree.transfers(&mut workspace, TransferForm::Amplitude(2), given, &mut own);
            let own: Vec<f64> = own.iter().flat_map(|w| [w.kinetic, w.potential]).collect();
            let size = largest(&own) + spring_flows(&whole, &sample.tree, [&q, &v]);
            for (own, derived) in own.iter().zip(&derived) {
                orders.note(own - derived, size, || {
                    format!("state {state} of tree {seed}")
                });
            }
        }
    }
    let all = seeds.end;
    assert!(
        3 * trees > 2 * all && 9 * nested > all && 9 * with_springs > 2 * all,
        "{trees} {nested} {with_springs}"
    );
    budgets.assert_alike();
    orders.assert_below(1e-13, "second order");
}

/// Springs between links of one sector, and springs that leave the sectors uncoupled together.
const WITHIN_SECTORS: [&str; 4] = [
    "a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.3, length = 0.4) [
        c: rod(mass = 0.2, length = 0.3) [d: rod(mass = 0.1, length = 0.2) * 2]]],
        between(a, c, spring = 0.7, rest = 0.3, friction = 1e-3)",
    "a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.3, length = 0.4) [
        c: rod(mass = 0.2, length = 0.3) [d: rod(mass = 0.1, length = 0.2)]] * 2],
        between(b_1, d_1, spring = 0.7), between(b_2, d_2, spring = 0.7),
        between(c_1, c_2, friction = 1e-3)",
    "a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.3, length = 0.4) * 3],
        between(b_1, b_2, spring = 0.7), between(b_2, b_3, spring = 0.7),
        between(b_3, b_1, spring = 0.7)",
    "a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.3, length = 0.4) [
        c: rod(mass = 0.2, length = 0.3) * 2] * 2],
        between(b_1, c_1_1, spring = 0.7), between(b_1, c_1_2, spring = 0.7),
        between(b_2, c_2_1, spring = 0.7), between(b_2, c_2_2, spring = 0.7),
        between(c_1_1, c_2_1, spring = 0.2), between(c_1_2, c_2_2, spring = 0.2),
        between(c_1_1, c_2_2, spring = 0.2), between(c_1_2, c_2_1, spring = 0.2)",
];

/// The energies of the sectors have all of the springs' energy, and the transfers are those of
/// trees at run time.
#[test]
fn springs_within_sectors_are_theirs() {
    let (mut budgets, mut energies) = (Budgets::default(), Worst::default());
    for text in WITHIN_SECTORS {
        let (links, _) = text
            .split_once(",\n        between")
            .expect("it has springs");
        let requests = "emit(budget(rest, canonical, parseval, velocity, matrix))";
        let [coupled, free] = [text, links].map(|own| format!("gravity = 9.81, {own}, {requests}"));
        let [with, without] = [&coupled, &free].map(|text| compile(text));
        let [whole, bare] = [&coupled, &free].map(|text| at_run_time(text));
        let tree = whole.symmetric().expect("no spring couples its sectors");
        let (n, count) = (tree.links(), tree.sectors().len());
        let mut random = Random::new(7);
        for state in 0..5 {
            let (theta, omega) = (random.around_zero(n, 2.0), random.around_zero(n, 3.0));
            let place = format!("state {state} of {text}");
            budgets.compare(&with, &tree, [&theta, &omega], &place);
            let stored = whole.potential_energy_of(&theta) - bare.potential_energy_of(&theta);
            for (_, entry) in DEFINITIONS {
                let [own, bare] =
                    [&with, &without].map(|own| own.evaluate(entry, &[&theta, &omega]));
                let sum = |values: &[f64]| values[..count].iter().sum::<f64>();
                energies.note(
                    sum(&own) - sum(&bare) - stored,
                    largest(&own[..count]),
                    || format!("{entry}, {place}"),
                );
            }
        }
    }
    budgets.assert_alike();
    energies.assert_below(1e-13, "energies of the springs");
}

/// W and H_d of pairs and triples, every form, with a spring and every law of friction between
/// the copies.
#[test]
fn transfers_into_leaves_are_those_of_trees_at_run_time() {
    let forms = "transfer(angle = 1, amplitude = 2, amplitude = 4, exact)";
    let [mut energies, mut worst, mut powers] = [(); 3].map(|()| Worst::default());
    for copies in [2, 3] {
        let text = format!(
            "gravity = 9.80665,
            parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, spring = 0.01) * {copies}
            ],
            siblings(child, spring = 0.02,
                friction(viscous = 1e-3, coulomb = 2e-3, quadratic = 1e-4, width = 0.2)),
            emit({forms})"
        );
        let compiled = compile(&text);
        let tree = at_run_time(&text).symmetric().expect("it has copies");
        let n = tree.links();
        let mut random = Random::new(17);
        for _ in 0..20 {
            let (q, p) = (random.around_zero(n, 0.8), random.around_zero(n, 0.02));
            let given = StateInput::Momenta {
                coordinates: &q,
                momenta: &p,
            };
            let workspace = &mut Workspace::new();
            let mut split = vec![[0.0; 2]; tree.sectors().len()];
            tree.energies(workspace, given, &mut split);
            let mut braked = vec![0.0; tree.sectors().len()];
            tree.powers(workspace, NonConservative::Friction, given, &mut braked);
            for (sector, own) in tree.sectors().iter().enumerate().skip(1) {
                let end = match copies {
                    2 => String::new(),
                    _ => format!("_{}", own.name()),
                };
                let place = || format!("{copies} copies{end}");
                let [kinetic, potential] = split[sector];
                let inputs: [&[f64]; 2] = [&q, &p];
                let energy = compiled.evaluate(&format!("antiphase_energy{end}"), &inputs)[0];
                energies.note(kinetic + potential - energy, energy, place);
                let power =
                    compiled.evaluate(&format!("antiphase_friction_power{end}"), &inputs)[0];
                assert!(power < 0.0, "{power}");
                powers.note(braked[sector] - power, power, place);
                let mut compared = Vec::new();
                for (form, stem) in [
                    (TransferForm::Exact, "transfer_exact"),
                    (TransferForm::Angle(1), "transfer_angle_1"),
                    (TransferForm::Amplitude(2), "transfer_amplitude_2"),
                    (TransferForm::Amplitude(4), "transfer_amplitude_4"),
                ] {
                    let derived = compiled.evaluate(&format!("{stem}{end}"), &inputs);
                    let mut all = vec![Transfer::default(); tree.sectors().len()];
                    tree.transfers(workspace, form, given, &mut all);
                    let own = [all[sector].kinetic, all[sector].potential];
                    compared.extend(own.into_iter().zip(derived));
                }
                let all: Vec<f64> = compared.iter().map(|(own, _)| *own).collect();
                let size = largest(&all);
                for (own, derived) in compared {
                    worst.note(own - derived, size, place);
                }
            }
        }
    }
    energies.assert_below(1e-13, "H_d");
    powers.assert_below(1e-12, "powers");
    worst.assert_below(1e-13, "transfers");
}

/// What acts between copies leaves a motion in phase as it is, to the bit, and what differs by
/// nothing does not begin to.
#[test]
fn copies_in_phase_stay_so() {
    let free = "gravity = 9.80665,
        a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35) [
            c: rod(mass = 0.1, length = 0.2) * 4] * 3]";
    let acts = "spring = 0.3, friction(viscous = 0.01, coulomb = 0.1, quadratic = 0.01)";
    let coupled = format!("{free}, siblings(b, {acts}), siblings(c, {acts}), emit(symmetric)");
    let [free, coupled] = [format!("{free}, emit(symmetric)"), coupled].map(|text| compile(&text));
    let n = free.scene.links.len();
    let mut random = Random::new(3);
    for _ in 0..20 {
        let (mut q, mut v) = (random.around_zero(n, 2.0), random.around_zero(n, 3.0));
        // Means, and the differences of `b` of number 2 with what hangs from it.
        let in_phase = |index: usize| index >= 3;
        for index in (0..n).filter(|&index| in_phase(index)) {
            (q[index], v[index]) = (0.0, 0.0);
        }
        let [own, other] =
            [&coupled, &free].map(|tree| tree.evaluate("symmetric_accelerations", &[&q, &v]));
        assert!(own[3..].iter().all(|alpha| *alpha == 0.0), "{own:?}");
        assert_eq!(own, other);
        // One difference alone wakes none that the symmetry forbids.
        let (last, rate) = (random.around_zero(1, 1.0)[0], random.around_zero(1, 1.0)[0]);
        (q[n - 1], v[n - 1]) = (last, rate);
        let own = coupled.evaluate("symmetric_accelerations", &[&q, &v]);
        let other = free.evaluate("symmetric_accelerations", &[&q, &v]);
        for (index, (own, other)) in own.iter().zip(other).enumerate() {
            assert_eq!(*own == 0.0, other == 0.0, "{index}");
        }
    }
}
