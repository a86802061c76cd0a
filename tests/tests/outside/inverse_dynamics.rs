//! Torques of a given motion: against the Lagrangian in dual numbers, the balance of energy,
//! the accelerations under these torques, and between the forms of a tree.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual};
use branched_pendulum::system::{At, Computes, TotalEnergy, functions};
use branched_pendulum_compiler_tests::random::Random;

/// All that acts on links, by one of the solves or in a loop.
macro_rules! branch {
    ($name:ident, $how:ident = $value:ident) => {
        #[branched_pendulum(
                    gravity = 9.80665,
                    $how = $value,
                    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
                        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
                            joint = (0.25, 0.03), spring = 0.1, friction(coulomb = 0.01,
                                static = 0.015, stribeck = 0.3, width = 0.1)) [
                            twig: rod(mass = 0.03, length = 0.2, drag = 1e-4) * 2
                        ],
                        shoot(mass = 0.05, com = 0.1, inertia = 1e-4),
                    ],
                    between(twig_2, shoot, spring = 0.03, rest = 0.2),
                    drive(torque = 0.2 * cos(3 * t), y = 0.01 * cos(4 * t)),
                    emit(energies, inverse_dynamics),
                )]
        struct $name;
    };
}

branch!(Factorized, solve = factorization);
branch!(Recursive, solve = recursion);
branch!(Looped, code = loops);

/// Without friction and drive.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [
        bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, at = (0.3, -0.02),
            joint = (0.25, 0.03), spring = 0.1) [
            twig: rod(mass = 0.03, length = 0.2) * 2
        ],
        shoot(mass = 0.05, com = 0.1, inertia = 1e-4),
    ],
    emit(energies, momenta, modes, inverse_dynamics),
)]
struct Conservative;

/// A tree by rule, in loops over generations.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    tree: generations(count = 6, branching = 2, mass = 0.3, com = 0.1, inertia = 1e-3,
        joint = (0.2, 0.01), mass_ratio = 0.6, length_ratio = 0.8, friction = 1e-3, spring = 0.02),
    emit(energies, inverse_dynamics),
)]
struct ByRule;

const LINKS: usize = 5;

type State5 = [[f64; LINKS]; 3];

/// Angles, angular velocities and angular accelerations.
fn motions(seed: u64) -> impl Iterator<Item = (f64, State5)> {
    let mut random = Random::new(seed);
    (0..100).map(move |_| {
        let time = random.between(0.0, 9.0);
        let sizes = [3.0, 9.0, 80.0];
        let values = sizes.map(|size| random.around_zero(LINKS, size).try_into().expect("five"));
        (time, values)
    })
}

/// Compares relative to the largest value.
fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let size = expected
        .iter()
        .fold(0.0_f64, |size, value| size.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - expected).abs();
        assert!(error <= tolerance * size, "{found} {expected}");
    }
}

/// Q = dp/dt − ∂(K − U)/∂θ with p = ∂K/∂ω, all by dual numbers.
#[test]
fn torques_are_those_of_the_lagrangian() {
    let model = Conservative::new();
    for (_, [theta, omega, alpha]) in motions(3) {
        let moving = |values: [f64; LINKS], rates: [f64; LINKS]| {
            std::array::from_fn(|i| Dual {
                value: values[i],
                tangents: [rates[i]],
            })
        };
        let along: Conservative<Dual<f64, 1>> = model.cast(Dual::constant);
        let momenta = along.momenta(&moving(theta, omega), &moving(omega, alpha));
        let at: Conservative<Dual<f64, LINKS>> = model.cast(Dual::constant);
        let angles: [_; LINKS] = std::array::from_fn(|i| Dual::variable(theta[i], i));
        let rates = omega.map(Dual::constant);
        let slopes = (at.kinetic_energy(&angles, &rates) - at.potential_energy(&angles)).tangents;
        let expected: [f64; LINKS] = std::array::from_fn(|i| momenta[i].tangents[0] - slopes[i]);
        near(
            &model.inverse_dynamics(&theta, &omega, &alpha),
            &expected,
            1e-13,
        );
    }
}

/// Q = M α + b, where b = −M α₀ with the accelerations α₀ of free motion.
#[test]
fn torques_are_the_mass_matrix_times_what_is_not_free() {
    let model = Conservative::new();
    for (_, [theta, omega, alpha]) in motions(4) {
        let free = model.accelerations(&theta, &omega);
        let mass = model.mass_matrix(&theta);
        let expected = mass.map(|row| {
            let terms = row.iter().zip(alpha.iter().zip(&free));
            terms
                .map(|(mass, (alpha, free))| mass * (alpha - free))
                .sum::<f64>()
        });
        near(
            &model.inverse_dynamics(&theta, &omega, &alpha),
            &expected,
            1e-13,
        );
    }
}

/// dE/dt along the motion is the power of the torques, of friction and of the drive.
fn balances<P>(
    model: &P,
    energy: &impl FirstIntegral<f64>,
    powers: impl Fn(f64, &[f64; LINKS], &[f64; LINKS]) -> f64,
) where
    P: Pendulum<f64>
        + Computes<functions::AccelerationsUnderTorques, f64>
        + Computes<functions::InverseDynamics, f64>,
{
    for (time, [theta, omega, alpha]) in motions(5) {
        let mut torques = [0.0; LINKS];
        model.inverse_dynamics_into(time, &theta, &omega, &alpha, &mut torques);
        let state: Vec<f64> = theta.into_iter().chain(omega).collect();
        let mut slopes = [0.0; 2 * LINKS];
        energy.evaluate(&state, &mut slopes);
        let rates = omega.iter().chain(&alpha);
        let rate: f64 = slopes
            .iter()
            .zip(rates)
            .map(|(slope, rate)| slope * rate)
            .sum();
        let outside = torques.iter().zip(&omega);
        let outside: Vec<f64> = outside.map(|(torque, omega)| torque * omega).collect();
        let power = outside.iter().sum::<f64>() + powers(time, &theta, &omega);
        let size: f64 = outside.iter().map(|power| power.abs()).sum();
        assert!((rate - power).abs() < 1e-12 * size, "{rate} {power}");
    }
}

#[test]
fn the_balance_of_energy_holds() {
    let model = Factorized::new();
    balances(
        &model,
        &TotalEnergy::new::<f64>(&model),
        |time, theta, omega| model.friction_power(omega) + model.drive_power(time, theta, omega),
    );
    let model = Recursive::new();
    balances(
        &model,
        &TotalEnergy::new::<f64>(&model),
        |time, theta, omega| model.friction_power(omega) + model.drive_power(time, theta, omega),
    );
    let model = Looped::new();
    balances(
        &model,
        &TotalEnergy::new::<f64>(&model),
        |time, theta, omega| model.friction_power(omega) + model.drive_power(time, theta, omega),
    );
}

/// The accelerations under the torques are those that were given.
fn returns<P>(model: &P, tolerance: f64)
where
    P: Pendulum<f64>
        + Computes<functions::AccelerationsUnderTorques, f64>
        + Computes<functions::InverseDynamics, f64>,
{
    let (links, mut random) = (model.links(), Random::new(6));
    for _ in 0..100 {
        let time = random.between(0.0, 9.0);
        let [theta, omega, alpha] = [3.0, 9.0, 80.0].map(|size| random.around_zero(links, size));
        let (mut torques, mut back) = (vec![0.0; links], vec![0.0; links]);
        model.inverse_dynamics_into(time, &theta, &omega, &alpha, &mut torques);
        model.accelerations_under_into(time, &theta, &omega, &torques, &mut back);
        near(&back, &alpha, tolerance);
    }
}

#[test]
fn accelerations_under_the_torques_are_the_given_ones() {
    returns(&Conservative::new(), 1e-12);
    returns(&Factorized::new(), 1e-12);
    returns(&Recursive::new(), 1e-12);
    returns(&Looped::new(), 1e-12);
    returns(&ByRule::new(), 1e-12);
}

#[test]
fn all_forms_agree() {
    let (factorized, recursive, looped) = (Factorized::new(), Recursive::new(), Looped::new());
    let precise: Recursive<Double> = recursive.cast(Double::from_f64);
    for (time, [theta, omega, alpha]) in motions(7) {
        let expected = precise
            .inverse_dynamics(
                Double::from_f64(time),
                &theta.map(Double::from_f64),
                &omega.map(Double::from_f64),
                &alpha.map(Double::from_f64),
            )
            .map(Double::to_f64);
        near(
            &factorized.inverse_dynamics(time, &theta, &omega, &alpha),
            &expected,
            1e-13,
        );
        near(
            &recursive.inverse_dynamics(time, &theta, &omega, &alpha),
            &expected,
            1e-13,
        );
        near(
            &looped.inverse_dynamics(time, &theta, &omega, &alpha),
            &expected,
            1e-13,
        );
    }
}

/// States in a batch have the bits that they have alone.
fn has_the_bits_of_single_states<P>(model: &P)
where
    P: Pendulum<f64>
        + Computes<functions::AccelerationsUnderTorques, f64>
        + Computes<functions::InverseDynamics, f64>,
{
    const STATES: usize = 21;
    let (links, mut random) = (model.links(), Random::new(8));
    let mut columns = |size: f64| -> Vec<Vec<f64>> {
        (0..links)
            .map(|_| random.around_zero(STATES, size))
            .collect()
    };
    let given = [3.0, 9.0, 80.0].map(&mut columns);
    let mut torques = vec![vec![0.0; STATES]; links];
    let slices: [&[Vec<f64>]; 3] = given.each_ref().map(Vec::as_slice);
    let at = At::time(0.7);
    Batch::new(model)
        .compute(functions::InverseDynamics, at, slices, [&mut torques[..]])
        .expect("slices fit");
    for state in 0..STATES {
        let [theta, omega, alpha] = given.each_ref().map(|argument| {
            argument
                .iter()
                .map(|slice| slice[state])
                .collect::<Vec<_>>()
        });
        let mut alone = vec![0.0; links];
        model.inverse_dynamics_into(0.7, &theta, &omega, &alpha, &mut alone);
        let in_batch: Vec<f64> = torques.iter().map(|slice| slice[state]).collect();
        assert_eq!(in_batch, alone);
    }
}

#[test]
fn a_batch_has_the_bits_of_single_states() {
    has_the_bits_of_single_states(&Factorized::new());
    has_the_bits_of_single_states(&Recursive::new());
    has_the_bits_of_single_states(&Looped::new());
    has_the_bits_of_single_states(&ByRule::new());
}

#[test]
fn slices_of_a_wrong_length_give_nan() {
    let mut torques = [0.0; LINKS];
    Looped::new().inverse_dynamics_into(0.0, &[0.0; 4], &[0.0; 5], &[0.0; 5], &mut torques);
    assert!(torques.iter().all(|torque| torque.is_nan()));
    let mut torques = [0.0; LINKS];
    Recursive::new().inverse_dynamics_into(0.0, &[0.0; 5], &[0.0; 5], &[0.0; 6], &mut torques);
    assert!(torques.iter().all(|torque| torque.is_nan()));
}

/// Copies in phase: torques on a link that stands for two are the sums of those on both.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.03, length = 0.2, friction = 1e-3) * 2],
    in_phase(twig),
    emit(inverse_dynamics),
)]
struct InPhase;

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.03, length = 0.2, friction = 1e-3) * 2],
    emit(inverse_dynamics),
)]
struct Whole;

#[test]
fn torques_in_phase_are_sums() {
    let (small, whole) = (InPhase::new(), Whole::new());
    let sum = small.inverse_dynamics(&[0.4, -1.0], &[1.0, 2.0], &[5.0, -3.0]);
    let all = whole.inverse_dynamics(&[0.4, -1.0, -1.0], &[1.0, 2.0, 2.0], &[5.0, -3.0, -3.0]);
    near(&sum, &[all[0], all[1] + all[2]], 1e-13);
}
