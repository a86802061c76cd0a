//! Tasks of different outputs, tolerances and lengths.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::{CastOde, DifferencePatterns, SmallOde};
use branched_pendulum_advice::{Advice, Advisor, Candidates, ModelForm, Wanted};

use crate::scenes::{InPhase, Paper, PaperSmall, Rods, states};

/// The file of trusted trajectories.
const FILE: &str = include_str!("../../../fixtures/reference/trajectories.json");

/// Values of an output at a state.
type Output<'a> = &'a dyn Fn(&[f64]) -> Vec<f64>;

fn wanted<'a>(tolerance: f64, output: Output<'a>) -> Wanted<'a> {
    Wanted::new("output", "", tolerance, move |_, state, out| {
        out.extend(output(state));
    })
}

/// The choice of an advisor, run again.
fn chosen(
    advice: &Advice,
    candidates: &Candidates,
    start: &State<f64>,
    times: &[f64],
) -> Vec<Vec<f64>> {
    println!("{advice}");
    let run = advice.chosen().expect("something is right");
    assert!(run.is_right());
    let mut states = vec![Vec::new(); times.len()];
    let candidate = candidates.get(run.candidate).unwrap();
    let starts = std::slice::from_ref(start);
    candidate
        .run(run.setting, starts, times, &mut |_, time, state| {
            states[time] = state.to_vec();
        })
        .unwrap();
    states
}

/// Largest difference of an output along two motions.
fn worst(output: Output, found: &[Vec<f64>], expected: &[Vec<f64>]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        let (found, expected) = (output(found), output(expected));
        assert!(!found.is_empty() && found.len() == expected.len());
        for (a, b) in found.iter().zip(&expected) {
            let difference = (a - b).abs();
            assert!(difference.is_finite());
            worst = worst.max(difference);
        }
    }
    worst
}

fn even(end: f64, count: u32) -> Vec<f64> {
    let time = |index| end * f64::from(index) / f64::from(count);
    (1..=count).map(time).collect()
}

fn angles(state: &[f64]) -> Vec<f64> {
    state[..state.len() / 2].to_vec()
}

/// Number `index` of the array `quantity` of a trusted trajectory.
fn trusted(problem: &str, time: &str, quantity: &str, index: usize) -> f64 {
    let file: serde_json::Value = serde_json::from_str(FILE).unwrap();
    let number = &file["problems"][problem]["t"][time][quantity][index];
    number.as_str().unwrap().parse().unwrap()
}

fn paper_candidates(paper: &Paper) -> Candidates<'_> {
    let symmetric = ModelForm::new("symmetric")
        .entry("emit(symmetric)")
        .system("SymmetricCoordinates(&model)")
        .methods(&[Method::Dop853, Method::Verner98])
        .through(
            |state| split(state, |half| paper.to_symmetric(half)),
            |state| split(state, |half| paper.from_symmetric(half)),
        );
    Candidates::new()
        .series(&ModelForm::new("written out"), AbsoluteAngles(paper))
        .rates(&symmetric, SymmetricCoordinates(paper))
}

/// A map of three angles or rates for both halves of a state.
fn split(state: &[f64], map: impl Fn(&[f64; 3]) -> [f64; 3]) -> Vec<f64> {
    let (theta, omega) = state.split_at(3);
    [
        map(theta.try_into().unwrap()),
        map(omega.try_into().unwrap()),
    ]
    .concat()
}

fn paper_task(release: f64, end: f64, samples: u32, tolerance: f64, output: Output) {
    let paper = Paper::new();
    let start = State::at_rest(0.0, &[release, 1e-3, -1e-3]);
    let times = even(end, samples);
    let ode = AbsoluteAngles(&paper);
    let advisor = Advisor::new(&ode)
        .start(start.clone())
        .at(times.clone())
        .wanted(wanted(tolerance, output));
    let candidates = paper_candidates(&paper);
    let found = chosen(
        &advisor.advise(&candidates).unwrap(),
        &candidates,
        &start,
        &times,
    );
    let exact = states(&ode.cast(Double::from_f64), &start, &times);
    let error = worst(output, &found, &exact);
    assert!(error <= tolerance, "{error:e}");
    // The trusted trajectories are those of a second program.
    let name = if release == 0.3 {
        "regular"
    } else {
        "near-threshold"
    };
    if end == 10.0 || end == 100.0 {
        let number = |quantity, index| trusted(name, &end.to_string(), quantity, index);
        let last: Vec<f64> = ["theta", "omega"]
            .into_iter()
            .flat_map(|quantity| (0..3).map(move |index| number(quantity, index)))
            .collect();
        let error = worst(output, &found[samples as usize - 1..], &[last]);
        assert!(error <= tolerance, "{error:e}");
    }
}

const THRESHOLD: f64 = 47.8 * (std::f64::consts::PI / 180.0);

#[test]
fn regular_angles_to_the_eye() {
    paper_task(0.3, 10.0, 100, 1e-2, &angles);
}

#[test]
fn regular_angles_to_a_millionth() {
    paper_task(0.3, 10.0, 100, 1e-6, &angles);
}

#[test]
fn regular_angles_to_twelve_digits() {
    paper_task(0.3, 10.0, 50, 1e-12, &angles);
}

#[test]
fn regular_states_for_long() {
    paper_task(0.3, 100.0, 50, 1e-8, &|state| state.to_vec());
}

#[test]
fn angles_near_the_threshold() {
    paper_task(THRESHOLD, 10.0, 100, 1e-4, &angles);
}

/// A hundred million times the error of a rounding at the start.
#[test]
fn angles_near_the_threshold_as_well_as_roundings_let_them() {
    paper_task(THRESHOLD, 10.0, 100, 1e-7, &angles);
}

#[test]
fn energy_near_the_threshold() {
    let paper = Paper::new();
    paper_task(THRESHOLD, 5.0, 40, 1e-9, &|state| {
        let (theta, omega) = state.split_at(3);
        vec![paper.kinetic_energy_of(theta, omega) + paper.potential_energy_of(theta)]
    });
}

#[test]
fn transfer_into_the_antiphase_mode() {
    let paper = Paper::new();
    paper_task(THRESHOLD, 6.0, 60, 1e-6, &|state| {
        let symmetric = split(state, |half| paper.to_symmetric(half));
        let (coordinates, rates) = symmetric.split_at(3);
        let half = |part: &[f64]| <[f64; 3]>::try_from(part).unwrap();
        vec![
            paper
                .transfer_exact_from_rates(&half(coordinates), &half(rates))
                .total(),
        ]
    });
}

/// Frames of a game: half a pixel of a screen of a thousand a metre.
#[test]
fn pixels_of_frames() {
    let paper = Paper::new();
    paper_task(THRESHOLD, 3.0, 180, 0.5, &|state| {
        let theta: [f64; 3] = state[..3].try_into().unwrap();
        paper
            .ends(&theta)
            .as_flattened()
            .iter()
            .map(|place| 1000.0 * place)
            .collect()
    });
}

fn rods_task(angles_at_start: &[f64; 7], end: f64, tolerance: f64, output: Output) -> Advice {
    let (rods, in_phase) = (Rods::new(), InPhase::new());
    let start = State::at_rest(0.0, angles_at_start);
    let times = even(end, 50);
    let ode = AbsoluteAngles(&rods);
    let advisor = Advisor::new(&ode)
        .start(start.clone())
        .at(times.clone())
        .wanted(wanted(tolerance, output));
    let methods = [Method::Dop853, Method::Verner98, Method::Rk4];
    let reduced = ModelForm::new("in phase")
        .entry("in_phase(all)")
        .methods(&methods)
        .reduced(InPhase::WHOLE);
    let candidates = Candidates::new()
        .series(&ModelForm::new("written out"), AbsoluteAngles(&rods))
        .rates(&reduced, AbsoluteAngles(&in_phase));
    let advice = advisor.advise(&candidates).unwrap();
    let found = chosen(&advice, &candidates, &start, &times);
    let exact = states(&ode.cast(Double::from_f64), &start, &times);
    let error = worst(output, &found, &exact);
    assert!(error <= tolerance, "{error:e}");
    advice
}

#[test]
fn rods_to_ten_digits() {
    rods_task(
        &[0.08, 0.005, 0.002, -0.001, -0.005, 0.0015, -0.003],
        10.0,
        1e-10,
        &angles,
    );
}

/// Rods that start in phase: the chain is right, and so is the tree.
#[test]
fn rods_in_phase() {
    let advice = rods_task(&[0.8, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2], 5.0, 1e-6, &angles);
    let right = |run: &&_| {
        advice
            .runs
            .iter()
            .any(|other| std::ptr::eq(*run, other) && other.is_right())
    };
    let models: Vec<&str> = advice
        .runs
        .iter()
        .filter(right)
        .map(|run| advice.names[run.candidate].model.as_str())
        .collect();
    assert!(models.contains(&"in phase"), "{models:?}");
}

/// Rods a hundredth of a radian out of phase: enough for an error of a millionth, which the
/// chain cannot have.
#[test]
fn rods_out_of_phase() {
    let advice = rods_task(&[0.8, 0.21, 0.2, 0.2, 0.19, 0.2, 0.2], 3.0, 1e-6, &angles);
    let chosen = advice.chosen().unwrap();
    assert_eq!(advice.names[chosen.candidate].model, "written out");
    let chain = |name: &branched_pendulum_advice::CandidateName| name.model == "in phase";
    assert!(
        advice
            .runs
            .iter()
            .all(|run| !chain(&advice.names[run.candidate]) || !run.is_right())
    );
}

/// A model nearly in phase is right where differences are small, and wrong where they are not.
#[test]
fn nearly_in_phase_is_right_for_small_differences_alone() {
    let (whole, model) = (Paper::new(), PaperSmall::new());
    let patterns = DifferencePatterns::of(&model, PaperSmall::WHOLE).unwrap();
    let form = ModelForm::new("nearly in phase")
        .entry("in_phase(child), emit(small)")
        .nearly_in_phase(patterns);
    let exact = AbsoluteAngles(&whole);
    let right = |difference: f64| {
        let start = [0.3, 0.1 + difference, 0.1 - difference];
        let advice = Advisor::new(&exact)
            .start(State::at_rest(0.0, &start))
            .until(2.0)
            .wanted(Wanted::angles(1e-4))
            .advise(&Candidates::new().rates(&form, SmallOde(&model)))
            .unwrap();
        advice.chosen().is_some_and(|chosen| chosen.is_right())
    };
    assert!(right(0.01) && !right(0.3));
}
