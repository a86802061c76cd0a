//! Derivatives of the end of a motion by the symplectic route. The flow of a conservative tree is
//! symplectic in canonical variables, JᵀΩJ = Ω, so that Jᵀ u = Ω J⁻¹ Ω⁻¹ u: a tangent that starts at
//! the end and follows the motion backwards. No discrete adjoint and no pullback is involved.

use std::cell::RefCell;

use branched_pendulum::analysis::variational::{Linearised, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{OdeFn, Workspace};
use branched_pendulum_compiler_tests::random::Random;

/// The apparatus of the paper, without friction.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(momenta, gradient(accelerations)),
)]
struct Paper;

const LINKS: usize = 3;
const STATE: usize = 2 * LINKS;

type Vector = [f64; LINKS];

fn halves(state: &[f64]) -> [Vector; 2] {
    let (first, second) = state.split_at(LINKS);
    [first, second].map(|half| half.try_into().expect("one number for each link"))
}

/// Derivatives of Σ u p(θ, ω) by the angles, for a vector u that is kept.
fn by_angles(paper: &Paper, [theta, omega]: [Vector; 2], u: Vector) -> Vector {
    let varied = paper.cast(Dual::<f64, LINKS>::constant);
    let angles = std::array::from_fn(|link| Dual::variable(theta[link], link));
    let momenta = varied.momenta(&angles, &omega.map(Dual::constant));
    let mut sums = [0.0; LINKS];
    for (momentum, u) in momenta.iter().zip(u) {
        for (sum, slope) in sums.iter_mut().zip(momentum.tangents) {
            *sum += u * slope;
        }
    }
    sums
}

fn sum(a: Vector, b: Vector, sign: f64) -> Vector {
    std::array::from_fn(|link| a[link] + sign * b[link])
}

#[test]
fn derivatives_by_the_start_follow_the_motion_backwards() {
    let paper = Paper::new();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let start = State::new(0.0, vec![0.4, -0.3, 0.5, 0.2, 1.0, -0.7]);
    let mut random = Random::new(12);
    let weights: [f64; STATE] = random.array(-1.0, 1.0);
    let cost = |_: usize, state: &[f64], slopes: &mut [f64]| {
        slopes.copy_from_slice(&weights);
        let terms = state.iter().zip(weights);
        terms.map(|(value, weight)| value * weight).sum()
    };
    let ode = AbsoluteAngles(&paper);
    let gradient = method.gradient(&ode, 0, &start, &[10.0], cost);
    let gradient = gradient.expect("a motion");

    // With y = (θ, ω), z = (θ, p) and T = ∂z/∂y, the derivatives Φᵀ w by the start are
    // T₀ᵀ Jᵀ T₁⁻ᵀ w. At the end, u = T₁⁻ᵀ w:
    let end = method.run(&ode, &start, 10.0).expect("a motion").state;
    let [theta, omega] = halves(&end.values);
    let [w_theta, w_omega] = halves(&weights);
    let u_momenta = paper.velocities(&theta, &w_omega);
    let u_theta = sum(w_theta, by_angles(&paper, [theta, omega], u_momenta), -1.0);
    // Ω⁻¹ u = (−u_p, u_θ), backwards along the motion.
    let momenta = paper.momenta(&theta, &omega);
    let tangent = [u_momenta.map(|value| -value), u_theta];
    let canonical = linearised(CanonicalVariables(&paper));
    let workspace = RefCell::new(Workspace::new());
    let backwards = OdeFn::new(2 * STATE, |time: f64, values: &[f64], rates: &mut [f64]| {
        let (state, deviation) = values.split_at(STATE);
        let (of_state, of_deviation) = rates.split_at_mut(STATE);
        let workspace = &mut *workspace.borrow_mut();
        canonical.linearised_rates(workspace, time, state, deviation, of_state, of_deviation);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
    });
    let values = [theta, momenta, tangent[0], tangent[1]].concat();
    let back = method.run(&backwards, &State::new(0.0, values), 10.0);
    let back = back.expect("a motion").state.values;
    let (state, tangent) = back.split_at(STATE);
    let [theta, omega] = halves(&start.values);
    let expected = [theta, paper.momenta(&theta, &omega)].concat();
    let missed = state.iter().zip(&expected).map(|(a, b)| (a - b).abs());
    let missed = missed.fold(0.0, f64::max);
    // Ω v = (v_p, −v_θ), then T₀ᵀ.
    let [v_theta, v_momenta] = halves(tangent);
    let (u_theta, u_momenta) = (v_momenta, v_theta.map(|value| -value));
    let found = [
        sum(u_theta, by_angles(&paper, [theta, omega], u_momenta), 1.0),
        paper.momenta(&theta, &u_momenta),
    ]
    .concat();

    let all = found.iter().chain(&gradient.start).chain(state);
    assert!(all.into_iter().all(|own| own.is_finite()));
    let size = found.iter().fold(0.0_f64, |size, own| size.max(own.abs()));
    let errors = found.iter().zip(&gradient.start);
    let errors = errors.map(|(a, b)| (a - b).abs() / size);
    let error = errors.fold(0.0, f64::max);
    println!("{error:.1e} of {size:.1e}; the start is missed by {missed:.1e}");
    assert!(missed < 1e-9, "{missed}");
    assert!(error < 1e-9, "{error}");
}
