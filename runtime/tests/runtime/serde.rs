//! What the feature `serde` writes is read as it was, to the bit.

use branched_pendulum::integrate::{Checkpoint, Tolerance, Trajectory};
use branched_pendulum::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::problems::harmonic;

fn read_back<V: Serialize + DeserializeOwned>(value: &V) -> V {
    serde_json::from_str(&serde_json::to_string(value).unwrap()).unwrap()
}

#[test]
fn runs_and_what_they_are_asked_for() {
    let options = Options {
        absolute: Tolerance::PerComponent(vec![1e-9 / 3.0, 1e-12]),
        max_step: Some(0.1 + 0.2),
        ..Options::with_tolerance(1e-10 / 7.0)
    };
    assert_eq!(read_back(&options), options);
    let start = State::at_rest(0.1 + 0.2, &[1.0 / 3.0]);
    let method = Dop853::new(options);
    let run = method.run(&harmonic(), &start, 7.7).unwrap();
    assert_eq!(read_back(&run), run);
    // Goes on from the file as from the state.
    let on = |state| method.run(&harmonic(), state, 9.9);
    assert_eq!(on(&read_back(&run.state)).unwrap(), on(&run.state).unwrap());
    let gauss = Gauss::<f32>::for_animation(1.0 / 60.0);
    assert_eq!(read_back(&gauss), gauss);
    for method in Method::ALL {
        assert_eq!(read_back(method), *method);
    }
}

/// A checkpoint goes on from the file with the same bits.
#[test]
fn checkpoints() {
    let ode = harmonic();
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let start = State::at_rest(0.0, &[1.0 / 3.0]);
    let mut stepper = method.start(&ode, &start).unwrap();
    for _ in 0..20 {
        stepper.step().unwrap();
        let checkpoint = stepper.checkpoint().unwrap();
        assert_eq!(read_back(&checkpoint), checkpoint);
        let mut resumed = method.resume(&ode, &read_back(&checkpoint)).unwrap();
        assert_eq!(resumed.step().unwrap().end(), stepper.step().unwrap().end());
    }
}

#[test]
fn trajectories() {
    let start = State::at_rest(0.0, &[1.0]);
    let motion = Verner98::new(Options::with_tolerance(1e-9))
        .trajectory(&harmonic(), &start, 20.0)
        .unwrap();
    let read = read_back(&motion);
    assert_eq!(read, motion);
    assert_eq!(read.at(12.34).unwrap(), motion.at(12.34).unwrap());
}

/// Files that lie about themselves are refused by the name of what does not fit, before anything
/// is reserved for what they speak of.
#[test]
fn a_trajectory_that_is_none() {
    let start = State::at_rest(0.0, &[1.0]);
    let motion = Dop853::new(Options::with_tolerance(1e-9))
        .trajectory(&harmonic(), &start, 1.0)
        .unwrap();
    let text = serde_json::to_string(&motion).unwrap();
    for (from, to, field) in [
        ("\"Alternating\"", "\"Bernstein\"", "`steps[0].terms`"),
        ("\"Alternating\"", "\"Hermite\"", "`steps[0].terms`"),
        ("\"Alternating\"", "\"Linear\"", "`steps[0].terms`"),
        ("\"dimension\":2", "\"dimension\":20000", "`dimension`"),
        ("\"dimension\":2", "\"dimension\":0", "`steps[0].terms`"),
        ("\"dimension\":2", "\"dimension\":1", "`steps[0].first`"),
        ("\"numbers\":[", "\"numbers\":[1.0,", "`numbers`"),
        ("\"times\":[", "\"times\":[0.0,", "`times`"),
        ("\"times\":[0.0,", "\"times\":[0.5,", "`times[1]`"),
        (
            "\"first\":2,",
            "\"first\":18446744073709551615,",
            "`steps[0].first`",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        refused(&text.replace(from, to), field);
    }
}

fn refused(text: &str, field: &str) {
    let error = serde_json::from_str::<Trajectory<f64>>(text).unwrap_err();
    assert!(error.is_data(), "{text}: {error}");
    assert!(error.to_string().contains(field), "{text}: {error}");
}

/// A trajectory as text, of some steps in a form.
fn trajectory(
    dimension: u64,
    times: &str,
    steps: &[(&str, u64, [u64; 2])],
    numbers: usize,
) -> String {
    let steps: Vec<String> = steps
        .iter()
        .map(|(form, first, [terms, apart])| {
            format!(r#"{{"form":{form},"length":1.0,"first":{first},"terms":[{terms},{apart}]}}"#)
        })
        .collect();
    let numbers = vec!["1.5"; numbers].join(",");
    format!(
        r#"{{"dimension":{dimension},"times":{times},"steps":[{}],"numbers":[{numbers}]}}"#,
        steps.join(",")
    )
}

#[test]
fn trajectories_of_any_size_and_form() {
    let taylor = r#""Taylor""#;
    let six = r#"{"Collocation":"Six"}"#;
    let once = "[0.0,1.0]";
    for (dimension, times, steps, numbers, field) in [
        (0, once, &[(taylor, 0, [4, 0])][..], 4, "`steps[0].terms`"),
        (
            0,
            once,
            &[(r#""Alternating""#, 0, [4, 0])],
            4,
            "`steps[0].terms`",
        ),
        (0, once, &[(six, 0, [3, 0])], 3, "`steps[0].terms`"),
        (1, once, &[(taylor, 1, [0, 0])], 3, "`steps[0].terms`"),
        (3, once, &[(taylor, 3, [4, 0])], 13, "`steps[0].terms`"),
        (2, once, &[(six, 2, [8, 0])], 14, "`steps[0].terms`"),
        (2, once, &[(six, 2, [6, 1])], 13, "`steps[0].terms`"),
        (2, once, &[(taylor, 2, [4, 2])], 12, "`steps[0].terms`"),
        (1 << 60, "[0.0]", &[], 1, "`dimension`"),
        (1 << 40, "[0.0]", &[], 1, "`dimension`"),
        (u64::MAX, once, &[(taylor, 0, [4, 0])], 4, "`dimension`"),
        (1, once, &[(taylor, 1, [u64::MAX, 0])], 7, "`steps[0]`"),
        (2, once, &[(six, 2, [6, u64::MAX])], 12, "`steps[0].terms`"),
        (1, once, &[(taylor, 1, [4, 0])], 8, "`numbers`"),
        (1, once, &[(taylor, 1, [4, 0])], 6, "`numbers`"),
        (0, "[]", &[], 0, "`times`"),
        (
            1,
            "[0.0,1.0,0.5]",
            &[(taylor, 1, [4, 0]), (taylor, 7, [4, 0])],
            13,
            "`times[2]`",
        ),
        (
            1,
            "[0.0,-1.0,-0.5]",
            &[(taylor, 1, [4, 0]), (taylor, 7, [4, 0])],
            13,
            "`times[2]`",
        ),
        (
            1,
            "[0.0,1.0,2.0]",
            &[(taylor, 1, [4, 0]), (taylor, 1, [4, 0])],
            13,
            "`steps[1].first`",
        ),
    ] {
        refused(&trajectory(dimension, times, steps, numbers), field);
    }
    // Their like that are in order.
    for (dimension, times, steps, numbers) in [
        (0, once, &[(taylor, 0, [0, 0])][..], 0),
        (1, once, &[(taylor, 1, [4, 0])], 7),
        (2, "[0.0,-1.0]", &[(six, 2, [6, 0])], 12),
        (2, once, &[(six, 2, [6, 2])], 14),
        (
            1,
            "[0.0,1.0,2.0]",
            &[(taylor, 1, [4, 0]), (taylor, 7, [4, 0])],
            13,
        ),
        (5, "[3.0]", &[], 5),
    ] {
        let text = trajectory(dimension, times, steps, numbers);
        let motion: Trajectory<f64> = serde_json::from_str(&text).unwrap();
        let middle = 0.5 * (motion.start_time() + motion.end_time());
        let state = motion.at(middle).unwrap();
        assert_eq!(state.len() as u64, dimension);
        assert!(
            state.iter().all(|value| value.is_finite()),
            "{text}: {state:?}"
        );
        assert_eq!(read_back(&motion), motion);
    }
}

/// Checkpoints whose numbers are none of a motion, likewise.
#[test]
fn a_checkpoint_that_is_none() {
    let ode = harmonic();
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let start = State::at_rest(0.0, &[1.0]);
    let mut stepper = method.start(&ode, &start).unwrap();
    stepper.step().unwrap();
    let text = serde_json::to_string(&stepper.checkpoint().unwrap()).unwrap();
    for (from, to, field) in [
        ("\"direction\":1.0", "\"direction\":0.5", "`direction`"),
        ("\"direction\":1.0", "\"direction\":0", "`direction`"),
        (
            "\"accepted\":1,",
            "\"accepted\":18446744073709551615,",
            "`report.accepted`",
        ),
        (
            "\"rejected\":0,",
            "\"rejected\":9223372036854775808,",
            "`report.rejected`",
        ),
    ] {
        assert!(text.contains(from), "{text}");
        let read = serde_json::from_str::<Checkpoint<f64>>(&text.replace(from, to));
        let error = read.unwrap_err().to_string();
        assert!(error.contains(field), "{error}");
    }
    // Memory and state of another length are of other methods and equations.
    for (from, to) in [
        ("\"memory\":[", "\"memory\":[1.0,"),
        ("\"values\":[", "\"values\":[1.0,"),
    ] {
        let other: Checkpoint<f64> = serde_json::from_str(&text.replace(from, to)).unwrap();
        assert!(matches!(
            method.resume(&ode, &other),
            Err(IntegrationError::Input(_))
        ));
    }
}
