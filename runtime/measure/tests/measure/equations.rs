//! Motions estimated by their equations, against the motions that they were made from.

use branched_pendulum::analysis::variational::WithDerivative;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Rk4};
use branched_pendulum::system::{OdeFn, State};
use branched_pendulum_measure::{KinematicSmoother, ModelSmoother};

use crate::normal::Normal;

/// A pendulum that swings far, seen 30 times a second: equations of motion that hold give
/// its velocity closer than smoothness does; those of a friction that is not there are
/// found out, and cost nothing.
#[test]
fn equations_of_motion_help_where_they_hold() {
    let equations = |friction: f64| {
        WithDerivative::new(
            OdeFn::new(2, move |_time: f64, y: &[f64], rates: &mut [f64]| {
                rates[0] = y[1];
                rates[1] = -14.7 * y[0].sin() - friction * y[1];
            }),
            move |_time: f64, y: &[f64], v: &[f64], out: &mut [f64]| {
                out[0] = v[1];
                out[1] = -14.7 * y[0].cos() * v[0] - friction * v[1];
            },
        )
    };
    let times: Vec<f64> = (0..300).map(|i| f64::from(i) / 30.0).collect();
    let exact = Dop853::new(Options::with_tolerance(1e-13));
    let truth = exact
        .sample_to_vec(&equations(0.0), &State::at_rest(0.0, &[2.0]), &times)
        .unwrap();
    let method = Rk4::new(0.005);
    let wrong_rate = |rate: f64, index: usize| rate - truth[index].values[1];
    let rms = |errors: &mut dyn Iterator<Item = f64>| {
        (errors.map(|error| error * error).sum::<f64>() / times.len() as f64).sqrt()
    };
    let mut inside = 0;
    for seed in 1..=24 {
        let mut normal = Normal(seed * 0x9e37_79b9);
        let angles = truth
            .iter()
            .map(|state| Some(state.values[0] + 2e-3 * normal.next()));
        let angles: Vec<Option<f64>> = angles.collect();
        let rough = KinematicSmoother::default()
            .smooth(&times, &angles)
            .unwrap();
        let guess = (0..times.len()).map(|i| rough.mean(i)[..2].to_vec());
        let guess: Vec<Vec<f64>> = guess.collect();
        let data: Vec<Vec<Option<f64>>> = angles.iter().map(|angle| vec![*angle]).collect();
        let smooth = |friction: f64| {
            let smoother = ModelSmoother::default();
            smoother
                .smooth(
                    &method,
                    &equations(friction),
                    |_| vec![vec![1.0]],
                    &times,
                    &data,
                    &guess,
                )
                .unwrap()
        };
        let right = smooth(0.0);
        inside += (0..times.len())
            .filter(|&i| wrong_rate(right.mean(i)[1], i).abs() < 1.96 * right.deviation(i)[1])
            .count();
        if seed > 3 {
            continue;
        }
        let by_smoothness = rms(&mut (0..times.len()).map(|i| wrong_rate(rough.mean(i)[1], i)));
        let by_model = rms(&mut (0..times.len()).map(|i| wrong_rate(right.mean(i)[1], i)));
        assert!(by_model < 0.1 * by_smoothness, "{by_model} {by_smoothness}");
        assert!(
            (right.noise() / 2e-3 - 1.0).abs() < 0.15,
            "{}",
            right.noise()
        );

        let wrong = smooth(0.05);
        let by_wrong = rms(&mut (0..times.len()).map(|i| wrong_rate(wrong.mean(i)[1], i)));
        assert!(by_wrong < by_smoothness, "{by_wrong} {by_smoothness}");
        assert!(wrong.densities()[0] > 100.0 * right.densities()[0]);
        assert!(wrong.deviation(150)[1] > 2.0 * right.deviation(150)[1]);
    }
    // The errors of one record are those of two numbers: 24 records, 48 numbers.
    let part = inside as f64 / (24 * times.len()) as f64;
    assert!((0.85..=0.995).contains(&part), "{part}");
}

/// Two bodies that turn freely, and what a smoother is given of them: right, but for what a test
/// changes.
struct Given {
    smoother: ModelSmoother,
    dimension: usize,
    mass: Vec<Vec<f64>>,
    data: Vec<Vec<Option<f64>>>,
    guess: Vec<Vec<f64>>,
}

/// Returns what a smoother says to two bodies that turn freely, given with a change.
fn refused(change: impl FnOnce(&mut Given)) -> String {
    let mut given = Given {
        smoother: ModelSmoother {
            noise: Some(1e-3),
            density: Some(1.0),
            ..ModelSmoother::default()
        },
        dimension: 4,
        mass: vec![vec![2.0, 1.0], vec![1.0, 2.0]],
        data: vec![vec![Some(0.1); 2]; 9],
        guess: vec![vec![0.0; 4]; 9],
    };
    change(&mut given);
    let free = WithDerivative::new(
        OdeFn::new(given.dimension, |_: f64, y: &[f64], rates: &mut [f64]| {
            rates.copy_from_slice(&[y[2], y[3], 0.0, 0.0])
        }),
        |_: f64, _: &[f64], v: &[f64], out: &mut [f64]| {
            out.copy_from_slice(&[v[2], v[3], 0.0, 0.0]);
        },
    );
    let times: Vec<f64> = (0..9).map(f64::from).collect();
    let mass = |_: &[f64]| given.mass.clone();
    let Given {
        smoother,
        data,
        guess,
        ..
    } = &given;
    match smoother.smooth(&Rk4::new(0.5), &free, mass, &times, data, guess) {
        Ok(_) => "not refused".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// What does not have the shape that the equations of motion have is refused, by its place.
#[test]
fn other_shapes_are_refused() {
    assert_eq!(refused(|_| ()), "not refused");
    assert_eq!(
        refused(|given| given.dimension = 5),
        "a system of dimension 5: a state is angles, followed by as many rates"
    );
    assert_eq!(
        refused(|given| given.data.truncate(8)),
        "9 times for 8 data"
    );
    assert_eq!(
        refused(|given| given.guess.truncate(8)),
        "9 times for 8 states of the guess"
    );
    assert_eq!(
        refused(|given| given.data[7].truncate(1)),
        "row 7 of the data has 1 numbers; the equations of motion need 2"
    );
    assert_eq!(
        refused(|given| given.guess[3].push(0.0)),
        "row 3 of the guess has 5 numbers; the equations of motion need 4"
    );
    assert_eq!(
        refused(|given| given.smoother.disturbances = vec![vec![1.0; 2], vec![1.0]]),
        "row 1 of the disturbances has 1 numbers; the equations of motion need 2"
    );
    assert_eq!(
        refused(|given| {
            given.smoother.frictions = vec![vec![vec![1.0; 2]], vec![vec![1.0; 2], vec![1.0; 3]]];
        }),
        "row 1 of the frictions has 3 numbers; the equations of motion need 2"
    );
    for mass in [
        vec![vec![1.0, 0.0]],
        vec![vec![1.0, 0.0], vec![0.0]],
        vec![vec![1.0, 2.0], vec![2.0, 1.0]],
    ] {
        assert_eq!(
            refused(|given| given.mass = mass),
            "the mass matrix at time 0 is not positive definite with a row and a column for each \
             of 2 angles"
        );
    }
    assert_eq!(
        refused(|given| given.data[2..].fill(vec![None; 2])),
        "4 data that are not missing; smoothing needs 5"
    );
}
