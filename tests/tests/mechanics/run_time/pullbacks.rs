//! Derivatives in reverse mode of trees at run time, in 31 digits against tangents of the equations
//! of one link.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual};
use branched_pendulum::system::{PullbackOde, PullbackWorkspace};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::samples::seeds;
use branched_pendulum_trees::{PendulumTree, TreeDescription};

use crate::pullbacks::random_description;
use crate::support::Worst;

const TIME: f64 = 0.7;

/// The scalar product of two vectors.
fn product(a: &[Double], b: &[Double]) -> Double {
    let terms = a.iter().zip(b);
    terms.fold(Double::from_f64(0.0), |sum, (a, b)| sum + *a * *b)
}

fn doubles(values: &[f64]) -> Vec<Double> {
    values.iter().copied().map(Double::from_f64).collect()
}

/// Compares ⟨w, J v⟩ by tangents with ⟨Jᵀ w, v⟩ for a random state and random vectors v and w.
fn compare(text: &str, random: &mut Random, worst: &mut Worst) {
    let description = TreeDescription::parse(text).expect(text);
    let names: Vec<&str> = description.parameters().collect();
    let values: Vec<f64> = names.iter().map(|_| random.between(0.6, 1.4)).collect();
    let named: Vec<(&str, f64)> = names.iter().copied().zip(values.clone()).collect();
    let tree: PendulumTree<Double> = description.tree(&named).expect(text);
    let motion = tree.pullback();
    let n = motion.dimension();
    let state = random.around_zero(n, 2.0);
    let weights = doubles(&random.around_zero(n, 1.0));
    let [by_state, by_values] = [n, values.len()].map(|len| random.around_zero(len, 1.0));

    let dual = |values: &[f64], tangents: &[f64]| -> Vec<Dual<Double, 1>> {
        let pairs = doubles(values).into_iter().zip(doubles(tangents));
        let pairs = pairs.map(|(value, tangent)| Dual {
            value,
            tangents: [tangent],
        });
        pairs.collect()
    };
    let mut rates = vec![Dual::constant(Double::from_f64(0.0)); n];
    let time = Dual::constant(Double::from_f64(TIME));
    let equations = description.equations(&dual(&values, &by_values));
    equations.rates(time, &dual(&state, &by_state), &mut rates);
    let tangents: Vec<Double> = rates.iter().map(|rate| rate.tangents[0]).collect();

    let zero = Double::from_f64(0.0);
    let (mut state_adjoint, mut parameters) = (vec![zero; n], vec![zero; values.len()]);
    motion.add_pullback(
        &mut PullbackWorkspace::new(),
        Double::from_f64(TIME),
        &doubles(&state),
        &weights,
        &mut state_adjoint,
        &mut parameters,
    );
    let forward = product(&weights, &tangents);
    let by = [
        product(&state_adjoint, &doubles(&by_state)),
        product(&parameters, &doubles(&by_values)),
    ];
    let sizes = [forward, by[0], by[1]].map(|own| own.to_f64().abs());
    worst.note(
        (forward - by[0] - by[1]).to_f64(),
        sizes.into_iter().sum(),
        || text.to_string(),
    );
}

#[test]
fn pullbacks_of_random_trees_are_transposed_tangents() {
    let mut worst = Worst::default();
    for seed in seeds(50) {
        let mut random = Random::new(9000 + seed);
        let text = random_description(seed, &mut random);
        compare(&text, &mut random, &mut worst);
    }
    worst.assert_below(1e-24, "⟨w, J v⟩ − ⟨Jᵀ w, v⟩");
}

/// Trees by rule, standing trees, one driven link, widths of friction laws and power laws of the
/// distance as parameters.
#[test]
fn pullbacks_of_other_forms_are_transposed_tangents() {
    let mut worst = Worst::default();
    let mut random = Random::new(3);
    for text in [
        "gravity = g, tree: generations(count = 4, branching = 2, shape = rod, mass = m, length = l, \
         mass_ratio = 0.5, length_ratio = r, friction = f)",
        "gravity = -g, parent(mass = m, com = (0.4, c), inertia = 0.1, joint = (0.9, 0.1), spring = k, \
         rest = a) [ child(mass = 0.2, com = (0.1, c), inertia = 0.05, spring = 0.1 * k) * 2 ], \
         drive(x = b * sin(3 * t), y = 0.02 * cos(p * t))",
        "gravity = g, rod: rod(mass = m, length = l, friction = f), drive(torque = b * sin(w * t), \
         x = b * cos(t))",
        "gravity = g, rod: rod(mass = m, length = 1, friction(viscous = f, coulomb = c, static = c + s, \
         stribeck = v, quadratic = q, width = w), drag(viscous = d, quadratic = q, width = w / 2))",
    ] {
        for _ in 0..10 {
            compare(text, &mut random, &mut worst);
        }
    }
    worst.assert_below(1e-24, "⟨w, J v⟩ − ⟨Jᵀ w, v⟩");
}

/// The derivatives by torques, and what slices of a wrong length give.
#[test]
fn derivatives_by_torques_are_those_of_the_accelerations() {
    let tree = PendulumTree::parse(
        "gravity = 9.81, parent(mass = 0.3, com = 0.1, inertia = 1e-3, joint = 0.3, friction = 0.01) \
         [ child(mass = 0.2, com = 0.05, inertia = 1e-3) * 2 ]",
    )
    .expect("a tree");
    let ([theta, omega], torques) = ([[0.3, -0.5, 0.9], [1.0, 2.0, -1.0]], [0.01, -0.02, 0.03]);
    let weights = [0.7, -0.2, 0.4];
    let motion = tree.pullback();
    let slopes = motion.accelerations_pullback(0.0, [&theta, &omega], Some(&torques), &weights);
    let sum = |torques: &[f64; 3], theta: &[f64; 3]| -> f64 {
        let mut alpha = [0.0; 3];
        tree.accelerations_under_into(0.0, theta, &omega, torques, &mut alpha);
        alpha
            .iter()
            .zip(weights)
            .map(|(own, weight)| own * weight)
            .sum()
    };
    for link in 0..3 {
        let [mut more, mut less] = [torques; 2];
        // The accelerations are linear in the torques.
        (more[link], less[link]) = (torques[link] + 1.0, torques[link] - 1.0);
        let difference = (sum(&more, &theta) - sum(&less, &theta)) / 2.0;
        assert!((slopes.torques[link] - difference).abs() < 1e-9 * difference.abs());
        let [mut more, mut less] = [theta; 2];
        (more[link], less[link]) = (theta[link] + 1e-5, theta[link] - 1e-5);
        let difference = (sum(&torques, &more) - sum(&torques, &less)) / 2e-5;
        assert!((slopes.theta[link] - difference).abs() < 1e-6 * difference.abs().max(1.0));
    }
    let wrong = motion.accelerations_pullback(0.0, [&theta, &omega[..2]], None, &weights);
    assert!(wrong.theta.iter().all(|slope| slope.is_nan()));
}
