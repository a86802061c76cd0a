//! Torques from outside on small differences that act back, against the whole tree under
//! the same torques.

use branched_pendulum::SmallDifferences;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{
    Computes, DifferencePatterns, OdeFn, SmallOde, SmallUnderTorques, UnderTorques, functions,
};
use branched_pendulum_compiler_tests::random::Random;

use super::lanes::couples;

/// Pairs on pairs, driven.
macro_rules! twice {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            stem: rod(mass = 0.4, length = 0.4, friction = 1e-3) [
                bough(mass = 0.1, com = (0.12, 0.01), inertia = 1e-3, joint = (0.25, 0.02),
                    spring = 0.1, friction = 1e-3) [
                    twig: rod(mass = 0.03, length = 0.2, drag = 1e-4) * 2
                ] * 2
            ],
            drive(torque = 0.2 * cos(3 * t), x = 0.01 * cos(4 * t)),
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}

twice!(Twice, emit(forces));
twice!(TwiceSmall, in_phase(all), emit(small, forces));

/// One pair, without friction.
macro_rules! pair {
    ($name:ident $(, $entry:ident($($inside:tt)*))*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
            ],
            $($entry($($inside)*)),*
        )]
        struct $name;
    };
}

pair!(Pair, emit(forces));
pair!(PairSmall, in_phase(child), emit(small, forces));

/// Number of angles and differences.
fn half<M: SmallDifferences<f64>>(model: &M) -> usize {
    SmallOde(model).dimension() / 2
}

/// Values on the links of the whole tree of those in phase and of differences.
fn spread(patterns: &DifferencePatterns, values: &[f64]) -> Vec<f64> {
    let mut state = values.to_vec();
    state.resize(2 * values.len(), 0.0);
    let mut whole = patterns.to_whole(&state);
    whole.truncate(whole.len() / 2);
    whole
}

/// Largest errors of the accelerations of angles in phase and of differences, against the
/// whole tree.
fn errors<M, W>(
    (model, whole): (&M, &W),
    patterns: &DifferencePatterns,
    state: &[f64],
    torques: &[f64],
) -> [f64; 2]
where
    M: SmallDifferences<f64> + Computes<functions::SmallDifferencesUnderTorques, f64>,
    W: Computes<functions::AccelerationsUnderTorques, f64>,
{
    let half = half(model);
    let pushes = spread(patterns, torques);
    let pushed = SmallUnderTorques::of(model, patterns.torques(&pushes));
    let mut found = vec![0.0; 2 * half];
    pushed.rates(0.7, state, &mut found);
    let full = patterns.to_whole(state);
    let mut rates = vec![0.0; full.len()];
    UnderTorques::of(whole, pushes).rates(0.7, &full, &mut rates);
    let expected = patterns.to_small(&rates);
    let mut largest = [0.0_f64; 2];
    for index in half..2 * half {
        let of = usize::from(index - half >= model.links());
        largest[of] = largest[of].max((found[index] - expected[index]).abs());
    }
    largest
}

/// Orders in the size of the differences, and of the torques on them, with which errors
/// vanish.
fn orders<M, W>(models: (&M, &W), patterns: &DifferencePatterns, sizes: [f64; 2]) -> [f64; 2]
where
    M: SmallDifferences<f64> + Computes<functions::SmallDifferencesUnderTorques, f64>,
    W: Computes<functions::AccelerationsUnderTorques, f64>,
{
    let mut random = Random::new(31);
    let half = half(models.0);
    let cases: Vec<[Vec<f64>; 3]> = (0..30)
        .map(|_| [3.0, 5.0, 0.3].map(|size| random.around_zero(half, size)))
        .collect();
    let sums = sizes.map(|size| {
        let scaled = |values: &[f64]| -> Vec<f64> {
            let (in_phase, differences) = values.split_at(models.0.links());
            let differences = differences.iter().map(|value| size * value);
            in_phase.iter().copied().chain(differences).collect()
        };
        let all = cases.iter().map(|[angles, rates, torques]| {
            let state = [scaled(angles), scaled(rates)].concat();
            errors(models, patterns, &state, &scaled(torques))
        });
        all.fold([0.0; 2], |sums, error| {
            [sums[0] + error[0], sums[1] + error[1]]
        })
    });
    let order = |of: usize| (sums[0][of] / sums[1][of]).ln() / (sizes[0] / sizes[1]).ln();
    [order(0), order(1)]
}

#[test]
fn errors_have_the_orders_that_they_have_without_torques() {
    let patterns = DifferencePatterns::of::<f64, _>(&PairSmall::new(), PairSmall::WHOLE).unwrap();
    let models = (&PairSmall::new(), &Pair::new());
    let [means, differences] = orders(models, &patterns, [1e-2, 5e-3]);
    assert!(means > 3.9 && differences > 2.9, "{means} {differences}");

    let patterns = DifferencePatterns::of::<f64, _>(&TwiceSmall::new(), TwiceSmall::WHOLE).unwrap();
    let models = (&TwiceSmall::new(), &Twice::new());
    let [means, differences] = orders(models, &patterns, [4e-3, 2e-3]);
    assert!(means > 3.8 && differences > 2.8, "{means} {differences}");
}

/// Without differences and torques on them the motion is the one in phase under the same
/// torques, and without torques that of the free model.
#[test]
fn without_differences_it_is_the_motion_in_phase() {
    let model = TwiceSmall::new();
    let links = TwiceSmall::LINKS;
    let mut random = Random::new(32);
    for _ in 0..100 {
        let [theta, omega, torques] = [3.0, 9.0, 0.3].map(|size| random.array::<3>(-size, size));
        let mut found = vec![1.0; half(&model)];
        let none = vec![0.0; found.len() - links];
        model.small_accelerations_under_into(
            0.7,
            [&theta[..], &none],
            [&omega[..], &none],
            [&torques[..], &none],
            &mut found,
        );
        let expected = model.accelerations_under(0.7, &theta, &omega, &torques);
        let size = expected.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12 * size);
        }
        assert!(found[links..].iter().all(|&second| second == 0.0));
        let differences = random.around_zero(none.len(), 0.3);
        let mut free = found.clone();
        model.small_accelerations_under_into(
            0.7,
            [&theta[..], &differences],
            [&omega[..], &none],
            [&[0.0; 3][..], &none],
            &mut found,
        );
        model.small_accelerations_into(0.7, &theta, &omega, &differences, &none, &mut free);
        let size = free.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
        for (found, free) in found.iter().zip(&free) {
            assert!((found - free).abs() < 1e-13 * size);
        }
        model.small_accelerations_under_into(
            0.7,
            [&theta[..], &none],
            [&omega[..], &none],
            [&torques[..], &none[1..]],
            &mut found,
        );
        assert!(found.iter().all(|second| second.is_nan()));
    }
}

/// The work that torques do on the whole tree is that on the angles in phase and on the
/// differences.
#[test]
fn torques_do_the_same_work() {
    let patterns = DifferencePatterns::of::<f64, _>(&TwiceSmall::new(), TwiceSmall::WHOLE).unwrap();
    let mut random = Random::new(33);
    for _ in 0..100 {
        let rates = random.around_zero(half(&TwiceSmall::new()), 5.0);
        let whole = spread(&patterns, &rates);
        let torques = random.around_zero(whole.len(), 0.3);
        let power = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let found = power(&patterns.torques(&torques), &rates);
        assert!((found - power(&torques, &whole)).abs() < 1e-13);
    }
    assert!(patterns.torques(&[0.0; 6]).is_empty());
}

/// Torques on the parent, on both children and, as far as `size` says, on their difference.
fn push(size: f64) -> impl Fn(f64, &[f64], &[f64], &mut [f64]) {
    move |time, _, omega, torques| {
        torques[0] = 0.05 * (2.3 * time).sin() - 0.002 * omega[0];
        torques[1] = 0.01 * (3.1 * time + 1.0).cos();
        torques[2] = size * (0.02 * (5.7 * time).sin() - 0.001 * omega[1]);
    }
}

fn end(ode: &impl Ode<f64>, start: &State<f64>, span: f64) -> Vec<f64> {
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let end = method.run(ode, start, span);
    end.expect("a regular motion").state.values
}

#[test]
fn energy_closes_with_the_work_of_torques() {
    let model = PairSmall::new();
    let torques = push(0.1);
    let pushed = SmallUnderTorques::new(&model, &torques);
    let with_work = OdeFn::new(7, |time: f64, state: &[f64], rates: &mut [f64]| {
        pushed.rates(time, &state[..6], &mut rates[..6]);
        let mut given = [0.0; 3];
        torques(time, &state[..3], &state[3..6], &mut given);
        rates[6] = (0..3).map(|i| given[i] * state[3 + i]).sum();
    });
    let start = State::new(0.0, vec![0.4, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0]);
    let after = end(&with_work, &start, 10.0);
    let energy = |values: &[f64]| SmallOde(&model).energy(&values[..6]);
    let (first, last) = (energy(&start.values), energy(&after));
    assert!(after[6].abs() > 1e-3);
    let error = last - first - after[6];
    assert!(
        error.abs() < 1e-10 * first.abs().max(last.abs()),
        "{error:e}"
    );
}

/// Over two seconds under the same torques, the change of the parent's motion by the
/// difference is that of the whole tree.
#[test]
fn trajectories_are_those_of_the_whole_tree() {
    let (model, whole) = (PairSmall::new(), Pair::new());
    let patterns = DifferencePatterns::of::<f64, _>(&model, PairSmall::WHOLE).unwrap();
    let errors = [0.04, 0.02].map(|size| {
        let start = State::at_rest(0.0, &[0.7, 0.0, size]);
        let torques = push(size);
        let small = end(&SmallUnderTorques::new(&model, &torques), &start, 2.0);
        let full = UnderTorques::new(
            &whole,
            |time: f64, _: &[f64], omega: &[f64], out: &mut [f64]| {
                let mut given = [0.0; 3];
                let mean = 0.5 * (omega[1] + omega[2]);
                torques(time, &[], &[omega[0], mean, 0.0], &mut given);
                // Of a sum and a difference, on two.
                let [parent, sum, difference] = given;
                out.copy_from_slice(&[parent, 0.5 * (sum + difference), 0.5 * (sum - difference)]);
            },
        );
        let full = end(&full, &State::at_rest(0.0, &[0.7, size, -size]), 2.0);
        let full = patterns.to_small(&full);
        [(small[0] - full[0]).abs(), (small[2] - full[2]).abs()]
    });
    let order = |of: usize| (errors[0][of] / errors[1][of]).log2();
    assert!((order(0) - 4.0).abs() < 0.3, "{}", order(0));
    assert!((order(1) - 3.0).abs() < 0.3, "{}", order(1));
}

#[test]
fn trajectories_under_torques_in_lanes() {
    let releases = couples(11).zip(0..).map(|(couples, i)| {
        let start = State::at_rest(0.0, &[0.06 * f64::from(i), 0.0, 0.02 * f64::from(i)]);
        (
            SmallUnderTorques::of(PairSmall::<f64>::new(), couples),
            start,
        )
    });
    let releases: Vec<_> = releases.collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &releases, 2.0);
    for ((system, start), lane) in releases.iter().zip(lanes) {
        let plain = method.run(system, start, 2.0);
        let (lane, plain) = (lane.unwrap().state, plain.unwrap().state);
        for (lane, plain) in lane.values.iter().zip(&plain.values) {
            assert!((lane - plain).abs() < 1e-8, "{lane} {plain}");
        }
    }
}
