//! Motions that nothing can follow to their end, requests that make no sense, and
//! candidates that are no model of this crate.

use std::error::Error;

use branched_pendulum::analysis::variational::{linearised, trusted_until};
use branched_pendulum::prelude::*;
use branched_pendulum_advice::{
    Advisor, Candidate, CandidateName, Candidates, Criterion, ModelForm, SettingRange, TimeLimit,
    Visit, Wanted,
};

use crate::scenes::Paper;

fn candidates(paper: &Paper) -> Candidates<'_> {
    let methods = [Method::Dop853, Method::Rk4];
    Candidates::new().rates(
        &ModelForm::new("full").methods(&methods),
        AbsoluteAngles(paper),
    )
}

/// Near the threshold the digits of `f64` end after some 20 s: so say the notes of the
/// trusted trajectories, and that the Lyapunov time is 0.76 s.
#[test]
fn beyond_the_digits_the_energy_is_judged() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let advisor = Advisor::new(&ode)
        .start(State::at_rest(0.0, &[47.8_f64.to_radians(), 1e-3, -1e-3]))
        .until(40.0)
        .wanted(Wanted::angles(1e-3))
        .conserved(Wanted::energy(&paper, 1e-6));
    let advice = advisor.advise(&candidates(&paper)).unwrap();
    println!("{advice}");
    let angles = &advice.outputs[0];
    let from = angles.chaotic_from.expect("nothing follows it for 40 s");
    assert!((12.0..30.0).contains(&from), "{from}");
    assert_eq!(angles.beyond, Some(Criterion::Conserved));
    // Of the variational equations: roundings of angles and velocities that grow as the worst
    // of all would.
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 1e-3, -1e-3]);
    let system = linearised(AbsoluteAngles(&paper));
    let worst = trusted_until(&method, &system, &start, 40.0, 32.0 * f64::EPSILON, 1e-3);
    let worst = worst.unwrap().unwrap();
    println!("{from} {worst} {:?}", advice.growth);
    assert!((worst - 1.0..worst + 5.0).contains(&from), "{from} {worst}");
    let text = advice.to_string();
    assert!(
        text.contains("judged there: what the motion keeps"),
        "{text}"
    );
    assert!(text.contains("in double-double"), "{text}");
    for run in &advice.runs {
        if let Some(worst) = &run.worst {
            assert!(worst.time <= from || worst.criterion == Criterion::Conserved);
        }
    }
}

#[test]
fn without_a_conserved_quantity_means_are_judged() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let advisor = Advisor::new(&ode)
        .start(State::at_rest(0.0, &[2.0, 2.5, 2.4]))
        .until(60.0)
        .wanted(Wanted::angles(1e-2));
    let advice = advisor.advise(&candidates(&paper)).unwrap();
    println!("{advice}");
    assert_eq!(advice.outputs[0].beyond, Some(Criterion::Statistics));
    assert!(
        advice
            .to_string()
            .contains("judged there: means and mean squares")
    );
}

/// Small oscillations about hanging, with the paper's frequencies left out: an angle that
/// stays where it is.
struct Still;

impl Candidate for Still {
    fn name(&self) -> CandidateName {
        CandidateName::new("still", "none", "f64")
    }

    fn settings(&self) -> SettingRange {
        SettingRange::Fixed
    }

    fn run(
        &self,
        _: f64,
        starts: &[State<f64>],
        times: &[f64],
        visit: &mut Visit<'_>,
    ) -> Result<u64, Box<dyn Error + Send + Sync>> {
        for (index, start) in starts.iter().enumerate() {
            for number in 0..times.len() {
                visit(index, number, &start.values);
            }
        }
        Ok(1)
    }

    fn to_write(&self, _: f64) -> Vec<String> {
        vec![String::from("start.clone()")]
    }
}

/// A tree that hangs at rest needs no model; one that moves does.
#[test]
fn anything_may_be_a_candidate() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let ask = |angle: f64| {
        let advisor = Advisor::new(&ode)
            .start(State::at_rest(0.0, &[angle, 0.0, 0.0]))
            .until(1.0)
            .wanted(Wanted::angles(1e-3));
        advisor.advise(&candidates(&paper).with(Still)).unwrap()
    };
    let still = ask(0.0);
    assert_eq!(
        still.names[still.chosen().unwrap().candidate].model,
        "still"
    );
    assert_eq!(still.to_write, ["start.clone()"]);
    let moving = ask(0.1);
    let chosen = moving.chosen().unwrap();
    assert_eq!(moving.names[chosen.candidate].model, "full");
    assert!(moving.next_cheaper().is_some_and(|run| !run.is_right()));
    let text = moving.to_string();
    assert!(
        text.contains("write:") && text.contains("let method = "),
        "{text}"
    );
}

/// Frames of a game: right where samples stand at their ends, no result elsewhere.
#[test]
fn frames_may_be_candidates() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let frame = |state: &mut [f64]| {
        let start = State::new(0.0, state.to_vec());
        let run = method.run(&ode, &start, 1.0 / 60.0);
        state.copy_from_slice(&run.unwrap().state.values);
    };
    let ask = |rate: f64| {
        let advisor = Advisor::new(&ode)
            .start(State::at_rest(0.0, &[0.5, 0.1, 0.0]))
            .at((1..20).map(|index| f64::from(index) / rate).collect())
            .wanted(Wanted::angles(1e-6));
        let form = ModelForm::new("game");
        let candidates = Candidates::new().frames(&form, "f64", 1.0 / 60.0, frame);
        advisor.advise(&candidates).unwrap()
    };
    assert!(ask(30.0).chosen().is_some());
    let none = ask(50.0);
    let failure = none.closest().unwrap().failure.as_deref().unwrap();
    assert!(failure.contains("no frame ends at t = 0.02 s"), "{failure}");
}

#[test]
fn a_limit_that_nothing_keeps_is_told() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let advisor = Advisor::new(&ode)
        .start(State::at_rest(0.0, &[0.5, 0.1, 0.0]))
        .until(1.0)
        .wanted(Wanted::angles(1e-9))
        .within(TimeLimit::Sample(1e-12));
    let advice = advisor.advise(&candidates(&paper)).unwrap();
    assert_eq!(advice.chosen(), None);
    assert!(advice.runner_up().unwrap().is_right());
    assert!(advice.to_string().contains("right, but too slow"));
}

#[test]
fn requests_that_make_no_sense_are_refused() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let start = || State::at_rest(0.0, &[0.5, 0.1, 0.0]);
    let refused = |advisor: Advisor, word: &str| {
        let error = advisor.advise(&candidates(&paper)).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    };
    let whole = || Advisor::new(&ode).until(1.0).wanted(Wanted::angles(1e-3));
    refused(whole(), "a start");
    refused(whole().start(State::at_rest(0.0, &[0.1])), "components");
    refused(whole().start(start()).at(Vec::new()), "times");
    refused(Advisor::new(&ode).start(start()).until(1.0), "an output");
    refused(
        whole().start(start()).wanted(Wanted::state(0.0)),
        "tolerances",
    );
    // Times that run backwards.
    let backwards = whole().start(start()).at(vec![1.0, 0.5]);
    assert!(backwards.advise(&candidates(&paper)).is_err());
}

/// Several starts, in the lanes of vector registers.
#[test]
fn lanes_are_candidates_for_many_starts() {
    let paper = Paper::new();
    let ode = AbsoluteAngles(&paper);
    let form = ModelForm::new("full").methods(&[Method::Dop853, Method::Taylor]);
    let mut advisor = Advisor::new(&ode).until(2.0).wanted(Wanted::angles(1e-7));
    for index in 0..16 {
        advisor = advisor.start(State::at_rest(
            0.0,
            &[0.3 + 0.01 * f64::from(index), 0.0, 0.1],
        ));
    }
    let all = Candidates::new()
        .series(&form, AbsoluteAngles(&paper))
        .lanes_with_series(&form, AbsoluteAngles(&paper));
    let advice = advisor.advise(&all).unwrap();
    println!("{advice}");
    let right = |run: &branched_pendulum_advice::Measured| {
        run.is_right() && advice.names[run.candidate].in_lanes
    };
    assert!(advice.runs.iter().any(right));
}
