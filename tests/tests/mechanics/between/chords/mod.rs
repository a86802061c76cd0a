//! Straight springs between copies in symmetric coordinates: compiled code against trees at run time,
//! Cartesian lengths, closed forms, and differences along motions.

mod rates;

use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{StateInput, SymmetricTree};
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::PendulumTree;

use super::sectors::{Budgets, at_run_time, largest};
use crate::support::{Worst, compile};

/// The apparatus of the paper with so many children, and what is between them.
fn apparatus(copies: usize, clauses: &str, requests: &str) -> String {
    format!(
        "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * {copies}
        ],
        {clauses},
        emit({requests})"
    )
}

/// Springs off the links' axes, two beside each other, and a torsion spring.
const SIBLINGS: &str = "siblings(child, at = (0.06, 0.02), spring = 3),
    siblings(child, at = 0.04, spring = 2), siblings(child, spring = 0.02)";

/// The end of the names of functions about a sector.
fn ending(copies: usize, sector: &str) -> String {
    match copies {
        2 => String::new(),
        _ => format!("_{sector}"),
    }
}

/// A rubber band off the children's axes.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    siblings(child, at = (0.06, 0.02), spring = 3),
    emit(transfer(exact)),
)]
struct Banded;

/// H_d = p_d²/(4 M) + (G + 2 κ r²) sin² θ_d.
#[test]
fn a_pair_has_the_closed_form() {
    let (stiffness, along, lateral) = (3.0, 0.06, 0.02);
    let clause = format!("siblings(child, at = ({along}, {lateral}), spring = {stiffness})");
    let compiled = compile(&apparatus(2, &clause, "transfer(exact)"));
    let inertia = 0.516e-3 + 0.10531 * 0.043 * 0.043;
    let weight = 0.10531 * 9.80665 * 0.043;
    let fall = weight + 2.0 * stiffness * (along * along + lateral * lateral);
    for (theta_d, p_d) in [(0.7, 2e-3), (1e-3, 1e-6), (-2.0, 0.01)] {
        let (q, p) = ([0.4, -0.3, theta_d], [0.02, -0.004, p_d]);
        let energy = compiled.evaluate("antiphase_energy", &[&q, &p])[0];
        let expected = p_d * p_d / (4.0 * inertia) + fall * f64::sin(theta_d).powi(2);
        assert!((energy - expected).abs() < 1e-13 * expected);
        let emitted = Banded::new();
        assert_eq!(emitted.antiphase_energy(&q, &p), energy);
        let transfer = emitted.transfer_exact(&q, &p);
        let own = compiled.evaluate("transfer_exact", &[&q, &p]);
        assert_eq!([transfer.kinetic, transfer.potential], own[..]);
    }
}

fn w(
    tree: &SymmetricTree<f64>,
    form: TransferForm,
    given: StateInput<'_, f64>,
) -> Vec<Transfer<f64>> {
    let mut all = vec![Transfer::default(); tree.sectors().len()];
    tree.transfers(&mut Workspace::new(), form, given, &mut all);
    all
}

/// H_d and W of pairs, triples and four, every form.
#[test]
fn transfers_into_leaves_are_those_of_trees_at_run_time() {
    let (mut energies, mut worst) = (Worst::default(), Worst::default());
    for copies in [2, 3, 4] {
        let requests = "transfer(angle = 1, angle = 3, amplitude = 2, amplitude = 4, exact)";
        let text = apparatus(copies, SIBLINGS, requests);
        let compiled = compile(&text);
        let tree = at_run_time(&text).symmetric().expect("springs of sectors");
        let n = tree.links();
        let mut random = Random::new(17);
        for _ in 0..20 {
            let (q, p) = (random.around_zero(n, 0.8), random.around_zero(n, 0.02));
            let (given, inputs) = (
                StateInput::Momenta {
                    coordinates: &q,
                    momenta: &p,
                },
                [q.as_slice(), &p],
            );
            let mut split = vec![[0.0; 2]; tree.sectors().len()];
            tree.energies(&mut Workspace::new(), given, &mut split);
            for (sector, own) in tree.sectors().iter().enumerate().skip(1) {
                let end = ending(copies, own.name());
                let place = || format!("{copies} copies{end}");
                let energy = compiled.evaluate(&format!("antiphase_energy{end}"), &inputs)[0];
                energies.note(split[sector].iter().sum::<f64>() - energy, energy, place);
                let mut compared = Vec::new();
                let forms = [
                    (TransferForm::Exact, "transfer_exact"),
                    (TransferForm::Angle(1), "transfer_angle_1"),
                    (TransferForm::Amplitude(2), "transfer_amplitude_2"),
                    (TransferForm::Angle(3), "transfer_angle_3"),
                    (TransferForm::Amplitude(4), "transfer_amplitude_4"),
                ];
                for (form, stem) in forms {
                    let derived = compiled.evaluate(&format!("{stem}{end}"), &inputs);
                    let own = w(&tree, form, given)[sector];
                    compared.extend([own.kinetic, own.potential].into_iter().zip(derived));
                }
                let all: Vec<f64> = compared.iter().map(|(own, _)| *own).collect();
                for (own, derived) in compared {
                    worst.note(own - derived, largest(&all), place);
                }
            }
        }
    }
    energies.assert_below(1e-13, "H_d");
    worst.assert_below(1e-13, "transfers");
}

/// Accelerations and H of flat and nested trees are those under Cartesian lines.
#[test]
fn symmetric_coordinates_describe_the_same_motion() {
    let (mut accelerations, mut energies) = (Worst::default(), Worst::default());
    let flat = apparatus(3, SIBLINGS, "energies, momenta, symmetric");
    let [nested, unequal] =
        [NESTED, UNEQUAL].map(|text| format!("{text}, emit(energies, momenta, symmetric)"));
    for text in [&flat, &nested, &unequal] {
        let (compiled, tree) = (compile(text), at_run_time(text));
        assert_eq!(compiled.mechanics.sectors.is_some(), text == &nested);
        let n = tree.links();
        let mut random = Random::new(11);
        for state in 0..30 {
            let place = || format!("{n} links, state {state}");
            let (q, v) = (random.around_zero(n, 2.0), random.around_zero(n, 3.0));
            let [mut theta, mut omega] = [(); 2].map(|()| vec![0.0; n]);
            tree.absolute_from_symmetric(Normalisation::Plain, &q, &mut theta);
            tree.absolute_from_symmetric(Normalisation::Plain, &v, &mut omega);
            let expected = tree.accelerations(0.0, &theta, &omega);
            let found = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
            let mut absolute = vec![0.0; n];
            tree.absolute_from_symmetric(Normalisation::Plain, &found, &mut absolute);
            for (found, own) in absolute.iter().zip(&expected) {
                accelerations.note(found - own, largest(&expected), place);
            }
            let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
            let energy = compiled.evaluate("hamiltonian", &[&q, &p])[0];
            let whole = tree.energy_of(&theta, &omega);
            energies.note(energy - whole, whole.abs(), place);
        }
    }
    accelerations.assert_below(1e-12, "accelerations");
    energies.assert_below(1e-13, "energies");
}

/// Springs between copies within copies, and between those.
const NESTED: &str = "gravity = 9.81,
    a: rod(mass = 0.4, length = 0.5, spring = 0.3) [
        b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25) * 2] * 3
    ],
    siblings(b, at = (0.3, -0.1), spring = 12), siblings(c, at = 0.2, spring = 5)";

/// Springs between copies that differ, within copies.
const UNEQUAL: &str = "gravity = 9.81,
    a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.2, length = 0.35) [c: rod(mass = each(0.1, 0.12, 0.11), length = 0.25) * 3] * 2
    ],
    siblings(b, at = (0.3, -0.1), spring = 12), siblings(c, at = 0.2, spring = 5)";

/// Springs between the copies under one link alone, clause by clause.
const ONE_FAMILY: &str = "gravity = 9.81,
    a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.2, length = 0.35) [c: rod(mass = 0.1, length = 0.25, com = (0.1, 0.02)) * 3] * 2
    ],
    between(c_1_1, c_1_2, at = 0.2, spring = 5), between(c_1_3, c_1_2, at = 0.2, spring = 5),
    between(c_1_1, c_1_3, at = (0.2, 0), spring = 2), between(c_1_1, c_1_3, at = (0, 0.2), spring = 3)";

/// All definitions of the energy, the transfer matrix, and orders; by Parseval the sectors have all
/// energy of the Cartesian lines.
#[test]
fn budgets_are_those_of_trees_at_run_time() {
    let requests = "budget(rest, canonical, parseval, velocity, matrix, angle = 2, amplitude = 3)";
    let (mut budgets, mut orders) = (Budgets::default(), Worst::default());
    let mut whole = Worst::default();
    let flat = apparatus(3, SIBLINGS, requests);
    for text in [NESTED, ONE_FAMILY]
        .map(|text| format!("{text}, emit({requests})"))
        .iter()
        .chain([&flat])
    {
        let (compiled, lined) = (compile(text), at_run_time(text));
        let tree = lined.symmetric().expect("springs of sectors");
        let (n, count) = (tree.links(), tree.sectors().len());
        let mut random = Random::new(29);
        for state in 0..5 {
            let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 5.0));
            let place = format!("state {state} of {text}");
            budgets.compare(&compiled, &tree, [&theta, &omega], &place);
            let parseval = compiled.evaluate("budget_parseval", &[&theta, &omega]);
            let sum: f64 = parseval[..count].iter().sum();
            let energy = lined.energy_of(&theta, &omega);
            whole.note(sum - energy, energy.abs(), || place.clone());
            let sum: f64 = parseval[count..2 * count].iter().sum();
            whole.note(sum, largest(&parseval[count..2 * count]), || place.clone());

            let (q, v) = (random.around_zero(n, 0.8), random.around_zero(n, 1.0));
            let p = momenta(&tree, &q, &v);
            let given = StateInput::Momenta {
                coordinates: &q,
                momenta: &p,
            };
            for (form, entry) in [
                (TransferForm::Angle(2), "sector_transfers_angle_2"),
                (TransferForm::Amplitude(3), "sector_transfers_amplitude_3"),
            ] {
                let own = w(&tree, form, given);
                let own: Vec<f64> = own.iter().flat_map(|w| [w.kinetic, w.potential]).collect();
                let derived = compiled.evaluate(entry, &[&q, &p]);
                let size = largest(&derived);
                for (own, derived) in own.iter().zip(&derived) {
                    orders.note(own - derived, size, || place.clone());
                }
            }
        }
    }
    budgets.assert_alike();
    orders.assert_below(1e-12, "orders");
    whole.assert_below(1e-13, "sums");
}

fn momenta(tree: &SymmetricTree<f64>, q: &[f64], v: &[f64]) -> Vec<f64> {
    let mut p = vec![0.0; q.len()];
    let given = StateInput::Rates {
        coordinates: q,
        rates: v,
    };
    tree.momenta(&mut Workspace::new(), given, &mut p);
    p
}

/// Copies that differ in their constants have springs of the mean tree's sectors.
#[test]
fn between_copies_that_differ() {
    let (mut energies, mut worst) = (Worst::default(), Worst::default());
    let text = "gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = each(0.10531, 0.112, 0.1), com = 0.043, inertia = 0.516e-3) * 3
        ],
        siblings(child, at = 0.06, spring = 3), emit(transfer(exact))";
    let (compiled, tree) = (compile(text), at_run_time(text));
    let symmetric = tree.symmetric().expect("springs of sectors");
    assert!(symmetric.has_unequal_copies());
    let n = tree.links();
    let mut random = Random::new(37);
    for state in 0..20 {
        let place = || format!("state {state}");
        let (q, v) = (random.around_zero(n, 0.8), random.around_zero(n, 2.0));
        let p = momenta(&symmetric, &q, &v);
        let given = StateInput::Momenta {
            coordinates: &q,
            momenta: &p,
        };
        let mut split = vec![[0.0; 2]; symmetric.sectors().len()];
        symmetric.energies(&mut Workspace::new(), given, &mut split);
        let exact = w(&symmetric, TransferForm::Exact, given);
        let mut growth = vec![Transfer::default(); exact.len()];
        symmetric.growth(&mut Workspace::new(), given, &mut growth);
        for sector in 1..exact.len() {
            let end = format!("_d{sector}");
            let energy = compiled.evaluate(&format!("antiphase_energy{end}"), &[&q, &p])[0];
            energies.note(split[sector].iter().sum::<f64>() - energy, energy, place);
            for (own, stem) in [
                (exact[sector], "transfer_exact"),
                (growth[sector], "transfer_growth"),
            ] {
                let derived = compiled.evaluate(&format!("{stem}{end}"), &[&q, &p]);
                let pair = [own.kinetic, own.potential];
                for (own, derived) in pair.iter().zip(&derived) {
                    worst.note(own - derived, largest(&pair), place);
                }
            }
        }
    }
    energies.assert_below(1e-13, "H_d");
    worst.assert_below(1e-12, "transfers");
}

/// Copies in phase stay so to the bit, and differences that are zero do not begin.
#[test]
fn copies_in_phase_stay_so() {
    let flat = apparatus(3, SIBLINGS, "symmetric");
    for (text, means) in [(&flat, 2), (&format!("{NESTED}, emit(symmetric)"), 3)] {
        let compiled = compile(text);
        let n = compiled.scene.links.len();
        let mut random = Random::new(3);
        for _ in 0..20 {
            let (mut q, mut v) = (random.around_zero(n, 2.0), random.around_zero(n, 3.0));
            q[means..].fill(0.0);
            v[means..].fill(0.0);
            let own = compiled.evaluate("symmetric_accelerations", &[&q, &v]);
            assert!(own[means..].iter().all(|alpha| *alpha == 0.0), "{own:?}");
        }
    }
}

/// Stiffness and place as parameters.
#[test]
fn parameters_are_those_of_numbers() {
    let clause = |at: &str, spring: &str| format!("siblings(child, at = {at}, spring = {spring})");
    let requests = "transfer(exact)";
    let given = compile(&apparatus(2, &clause("(reach, 0.01)", "kappa"), requests));
    let fixed = compile(&apparatus(2, &clause("(0.05, 0.01)", "2.5"), requests));
    let names: Vec<&str> = given
        .scene
        .parameters
        .iter()
        .map(|own| own.name.as_str())
        .collect();
    let values: Vec<f64> = names
        .iter()
        .map(|name| if *name == "reach" { 0.05 } else { 2.5 })
        .collect();
    let (q, p) = ([0.4, -0.3, 0.7], [0.02, -0.004, 2e-3]);
    for entry in ["antiphase_energy", "transfer_exact"] {
        let own = given.evaluate_with(&values, entry, &[&q, &p]);
        for (own, fixed) in own.iter().zip(fixed.evaluate(entry, &[&q, &p])) {
            assert!(
                (own - fixed).abs() <= 1e-14 * fixed.abs(),
                "{entry}: {own} {fixed}"
            );
        }
    }
}

/// Observables in symmetric coordinates have the energy of the lines.
#[test]
fn observables_in_symmetric_coordinates_know_them() {
    let observe = "observe(watched = potential_energy + omega_d1 * theta_d1)";
    let text = apparatus(3, SIBLINGS, "symmetric").replace("emit(symmetric)", observe);
    let compiled = compile(&text);
    let tree = PendulumTree::parse(&text).expect("the compiler takes it");
    let own = tree.observable("watched").expect("it is described");
    let (mut values, mut rates) = (Worst::default(), Worst::default());
    let (n, mut random) = (tree.links(), Random::new(41));
    for state in 0..10 {
        let place = || format!("state {state}");
        let (q, v) = (random.around_zero(n, 1.0), random.around_zero(n, 2.0));
        let given = StateInput::Rates {
            coordinates: &q,
            rates: &v,
        };
        let value = compiled.evaluate("watched", &[&q, &v])[0];
        values.note(own.value(given) - value, value.abs(), place);
        let rate = compiled.evaluate("watched_rate", &[&q, &v])[0];
        rates.note(own.rate(0.0, given) - rate, rate.abs(), place);
    }
    values.assert_below(1e-12, "values");
    rates.assert_below(1e-11, "rates");
}
