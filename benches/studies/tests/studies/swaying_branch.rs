//! The program `swaying-branch`.

use branched_pendulum::approximate::Approximation;
use branched_pendulum::integrate::{Frames, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Computes, UnderTorques, functions};
use branched_pendulum_frame::film;
use branched_pendulum_studies::swaying_branch::motion::{Branches, reference};
use branched_pendulum_studies::swaying_branch::scene::{Branch, LINKS};
use branched_pendulum_studies::swaying_branch::storm;
use branched_pendulum_studies::swaying_branch::weather::Weather;

/// A second from the moment in which the hand lets go, in wind that changes all the
/// time, at several rates of frames.
fn second<T: Real, P: Positions<T> + Computes<functions::AccelerationsUnderTorques, T>>(
    branch: &P,
    sub_step: T,
    start: &[f64],
    rate: u32,
) -> Vec<f64> {
    let weather = Weather::new(5.0, 6.0, 1.0);
    let torques = |time: T, theta: &[T], omega: &[T], torques: &mut [T]| {
        let mut state = [T::ZERO; 2 * LINKS];
        let (angles, rates) = state.split_at_mut(LINKS);
        angles.copy_from_slice(theta);
        rates.copy_from_slice(omega);
        weather.torques(branch, time.to_f64() + 3.0, &state, torques);
    };
    let start: Vec<T> = start.iter().map(|&value| T::from_f64(value)).collect();
    let start = State::new(T::ZERO, start);
    let mut frames = Frames::new(UnderTorques::new(branch, torques), &start, sub_step).unwrap();
    for _ in 0..rate {
        frames.advance(T::from_f64(1.0 / f64::from(rate)));
    }
    assert_eq!(frames.limited(), 0);
    frames.state().iter().map(|value| value.to_f64()).collect()
}

#[test]
fn the_same_second_at_any_rate_of_frames() {
    let branches = Branches::new().unwrap();
    let seen = reference(&branches, &Weather::new(5.0, 6.0, 1.0), 1.0 / 60.0, 180).unwrap();
    let start = seen.states.last().unwrap();
    // Far from rest, or there is nothing to see.
    let rest = branches.linear.equilibrium();
    let ways = start.iter().zip(rest).map(|(a, b)| (a - b).abs());
    assert!(ways.fold(0.0, f64::max) > 0.5);
    let (double, single) = (branches.sub_step, longest_sub_step(&branches.single));
    let exact = second(&branches.double, 0.1 * double, start, 1000);
    for rate in [30, 60, 144] {
        for state in [
            second(&branches.double, double, start, rate),
            second(&branches.single, single, start, rate),
        ] {
            for (found, exact) in state.iter().zip(&exact).take(LINKS) {
                assert!((found - exact).abs() < 1e-3, "{rate}: {found} {exact}");
            }
        }
    }
}

/// The linear model in a breeze: as far off as it says.
#[test]
fn the_linear_model_knows_how_far_it_is_off() {
    let branches = Branches::new().unwrap();
    let mut frames = branches.linear.frames::<f64>(1.0 / 60.0).unwrap();
    let rest = branches.linear.equilibrium();
    let mut state = [rest, &[0.0; LINKS]].concat();
    state[0] += 0.02;
    state[1] -= 0.03;
    let estimate = frames.error(&state);
    let start = State::new(0.0, state.clone());
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let times: Vec<f64> = (1..=60).map(|frame| f64::from(frame) / 60.0).collect();
    let ode = AbsoluteAngles(&branches.double);
    let full = method.sample_to_vec(&ode, &start, &times).unwrap();
    let mut error = 0.0_f64;
    for full in full {
        frames.step(&mut state);
        let pairs = state.iter().zip(&full.values).take(LINKS);
        error = pairs.fold(error, |error, (a, b)| error.max((a - b).abs()));
    }
    assert!(error > 1e-5 && estimate > 0.8 * error && estimate < 12.0 * error);
}

/// A short form of the storm; the hour is `swaying-branch --storm 3600`.
#[test]
fn a_storm_with_hits_leaves_every_state_finite() {
    let storm = storm::run(&Branch::default(), 60.0, 1.0 / 60.0).unwrap();
    assert_eq!((storm.frames, storm.not_finite), (3600, 0));
    assert!(storm.hits > 0 && storm.limited > 0);
    let limit = 0.5 / f64::from(longest_sub_step(&Branch::<f32>::default()));
    assert!(storm.largest_rate < 1.000_001 * limit);
}

#[test]
fn a_short_run_leaves_frames_picture_and_chart() {
    let folder = std::env::temp_dir().join(format!("swaying-branch-{}", std::process::id()));
    let path = folder.to_str().unwrap();
    let output = super::run(
        env!("CARGO_BIN_EXE_swaying-branch"),
        &["--duration", "1", "--storm", "1", "--output", path],
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    assert!(text.contains("| switched, f32 | to 0.01 rad |"), "{text}");
    assert!(text.contains("0 states not finite"), "{text}");
    let csv = std::fs::read_to_string(folder.join("swaying-branch.csv")).unwrap();
    // The header and the start beside sixty frames.
    assert_eq!(csv.lines().count(), 62);
    let svg = std::fs::read_to_string(folder.join("swaying-branch-animation.svg")).unwrap();
    assert_eq!(svg.matches("<animateTransform").count(), LINKS);
    assert_eq!(
        svg.matches("<g ").count() + svg.matches("<g>").count(),
        svg.matches("</g>").count()
    );
    for file in ["models.csv", "models.svg", "models.png"] {
        let file = folder.join(format!("swaying-branch-{file}"));
        assert!(file.metadata().unwrap().len() > 1000);
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The film draws the branch where it stands, by angles from the downward vertical.
#[test]
fn the_film_stands_as_the_branch_does() {
    let branch = Branch::new();
    let theta: [f64; LINKS] = std::array::from_fn(|link| 0.3 - 0.05 * link as f64);
    let (links, angles) = (film::links(&branch), film::angles(&branch, &theta));
    let mut pivots: Vec<[f64; 2]> = Vec::new();
    for (index, link) in links.iter().enumerate() {
        let turned = |[along, across]: [f64; 2], link: usize| {
            let (sine, cosine) = angles[link].sin_cos();
            [
                along * sine + across * cosine,
                across * sine - along * cosine,
            ]
        };
        let [x, y] = link.parent.map_or([0.0; 2], |parent| {
            let [x, y] = turned(link.pivot, parent);
            [pivots[parent][0] + x, pivots[parent][1] + y]
        });
        pivots.push([x, y]);
        let [along, up] = turned(link.end, index);
        let end = branch.ends(&theta)[index];
        assert!((end[0] - x - along).abs() < 1e-14 && (end[1] - y - up).abs() < 1e-14);
    }
    assert!(branch.ends(&[0.0; LINKS]).iter().all(|[_, y]| *y > 0.0));
}
