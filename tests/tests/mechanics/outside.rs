//! Torques from outside, and where links are, on random trees: against the Cartesian
//! oracle.

use std::f64::consts::PI;

use branched_pendulum_codegen::scene::Solve;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, sample};
use branched_pendulum_tests::oracle::points::Place;
use nalgebra::DVector;

use crate::support::{Worst, compile};

/// Residuals of M θ̈ + b = Q, relative to the sum of their absolute terms; trees of 1 to
/// 12 links with copies, offsets, friction, drag and springs, by both solves.
#[test]
fn torques_from_outside_add_to_the_equations_of_motion() {
    let mut worst = Worst::default();
    for seed in 0..12 {
        let recipe = Recipe {
            links: 1 + seed as usize,
            copies: &[1, 1, 2, 3],
            nested: true,
            requests: "forces",
        };
        let sample = sample(&recipe, 700 + seed);
        for solve in Solve::ALL {
            let compiled = compile(&format!("{}, solve = {}", sample.text, solve.name()));
            let links = sample.tree.links.len();
            let mut random = Random::new(9000 + seed);
            for count in 0..100 {
                let theta = random.around_zero(links, PI);
                let omega = random.around_zero(links, 10.0);
                let torques = random.around_zero(links, 1.0);
                let inputs = [&theta[..], &omega, &torques];
                let alpha = compiled.evaluate("accelerations_under", &inputs);
                let alpha = DVector::from_vec(alpha);
                let motion = Motion::new(&sample.tree, &theta, &omega);
                let left = &motion.mass * &alpha + &motion.bias;
                let terms = &motion.mass_terms * alpha.abs() + &motion.bias_terms;
                for link in 0..links {
                    let size = terms.amax() + torques[link].abs();
                    let error = left[link] - torques[link];
                    worst.note(error, size, || format!("tree {seed}, state {count}"));
                }
            }
        }
    }
    worst.assert_below(1e-13, "residual under torques from outside");
}

#[test]
fn points_and_their_torques_are_those_of_vectors() {
    let mut worst = Worst::default();
    for seed in 0..12 {
        let recipe = Recipe {
            links: 1 + seed as usize,
            copies: &[1, 1, 2, 3],
            nested: true,
            requests: "positions",
        };
        let sample = sample(&recipe, 800 + seed);
        let compiled = compile(&sample.text);
        let (tree, links) = (&sample.tree, sample.tree.links.len());
        let mut random = Random::new(seed);
        for _ in 0..50 {
            let theta = random.around_zero(links, PI);
            let omega = random.around_zero(links, 10.0);
            let forces = random.around_zero(2 * links, 2.0);
            for (kind, place) in [("pivot", None), ("centre", Some(()))] {
                let points: Vec<Place> = (0..links)
                    .map(|link| Place {
                        link,
                        place: place.map_or([0.0; 2], |()| tree.links[link].com),
                    })
                    .collect();
                let each = |value: &dyn Fn(Place) -> [f64; 2]| -> Vec<f64> {
                    points.iter().flat_map(|&point| value(point)).collect()
                };
                let mut torques = vec![0.0; links];
                for (point, force) in points.iter().zip(forces.chunks(2)) {
                    let own = tree.torques(*point, &theta, [force[0], force[1]]);
                    for (sum, own) in torques.iter_mut().zip(own) {
                        *sum += own;
                    }
                }
                let compared = [
                    (
                        compiled.evaluate(&format!("{kind}s"), &[&theta]),
                        each(&|point| tree.position(point, &theta)),
                    ),
                    (
                        compiled.evaluate(&format!("{kind}_velocities"), &[&theta, &omega]),
                        each(&|point| tree.velocity(point, &theta, &omega)),
                    ),
                    (
                        compiled.evaluate(&format!("{kind}_torques"), &[&theta, &forces]),
                        torques,
                    ),
                ];
                for (found, expected) in compared {
                    let size = expected.iter().fold(1e-3_f64, |size, v| size.max(v.abs()));
                    for (found, expected) in found.iter().zip(&expected) {
                        worst.note(found - expected, size, || format!("{kind}, tree {seed}"));
                    }
                }
            }
        }
    }
    worst.assert_below(1e-14, "points of random trees");
}

/// With a drive and friction, by M⁻¹ Q on top of the accelerations without.
#[test]
fn torques_from_outside_stand_beside_a_drive() {
    for solve in Solve::ALL {
        let compiled = compile(&format!(
            "gravity = 9.80665, solve = {},
            trunk: rod(mass = 0.2, length = 0.3, friction = 2e-3) [
                twig: rod(mass = 0.1, length = 0.2, friction = 1e-3) * 2
            ],
            drive(torque = 0.3 * cos(3 * t), x = 0.01 * sin(5 * t)),
            emit(momenta, forces)",
            solve.name()
        ));
        let mut random = Random::new(4);
        for _ in 0..50 {
            let [theta, omega] = [PI, 8.0].map(|size| random.around_zero(3, size));
            let torques = random.around_zero(3, 0.5);
            let time = [random.between(0.0, 9.0)];
            let free = compiled.evaluate("accelerations", &[&time, &theta, &omega]);
            let pushed =
                compiled.evaluate("accelerations_under", &[&time, &theta, &omega, &torques]);
            let more = compiled.evaluate("velocities", &[&theta, &torques]);
            let size = pushed
                .iter()
                .chain(&free)
                .fold(1.0_f64, |s, v| s.max(v.abs()));
            for link in 0..3 {
                assert!((pushed[link] - free[link] - more[link]).abs() < 1e-12 * size);
            }
        }
    }
}
