//! Energies of sectors and the transfers between them at run time, against the programs that
//! the compiler derives for each tree.

use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, SectorBudget, StateInput, SymmetricTree,
};
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::generator::{Recipe, braked_sample, sample};
use branched_pendulum_tests::samples::seeds;
use branched_pendulum_trees::PendulumTree;

use super::driven_tree::driven_tree;
use crate::support::{Compiled, Worst, compile};

const DEFINITIONS: [(EnergyDefinition, &str); 4] = [
    (EnergyDefinition::Rest, "budget_rest"),
    (EnergyDefinition::Canonical, "budget_canonical"),
    (EnergyDefinition::Parseval, "budget_parseval"),
    (EnergyDefinition::Velocity, "budget_velocity"),
];

/// A tree at run time without what it is not asked for, in symmetric coordinates.
fn symmetric(text: &str) -> SymmetricTree<f64> {
    let (text, _) = text.rsplit_once("emit(").expect("it asks for something");
    let tree = PendulumTree::parse(text).expect("the compiler takes it");
    tree.symmetric().expect("it has copies")
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

fn parts(transfers: &[Transfer<f64>]) -> Vec<f64> {
    let parts = transfers.iter().map(|w| [w.kinetic, w.potential]);
    parts.flatten().collect()
}

/// W into all sectors by a form.
fn transfers(
    tree: &SymmetricTree<f64>,
    form: TransferForm,
    given: StateInput<'_, f64>,
) -> Vec<f64> {
    let mut transfers = vec![Transfer::default(); tree.sectors().len()];
    tree.transfers(&mut Workspace::new(), form, given, &mut transfers);
    parts(&transfers)
}

/// Notes each difference by the largest of the values.
fn compare(worst: &mut Worst, own: &[f64], derived: &[f64], place: impl Fn() -> String) {
    assert_eq!(own.len(), derived.len(), "{}", place());
    let size = largest(derived);
    for (own, derived) in own.iter().zip(derived) {
        worst.note(own - derived, size, &place);
    }
}

/// Notes each difference by the largest of all values.
fn compare_all(worst: &mut Worst, all: &[(Vec<f64>, Vec<f64>)], place: impl Fn() -> String) {
    let sizes = all.iter().map(|(_, derived)| largest(derived));
    let size = sizes.fold(0.0, f64::max);
    for (own, derived) in all {
        assert_eq!(own.len(), derived.len(), "{}", place());
        for (own, derived) in own.iter().zip(derived) {
            if size > 0.0 || own != derived {
                worst.note(own - derived, size, &place);
            }
        }
    }
}

/// Nested copies with springs, lateral offsets and friction of all kinds, every second tree
/// without friction that is not viscous.
#[test]
fn budgets_of_random_trees_agree_with_their_programs() {
    let [mut energies, mut transfers_of] = [(); 2].map(|()| Worst::default());
    let [mut powers, mut accelerated] = [(); 2].map(|()| Worst::default());
    let (mut trees, mut nested) = (0, 0);
    let seeds = seeds(40);
    for seed in seeds.clone() {
        let recipe = Recipe {
            links: 3 + seed as usize % 6,
            copies: [&[2][..], &[1, 2, 3], &[2, 3]][seed as usize % 3],
            nested: true,
            requests: "budget(rest, canonical, parseval, velocity, matrix)",
        };
        let sample = match seed % 2 {
            0 => sample(&recipe, 9_000 + seed),
            _ => braked_sample(&recipe, 9_000 + seed),
        };
        if !sample.text.contains("] * ") && !sample.text.contains(") * ") {
            continue;
        }
        let (compiled, tree) = (compile(&sample.text), symmetric(&sample.text));
        let sectors = tree.sectors();
        let expected = compiled.mechanics.sectors.as_ref().expect("asked for");
        let names = expected.sectors.iter().map(|sector| &sector.name);
        assert!(sectors.iter().map(|own| own.name()).eq(names));
        trees += 1;
        nested += u64::from(
            sectors
                .iter()
                .skip(1)
                .any(|own| own.coordinates().len() > 1),
        );
        let (n, count) = (tree.links(), sectors.len());
        let (mut random, mut workspace) = (Random::new(seed), Workspace::new());
        let mut budget = SectorBudget::new();
        for state in 0..3 {
            let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 5.0));
            let inputs: [&[f64]; 2] = [&theta, &omega];
            let given = StateInput::Absolute {
                theta: &theta,
                omega: &omega,
            };
            let (mut flows, mut forces) = (Vec::new(), [Vec::new(), Vec::new()]);
            for (definition, entry) in DEFINITIONS {
                let place = || format!("{entry}, state {state} of tree {seed}");
                let derived = compiled.evaluate(entry, &inputs);
                let acting = [NonConservative::Friction];
                tree.budget(&mut workspace, definition, &acting, given, &mut budget);
                compare(&mut energies, &budget.energies, &derived[..count], place);
                let (transfers, rest) = derived[count..].split_at(count);
                flows.push((budget.transfers.clone(), transfers.to_vec()));
                let by_accelerations = ["budget_parseval", "budget_velocity"].contains(&entry);
                forces[usize::from(by_accelerations)].push((budget.powers.clone(), rest.to_vec()));
            }
            let place = || format!("state {state} of tree {seed}");
            let derived = compiled.evaluate("sector_transfers", &inputs);
            flows.push((transfers(&tree, TransferForm::Exact, given), derived));
            let derived = compiled.evaluate("sector_transfer_matrix", &inputs);
            let mut own = vec![0.0; count * count];
            tree.transfer_matrix(&mut workspace, given, &mut own);
            for (place, entry) in own.iter().enumerate() {
                assert_eq!(*entry, -own[place % count * count + place / count]);
            }
            flows.push((own, derived));
            // What the sectors exchange are the parts of what each one gets.
            compare_all(&mut transfers_of, &flows, place);
            compare_all(&mut powers, &forces[0], place);
            compare_all(&mut accelerated, &forces[1], place);
        }
    }
    let all = seeds.end;
    assert!(
        13 * trees >= 10 * all && 26 * nested > 3 * all,
        "{trees} {nested}"
    );
    energies.assert_below(1e-13, "energies");
    transfers_of.assert_below(1e-13, "transfers");
    powers.assert_below(1e-13, "powers");
    // What forces do to velocities comes from a solve, and has its conditioning.
    accelerated.assert_below(1e-12, "powers on energies from velocities");
}

/// What a compiled model and a tree at run time say of a difference of leaves.
struct Leaf<'a> {
    compiled: &'a Compiled,
    tree: &'a SymmetricTree<f64>,
    /// Number of the sector, and the end of names of functions about it.
    sector: usize,
    place: String,
}

impl<'a> Leaf<'a> {
    fn all(compiled: &'a Compiled, tree: &'a SymmetricTree<f64>) -> Vec<Self> {
        let differences = tree.sectors().iter().enumerate().skip(1);
        let single = tree.sectors().len() == 2;
        let own = differences.map(|(sector, own)| Self {
            compiled,
            tree,
            sector,
            place: match single {
                true => String::new(),
                false => format!("_{}", own.name()),
            },
        });
        own.collect()
    }

    fn derived(&self, stem: &str, inputs: &[&[f64]]) -> Vec<f64> {
        let entry = format!("{stem}{}", self.place);
        self.compiled.evaluate(&entry, inputs)
    }

    fn own(&self, form: TransferForm, given: StateInput<'_, f64>) -> [f64; 2] {
        let all = transfers(self.tree, form, given);
        [all[2 * self.sector], all[2 * self.sector + 1]]
    }

    fn power(&self, acting: NonConservative<'_, f64>, given: StateInput<'_, f64>) -> f64 {
        let mut powers = vec![0.0; self.tree.sectors().len()];
        let workspace = &mut Workspace::new();
        self.tree.powers(workspace, acting, given, &mut powers);
        powers[self.sector]
    }
}

/// H_d, exact W, and the powers of friction, drive and torques from outside, of pairs and
/// triples of equal leaves and of those that differ, from momenta and from rates.
#[test]
fn transfers_into_leaves_agree_with_their_programs() {
    let [mut exact, mut causes, mut energies, mut powers] = [(); 4].map(|()| Worst::default());
    for seed in seeds(12) {
        let differ = seed % 2 == 1;
        let text = driven_tree(seed, differ, "forces, transfer(exact)");
        let (compiled, tree) = (compile(&text), symmetric(&text));
        assert_eq!(tree.has_unequal_copies(), differ);
        let driven = PendulumTree::parse(text.rsplit_once("emit(").expect("asks").0);
        let driven = driven.expect("the compiler takes it");
        let n = tree.links();
        let mut random = Random::new(seed);
        for leaf in Leaf::all(&compiled, &tree) {
            let (q, v) = (random.around_zero(n, 2.0), random.around_zero(n, 5.0));
            let rates = StateInput::Rates {
                coordinates: &q,
                rates: &v,
            };
            let workspace = &mut Workspace::new();
            let mut p = vec![0.0; n];
            tree.momenta(workspace, rates, &mut p);
            let momenta = StateInput::Momenta {
                coordinates: &q,
                momenta: &p,
            };
            let place = || format!("tree {seed}{}", leaf.place);
            let mut all = vec![[0.0; 2]; tree.sectors().len()];
            tree.energies(workspace, momenta, &mut all);
            let [kinetic, potential] = all[leaf.sector];
            let energy = leaf.derived("antiphase_energy", &[&q, &p])[0];
            energies.note(kinetic + potential - energy, energy, place);
            for (given, second, end) in [(momenta, &p, ""), (rates, &v, "_from_rates")] {
                let inputs: [&[f64]; 2] = [&q, second];
                let name = |stem: &str| format!("{stem}{end}");
                let derived = leaf.derived(&name("transfer_exact"), &inputs);
                let own = leaf.own(TransferForm::Exact, given);
                compare(&mut exact, &own, &derived, place);
                if differ {
                    let mut growth = vec![Transfer::default(); tree.sectors().len()];
                    let mut forcing = growth.clone();
                    tree.growth(workspace, given, &mut growth);
                    tree.forcing(workspace, given, &mut forcing);
                    let derived = leaf.derived(&name("transfer_growth"), &inputs);
                    compare(
                        &mut causes,
                        &parts(&growth[leaf.sector..][..1]),
                        &derived,
                        place,
                    );
                    let derived = leaf.derived(&name("transfer_forcing"), &inputs);
                    compare(
                        &mut causes,
                        &parts(&forcing[leaf.sector..][..1]),
                        &derived,
                        place,
                    );
                }
                let time = random.between(0.0, 2.0);
                let torques = random.around_zero(n, 0.1);
                let drive = driven.drive(time).expect("it has one");
                let [coordinates, motion] = inputs;
                for (acting, stem, inputs) in [
                    (
                        NonConservative::Friction,
                        "friction",
                        vec![coordinates, motion],
                    ),
                    (
                        NonConservative::Drive(drive),
                        "drive",
                        vec![&[time], coordinates, motion],
                    ),
                    (
                        NonConservative::Torques(&torques),
                        "outside",
                        vec![coordinates, motion, &torques],
                    ),
                ] {
                    let derived = leaf.derived(&format!("antiphase_{stem}_power{end}"), &inputs);
                    powers.note(leaf.power(acting, given) - derived[0], 1.0, place);
                }
            }
        }
    }
    energies.assert_below(1e-13, "H_d");
    exact.assert_below(1e-13, "exact W");
    causes.assert_below(1e-13, "growth and forcing");
    powers.assert_below(1e-13, "powers");
}

/// Published form, other orders of the angles, and orders 2 to 8 of the amplitude: of leaves by
/// formulas, of nested copies by the compiler's series.
#[test]
fn truncated_transfers_agree_with_their_programs() {
    let few = "transfer(angle = 1, amplitude = 2, amplitude = 3, amplitude = 4, exact)";
    let many = "transfer(angle = 1, angle = 2, angle = 3, amplitude = 2, amplitude = 3, \
                amplitude = 4, amplitude = 5, amplitude = 6, amplitude = 7, amplitude = 8, exact)";
    let sectors = "budget(canonical, angle = 1, angle = 2, amplitude = 2, amplitude = 3, \
                   amplitude = 4)";
    let pair = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, spring = 0.01) * 2
        ],";
    let triple = "gravity = 9.80665,
        trunk: rod(mass = 0.4, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 3],";
    let nested = "gravity = 9.80665,
        body: rod(mass = 0.4, length = 0.3) [
            arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1) * 2] * 2
        ],";
    let mut worst = Worst::default();
    for (scene, requests) in [
        (pair, many),
        (triple, few),
        (triple, sectors),
        (nested, sectors),
    ] {
        let text = format!("{scene} emit({requests})");
        let (compiled, tree) = (compile(&text), symmetric(&text));
        let n = tree.links();
        let mut random = Random::new(17);
        for state in 0..10 {
            let (q, p) = (random.around_zero(n, 0.8), random.around_zero(n, 0.02));
            let given = StateInput::Momenta {
                coordinates: &q,
                momenta: &p,
            };
            let forms = [1, 2, 3].map(|order| (TransferForm::Angle(order), "angle", order));
            let more = [2, 3, 4, 5, 6, 7, 8];
            let more = more.map(|order| (TransferForm::Amplitude(order), "amplitude", order));
            let mut found: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
            for (form, counted, order) in forms.into_iter().chain(more) {
                for leaf in Leaf::all(&compiled, &tree) {
                    let stem = format!("transfer_{counted}_{order}");
                    if compiled
                        .program
                        .entry(&format!("{stem}{}", leaf.place))
                        .is_some()
                    {
                        let derived = leaf.derived(&stem, &[&q, &p]);
                        found.push((leaf.own(form, given).to_vec(), derived));
                    }
                }
                let entry = format!("sector_transfers_{counted}_{order}");
                if compiled.program.entry(&entry).is_some() {
                    let derived = compiled.evaluate(&entry, &[&q, &p]);
                    found.push((transfers(&tree, form, given), derived));
                }
            }
            assert!(found.len() >= 4);
            compare_all(&mut worst, &found, || format!("state {state}, {n} links"));
        }
    }
    worst.assert_below(1e-13, "truncated transfers");
}
