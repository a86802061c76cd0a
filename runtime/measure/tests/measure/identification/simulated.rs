//! Records whose parameters are known.

use branched_pendulum_measure::identification::{AngleRecord, Shooting};

use super::chain::{REAL, five_unknown, simulated};

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
