//! Springs and friction between links that are not parent and child: against Cartesian bodies,
//! trees at run time, closed forms, and the energy along emitted models' motions.

mod chords;
mod motion;
mod sectors;
mod straight;

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use branched_pendulum::analysis::Modes;
use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::constrained;
use branched_pendulum_tests::oracle::generator::{Coupling, Recipe, Sample, coupled_sample};
use branched_pendulum_trees::PendulumTree;

use crate::support::{Compiled, Worst, compile};

const STATES: usize = 50;

/// Random trees of 3 to 10 links, by either solve.
static SAMPLES: LazyLock<Vec<(Sample, [Compiled; 2])>> = LazyLock::new(|| {
    (0..40)
        .map(|seed| {
            let recipe = Recipe {
                links: 3 + seed as usize % 8,
                copies: &[1, 1, 2, 3],
                nested: true,
                requests: "energies, momenta, modes, forces",
            };
            let sample = coupled_sample(&recipe, 4_000 + seed, Coupling::Any);
            let solves = ["factorization", "recursion"];
            let compiled =
                solves.map(|solve| compile(&format!("solve = {solve}, {}", sample.text)));
            (sample, compiled)
        })
        .collect()
});

#[test]
fn the_samples_are_rich() {
    let between = || SAMPLES.iter().flat_map(|(sample, _)| &sample.tree.between);
    assert!(between().filter(|own| own.spring > 0.0).count() > 20);
    assert!(between().filter(|own| own.rest != 0.0).count() > 8);
    assert!(between().filter(|own| own.friction > 0.0).count() > 20);
    assert!(between().filter(|own| own.law.coulomb > 0.0).count() > 8);
    assert!(between().filter(|own| own.law.quadratic > 0.0).count() > 8);
    let count = |wanted: &dyn Fn(&[usize], &[usize]) -> bool| {
        let all = SAMPLES.iter().flat_map(|(sample, _)| {
            let lineages = |own: &[usize; 2]| own.map(|link| sample.tree.lineage(link));
            sample
                .tree
                .between
                .iter()
                .map(move |own| lineages(&own.links))
        });
        all.filter(|[a, b]| wanted(a, b)).count()
    };
    let siblings = count(&|a: &[usize], b: &[usize]| a[1..] == b[1..]);
    let of_ancestors = count(&|a: &[usize], b: &[usize]| a.contains(&b[0]) || b.contains(&a[0]));
    let is_uncle =
        |a: &[usize], b: &[usize]| a.len() + 1 == b.len() && a[1..] == b[2..] && a[0] != b[1];
    let uncles = count(&|a: &[usize], b: &[usize]| is_uncle(a, b) || is_uncle(b, a));
    let cousins =
        count(&|a: &[usize], b: &[usize]| a.len() == b.len() && a[1] != b[1] && a.len() > 2);
    let counts = [siblings, of_ancestors, uncles, cousins];
    assert!(counts.iter().all(|&count| count > 2), "{counts:?}");
}

/// Rates of all sizes: within widths, between them, and far beyond.
fn rates(random: &mut Random, links: usize, state: usize) -> Vec<f64> {
    random.around_zero(links, [10.0, 1.0, 0.1, 1e-3][state % 4])
}

#[test]
fn motions_are_those_of_bodies() {
    let [mut accelerations, mut energies, mut bodies] = [(); 3].map(|()| Worst::default());
    for (number, (sample, solves)) in SAMPLES.iter().enumerate() {
        let links = sample.tree.links.len();
        let mut random = Random::new(number as u64);
        for state in 0..STATES {
            let theta = random.around_zero(links, PI);
            let omega = rates(&mut random, links, state);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let expected = motion.accelerations();
            let sensitivity = motion.sensitivity(&expected);
            let place = |link: usize| format!("tree {number}, state {state}, link {link}");
            for compiled in solves {
                let found = compiled.evaluate("accelerations", &[&theta, &omega]);
                for link in 0..links {
                    let error = found[link] - expected[link];
                    accelerations.note(error, sensitivity[link], || place(link));
                }
            }
            let free = constrained::accelerations(&sample.tree, &theta, &omega);
            for link in 0..links {
                bodies.note(free[link] - expected[link], sensitivity[link], || {
                    place(link)
                });
            }
            let found = solves[0].evaluate("potential_energy", &[&theta])[0];
            let error = found - motion.potential;
            energies.note(error, motion.potential_terms, || place(0));
        }
    }
    bodies.assert_below(1e-9, "two oracles");
    accelerations.assert_below(1e-12, "accelerations");
    energies.assert_below(1e-14, "potential energies");
}

#[test]
fn functions_are_those_of_trees_at_run_time() {
    let [
        mut powers,
        mut matrices,
        mut canonical,
        mut energies,
        mut accelerations,
    ] = [(); 5].map(|()| Worst::default());
    for (number, (sample, solves)) in SAMPLES.iter().enumerate() {
        let tree = PendulumTree::parse(&sample.text).expect("the compiler takes it");
        let [compiled, recursion] = solves;
        let n = tree.links();
        let mut random = Random::new(50 + number as u64);
        for state in 0..STATES {
            let place = || format!("tree {number}, state {state}");
            let theta = random.around_zero(n, PI);
            let omega = rates(&mut random, n, state);
            let inputs: [&[f64]; 2] = [&theta, &omega];
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let own = tree.accelerations(0.0, &theta, &omega);
            let sensitivity = motion.sensitivity(&motion.accelerations());
            for compiled in solves {
                let found = compiled.evaluate("accelerations", &inputs);
                for (link, found) in found.iter().enumerate() {
                    accelerations.note(found - own[link], sensitivity[link], place);
                }
            }
            let torques = random.around_zero(n, 0.5);
            let under = [&theta, &omega, &torques].map(Vec::as_slice);
            let [first, second] = solves
                .each_ref()
                .map(|own| own.evaluate("accelerations_under", &under));
            for (link, (first, second)) in first.iter().zip(second).enumerate() {
                let scale = sensitivity[link] + first.abs();
                accelerations.note(first - second, scale, place);
            }
            let potential = recursion.evaluate("potential_energy", &[&theta])[0];
            let error = tree.potential_energy_of(&theta) - potential;
            energies.note(error, motion.potential_terms, place);
            if compiled.program.entry("friction_power").is_some() {
                let power = compiled.evaluate("friction_power", &[&omega])[0];
                powers.note(tree.friction_power(&theta, &omega) - power, power, place);
                assert!(power < 0.0, "{}", place());
            }
            let pairs = [
                ("mass_matrix", tree.mass_matrix(&theta)),
                ("stiffness_matrix", tree.stiffness_matrix(&theta)),
            ];
            for (entry, own) in pairs {
                let derived = compiled.evaluate(entry, &[&theta]);
                let size = derived.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                for (own, derived) in own.iter().flatten().zip(derived) {
                    matrices.note(own - derived, size, || format!("{entry}, {}", place()));
                }
            }
            let momenta = tree.momenta(&theta, &omega);
            let derived = compiled.evaluate("canonical_rates", &[&theta, &momenta]);
            let [mut velocities, mut slopes] = [(); 2].map(|()| vec![0.0; n]);
            tree.canonical_rates_into(0.0, &theta, &momenta, &mut velocities, &mut slopes);
            let terms = motion.bias_terms.iter().chain(motion.mass_terms.iter());
            let size = terms.fold(0.0, |size: f64, x| size.max(x.abs()));
            for (own, derived) in slopes.iter().zip(&derived[n..]) {
                canonical.note(own - derived, size * (1.0 + 1e2 * size), place);
            }
        }
    }
    accelerations.assert_below(1e-12, "accelerations");
    energies.assert_below(1e-14, "potential energies");
    powers.assert_below(1e-13, "powers of friction");
    matrices.assert_below(1e-13, "matrices of the modes");
    canonical.assert_below(1e-10, "rates of momenta");
}

/// Copies apart on copies in phase: what acts between them is as strong as those that one link
/// stands for together.
#[test]
fn copies_on_copies_in_phase_move_as_in_the_whole_tree() {
    let tree = "gravity = 9.80665,
        a: rod(mass = 0.4, length = 0.5) [b: rod(mass = 0.2, length = 0.35) [
            c: rod(mass = 0.1, length = 0.2, friction = 1e-3) * 2] * 3],
        siblings(c, spring = 0.3, friction(viscous = 1e-2, coulomb = 0.1, quadratic = 1e-2)),
        siblings(b, spring = 0.2)";
    let (whole, in_phase) = (compile(tree), compile(&format!("{tree}, in_phase(b)")));
    let at_run_time = PendulumTree::parse(&format!("{tree}, in_phase(b)"));
    let at_run_time = at_run_time.expect("the compiler takes it");
    let mut random = Random::new(5);
    for _ in 0..50 {
        let (theta, omega) = (random.around_zero(4, PI), random.around_zero(4, 5.0));
        let whole_of = |own: &[f64]| -> Vec<f64> {
            let branch = [own[1], own[2], own[3]];
            [vec![own[0]], branch.repeat(3)].concat()
        };
        let inputs = [whole_of(&theta), whole_of(&omega)];
        let expected = whole.evaluate("accelerations", &inputs.each_ref().map(Vec::as_slice));
        let found = in_phase.evaluate("accelerations", &[&theta, &omega]);
        let own = at_run_time.accelerations(0.0, &theta, &omega);
        let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for ((found, own), expected) in found.iter().zip(own).zip(expected) {
            assert!(
                (found - expected).abs() < 1e-12 * size,
                "{found} {expected}"
            );
            assert!((own - expected).abs() < 1e-12 * size, "{own} {expected}");
        }
    }
}

/// Two equal rods in one pivot: against each other they have
/// ω² = (m g ℓ/2 + 2 κ)/(m ℓ²/3), and together what gravity alone gives them.
#[test]
fn modes_of_two_coupled_rods_are_those_of_the_closed_form() {
    let (mass, length, stiffness, gravity): (f64, f64, f64, f64) = (0.12, 0.3, 0.02, 9.80665);
    let rods = Rods::new();
    let [hanging, inertia] = [mass * gravity * length / 2.0, mass * length * length / 3.0];
    let rest = [0.0; 3];
    let modes = Modes::new(&rods.mass_matrix(&rest), &rods.stiffness_matrix(&rest));
    let modes = modes.expect("rods hang");
    let against = ((hanging + 2.0 * stiffness) / inertia).sqrt() / TAU;
    let together = (hanging / inertia).sqrt() / TAU;
    for wanted in [against, together] {
        let own = modes.frequencies_hz.iter();
        let apart = own.fold(f64::INFINITY, |least: f64, own| {
            least.min((own / wanted - 1.0).abs())
        });
        assert!(apart < 1e-12, "{wanted}: {:?}", modes.frequencies_hz);
    }
}

#[branched_pendulum(
    gravity = 9.80665,
    frame(mass = 1, com = 0.1, inertia = 1, joint = 0) [
        left: rod(mass = 0.12, length = 0.3),
        right: rod(mass = 0.12, length = 0.3),
    ],
    between(left, right, spring = 0.02),
    emit(modes),
)]
struct Rods;
