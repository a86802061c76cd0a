//! What the feature `serde` writes is read as it was, to the bit.

use branched_pendulum::integrate::{Tolerance, Trajectory};
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
    let run = method
        .integrate(&harmonic(), &start, 7.7, |_| ControlFlow::Continue(()))
        .unwrap();
    assert_eq!(read_back(&run), run);
    // Goes on from the file as from the state.
    let on = |state| method.integrate(&harmonic(), state, 9.9, |_| ControlFlow::Continue(()));
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

/// Files that lie about themselves have no answer, and make no panic.
#[test]
fn a_trajectory_that_is_none() {
    let start = State::at_rest(0.0, &[1.0]);
    let motion = Dop853::new(Options::with_tolerance(1e-9))
        .trajectory(&harmonic(), &start, 1.0)
        .unwrap();
    let text = serde_json::to_string(&motion).unwrap();
    for (from, to) in [
        ("\"Alternating\"", "\"Bernstein\""),
        ("\"Alternating\"", "\"Hermite\""),
        ("\"dimension\":2", "\"dimension\":20000"),
        ("\"dimension\":2", "\"dimension\":0"),
        ("\"numbers\":[", "\"numbers\":[1.0,"),
        ("\"first\":2,", "\"first\":18446744073709551615,"),
    ] {
        assert!(text.contains(from), "{from}");
        let lie: Trajectory<f64> = serde_json::from_str(&text.replace(from, to)).unwrap();
        let _ = (lie.at(0.01), lie.at(0.5), lie.at(1.0));
        let _ = lie.derivative_into(0.5, &mut [0.0; 2]);
    }
}
