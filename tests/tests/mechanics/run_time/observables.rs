//! Observables at run time, and their rates, against the programs that the compiler derives.

use branched_pendulum::transfer::StateInput;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_trees::{PendulumTree, TreeError};

use crate::support::{Worst, compile};

const TREE: &str = "gravity = 9.80665,
    trunk: rod_with_bob(mass = 0.4, length = 0.35, bob_mass = 0.2, drag(quadratic = 1e-3)) [
        twig(mass = 0.1, com = (0.1, 0.02), inertia = 1e-3, joint = 0.2, at = (0.3, 0.01), spring = 0.2,
            rest = 0.1, friction(viscous = 1e-3, coulomb = 0.02, width = 0.3)) [
            leaf: rod(mass = 0.05, length = 0.1)
        ] * 2
    ],
    drive(x = 0.05 * cos(7 * t), torque = 0.2 * cos(3 * t)),";

const OBSERVED: &str = "observe(
    swing = p_twig_d * sin(theta_twig_d) / inertia_twig + omega_leaf_1^2,
    total = kinetic_energy + potential_energy - p_trunk * omega_trunk,
    mixed = sqrt(1 + cos(theta_leaf_m)^2) * coupling_leaf_twig * (gravity_leaf - spring_twig
        + coulomb_twig) / (2 + lateral_coupling_twig_trunk * gravity))";

#[test]
fn observables_agree_with_their_programs() {
    let text = format!("{TREE} {OBSERVED}");
    let compiled = compile(&text);
    let tree = PendulumTree::parse(&text).expect("the compiler takes it");
    let (mut values, mut rates) = (Worst::default(), Worst::default());
    let mut random = Random::new(23);
    for name in ["swing", "total", "mixed"] {
        let observable = tree.observable(name).expect("it is defined");
        let observed = compiled.scene.observables.iter();
        let mut observed = observed.filter(|observed| observed.name == name);
        let is_symmetric = observed.any(|observed| observed.value.is_symmetric());
        for state in 0..10 {
            let n = tree.names().len();
            let (first, second) = (random.around_zero(n, 2.0), random.around_zero(n, 5.0));
            let given = match is_symmetric {
                true => StateInput::Rates {
                    coordinates: &first,
                    rates: &second,
                },
                false => StateInput::Absolute {
                    theta: &first,
                    omega: &second,
                },
            };
            let place = || format!("{name}, state {state}");
            let time = random.between(0.0, 2.0);
            let derived = compiled.evaluate(name, &[&first, &second])[0];
            values.note(
                observable.value(given) - derived,
                derived.abs().max(1.0),
                place,
            );
            let entry = format!("{name}_rate");
            let derived = compiled.evaluate(&entry, &[&[time], &first, &second])[0];
            rates.note(
                observable.rate(time, given) - derived,
                derived.abs().max(1.0),
                place,
            );
            let entry = format!("{name}_friction_rate");
            // Where nothing depends on velocities, friction has no function.
            let derived = match compiled.program.entry(&entry) {
                Some(_) => compiled.evaluate(&entry, &[&first, &second])[0],
                None => 0.0,
            };
            let own = observable.friction_rate(given);
            rates.note(own - derived, derived.abs().max(1.0), place);
        }
    }
    values.assert_below(1e-13, "observables");
    rates.assert_below(1e-12, "rates of observables");
}

#[test]
fn what_is_not_defined_is_refused() {
    let tree = PendulumTree::parse(&format!("{TREE} {OBSERVED}")).expect("it is right");
    let error = tree.observable("swin").unwrap_err();
    assert_eq!(
        error.to_string(),
        "no observable `swin`: there are `swing`, `total`, `mixed`"
    );
    let unequal = "gravity = 9.81,
        trunk: rod(mass = 1, length = 1) [twig: rod(mass = each(0.1, 0.2), length = 0.3) * 2],
        observe(f = theta_d * mismatch_inertia_d)";
    let tree = PendulumTree::parse(unequal).expect("the compiler takes it");
    let error = tree.observable("f").unwrap_err();
    let constant = "mismatch_inertia_d".to_owned();
    assert!(
        matches!(&error, TreeError::Constant { constant: own, .. } if *own == constant),
        "{error}"
    );
}
