//! Trees that are described at run time, against the interpreted program that the compiler
//! derives for each, and against bodies with Cartesian velocities.

mod driven_tree;
mod growth;
mod observables;
mod pullbacks;
mod series;
mod transfer;
mod truncation;

use std::collections::BTreeSet;
use std::f64::consts::PI;

use branched_pendulum::prelude::*;
use branched_pendulum_codegen::report::Problem;
use branched_pendulum_compiler_tests::front_end::{run, split};
use branched_pendulum_compiler_tests::mistakes::mistakes;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, sample};
use branched_pendulum_tests::samples::seeds;
use branched_pendulum_trees::{PendulumTree, TreeError};

use crate::support::{Worst, compile};

const STATES: usize = 20;

/// Relative to the problem's conditioning, as in `random_trees`.
#[test]
fn random_trees_agree_with_their_programs() {
    let (mut accelerations, mut energies) = (Worst::default(), Worst::default());
    let mut bodies = Worst::default();
    for seed in seeds(50) {
        let recipe = Recipe {
            links: 1 + seed as usize % 8,
            copies: &[1, 1, 1, 2, 3],
            nested: true,
            requests: "energies, momenta",
        };
        let sample = sample(&recipe, 7000 + seed);
        let compiled = compile(&sample.text);
        let tree = PendulumTree::parse(&sample.text).expect("the compiler takes it");
        let names: Vec<&String> = compiled.scene.links.iter().map(|link| &link.name).collect();
        assert!(tree.names().iter().eq(names), "{}", sample.text);
        let n = tree.links();
        let mut random = Random::new(seed);
        for count in 0..STATES {
            let theta = random.around_zero(n, PI);
            let omega = random.around_zero(n, 10.0);
            let motion = Motion::new(&sample.tree, &theta, &omega);
            let right = motion.accelerations();
            let bound = motion.sensitivity(&right);
            let own = tree.accelerations(0.0, &theta, &omega);
            let interpreted = compiled.evaluate("accelerations", &[&theta, &omega]);
            for link in 0..n {
                let place = || format!("tree {seed}, state {count}, link {link}");
                accelerations.note(own[link] - interpreted[link], bound[link], place);
                bodies.note(own[link] - right[link], bound[link], place);
            }
            let place = || format!("tree {seed}, state {count}");
            let kinetic = compiled.evaluate("kinetic_energy", &[&theta, &omega])[0];
            let error = tree.kinetic_energy_of(&theta, &omega) - kinetic;
            energies.note(error, motion.kinetic_terms, place);
            let potential = compiled.evaluate("potential_energy", &[&theta])[0];
            let error = tree.potential_energy_of(&theta) - potential;
            energies.note(error, motion.potential_terms, place);
            let momenta = compiled.evaluate("momenta", &[&theta, &omega]);
            for (link, (own, other)) in tree.momenta(&theta, &omega).iter().zip(momenta).enumerate()
            {
                let row = motion.mass_terms.row(link);
                let size: f64 = row.iter().zip(&omega).map(|(m, w)| m * w.abs()).sum();
                energies.note(own - other, size, place);
            }
        }
    }
    accelerations.assert_below(1e-13, "accelerations");
    bodies.assert_below(1e-12, "accelerations of bodies");
    energies.assert_below(1e-14, "energies and momenta");
}

#[test]
fn linear_modes_agree_with_the_derived_matrices() {
    let text = "gravity = 9.80665,
        limb(mass = 0.4, com = 0.2, inertia = 2e-3, joint = 0.5, spring = 0.3) [
            twig: rod(mass = 0.1, length = 0.3, at = (0.4, 0.05), friction = 1e-3) * 2
        ]";
    let compiled = compile(&format!("{text}, emit(modes)"));
    let tree = PendulumTree::parse(text).expect("it is right");
    let theta = [0.3, -0.2, 0.5];
    let pairs = [
        ("mass_matrix", tree.mass_matrix(&theta)),
        ("stiffness_matrix", tree.stiffness_matrix(&theta)),
    ];
    for (entry, own) in pairs {
        let derived = compiled.evaluate(entry, &[&theta]);
        let size = derived.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        for (own, derived) in own.iter().flatten().zip(derived) {
            assert!(
                (own - derived).abs() < 1e-14 * size,
                "{entry}: {own} {derived}"
            );
        }
    }
}

/// All laws of friction, in pivots at several places and against the ground.
#[test]
fn rough_trees_agree_with_their_programs() {
    let text = "gravity = 9.80665,
        limb(mass = 0.4, com = (0.2, 0.03), inertia = 2e-3, joint = 0.5,
            friction(viscous = 1e-3, coulomb = 0.05, static = 0.08, stribeck = 0.7,
                quadratic = 2e-3, width = 0.3)) [
            twig: rod(mass = 0.1, length = 0.3, at = (0.4, 0.05), drag(quadratic = 1e-3)) * 2,
            leaf: rod(mass = 0.05, length = 0.2, spring = 0.02, friction(coulomb = 0.01)),
        ]";
    let compiled = compile(&format!("{text}, emit(forces, energies)"));
    let tree = PendulumTree::parse(text).expect("it is right");
    let mut random = Random::new(3);
    for _ in 0..50 {
        let (theta, omega) = (random.around_zero(4, PI), random.around_zero(4, 10.0));
        let torques = random.around_zero(4, 0.1);
        let own = tree.accelerations(0.0, &theta, &omega);
        let derived = compiled.evaluate("accelerations", &[&theta, &omega]);
        let size = derived.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        for (own, derived) in own.iter().zip(derived) {
            assert!((own - derived).abs() < 1e-12 * size, "{own} {derived}");
        }
        let power = compiled.evaluate("friction_power", &[&omega])[0];
        let own = tree.friction_power(&theta, &omega);
        assert!((own - power).abs() < 1e-14 * power.abs(), "{own} {power}");
        let power = compiled.evaluate("outside_power", &[&omega, &torques])[0];
        let own = tree.outside_power(&omega, &torques);
        assert!((own - power).abs() < 1e-14, "{own} {power}");
    }
}

/// A text that a program reads is answered in the words of the macro, unless it asks for what
/// is derived for one tree.
#[test]
fn texts_at_run_time_are_answered_alike() {
    let (mut compared, mut differ) = (0, Vec::new());
    for (name, source) in mistakes() {
        let (_, text) = source.split_once("#[branched_pendulum(").expect(name);
        let derives = text.split_once(")]\n#[derive");
        let (text, _) = derives.or_else(|| text.rsplit_once(")]")).expect(name);
        let Err(TreeError::Description(error)) = PendulumTree::parse(text) else {
            continue;
        };
        let own: BTreeSet<[String; 3]> = error
            .mistakes()
            .iter()
            .map(|at| [&at.message, &at.label, &at.help].map(Clone::clone))
            .collect();
        if own.iter().any(|[text, ..]| text.contains("at run time")) {
            continue;
        }
        // Mistakes in the item are the macro's alone.
        let item = "struct Pendulum;".parse().expect("an item");
        let report = run(split(source).0, item).report;
        let diagnostics = report.diagnostics().iter();
        let problems = diagnostics.map(|diagnostic| diagnostic.message.problem());
        let texts = problems.map(|Problem { text, label, hint }| [text, label, hint]);
        // Names that no code is written with are free.
        let is_shared = |[text, label, _]: &[String; 3]| {
            !text.ends_with("is not a snake-case name")
                && !label.starts_with("parameters have small letters")
        };
        let compiled: BTreeSet<[String; 3]> = texts.filter(is_shared).collect();
        let own: BTreeSet<[String; 3]> = own.into_iter().filter(is_shared).collect();
        if own != compiled {
            differ.push((name, own, compiled));
        }
        compared += 1;
    }
    assert!(differ.is_empty(), "{differ:#?}");
    assert!(compared > 50, "{compared}");
}
