//! Copies nearly in phase, by frames, against the full model.

use branched_pendulum::approximate::{
    Approximation, ForcedApproximation, Linear, NearlyInPhase, Switched,
};
use branched_pendulum::integrate::{Frames, InputError, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{DifferencePatterns, SmallOde, UnderTorques};
use branched_pendulum::{Pendulum, SmallDifferences};

use crate::scenes::{BranchedSmall, BranchedSmallParameters, Tree, TreeSmall, branched};

const FRAME: f64 = 1.0 / 60.0;

fn branched_small(friction: f64) -> BranchedSmall {
    BranchedSmall::new(BranchedSmallParameters { friction }).unwrap()
}

/// Energy of the motion in phase over that which lifts the lightest sector to the
/// horizontal.
fn energy<M: SmallDifferences<f64>>(model: &M, theta: &[f64], omega: &[f64]) -> f64 {
    let none = vec![0.0; SmallOde(model).dimension() / 2 - model.links()];
    let still = vec![0.0; model.links()];
    let rest = model.small_energy_of(&still, &still, &none, &none);
    let lift = M::SMALL.iter().map(|&number| {
        let sector = M::TRANSVERSE[number];
        let mut lifted = still.clone();
        lifted[sector.first..sector.first + sector.links].fill(std::f64::consts::FRAC_PI_2);
        model.small_energy_of(&lifted, &still, &none, &none) - rest
    });
    (model.small_energy_of(theta, omega, &none, &none) - rest) / lift.fold(f64::INFINITY, f64::min)
}

/// Least and largest ratio of the estimate to the largest error of an angle in the second
/// that follows, over states in disorder whose motion in phase has up to the energy that
/// lifts a sector's links to the horizontal.
fn ratios<M: SmallDifferences<f64>, W: Pendulum<f64>>(
    model: &M,
    patterns: &DifferencePatterns,
    whole: &W,
) -> (f64, f64) {
    // Errors of the steps themselves are not what is estimated.
    let mut nearly = NearlyInPhase::new(model, patterns.clone(), 1e-3, FRAME).unwrap();
    let mut seed = 1_u64;
    let mut number = || {
        // SplitMix64.
        seed = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = (seed ^ (seed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        2.0 * ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
    };
    let count = SmallOde(model).dimension() / 2 - model.links();
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for size in [0.01, 0.05, 0.2, 0.5] {
        let mut followed = 0;
        while followed < 100 {
            let theta: Vec<f64> = (0..model.links()).map(|_| number()).collect();
            let omega: Vec<f64> = (0..model.links()).map(|_| 6.0 * number()).collect();
            if energy(model, &theta, &omega) > 1.0 {
                continue;
            }
            followed += 1;
            let difference: Vec<f64> = (0..count).map(|_| size * number()).collect();
            let rates: Vec<f64> = (0..count).map(|_| 5.0 * size * number()).collect();
            let mut state = patterns.to_whole(&[theta, difference, omega, rates].concat());
            let estimate = nearly.error(&state);
            let start = State::new(0.0, state.clone());
            let times: Vec<f64> = (1..=60).map(|frame| f64::from(frame) / 60.0).collect();
            let mut worst = 0.0_f64;
            let method = Dop853::new(Options::with_tolerance(1e-11));
            method
                .sample(&AbsoluteAngles(whole), &start, &times, |_, full| {
                    nearly.step(&mut state);
                    for (a, b) in full.iter().zip(&state).take(whole.links()) {
                        worst = worst.max((a - b).abs());
                    }
                })
                .unwrap();
            (least, most) = (least.min(estimate / worst), most.max(estimate / worst));
        }
    }
    (least, most)
}

#[test]
fn estimates_are_near_the_errors() {
    let model = branched_small(1e-4);
    let patterns = DifferencePatterns::of(&model, BranchedSmall::WHOLE).unwrap();
    let (least, most) = ratios(&model, &patterns, &branched(1e-4));
    assert!(least > 0.8 && most < 30.0, "branched: {least} {most}");
    let model = TreeSmall::new();
    let patterns = DifferencePatterns::of(&model, TreeSmall::WHOLE).unwrap();
    let (least, most) = ratios(&model, &patterns, &Tree::new());
    assert!(least > 0.3 && most < 30.0, "tree: {least} {most}");
}

/// Differences that swing widely fade under friction: the full model first, and the one of
/// small differences once they are small, with the whole run within the tolerance.
#[test]
fn the_switched_motion_meets_the_tolerance() {
    let whole = branched(2e-3);
    let model = branched_small(2e-3);
    let sub_step = longest_sub_step(&whole);
    let seconds = Linear::about(&whole, &[0.0; 3]).unwrap().fading_time();
    let patterns = DifferencePatterns::of(&model, BranchedSmall::WHOLE).unwrap();
    let start = State::at_rest(0.0, &[0.3, 0.6, -0.2]);
    let frames = || Frames::new(AbsoluteAngles(&whole), &start, sub_step).unwrap();
    for tolerance in [1e-2, 1e-3] {
        let nearly = NearlyInPhase::new(&model, patterns.clone(), sub_step, FRAME).unwrap();
        let mut full = frames();
        let mut switched = Switched::new(frames(), nearly, tolerance, seconds);
        let mut worst = 0.0_f64;
        for _ in 0..1200 {
            full.advance(FRAME);
            switched.advance();
            for (a, b) in full.state().iter().zip(switched.state()).take(3) {
                worst = worst.max((a - b).abs());
            }
        }
        let log = switched.log();
        assert!(worst < tolerance, "{tolerance}: {worst}");
        assert!(
            log.full_frames > 30 && log.approximate_frames > 300,
            "{log}"
        );
        assert_eq!(log.switches, 1, "{log}");
    }
}

/// What a state has of differences that no pattern has is an error; without any, there is
/// none, and the motion is the one in phase.
#[test]
fn what_is_left_out_is_told() {
    let model = TreeSmall::<f32>::default();
    let patterns = DifferencePatterns::of(&model, TreeSmall::WHOLE).unwrap();
    let mut nearly = NearlyInPhase::new(&model, patterns, 5e-3_f32, FRAME as f32).unwrap();
    let in_phase = |own: [f32; 3]| {
        let mut whole = [0.0; 7];
        TreeSmall::WHOLE.angles(&own, &mut whole).unwrap();
        whole
    };
    let mut state = in_phase([0.2, 0.3, 0.1]).to_vec();
    state.extend([0.0; 7]);
    assert_eq!((nearly.error(&state), nearly.validity(&state)), (0.0, 0.0));
    nearly.step(&mut state);
    assert!(state.iter().all(|value| value.is_finite()) && nearly.error(&state) < 1e-6);
    // One leaf alone: neither all pairs alike nor in phase.
    state[6] += 0.1;
    assert!(nearly.error(&state) > 0.02 && nearly.validity(&state) > 0.02);
}

/// Where copies may turn over, nothing is known of differences: the full model moves them.
#[test]
fn no_estimate_stands_where_copies_turn_over() {
    let (whole, model) = (branched(1e-4), branched_small(1e-4));
    let patterns = DifferencePatterns::of(&model, BranchedSmall::WHOLE).unwrap();
    let mut nearly = NearlyInPhase::new(&model, patterns, 1e-3, FRAME).unwrap();
    let state = |rate: f64, difference: f64| [0.0, difference, -difference, rate, rate, rate];
    let energy = |rate: f64| energy(&model, &[0.0; 2], &[rate; 2]);
    let (slow, quick) = (2.0, 12.0);
    assert!(energy(slow) < 1.5 && energy(quick) > 1.5);
    assert!(nearly.error(&state(slow, 1e-3)) < 1e-3);
    assert_eq!(nearly.error(&state(quick, 1e-9)), f64::INFINITY);
    assert_eq!(nearly.validity(&state(quick, 1e-9)), f64::INFINITY);
    assert_eq!(nearly.error(&state(quick, 0.0)), 0.0);
    let start = State::new(0.0, state(quick, 1e-3).to_vec());
    let frames = Frames::new(AbsoluteAngles(&whole), &start, longest_sub_step(&whole)).unwrap();
    let mut switched = Switched::new(frames, nearly.clone(), 1e-2, 1.0);
    switched.advance();
    assert_eq!(switched.log().full_frames, 1);
    nearly.step(&mut state(quick, 0.0));
}

#[test]
fn what_the_model_does_not_know() {
    let model = branched_small(1e-4);
    let patterns = DifferencePatterns::of(&model, BranchedSmall::WHOLE).unwrap();
    let refused = NearlyInPhase::new(&model, patterns.clone(), 0.01, 0.0);
    assert!(matches!(
        refused,
        Err(InputError::Step { name: "frame", .. })
    ));
    let mut nearly = NearlyInPhase::under_torques(&model, patterns, 0.01, FRAME).unwrap();
    assert!(nearly.error(&[0.1; 5]).is_nan());
    let mut state = [0.1, 0.2, 0.1, 0.0, 0.0, 0.0];
    nearly.step_under(&mut state, &[0.0; 2]);
    assert!(state.iter().all(|value| value.is_nan()));
}

/// Gusts that push one child more than the other: the error is what the estimate says, and
/// it is gone with the gust.
#[test]
fn torques_act_during_their_frame() {
    let (whole, model) = (branched(2e-3), branched_small(2e-3));
    let patterns = DifferencePatterns::of(&model, BranchedSmall::WHOLE).unwrap();
    let mut nearly = NearlyInPhase::under_torques(&model, patterns, 1e-3, FRAME).unwrap();
    let start = State::at_rest(0.0, &[0.1, 0.2, 0.2]);
    let full = UnderTorques::of(&whole, vec![0.0; 3]);
    let mut full = Frames::new(full, &start, 1e-3).unwrap();
    let mut state = start.values.clone();
    let (mut worst, mut estimate, mut apart) = (0.0_f64, 0.0_f64, 0.0_f64);
    for frame in 0..60 {
        let gust = 4e-3 * (0.3 * f64::from(frame)).sin();
        let torques = [0.02, gust, 0.4 * gust];
        full.ode_mut().torques_mut().copy_from_slice(&torques);
        full.advance(FRAME);
        nearly.step_under(&mut state, &torques);
        for (a, b) in full.state().iter().zip(&state).take(3) {
            worst = worst.max((a - b).abs());
        }
        estimate = estimate.max(nearly.error(&state));
        apart = apart.max((state[1] - state[2]).abs());
    }
    assert!(apart > 0.02, "{apart}");
    assert!(
        1e-9 < worst && worst < estimate && estimate < 1e-2,
        "{worst} {estimate}"
    );
    // None is left over for the frames after.
    let [mut one, mut other] = [state.clone(), state];
    nearly.step(&mut one);
    nearly.step_under(&mut other, &[0.0; 3]);
    assert_eq!(one, other);
}

/// A push on one leaf of four is none that the pairs of all holders take alike: the full
/// model takes it.
#[test]
fn torques_beyond_the_patterns_are_for_the_full_model() {
    let (whole, model) = (Tree::<f64>::new(), TreeSmall::new());
    let patterns = DifferencePatterns::of(&model, TreeSmall::WHOLE).unwrap();
    let sub_step = longest_sub_step(&whole);
    let nearly = NearlyInPhase::under_torques(&model, patterns, sub_step, FRAME).unwrap();
    let full = UnderTorques::of(&whole, vec![0.0; 7]);
    let full = Frames::new(full, &State::at_rest(0.0, &[0.0; 7]), sub_step).unwrap();
    let mut switched = Switched::new(full, nearly, 1e-2, 1.0);
    let alike = [1e-3, 2e-4, 2e-5, 1e-5, 1e-4, 2e-5, 1e-5];
    let mut alone = alike;
    alone[6] += 1e-5;
    switched.advance_under(&alike);
    assert_eq!(switched.log().approximate_frames, 1);
    switched.advance_under(&alone);
    assert_eq!(switched.log().full_frames, 1);
    assert!(switched.state().iter().all(|value| value.is_finite()));
}
