//! The paper's apparatus against reference numbers from arbitrary-precision
//! arithmetic (physics §6 and §7).

mod run_time;

use branched_pendulum::analysis::Modes;
use branched_pendulum::prelude::*;
use branched_pendulum_tests::reference::{number, numbers, read, trajectory};
use branched_pendulum_tests::scenes::paper::Paper;

use self::run_time::AtRunTime;
use crate::support::{Worst, compile_paper};

/// The paper's constants.
struct Constants {
    m_1: f64,
    m_2: f64,
    mu: f64,
    g_1: f64,
    g_2: f64,
}

/// The sizes of the summands of each formula at one phase point: every product
/// of the multiplied-out formula by itself, without the cancellation between
/// them. Velocities stand for the sums |M̃⁻¹| |p| that they are.
struct Terms {
    energy: Vec<f64>,
    antiphase_energy: Vec<f64>,
    angle_kinetic: Vec<f64>,
    angle_potential: Vec<f64>,
    quadratic_form: [Vec<f64>; 3],
    amplitude: Vec<f64>,
    exact: Vec<f64>,
}

impl Terms {
    fn new(constants: &Constants, q: &[f64], p: &[f64]) -> Self {
        let Constants {
            m_1,
            m_2,
            mu,
            g_1,
            g_2,
        } = *constants;
        let (theta_1, theta_m, theta_d) = (q[0], q[1], q[2]);
        let (p_1, p_m, p_d) = (p[0].abs(), p[1].abs(), p[2].abs());
        let (s, c) = (theta_m - theta_1).sin_cos();
        let (s, c) = (s.abs(), c.abs());
        let (sin_d, cos_d) = (theta_d.sin().abs(), theta_d.cos().abs());
        let d = 2.0 * m_1 * m_2 - 4.0 * mu * mu * c * c;
        // W_K = -μ s (M_2 p_1 - μ c p_m) p_d² / (M_2² D)
        let kinetic = |x: f64| mu * s * x * p_d * p_d / (m_2 * m_2 * d);
        let angle_kinetic = vec![kinetic(m_2 * p_1), kinetic(mu * c * p_m)];
        // W_P = (G_2/M_2) (1 - cos θ_m) p_d θ_d
        let lift = 1.0 - theta_m.cos();
        let angle_potential = vec![g_2 / m_2 * lift * p_d * theta_d.abs()];
        // In-phase velocities of the expansion.
        let w_1 = (2.0 * m_2 * p_1 + 2.0 * mu * c * p_m) / d;
        let w_m = (m_1 * p_m + 2.0 * mu * c * p_1) / d;
        let a_pp = [m_2 * p_1, mu * c * p_m].map(|x| mu * s * x / (m_2 * m_2 * d));
        let a_pq = [
            g_2 * lift / m_2,
            mu * mu * s * s * w_1 * w_1 / m_2,
            mu * c * w_1 * w_m,
        ];
        let a_pq = [a_pq[0], a_pq[1], a_pq[2] / m_2];
        let a_qq = [m_2 * p_1, mu * c * p_m].map(|x| 4.0 * g_2 * mu * s * x / (m_2 * d));
        let amplitude = a_pp
            .iter()
            .map(|a| a * p_d * p_d)
            .chain(a_pq.iter().map(|a| a * p_d * theta_d.abs()))
            .chain(a_qq.iter().map(|a| a * theta_d * theta_d))
            .collect();
        // Velocities proper, |M̃⁻¹| |p| by Cramer's rule.
        let (b, e) = (2.0 * mu * c * cos_d, 2.0 * mu * s * sin_d);
        let two = 2.0 * m_2;
        let det = two * (m_1 * two - b * b - e * e);
        let v_1 = (two * two * p_1 + two * b * p_m + two * e * p_d) / det;
        let v_m = (two * b * p_1 + (m_1 * two - e * e) * p_m + b * e * p_d) / det;
        let v_d = (two * e * p_1 + b * e * p_m + (m_1 * two - b * b) * p_d) / det;
        let slope = g_2 * (2.0 * theta_d).sin().abs();
        let rate = p_d / two;
        let exact = vec![
            slope * v_d,
            rate * 2.0 * mu * c * sin_d * v_1 * v_m,
            rate * 2.0 * mu * s * cos_d * v_1 * v_d,
            rate * 2.0 * g_2 * theta_m.cos().abs() * sin_d,
        ];
        Self {
            energy: vec![
                0.5 * p_1 * v_1,
                0.5 * p_m * v_m,
                0.5 * p_d * v_d,
                g_1 * (1.0 - theta_1.cos()),
                2.0 * g_2 * (1.0 - theta_m.cos() * theta_d.cos()),
            ],
            antiphase_energy: vec![p_d * p_d / (4.0 * m_2), g_2 * sin_d * sin_d],
            angle_kinetic,
            angle_potential,
            quadratic_form: [a_pp.to_vec(), a_pq.to_vec(), a_qq.to_vec()],
            amplitude,
            exact,
        }
    }
}

fn largest(terms: &[f64]) -> f64 {
    terms.iter().copied().fold(0.0, f64::max)
}

/// All 25 points, each figure by the program, by the compiled code and by a tree at run time, to
/// 1e-12 of its largest term.
#[test]
fn energy_and_transfer_at_phase_points() {
    let reference = read("energy-transfer-points.json");
    let constants = &reference["constants"];
    let constants = Constants {
        m_1: number(&constants["M1"]),
        m_2: number(&constants["M2"]),
        mu: number(&constants["mu"]),
        g_1: number(&constants["G1"]),
        g_2: number(&constants["G2"]),
    };
    let model = Paper::new();
    // The literals are exact, so that these are the nearest numbers.
    assert_eq!(model.inertia_parent(), constants.m_1);
    assert_eq!(model.inertia_child(), constants.m_2);
    assert_eq!(model.coupling_child_parent(), constants.mu);
    assert_eq!(model.gravity_parent(), constants.g_1);
    assert_eq!(model.gravity_child(), constants.g_2);
    let compiled = compile_paper();
    let at_run_time = AtRunTime::new();
    let points = reference["points"].as_array().expect("points");
    assert_eq!(points.len(), 25);
    let mut worst = Worst::default();
    for (count, point) in points.iter().enumerate() {
        let q = ["th1", "thM", "thD"].map(|name| number(&point[name]));
        let p = ["p1", "pM", "pD"].map(|name| number(&point[name]));
        let terms = Terms::new(&constants, &q, &p);
        let rates = model.symmetric_velocities(&q, &p);
        let angle = model.transfer_angle_1(&q, &p);
        let form = model.transfer_quadratic_form(&q, &p);
        let amplitude = model.transfer_amplitude_2(&q, &p);
        let exact = model.transfer_exact(&q, &p);
        let by_rates = model.transfer_exact_from_rates(&q, &rates);
        let mut check = |name: &str, emitted: f64, terms: &[f64], by_program: f64| {
            assert_eq!(emitted, by_program, "{name} at point {count}");
            let expected = number(&point[name]);
            worst.note(emitted - expected, largest(terms), || {
                format!("{name}, point {count}")
            });
        };
        let program = |entry: &str| compiled.evaluate(entry, &[&q, &p]);
        let total = |entry: &str| program(entry)[0] + program(entry)[1];
        check(
            "H",
            model.hamiltonian(&q, &p),
            &terms.energy,
            program("hamiltonian")[0],
        );
        check(
            "Hd",
            model.antiphase_energy(&q, &p),
            &terms.antiphase_energy,
            program("antiphase_energy")[0],
        );
        check(
            "WK_paper",
            angle.kinetic,
            &terms.angle_kinetic,
            program("transfer_angle_1")[0],
        );
        check(
            "WP_paper",
            angle.potential,
            &terms.angle_potential,
            program("transfer_angle_1")[1],
        );
        for (index, name) in ["a_pp", "a_pq", "a_qq"].into_iter().enumerate() {
            check(
                name,
                form[index],
                &terms.quadratic_form[index],
                program("transfer_quadratic_form")[index],
            );
        }
        check(
            "W_eps2",
            amplitude.total(),
            &terms.amplitude,
            total("transfer_amplitude_2"),
        );
        check("W", exact.total(), &terms.exact, total("transfer_exact"));
        let program = compiled.evaluate("transfer_exact_from_rates", &[&q, &rates]);
        check("W", by_rates.total(), &terms.exact, program[0] + program[1]);
        at_run_time.note(&mut worst, point, &terms, [&q, &p]);
    }
    worst.assert_below(1e-12, "phase points");
}

/// Largest error of angles and velocities at each of the times, of a run in
/// absolute angles and of one in symmetric coordinates.
fn trajectory_errors(problem: &str, times: &[f64]) -> Vec<[f64; 2]> {
    let (theta, expected) = trajectory(problem);
    let model = Paper::new();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let distance = |time: f64, found: &[f64]| -> f64 {
        let expected = expected(time);
        assert_eq!(expected.len(), found.len());
        let differences = expected.iter().zip(found).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
    };
    let mut errors = vec![[0.0; 2]; times.len()];
    let mut visits = 0;
    method
        .sample(
            &AbsoluteAngles(&model),
            &State::at_rest(0.0, &theta),
            times,
            |time, state| {
                errors[visits][0] = distance(time, state);
                visits += 1;
            },
        )
        .expect("the motion is regular");
    assert_eq!(visits, times.len());
    let mut visits = 0;
    method
        .sample(
            &SymmetricCoordinates(&model),
            &State::at_rest(0.0, &model.to_symmetric(&theta)),
            times,
            |time, state| {
                let &[q_1, q_m, q_d, v_1, v_m, v_d] = state else {
                    panic!("{} values", state.len());
                };
                let theta = model.from_symmetric(&[q_1, q_m, q_d]);
                let omega = model.from_symmetric(&[v_1, v_m, v_d]);
                errors[visits][1] = distance(time, &[theta, omega].concat());
                visits += 1;
            },
        )
        .expect("the motion is regular");
    assert_eq!(visits, times.len());
    errors
}

#[test]
fn regular_trajectory() {
    let errors = trajectory_errors("regular", &[1.0, 2.0, 5.0, 10.0]);
    println!("regular: {errors:?}");
    assert!(errors.as_flattened().iter().all(|error| *error < 1e-11));
}

#[test]
fn trajectory_near_the_threshold() {
    let errors = trajectory_errors("near-threshold", &[1.0, 2.0, 5.0, 10.0]);
    println!("near the threshold: {errors:?}");
    assert!(errors.as_flattened().iter().all(|error| *error < 1e-7));
}

/// Energy along 10 s of the paper's case, at every step, relative to the
/// energy above the hanging state.
#[test]
fn energy_is_held_along_ten_seconds() {
    let model = Paper::new();
    let mut worst = Worst::default();
    for problem in ["regular", "near-threshold"] {
        let reference = &read("trajectories.json")["problems"][problem];
        let theta: [f64; 3] = numbers(&reference["theta_0"])
            .try_into()
            .expect("three angles");
        let initial = model.potential_energy(&theta);
        // The reference counts from where the angles are 90°.
        let rest = model.gravity_parent() + 2.0 * model.gravity_child();
        let expected = number(&reference["energy"]) + rest;
        assert!((initial - expected).abs() < 1e-15, "{initial} {expected}");
        let mut steps = 0;
        Dop853::new(Options::with_tolerance(1e-13))
            .integrate(
                &AbsoluteAngles(&model),
                &State::at_rest(0.0, &theta),
                10.0,
                |step| {
                    let &[a, b, c, u, v, w] = step.end() else {
                        panic!("{} values", step.end().len());
                    };
                    let (theta, omega) = ([a, b, c], [u, v, w]);
                    let energy =
                        model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta);
                    steps += 1;
                    worst.note(energy - initial, initial, || {
                        format!("{problem}, step {steps}")
                    });
                    ControlFlow::Continue(())
                },
            )
            .expect("the motion is regular");
        assert!(steps > 100);
    }
    worst.assert_below(1e-12, "energy");
}

/// f_+, f_−, f_d to the seven digits that physics §6 and the paper's
/// parameters give.
#[test]
fn linear_modes() {
    let model = Paper::new();
    let rest = [0.0; 3];
    let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest))
        .expect("the pendulum hangs stably");
    let expected = [0.873_169_6, 1.258_058_4, 1.582_556_7];
    println!("modes: {:?}", modes.frequencies_hz);
    assert_eq!(modes.frequencies_hz.len(), 3);
    for (found, expected) in modes.frequencies_hz.iter().zip(expected) {
        assert!((found - expected).abs() < 0.5e-7, "{found} {expected}");
    }
    // The middle one is the antiphase mode: the parent rests.
    let antiphase = &modes.shapes[1];
    assert!(antiphase[0].abs() < 1e-12 * antiphase[1].abs());
    assert!((antiphase[1] + antiphase[2]).abs() < 1e-12 * antiphase[1].abs());
    let f_d = (model.gravity_child() / model.inertia_child()).sqrt() / std::f64::consts::TAU;
    assert!((modes.frequencies_hz[1] - f_d).abs() < 1e-14 * f_d);
}

/// The emitted Hamilton's equations under a symplectic method: energy wanders by
/// rounding and does not drift.
#[test]
fn gauss_methods_hold_the_energy_of_canonical_variables() {
    let model = Paper::new();
    let theta = [0.3, 0.25, 0.35];
    let momenta = model.momenta(&theta, &[0.0; 3]);
    let start = State::from_positions_and_momenta(0.0, &theta, &momenta).expect("three of each");
    let energy = |state: &[f64]| {
        let theta = [state[0], state[1], state[2]];
        let omega = model.velocities(&theta, &[state[3], state[4], state[5]]);
        model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta)
    };
    let first = energy(&start.values);
    let mut worst = 0.0_f64;
    Gauss::new(GaussOrder::Eight, 5e-3)
        .integrate(&CanonicalVariables(&model), &start, 100.0, |step| {
            worst = worst.max((energy(step.end()) - first).abs());
            ControlFlow::Continue(())
        })
        .expect("it runs");
    println!("energy error {:.1e} of {first:.3}", worst);
    assert!(worst <= 1e-14 * first, "{worst:e} of {first:e}");
}
