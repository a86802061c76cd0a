//! Children at several places of a link, and in its own pivot.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_codegen::scene::Layout;

use super::{Powered, agree, array, balance, pair, powered, scene_of, states};

pair!(RackTable, RackUnrolled, RACK:
    beam: rod(mass = 0.3, length = 0.4) [
        hook: point(mass = 0.05, length = 0.2, at = 0.1),
        bar: rod(mass = 0.1, length = 0.3, at = 0.25) [
            stick: rod(mass = 0.03, length = 0.1) * 3,
            leaf: disc(mass = 0.01, length = 0.05, radius = 0.02, at = -0.1),
            twin: rod(mass = 0.02, length = 0.15, at = 0) [
                tip: point(mass = 0.01, length = 0.05),
            ],
        ],
        tail: rod(mass = 0.02, length = 0.1),
    ]
);
pair!(MobileTable, MobileUnrolled, MOBILE:
    beam(mass = 0.2, com = (0.01, -0.03), inertia = 1e-3, friction = 1e-4, spring = 0.03) [
        left(mass = 0.1, com = (0.1, 0.01), inertia = 1e-4, at = (0.02, -0.2), spring = 0.01) [
            inner: rod(mass = 0.04, length = 0.1, at = (0, 0.05), drag = 2e-4),
            outer(mass = 0.04, com = (0, 0.1), inertia = 0, at = (0, -0.1), friction = 1e-5) * 2,
        ] * 2,
        right: rod(mass = 0.15, length = 0.2, at = (0.02, 0.2), friction = 1e-4) [
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ],
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(MobileTable, MobileUnrolled, braked);
// Pendulums on one axis, that springs connect: a discrete sine-Gordon chain.
pair!(AxisTable, AxisUnrolled, AXIS:
    tree: generations(count = 12, branching = 1, mass = 0.2, com = 0.05, inertia = 1e-4,
        joint = 0, spring = 0.1)
);
pair!(HubTable, HubUnrolled, HUB:
    tree: generations(count = 4, branching = 2, mass = 0.2, com = (0.01, 0.05), inertia = 1e-4,
        joint = (0, 0), mass_ratio = 0.7, friction = 2e-4, spring = 0.1),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(HubTable, HubUnrolled, braked);

#[test]
fn tables_with_places_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (RackTable::<f64>::new(), RackUnrolled::<f64>::new());
    agree(&table, &unrolled, RACK, [false, false]);
    let (table, unrolled) = (MobileTable::<f64>::new(), MobileUnrolled::<f64>::new());
    agree(&table, &unrolled, MOBILE, [true, true]);
    balance(&table, &unrolled);
}

/// A rule of which no distance is a unit of length takes that of its leaves.
#[test]
fn rules_in_one_pivot_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (AxisTable::<f64>::new(), AxisUnrolled::<f64>::new());
    agree(&table, &unrolled, AXIS, [false, false]);
    let (table, unrolled) = (HubTable::<f64>::new(), HubUnrolled::<f64>::new());
    agree(&table, &unrolled, HUB, [true, true]);
    balance(&table, &unrolled);
}

/// Constants are exact in 106 bits too.
#[test]
fn a_table_with_places_is_that_of_code_written_out_in_more_digits() {
    let n = MobileTable::LINKS;
    let wide = |numbers: &[f64]| -> Vec<Double> {
        numbers.iter().copied().map(Double::from_f64).collect()
    };
    for super::State { time, theta, omega } in states(n, 5) {
        let (time, theta, omega) = (Double::from_f64(time), wide(&theta), wide(&omega));
        let (mut own, mut other) = (theta.clone(), theta.clone());
        MobileTable::<Double>::default().accelerations_into(time, &theta, &omega, &mut own);
        MobileUnrolled::<Double>::default().accelerations_into(time, &theta, &omega, &mut other);
        let size = other
            .iter()
            .fold(0.0, |size: f64, x| size.max(x.to_f64().abs()));
        for (own, other) in own.iter().zip(&other) {
            assert!((*own - *other).to_f64().abs() < 1e-26 * size);
        }
    }
}

#[test]
fn slices_of_another_length_give_nan() {
    let model = RackTable::<f64>::new();
    let mut alpha = [0.0; 9];
    model.accelerations_into(0.0, &[0.0; 3], &[0.0; 9], &mut alpha);
    assert!(alpha.iter().all(|alpha| alpha.is_nan()));
    assert!(model.potential_energy(&[0.0; 3]).is_nan());
    assert!(model.kinetic_energy(&[0.0; 9], &[]).is_nan());
    let model = MobileTable::<f64>::new();
    assert!(model.friction_power(&[0.0; 2]).is_nan());
    assert!(model.drive_power(0.0, &[0.0; 2], &[]).is_nan());
}

#[test]
fn large_trees_with_places_get_a_loop() {
    let tree = |teeth: usize| {
        format!(
            "gravity = 9.81, emit(energies), drive(y = sin(t)),
             back: rod(mass = 0.3, length = 0.4) [
                 tooth: rod(mass = 0.1, length = 0.2, at = (0.1, 0.05)) * {teeth},
                 other: rod(mass = 0.1, length = 0.2) * {teeth},
             ]"
        )
    };
    assert_eq!(scene_of(&tree(10)).layout, Layout::Unrolled);
    assert_eq!(scene_of(&tree(50)).layout, Layout::Links);
    assert_eq!(scene_of(&tree(50)).links.len(), 101);
}

#[test]
fn large_rules_in_one_pivot_get_loops() {
    let chain = |count: usize, joint: &str, code: &str| {
        scene_of(&format!(
            "gravity = 9.81, tree: generations(count = {count}, branching = 1, mass = 0.1, \
             com = 0.05, inertia = 0, joint = {joint}, spring = 0.1{code})"
        ))
    };
    let links = |scene: super::Scene| match scene.layout {
        Layout::Generations { links, .. } => Some(links),
        _ => None,
    };
    assert_eq!(links(chain(60, "0", "")), None);
    assert_eq!(links(chain(101, "(0, 0)", "")), Some(101));
    assert_eq!(links(chain(101, "0", ", code = unrolled")), None);
    assert_eq!(links(chain(3, "0", ", code = loops")), Some(3));
    assert_eq!(links(chain(101, "0.1", "")), Some(101));
}
