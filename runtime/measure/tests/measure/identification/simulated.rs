//! Records whose parameters are known.

use branched_pendulum_measure::identification::{
    AngleRecord, FamilyOf, Frequency, Identification, IdentificationError, Shooting,
};

use super::chain::{Chain, GRAVITY, REAL, five_unknown, simulated};

#[test]
fn parameters_come_back_from_a_motion_without_noise() {
    let record = simulated([0.8, -0.5], 20.0, 50.0, 0.0, 1);
    let shooting = Shooting {
        tolerance: 1e-13,
        ..Shooting::default()
    };
    let task = five_unknown(|value| 1.3 * value)
        .with_offsets()
        .with_shooting(shooting);
    let fit = task.fit(&record).unwrap();
    for (name, value) in &REAL[3..] {
        let found = fit.determined(name).unwrap().value;
        assert!(
            (found / value - 1.0).abs() < 1e-8 * scale(name),
            "{name} {found} {value}"
        );
    }
    assert!(fit.offset("upper").abs() < 1e-9);
    assert_eq!(fit.stages.last().unwrap().segments, 1);
    assert_eq!(fit.impossible, None);
}

/// The friction of the lower joint is small beside all others.
fn scale(name: &str) -> f64 {
    match name {
        "viscous_2" => 100.0,
        _ => 1.0,
    }
}

#[test]
fn one_link_in_sight_tells_of_both() {
    let record = simulated([0.8, -0.5], 20.0, 50.0, 0.0, 1);
    let times = record.times().to_vec();
    let whole = five_unknown(|value| value);
    let fit = whole.fit(&record).unwrap();
    let motion = whole.predict(&fit, &times).unwrap();
    let lower: Vec<Option<f64>> = motion.iter().map(|state| Some(state.values[1])).collect();
    let half = AngleRecord::new(&times).with_link("lower", &lower, 1e-3);
    let fit = five_unknown(|value| 1.05 * value).fit(&half).unwrap();
    let joint = fit.determined("joint_1").unwrap().value;
    assert!((joint / 0.172719204 - 1.0).abs() < 1e-6, "{joint}");
}

#[test]
fn frequencies_determine_inertias() {
    // Frequencies of the truth, then from 20 % off.
    let task = |off: f64| {
        let task = Identification::new(FamilyOf::<Chain>::new()).known("gravity", GRAVITY);
        REAL.iter().fold(task, |task, &(name, value)| {
            match name.starts_with("inertia") {
                true => task.unknown(name, off * value),
                false if name.starts_with("viscous") => task.known(name, 0.0),
                false => task.known(name, value),
            }
        })
    };
    let datum = |mode: usize, hertz: f64| Frequency {
        mode,
        hertz,
        deviation: 1e-3,
    };
    // Known from the mass matrix and the stiffness of the two links by hand.
    let hertz = two_frequencies();
    let fit = task(1.2)
        .with_frequency(datum(0, hertz[0]))
        .with_frequency(datum(1, hertz[1]))
        .fit_to_frequencies()
        .unwrap();
    for name in ["inertia_1", "inertia_2"] {
        let value = REAL.iter().find(|(own, _)| *own == name).unwrap().1;
        let found = fit.determined(name).unwrap().value;
        assert!((found / value - 1.0).abs() < 1e-6, "{name} {found} {value}");
    }
    let error = task(1.2).with_frequency(datum(2, 1.0)).fit_to_frequencies();
    assert_eq!(error, Err(IdentificationError::Mode { mode: 2, modes: 2 }));
}

/// Without friction.
fn two_frequencies() -> [f64; 2] {
    let [m1, m2, d1, d2, l, i1, i2] = [0, 1, 2, 3, 4, 5, 6].map(|index: usize| REAL[index].1);
    let (a, b, c) = (
        i1 + m1 * d1 * d1 + l * l * m2,
        l * m2 * d2,
        i2 + m2 * d2 * d2,
    );
    let (g1, g2) = (GRAVITY * (m1 * d1 + l * m2), GRAVITY * m2 * d2);
    // det(K − λ M) = 0
    let (p, q, r) = (a * c - b * b, -(g1 * c + g2 * a), g1 * g2);
    let root = (q * q - 4.0 * p * r).sqrt();
    [-root, root].map(|root| ((-q + root) / (2.0 * p)).sqrt() / std::f64::consts::TAU)
}
