//! Centres of mass and pivots beside the links' axes.

use branched_pendulum::prelude::*;

use super::{Powered, agree, array, balance, pair, powered};

pair!(CrookedLoops, CrookedUnrolled, CROOKED:
    tree: generations(count = 5, branching = 2, mass = 0.12, com = (0.1, 0.03), inertia = 1e-4,
        joint = (0.2, -0.07), mass_ratio = 0.5, length_ratio = 0.7)
);
// Pivots across the links alone; all forces, and a drive.
pair!(SidewaysLoops, SidewaysUnrolled, SIDEWAYS:
    tree: generations(count = 4, branching = 3, mass = 0.2, com = (-0.05, 0.02), inertia = 1e-4,
        joint = (0, 0.2), mass_ratio = 0.4, length_ratio = 0.8, friction = 2e-4, drag = 1e-4,
        spring = 3e-3),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(SidewaysLoops, SidewaysUnrolled, braked);
// Centres of mass beside the axis alone, without length along it.
pair!(ShortLoops, ShortUnrolled, SHORT:
    tree: generations(count = 2, branching = 5, mass = 0.3, com = (0, 0.04), inertia = 1e-4,
        joint = 0.2)
);
pair!(BushTable, BushUnrolled, BUSH:
    trunk(mass = 0.3, com = (0.2, 0.1), inertia = 1e-3, joint = (0.4, 0.1)) [
        twig: point(mass = 0.05, length = 0.2),
        bough(mass = 0.1, com = 0.15, inertia = 1e-4, joint = (0, -0.3)) [
            stick(mass = 0.03, com = (0.05, -0.05), inertia = 1e-5) * 3,
            hub(mass = 0.01, com = 0, inertia = 1e-5),
        ],
    ]
);
pair!(SprungTable, SprungUnrolled, SPRUNG:
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm(mass = 0.1, com = (0.1, 0.01), inertia = 1e-4, joint = (0.2, 0.05), spring = 0.01) [
            hand(mass = 0.04, com = (0, 0.1), inertia = 0, drag = 2e-4),
            fork: generations(count = 3, branching = 2, mass = 0.02, com = (0.05, 0.02),
                inertia = 1e-5, joint = (0.1, 0.03), length_ratio = 0.8, friction = 1e-5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3, spring = 0.02),
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(SprungTable, SprungUnrolled, braked);

#[test]
fn crooked_loops_agree_with_code_written_out_and_with_the_oracle() {
    agree(
        &CrookedLoops::<f64>::new(),
        &CrookedUnrolled::<f64>::new(),
        CROOKED,
        [false, false],
    );
    agree(
        &ShortLoops::<f64>::new(),
        &ShortUnrolled::<f64>::new(),
        SHORT,
        [false, false],
    );
    let (loops, unrolled) = (SidewaysLoops::<f64>::new(), SidewaysUnrolled::<f64>::new());
    agree(&loops, &unrolled, SIDEWAYS, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn crooked_tables_agree_with_code_written_out_and_with_the_oracle() {
    agree(
        &BushTable::<f64>::new(),
        &BushUnrolled::<f64>::new(),
        BUSH,
        [false, false],
    );
    let (table, unrolled) = (SprungTable::<f64>::new(), SprungUnrolled::<f64>::new());
    agree(&table, &unrolled, SPRUNG, [true, true]);
    balance(&table, &unrolled);
}

/// The crooked tree with its numbers as parameters, one of which may be zero.
#[branched_pendulum(
    gravity = g,
    code = loops,
    tree: generations(count = 5, branching = 2, mass = m, com = (c, 0.03), inertia = 1e-4,
        joint = (l, -0.07), mass_ratio = 0.5, length_ratio = 0.7),
    emit(energies),
)]
struct Named;

/// The crooked tree without length along the links.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    tree: generations(count = 5, branching = 2, mass = 0.12, com = (0, 0.03), inertia = 1e-4,
        joint = (0, -0.07), mass_ratio = 0.5, length_ratio = 0.7),
    emit(energies),
)]
struct Bent;

fn alike<A: Energy<f64>, B: Energy<f64>>(one: &A, other: &B) {
    for super::State { time, theta, omega } in super::states(one.links(), 20) {
        let (mut own, mut right) = (vec![0.0; one.links()], vec![0.0; one.links()]);
        one.accelerations_into(time, &theta, &omega, &mut own);
        other.accelerations_into(time, &theta, &omega, &mut right);
        let size = right.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        for (own, right) in own.iter().zip(&right) {
            assert!((own - right).abs() < 1e-12 * size);
        }
        let energy = other.kinetic_energy_of(&theta, &omega);
        assert!((one.kinetic_energy_of(&theta, &omega) - energy).abs() < 1e-14 * energy);
    }
}

#[test]
fn parameters_give_the_tree_of_their_values() {
    let named = |c, l| {
        Named::new(NamedParameters {
            g: 9.80665,
            m: 0.12,
            c,
            l,
        })
        .unwrap()
    };
    alike(&named(0.1, 0.2), &CrookedLoops::<f64>::new());
    alike(&named(0.0, 0.0), &Bent::<f64>::new());
}
