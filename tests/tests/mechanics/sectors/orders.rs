//! Transfers cut off in the amplitude of the differences.

use branched_pendulum_compiler_tests::random::Random;

use crate::support::{Compiled, compile};

/// Largest error of the truncated transfers at an amplitude, and the largest
/// transfer, over in-phase states and directions of the differences.
fn error(compiled: &Compiled, order: u32, epsilon: f64) -> f64 {
    let n = compiled.scene.links.len();
    let sectors = compiled.mechanics.sectors.as_ref().expect("asked for");
    let budget = compiled.scene.requests.budget.as_ref().expect("asked for");
    let small: Vec<usize> = sectors
        .sectors
        .iter()
        .filter(|sector| {
            sector.difference.is_some_and(|difference| {
                budget.small.is_empty() || budget.small.contains(&difference)
            })
        })
        .flat_map(|sector| sector.coordinates.clone())
        .collect();
    let mut random = Random::new(11);
    let mut worst = 0.0_f64;
    for _ in 0..5 {
        let mut q = random.around_zero(n, 1.5);
        let mut p = random.around_zero(n, 0.02);
        for index in 0..n {
            if small.contains(&index) {
                q[index] *= epsilon;
                p[index] *= epsilon;
            }
        }
        let entry = format!("sector_transfers_amplitude_{order}");
        let truncated = compiled.evaluate(&entry, &[&q, &p]);
        let v = compiled.evaluate("symmetric_velocities", &[&q, &p]);
        let exact = compiled.evaluate("symmetric_sector_transfers", &[&q, &v]);
        // The sector of the means comes first.
        for (truncated, exact) in truncated.iter().zip(&exact).skip(2) {
            worst = worst.max((truncated - exact).abs());
        }
    }
    worst
}

fn assert_orders(compiled: &Compiled, orders: &[u32], gained: u32, epsilon: f64) {
    for &order in orders {
        let (coarse, fine) = (
            error(compiled, order, epsilon),
            error(compiled, order, 0.5 * epsilon),
        );
        let slope = (coarse / fine).log2();
        let expected = f64::from(order + gained);
        println!("order {order}: errors {coarse:.2e}, {fine:.2e}, slope {slope:.2}");
        assert!(
            (slope - expected).abs() < 0.35,
            "order {order}: slope {slope:.2}"
        );
    }
}

/// Between two copies all odd orders vanish.
#[test]
fn errors_fall_by_two_orders_for_nested_pairs() {
    let compiled = compile(
        "gravity = 9.80665, body: rod(mass = 0.4, length = 0.3) [arm: rod(mass = 0.2, length = 0.2) \
         [hand: point(mass = 0.1, length = 0.1)] * 2], \
         emit(budget(canonical, amplitude = 2, amplitude = 4, amplitude = 6, amplitude = 8))",
    );
    assert_orders(&compiled, &[2, 4, 6, 8], 2, 0.1);
}

#[test]
fn errors_of_a_full_binary_tree() {
    let compiled = compile(
        "gravity = 9.80665, arm: generations(count = 3, branching = 2, shape = rod, mass = 0.12, \
         length = 0.3, mass_ratio = 0.5, length_ratio = 0.7), \
         emit(budget(canonical, amplitude = 2, amplitude = 3, amplitude = 4))",
    );
    // Inner differences couple in pairs to the outer one: odd orders occur,
    // with small factors.
    assert_orders(&compiled, &[2, 3, 4], 1, 0.01);
}

#[test]
fn errors_of_three_copies_fall_by_one_order() {
    let compiled = compile(
        "gravity = 9.80665, body: rod(mass = 0.4, length = 0.3) [arm: rod(mass = 0.2, length = 0.2) \
         [hand: point(mass = 0.1, length = 0.1)] * 3], \
         emit(budget(canonical, amplitude = 2, amplitude = 3, amplitude = 4))",
    );
    assert_orders(&compiled, &[2, 3, 4], 1, 0.1);
}

/// Inner differences small, the outer one as large as it likes.
#[test]
fn errors_with_chosen_sectors_small() {
    let compiled = compile(
        "gravity = 9.80665, arm: generations(count = 3, branching = 2, shape = rod, mass = 0.12, \
         length = 0.3, mass_ratio = 0.5, length_ratio = 0.7), \
         emit(budget(canonical, amplitude = 2, amplitude = 4, small(arm_3_1_d, arm_3_2_d)))",
    );
    // Each of them is between two leaves: no odd orders.
    assert_orders(&compiled, &[2, 4], 2, 0.05);
}

/// One pair of leaves: the transfers that `transfer(...)` derives symbolically.
#[test]
fn leaves_have_the_transfers_of_the_symbolic_series() {
    let compiled = compile(
        "gravity = 9.80665, parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) \
         [child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2], \
         emit(transfer(angle = 1, angle = 2, angle = 3, amplitude = 2, amplitude = 4, exact), \
              budget(canonical, angle = 1, angle = 2, angle = 3, amplitude = 2, amplitude = 4))",
    );
    let mut random = Random::new(5);
    for _ in 0..50 {
        let q = random.around_zero(3, 1.0);
        let p = random.around_zero(3, 0.02);
        let v = compiled.evaluate("symmetric_velocities", &[&q, &p]);
        let pairs = [
            ("transfer_angle_1", "sector_transfers_angle_1", &p),
            ("transfer_angle_2", "sector_transfers_angle_2", &p),
            ("transfer_angle_3", "sector_transfers_angle_3", &p),
            ("transfer_amplitude_2", "sector_transfers_amplitude_2", &p),
            ("transfer_amplitude_4", "sector_transfers_amplitude_4", &p),
            (
                "transfer_exact_from_rates",
                "symmetric_sector_transfers",
                &v,
            ),
        ];
        for (symbolic, by_sectors, second) in pairs {
            let expected = compiled.evaluate(symbolic, &[&q, second]);
            let got = compiled.evaluate(by_sectors, &[&q, second]);
            let scale = expected[0].abs() + expected[1].abs();
            for (expected, got) in expected.iter().zip(&got[2..]) {
                let error = (got - expected).abs();
                assert!(error <= 1e-12 * scale, "{by_sectors}: {got} for {expected}");
            }
        }
    }
}
