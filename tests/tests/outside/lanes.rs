//! Torques from outside, and small differences, in the lanes of vector registers.

use branched_pendulum::prelude::*;
use branched_pendulum::state_function;
use branched_pendulum::system::functions::AccelerationsUnderTorques;
use branched_pendulum::system::{
    Action, At, CastAction, CastOde, Computes, TransverseOde, UnderTorques,
};
use branched_pendulum_compiler_tests::random::Random;

use super::balance::{ByGeneration, Irregular};

/// Couples that turn with the time, and brake.
#[derive(Clone, Copy)]
pub(super) struct Couples<T> {
    size: T,
    phase: T,
}

impl<T: Scalar> Action<T> for Couples<T> {
    #[inline(always)]
    fn act(&self, time: T, _: &[T], omega: &[T], torques: &mut [T]) {
        for (link, torque) in torques.iter_mut().enumerate() {
            let pace = T::from_f64(2.0 + 0.3 * link as f64);
            let (sine, _) = (pace * time + self.phase).sin_cos();
            *torque = self.size * sine - T::from_f64(1e-4) * omega[link];
        }
    }
}

impl<T: Scalar> CastAction<T> for Couples<T> {
    type Of<S: Scalar> = Couples<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Couples<S> {
        Couples {
            size: convert(self.size),
            phase: convert(self.phase),
        }
    }
}

pub(super) fn couples(count: usize) -> impl Iterator<Item = Couples<f64>> {
    let number = |i: usize| i as f64;
    (0..count).map(move |i| Couples {
        size: 0.01 * (1.0 + number(i)) / count as f64,
        phase: 0.7 * number(i),
    })
}

/// Written out, with the same links as the one in loops.
#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5, friction = 2e-2) [
        twig: rod(mass = 0.1, length = 0.3, friction = 1e-3) * 2
    ],
    drive(torque = push * cos(3 * t)),
    emit(forces),
)]
struct Written;

fn lanes_meet_the_plain_method<P>(model: impl Fn() -> P)
where
    P: Pendulum<f64> + Computes<AccelerationsUnderTorques, f64> + Sync,
{
    let mut random = Random::new(3);
    let releases: Vec<_> = couples(21)
        .map(|couples| {
            let values = random.around_zero(2 * model().links(), 0.4);
            (UnderTorques::of(model(), couples), State::new(0.0, values))
        })
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes = Ensemble::new().integrate_models_in_lanes(&method, &releases, 2.0);
    for ((system, start), lane) in releases.iter().zip(lanes) {
        let plain = method.run(system, start, 2.0);
        let (lane, plain) = (lane.unwrap().state, plain.unwrap().state);
        for (lane, plain) in lane.values.iter().zip(&plain.values) {
            assert!((lane - plain).abs() < 1e-8, "{lane} {plain}");
        }
        let free = method.run(&AbsoluteAngles(model()), start, 2.0);
        let free = free.unwrap().state.values;
        let pushed = lane
            .values
            .iter()
            .zip(free)
            .any(|(a, b)| (a - b).abs() > 1e-4);
        assert!(pushed);
    }
}

#[test]
fn trajectories_under_torques_in_lanes() {
    lanes_meet_the_plain_method(|| Written::new(WrittenParameters { push: 0.2 }).unwrap());
    lanes_meet_the_plain_method(Irregular::<f64>::new);
    lanes_meet_the_plain_method(ByGeneration::<f64>::new);
}

/// A torque on each link that grows with the time, and brakes: without sines, which have other
/// last bits in the plain arithmetic of one state.
struct Ramp<T>(T);

impl<T: Scalar> Action<T> for Ramp<T> {
    #[inline(always)]
    fn act(&self, time: T, _: &[T], omega: &[T], torques: &mut [T]) {
        for (torque, &omega) in torques.iter_mut().zip(omega) {
            *torque = self.0 * time - T::from_f64(1e-4) * omega;
        }
    }
}

impl<T: Scalar> CastAction<T> for Ramp<T> {
    type Of<S: Scalar> = Ramp<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Ramp<S> {
        Ramp(convert(self.0))
    }
}

/// Ends, samples and accounts of fixed steps in lanes are those of single states, to the last
/// bit, and so of the order that is measured of these.
fn fixed_steps_have_the_bits_of_single_states<P>(model: impl Fn() -> P)
where
    P: Pendulum<f64> + Computes<AccelerationsUnderTorques, f64> + Sync,
{
    let mut random = Random::new(5);
    let mut start = || State::new(0.25, random.around_zero(2 * model().links(), 0.4));
    let starts: Vec<_> = (0..13).map(|_| start()).collect();
    let (ensemble, method) = (Ensemble::new(), Rk4::new(0.001));
    let free = AbsoluteAngles(model());
    let gauss = Gauss::new(GaussOrder::Four, 0.01);
    let lanes = ensemble.integrate_in_lanes(&gauss, &free, &starts, 0.5);
    assert_eq!(lanes, ensemble.integrate(&gauss, &free, &starts, 0.5));
    let lanes = ensemble.integrate_in_lanes(&method, &free, &starts, 1.0);
    assert_eq!(lanes, ensemble.integrate(&method, &free, &starts, 1.0));

    let releases: Vec<_> = (1..14)
        .zip(starts)
        .map(|(i, start)| {
            let ramp = Ramp(1e-3 * f64::from(i));
            (UnderTorques::of(model(), ramp), start)
        })
        .collect();
    // At ends of steps, and inside.
    let times = [0.25, 0.253, 0.4, 0.4001, 1.0];
    let lanes = ensemble.sample_models_in_lanes(&method, &releases, &times);
    for ((system, start), lane) in releases.iter().zip(lanes) {
        let mut samples = Vec::new();
        let plain = method.sample(system, start, &times, |_, y| samples.push(y.to_vec()));
        assert!(lane.states().eq(samples.iter().map(Vec::as_slice)));
        assert_eq!((lane.end.is_ok(), &lane.end), (true, &plain));
    }
}

#[test]
fn fixed_steps_in_lanes_have_the_bits_of_single_states() {
    fixed_steps_have_the_bits_of_single_states(|| {
        Written::new(WrittenParameters { push: 0.2 }).unwrap()
    });
    fixed_steps_have_the_bits_of_single_states(Irregular::<f64>::new);
    fixed_steps_have_the_bits_of_single_states(ByGeneration::<f64>::new);
}

/// The work on a tree beside its state.
struct WithWork<T> {
    model: ByGeneration<T>,
    couples: Couples<T>,
}

const LINKS: usize = ByGeneration::LINKS;

impl<T: Scalar> Ode<T> for WithWork<T> {
    fn dimension(&self) -> usize {
        2 * LINKS + 1
    }

    #[inline(always)]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let (theta, omega) = (&state[..LINKS], &state[LINKS..2 * LINKS]);
        let mut torques = [T::from_f64(0.0); LINKS];
        self.couples.act(time, theta, omega, &mut torques);
        rates[..LINKS].copy_from_slice(omega);
        let alpha = &mut rates[LINKS..2 * LINKS];
        let given = [theta, omega, &torques];
        Computes::<AccelerationsUnderTorques, T>::compute(
            &self.model,
            At::time(time),
            &given,
            &mut [alpha],
        );
        let outside = self.model.outside_power(omega, &torques);
        rates[2 * LINKS] = outside + self.model.friction_power(omega);
    }
}

impl<T: Scalar> CastOde<T> for WithWork<T> {
    type Of<S: Scalar> = WithWork<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> WithWork<S> {
        WithWork {
            model: self.model.cast(&convert),
            couples: self.couples.cast(&convert),
        }
    }
}

#[test]
fn energy_closes_in_lanes() {
    let model = ByGeneration::<f64>::new();
    let mut random = Random::new(4);
    let releases: Vec<_> = couples(11)
        .map(|couples| {
            let mut values = random.around_zero(2 * LINKS, 0.4);
            values.push(0.0);
            let model = ByGeneration::<f64>::new();
            (WithWork { model, couples }, State::new(0.0, values))
        })
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &releases, 3.0);
    for ((_, start), end) in releases.iter().zip(ends) {
        let energy = |values: &[f64]| {
            let (theta, omega) = (&values[..LINKS], &values[LINKS..2 * LINKS]);
            model.kinetic_energy_of(theta, omega) + model.potential_energy_of(theta)
        };
        let end = end.unwrap().state.values;
        let (before, after) = (energy(&start.values), energy(&end));
        let error = after - before - end[2 * LINKS];
        assert!(error.abs() < 1e-10 * before.max(after), "{error:e}");
    }
}

/// Many states with torques each, in a batch.
#[test]
fn batches_under_torques() {
    const STATES: usize = 37;
    let model = Irregular::<f64>::new();
    let mut random = Random::new(8);
    let [theta, omega, torques]: [Vec<Vec<f64>>; 3] = [3.0, 9.0, 0.1].map(|size| {
        let links = 0..Irregular::LINKS;
        links.map(|_| random.around_zero(STATES, size)).collect()
    });
    let mut alpha: Vec<Vec<f64>> = theta.clone();
    let under = state_function!(|model: Irregular, theta, omega, torques| {
        model.accelerations_under(theta, omega, torques)
    });
    Batch::new(&model)
        .evaluate(under, 0.0, [&theta, &omega, &torques], &mut alpha)
        .unwrap();
    let mut same = theta.clone();
    Batch::new(&model)
        .accelerations_under(0.0, [&theta, &omega, &torques], &mut same)
        .unwrap();
    assert_eq!(alpha, same);
    for state in 0..STATES {
        let of_state = |slices: &[Vec<f64>]| std::array::from_fn(|link| slices[link][state]);
        let alone =
            model.accelerations_under(&of_state(&theta), &of_state(&omega), &of_state(&torques));
        let size = alone.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
        for (link, alone) in alone.iter().enumerate() {
            assert!((alpha[link][state] - alone).abs() < 1e-12 * size);
        }
    }
}

/// Lanes of a tree in loops over generations, against each alone.
#[test]
fn batches_of_generations_under_torques() {
    const STATES: usize = 13;
    let model = ByGeneration::<f64>::new();
    let mut random = Random::new(8);
    let [theta, omega, torques]: [Vec<Vec<f64>>; 3] = [3.0, 9.0, 0.1].map(|size| {
        (0..LINKS)
            .map(|_| random.around_zero(STATES, size))
            .collect()
    });
    let mut alpha = theta.clone();
    Batch::new(&model)
        .accelerations_under(0.0, [&theta, &omega, &torques], &mut alpha)
        .unwrap();
    for state in 0..STATES {
        let [theta, omega, torques] = [&theta, &omega, &torques].map(|slices| {
            slices
                .iter()
                .map(|slice| slice[state])
                .collect::<Vec<f64>>()
        });
        let mut alone = [0.0; LINKS];
        model.accelerations_under_into(0.0, &theta, &omega, &torques, &mut alone);
        for (link, alone) in alone.iter().enumerate() {
            // The same equations in the same order, in fused arithmetic both.
            assert_eq!(alpha[link][state], *alone);
        }
    }
    let short =
        Batch::new(&model).accelerations_under(0.0, [&theta, &omega[1..], &torques], &mut alpha);
    assert!(short.is_err());
}

/// The paper's pendulum, its children in phase.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    in_phase(child),
    emit(transverse),
)]
struct InPhase;

#[test]
fn small_differences_in_lanes() {
    let system = TransverseOde::new(InPhase::<f64>::new(), 0).expect("it has that sector");
    let starts: Vec<State<f64>> = (0..19)
        .map(|i| State::at_rest(0.0, &[0.04 * f64::from(i), 0.0, 1.0]))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let lanes = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 10.0);
    let plain = Ensemble::new().integrate(&method, &system, &starts, 10.0);
    for (lane, plain) in lanes.into_iter().zip(plain) {
        let (lane, plain) = (lane.unwrap().state.values, plain.unwrap().state.values);
        for (lane, plain) in lane.iter().zip(&plain) {
            assert!(
                (lane - plain).abs() < 1e-8 * plain.abs().max(1.0),
                "{lane} {plain}"
            );
        }
    }
}
