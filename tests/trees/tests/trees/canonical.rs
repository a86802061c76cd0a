//! Canonical variables of trees at run time.

use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

/// Velocities are M⁻¹ p, however strong the forces are that act besides: momenta of known
/// velocities lead back to these.
#[test]
fn velocities_keep_their_digits_under_strong_forces() {
    let rods = "b: rod(mass = 0.2, length = 0.4) [
        c: rod(mass = 0.1, length = 0.3), d(mass = 0.1, com = (0.1, 0.02), inertia = 1e-3) * 2
    ]";
    for (gravity, root, others) in [
        ("9.81", "", ""),
        ("9.81", ", spring = 1e9, rest = 0.3", ""),
        ("1e8", "", ""),
        ("-1e7", ", friction(coulomb = 1e8, width = 0.1)", ""),
        (
            "9.81",
            "",
            ", between(c, a, spring = 1e9, rest = 2, friction = 1e6)",
        ),
        (
            "9.81",
            "",
            ", guy(c, at = 0.2, to = (3, 1), spring = 1e8, rest = 0.1)",
        ),
        ("9.81", "", ", drive(torque = 1e9, x = 1e6 * sin(2 * t))"),
    ] {
        let text =
            format!("gravity = {gravity}, a: rod(mass = 1, length = 0.3{root}) [{rods}]{others}");
        let tree = PendulumTree::parse(&text).unwrap_or_else(|error| panic!("{error}"));
        let n = tree.links();
        for seed in 0..5 {
            let angle = |link: usize| 2.0 * (1.0 + 3.0 * link as f64 + f64::from(seed)).sin();
            let theta: Vec<f64> = (0..n).map(angle).collect();
            let omega: Vec<f64> = (0..n).map(|link| angle(link + 7)).collect();
            let momenta = tree.momenta(&theta, &omega);
            let mut rates = [vec![0.0; n], vec![0.0; n]];
            let [q_rates, p_rates] = &mut rates;
            tree.canonical_rates_into(0.3, &theta, &momenta, q_rates, p_rates);
            for (found, expected) in q_rates.iter().zip(&omega) {
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{text}: {found} {expected}"
                );
            }
            assert!(p_rates.iter().all(|rate| rate.is_finite()));
        }
    }
}

/// Ensembles in lanes move as each tree in absolute angles. The trees differ in a mass.
#[test]
fn ensembles_in_lanes_move_as_in_absolute_angles() {
    let tree = |number: usize| {
        let tree = PendulumTree::parse(&format!(
            "gravity = 9.81, a: rod(mass = {}, length = 0.3, friction = 0.02) [
                b: rod(mass = 0.2, length = 0.4) * 2
            ], drive(torque = 0.1 * sin(3 * t))",
            0.5 + 0.1 * number as f64
        ));
        tree.unwrap_or_else(|error| panic!("{error}"))
    };
    let starts: Vec<State<f64>> = (0..7)
        .map(|number| State::at_rest(0.0, &[0.1 * f64::from(number), 0.4, -0.3]))
        .collect();
    // At rest all momenta are zero.
    let releases = starts.iter().enumerate();
    let releases: Vec<_> = releases
        .map(|(number, start)| (CanonicalVariables(tree(number)), start.clone()))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 1.0);
    for ((number, start), end) in starts.iter().enumerate().zip(ends) {
        let end = end.unwrap().state;
        let plain = method.run(&AbsoluteAngles(tree(number)), start, 1.0);
        let plain = plain.unwrap().state;
        let momenta = tree(number).momenta(plain.positions(), plain.velocities());
        let plain = [plain.positions(), &momenta].concat();
        for (own, plain) in end.values.iter().zip(plain) {
            assert!((own - plain).abs() < 1e-8, "{own} {plain}");
        }
    }
}
