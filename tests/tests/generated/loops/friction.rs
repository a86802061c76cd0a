//! Coulomb, Stribeck and quadratic friction and drag in loops.

use branched_pendulum::Pendulum;
use branched_pendulum::prelude::*;

use super::{Powered, agree, array, balance, pair, powered};

pair!(BrakedLoops, BrakedUnrolled, BRAKED:
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction_ratio = 0.3, drag_ratio = 0.2,
        friction(viscous = 1e-4, coulomb = 2e-2, static = 3e-2, stribeck = 2, quadratic = 1e-4,
            width = 0.5),
        drag(quadratic = 1e-4)),
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(BrakedLoops, BrakedUnrolled, braked);
// Laws on some of the links, with and without width of their own.
pair!(MixedTable, MixedUnrolled, MIXED:
    trunk(mass = 0.2, com = 0.03, inertia = 1e-3, joint = 0.2, friction(coulomb = 1e-2)) [
        arm(mass = 0.1, com = (0.1, 0.01), inertia = 1e-3, joint = 0.2, spring = 0.01,
            friction(quadratic = 1e-3), drag = 1e-3) [
            hand(mass = 0.04, com = 0.1, inertia = 1e-4, drag(quadratic = 2e-4)),
            fork: generations(count = 3, branching = 2, mass = 0.02, com = 0.05,
                inertia = 1e-5, joint = 0.1, length_ratio = 0.8, at = 0.15,
                friction(coulomb = 1e-4, width = 1), friction_ratio = 0.5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3),
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))
);
powered!(MixedTable, MixedUnrolled, braked);

#[test]
fn braked_generations_agree_with_code_written_out_and_with_the_oracle() {
    let (loops, unrolled) = (BrakedLoops::<f64>::new(), BrakedUnrolled::<f64>::new());
    agree(&loops, &unrolled, BRAKED, [true, true]);
    balance(&loops, &unrolled);
}

#[test]
fn braked_tables_agree_with_code_written_out_and_with_the_oracle() {
    let (table, unrolled) = (MixedTable::<f64>::new(), MixedUnrolled::<f64>::new());
    agree(&table, &unrolled, MIXED, [true, true]);
    balance(&table, &unrolled);
}

/// Several states at once, in registers, as one by one.
#[test]
fn batches_agree_with_single_states() {
    fn check<P: Pendulum<f64>>(model: &P) {
        let states: Vec<super::State> = super::states(model.links(), 9).collect();
        let columns = |of: fn(&super::State) -> &Vec<f64>| -> Vec<Vec<f64>> {
            let column = |link: usize| states.iter().map(|state| of(state)[link]).collect();
            (0..model.links()).map(column).collect()
        };
        let (theta, omega) = (columns(|state| &state.theta), columns(|state| &state.omega));
        let mut found = columns(|state| &state.theta);
        let mut batch = Batch::new(model);
        let done = batch.accelerations(0.3, &theta, &omega, &mut found);
        done.expect("as many numbers as links and states");
        for (index, state) in states.iter().enumerate() {
            let mut alone = vec![0.0; model.links()];
            model.accelerations_into(0.3, &state.theta, &state.omega, &mut alone);
            let size = alone.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            for (found, alone) in found.iter().zip(&alone) {
                assert!((found[index] - alone).abs() < 1e-11 * size);
            }
        }
    }
    check(&BrakedLoops::<f64>::new());
    check(&BrakedUnrolled::<f64>::new());
    check(&MixedTable::<f64>::new());
    check(&MixedUnrolled::<f64>::new());
}
