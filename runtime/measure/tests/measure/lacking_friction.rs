//! What equations of motion lack, found by a smoother: friction, and all else as disturbances.

use branched_pendulum::analysis::variational::WithDerivative;
use branched_pendulum::integrate::{Dop853, Integrator, Options, Rk4};
use branched_pendulum::system::{OdeFn, State};
use branched_pendulum_measure::{KinematicSmoother, ModelSmoother, SmoothedMotion};

use crate::normal::Normal;

/// Forces per unit of inertia.
fn unit_mass(_: &[f64]) -> Vec<Vec<f64>> {
    vec![vec![1.0]]
}

/// Rates of a pendulum.
fn without_friction(_time: f64, y: &[f64], rates: &mut [f64]) {
    rates[0] = y[1];
    rates[1] = -14.7 * y[0].sin();
}

/// 10 s of a pendulum with this friction (1/s), 30 times a second, seen with 2 mrad of noise.
struct Swing {
    times: Vec<f64>,
    truth: Vec<State<f64>>,
}

impl Swing {
    fn new(friction: f64) -> Self {
        let ode = OdeFn::new(2, move |_time: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = y[1];
            rates[1] = -14.7 * y[0].sin() - friction * y[1];
        });
        let times: Vec<f64> = (0..300).map(|i| f64::from(i) / 30.0).collect();
        let method = Dop853::new(Options::with_tolerance(1e-13));
        let truth = method.sample_to_vec(&ode, &State::at_rest(0.0, &[2.0]), &times);
        Self {
            truth: truth.unwrap(),
            times,
        }
    }

    /// Smooths by equations without friction.
    fn smoothed(&self, seed: u64, with_friction: bool) -> SmoothedMotion<Vec<f64>> {
        let ideal = WithDerivative::new(
            OdeFn::new(2, without_friction),
            |_time: f64, y: &[f64], v: &[f64], out: &mut [f64]| {
                out[0] = v[1];
                out[1] = -14.7 * y[0].cos() * v[0];
            },
        );
        let mut normal = Normal(seed * 0x9e37_79b9);
        let angles = self.truth.iter();
        let angles: Vec<Option<f64>> = angles
            .map(|state| Some(state.values[0] + 2e-3 * normal.next()))
            .collect();
        let rough = KinematicSmoother::default();
        let rough = rough.smooth(&self.times, &angles).unwrap();
        let guess = (0..self.times.len()).map(|i| rough.mean(i)[..2].to_vec());
        let guess: Vec<Vec<f64>> = guess.collect();
        let data: Vec<Vec<Option<f64>>> = angles.iter().map(|angle| vec![*angle]).collect();
        let smoother = ModelSmoother {
            frictions: match with_friction {
                true => vec![vec![vec![1.0]]],
                false => Vec::new(),
            },
            ..ModelSmoother::default()
        };
        let method = Rk4::new(0.005);
        smoother
            .smooth(&method, &ideal, unit_mass, &self.times, &data, &guess)
            .unwrap()
    }

    /// Errors of the velocity in its deviations, and as they are (rms).
    fn errors(&self, motion: &SmoothedMotion<Vec<f64>>) -> (Vec<f64>, f64) {
        let errors = self.truth.iter().enumerate();
        let errors: Vec<[f64; 2]> = errors
            .map(|(i, truth)| {
                let error = motion.mean(i)[1] - truth.values[1];
                [error / motion.deviation(i)[1], error]
            })
            .collect();
        let squares: f64 = errors.iter().map(|[_, error]| error * error).sum();
        let scaled = errors.iter().map(|[scaled, _]| *scaled).collect();
        (scaled, (squares / self.times.len() as f64).sqrt())
    }
}

#[test]
fn friction_that_equations_lack_is_found_with_its_bars() {
    let swing = Swing::new(0.05);
    let (mut inside, mut gain) = (0, 0.0);
    for seed in 1..=24 {
        let motion = swing.smoothed(seed, true);
        let [friction] = motion.frictions() else {
            panic!("one pivot, one friction");
        };
        assert!((friction / 0.05 - 1.0).abs() < 0.05, "{friction}");
        let (scaled, error) = swing.errors(&motion);
        inside += scaled.iter().filter(|error| error.abs() < 1.96).count();
        if seed <= 3 {
            let white = swing.smoothed(seed, false);
            assert!(white.frictions().is_empty());
            gain += swing.errors(&white).1 / error / 3.0;
        }
    }
    assert!(gain > 3.0, "{gain}");
    // The errors of one record are those of three numbers.
    let part = inside as f64 / (24 * swing.times.len()) as f64;
    assert!((0.85..=0.995).contains(&part), "{part}");
}

#[test]
fn right_equations_are_left_as_they_are() {
    let swing = Swing::new(0.0);
    let [plain, damped] = [false, true].map(|friction| swing.smoothed(5, friction));
    assert_eq!(damped.frictions(), [0.0]);
    for index in 0..swing.times.len() {
        assert_eq!(plain.mean(index), damped.mean(index));
        assert_eq!(plain.deviation(index), damped.deviation(index));
    }
}

#[test]
fn draws_have_the_errors_of_the_friction() {
    let motion = Swing::new(0.05).smoothed(3, true);
    let mut normal = Normal(17);
    let draws: Vec<_> = (0..2000).map(|_| motion.draw(|| normal.next())).collect();
    for index in [0, 150, 299] {
        let (mean, deviation) = (motion.mean(index), motion.deviation(index));
        for part in 0..2 {
            let off = draws.iter().map(|draw| draw[index][part] - mean[part]);
            let spread = (off.map(|off| off * off).sum::<f64>() / 2000.0).sqrt();
            let ratio = spread / deviation[part];
            assert!((ratio - 1.0).abs() < 0.08, "{index} {part} {ratio}");
        }
    }
}

/// Energy of the motion at all times that disturbances bring since the first.
fn brought(motion: &SmoothedMotion<Vec<f64>>, disturbances: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = 0.0;
    let changes = disturbances.iter().enumerate();
    changes
        .map(|(index, change)| {
            let state = motion.mean(index);
            sum += 14.7 * state[0].sin() * change[0] + state[1] * change[1];
            sum
        })
        .collect()
}

#[test]
fn disturbances_are_where_the_motion_leaves_its_equations() {
    let swing = Swing::new(0.05);
    let motion = swing.smoothed(3, false);
    let disturbances = motion.disturbances();
    assert_eq!(disturbances[0], [0.0; 2]);
    let largest = disturbances.iter().map(|change| change[1].abs());
    let largest = largest.fold(0.0, f64::max);
    let (method, ode) = (Rk4::new(0.005), OdeFn::new(2, without_friction));
    for (index, times) in swing.times.windows(2).enumerate() {
        let start = State::new(times[0], motion.mean(index));
        let end = method.sample_to_vec(&ode, &start, &times[1..]).unwrap();
        let next = motion.mean(index + 1);
        for part in 0..2 {
            let off = next[part] - end[0].values[part] - disturbances[index + 1][part];
            assert!(off.abs() < 1e-4 * largest, "{index} {part} {off} {largest}");
        }
    }
}

/// The energy that disturbances seem to bring is as large as noise makes it, where the equations
/// lack nothing or a friction that is found, and far larger where they lack friction.
#[test]
fn what_noise_feigns_is_told_from_what_equations_lack() {
    let deviations = |friction: f64, with_friction: bool, seeds: u64| {
        let swing = Swing::new(friction);
        let mut sum = 0.0;
        for seed in 1..=seeds {
            let motion = swing.smoothed(seed, with_friction);
            let mut normal = Normal(seed);
            let feigned = (0..60).map(|_| {
                let spurious = motion.spurious_disturbances(|| normal.next());
                brought(&motion, &spurious)
            });
            let feigned: Vec<Vec<f64>> = feigned.collect();
            let energy = brought(&motion, &motion.disturbances());
            for (index, energy) in energy.iter().enumerate().skip(1) {
                let squares = feigned.iter().map(|one| one[index] * one[index]);
                sum += energy * energy / (squares.sum::<f64>() / 60.0);
            }
        }
        (sum / (seeds * 299) as f64).sqrt()
    };
    for (friction, with_friction) in [(0.0, false), (0.05, true)] {
        let usual = deviations(friction, with_friction, 60);
        assert!((0.8..=1.3).contains(&usual), "{friction} {usual}");
    }
    let lacking = deviations(0.05, false, 3);
    assert!(lacking > 10.0, "{lacking}");
}
