//! Observables of nested trees in symmetric coordinates, which are formed on
//! means and differences: against the same quantities written in single links,
//! which are derived in the absolute angles, and without rounding where the
//! symmetry makes them zero.

use branched_pendulum_compiler_tests::random::Random;

use crate::support::{Compiled, Worst, compile};

const TREE: &str = "gravity = 9.80665,
    trunk: rod(mass = 0.12, length = 0.3, friction = 2e-3) [
        limb: rod(mass = 0.06, length = 0.2, friction = 1e-3, drag = 1e-4, spring = 0.02) [
            twig: rod(mass = 0.03, length = 0.15, friction = 5e-4) * 2
        ] * 2
    ],
    drive(torque = 0.05 * cos(6 * t), y = 0.01 * sin(9 * t)),
    emit(symmetric, momenta)";

/// Name, in symmetric coordinates, in those of single links.
const OBSERVABLES: [[&str; 3]; 6] = [
    [
        "swing",
        "sin(theta_limb_d)^2 + omega_limb_d^2",
        "sin((theta_limb_1 - theta_limb_2) / 2)^2 + ((omega_limb_1 - omega_limb_2) / 2)^2",
    ],
    [
        "push",
        "p_limb_d * theta_twig_d",
        "(p_limb_1 - p_limb_2)
            * (theta_twig_1_1 + theta_twig_1_2 - theta_twig_2_1 - theta_twig_2_2) / 4",
    ],
    [
        "inner",
        "p_twig_1_d * cos(theta_twig_1_d)",
        "(p_twig_1_1 - p_twig_1_2) * cos((theta_twig_1_1 - theta_twig_1_2) / 2)",
    ],
    [
        "lag",
        "omega_limb_m - omega_trunk",
        "(omega_limb_1 + omega_limb_2) / 2 - omega_trunk",
    ],
    [
        "weighted",
        "kinetic_energy * theta_limb_d + potential_energy",
        "kinetic_energy * (theta_limb_1 - theta_limb_2) / 2 + potential_energy",
    ],
    [
        "mixed",
        "omega_twig_1_1 * sin(theta_twig_m - theta_trunk)",
        "omega_twig_1_1
            * sin((theta_twig_1_1 + theta_twig_1_2 + theta_twig_2_1 + theta_twig_2_2) / 4
                - theta_trunk)",
    ],
];

fn observed(form: usize) -> Compiled {
    let list = OBSERVABLES.map(|observable| format!("{} = {}", observable[0], observable[form]));
    compile(&format!("{TREE}, observe({})", list.join(", ")))
}

/// Σ weights · values of each link's symmetric coordinates, and its transpose
/// where momenta are meant.
fn single_links(compiled: &Compiled, values: &[f64], momenta: bool) -> Vec<f64> {
    let mut links = vec![0.0; values.len()];
    for (coordinate, value) in compiled.mechanics.coordinates.iter().zip(values) {
        let norm = if momenta { coordinate.norm() } else { 1 };
        for &(link, weight) in &coordinate.weights {
            links[link.0] += weight as f64 * value / norm as f64;
        }
    }
    links
}

#[test]
fn they_are_those_of_single_links() {
    let (symmetric, single) = (observed(1), observed(2));
    let mut random = Random::new(3);
    let mut worst = Worst::default();
    for state in 0..100 {
        let time = [random.between(0.0, 10.0)];
        let q = random.around_zero(7, 1.5);
        let v = random.around_zero(7, 4.0);
        let p = symmetric.evaluate("symmetric_momenta", &[&q, &v]);
        let theta = single_links(&symmetric, &q, false);
        let omega = single_links(&symmetric, &v, false);
        let momenta = single_links(&symmetric, &p, true);
        for [name, ..] in OBSERVABLES {
            for (suffix, timed, canonical) in [
                ("", false, false),
                ("_rate", true, false),
                ("_friction_rate", false, false),
                ("_from_momenta", false, true),
                ("_rate_from_momenta", true, true),
            ] {
                let entry = format!("{name}{suffix}");
                let (found, expected) = match canonical {
                    false => ([&q, &v], [&theta, &omega]),
                    true => ([&q, &p], [&theta, &momenta]),
                };
                let evaluate = |compiled: &Compiled, [a, b]: [&Vec<f64>; 2]| match timed {
                    true => compiled.evaluate(&entry, &[&time, a, b])[0],
                    false => compiled.evaluate(&entry, &[a, b])[0],
                };
                let found = evaluate(&symmetric, found);
                let expected = evaluate(&single, expected);
                worst.note(found - expected, 1.0 + expected.abs(), || {
                    format!("{entry}, state {state}")
                });
            }
        }
    }
    worst.assert_below(1e-11, "observable");
}

/// While the twigs of limb 1 move alike, everything of their difference is
/// zero whatever the rest does; while all copies do, every difference is.
#[test]
fn what_the_symmetry_makes_zero_is_zero() {
    let zeros = [
        "a = omega_twig_1_d + theta_twig_1_d",
        "b = p_twig_1_d",
        "c = omega_limb_d * theta_trunk + p_twig_d",
        "d = kinetic_energy * p_limb_d",
    ];
    let compiled = compile(&format!("{TREE}, observe({})", zeros.join(", ")));
    let coordinates = &compiled.mechanics.coordinates;
    let mut random = Random::new(5);
    for _ in 0..50 {
        let time = [random.between(0.0, 10.0)];
        let (all_q, all_v) = (random.around_zero(7, 2.0), random.around_zero(7, 5.0));
        for (functions, still) in [
            (&["a", "b"][..], "twig_1_d"),
            (&["a", "b", "c", "d"][..], "_d"),
        ] {
            let kept = |values: &[f64]| -> Vec<f64> {
                let values = coordinates.iter().zip(values);
                let kept = values.map(|(c, value)| match c.name.ends_with(still) {
                    true => 0.0,
                    false => *value,
                });
                kept.collect()
            };
            let (q, v) = (kept(&all_q), kept(&all_v));
            let p = compiled.evaluate("symmetric_momenta", &[&q, &v]);
            for name in functions {
                let rate = compiled.evaluate(&format!("{name}_rate"), &[&time, &q, &v]);
                assert_eq!(rate, [0.0], "{name} at {q:?}, {v:?}");
                let name = format!("{name}_rate_from_momenta");
                assert_eq!(compiled.evaluate(&name, &[&time, &q, &p]), [0.0], "{name}");
            }
        }
    }
}

/// A rate is hardly longer than the motion that it is a rate of: the formulas
/// in symmetric coordinates would fill hundreds of pages.
#[test]
fn fifteen_links_stay_short() {
    let compiled = compile(
        "gravity = 9.80665,
        arm: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
        observe(
            swing = sin(theta_arm_2_d)^2 + omega_arm_2_d^2,
            push = p_arm_3_d * theta_arm_3_d,
            lag = omega_arm_3_m - omega_arm_2_m,
            share = kinetic_energy + potential_energy - p_arm_2_d^2 / (4 * inertia_arm_2),
        )",
    );
    let length = |name: &str| {
        let entry = compiled.program.entry(name).expect("the scene has it");
        compiled.program.needed(&entry.outputs).len()
    };
    let motion = length("symmetric_accelerations");
    for name in ["swing_rate", "push_rate", "lag_rate", "share_rate"] {
        let values = length(name);
        assert!(values < 3 * motion / 2, "{name}: {values} of {motion}");
    }
}
