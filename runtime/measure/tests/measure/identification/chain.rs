//! A chain of two links, with friction as real joints have it.

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{Action, UnderTorques};
use branched_pendulum_measure::identification::{
    AngleRecord, Family, FamilyOf, Identification, ImpossibleValue,
};

#[branched_pendulum(
    gravity = gravity,
    upper(mass = mass_1, com = com_1, inertia = inertia_1, joint = joint_1, friction = viscous_1) [
        lower(mass = mass_2, com = com_2, inertia = inertia_2, friction = viscous_2)
    ],
    emit(energies, forces),
)]
pub(crate) struct Chain;

/// The chain with Coulomb friction in its joints and quadratic drag against the air: a
/// family of one's own, with torques from outside.
#[derive(Clone, Copy)]
pub(crate) struct Rubbing;

/// Parameters of [`Rubbing`] beside those of [`Chain`].
pub(crate) const LAWS: [&str; 4] = ["coulomb_1", "coulomb_2", "quadratic_1", "quadratic_2"];
/// Rate below which Coulomb friction gives way, rad/s.
const WIDTH: f64 = 0.05;

pub(crate) struct Laws<T>([T; 4]);

impl<T: Scalar> Action<T> for Laws<T> {
    fn act(&self, _time: T, _theta: &[T], omega: &[T], torques: &mut [T]) {
        let [coulomb_1, coulomb_2, quadratic_1, quadratic_2] = self.0;
        let width = T::from_f64(WIDTH);
        let speed = |rate: T| (rate * rate + width * width).sqrt();
        let joint = |coulomb: T, rate: T| -(coulomb * rate / speed(rate));
        let air = |quadratic: T, rate: T| -(quadratic * rate * speed(rate));
        let upper = joint(coulomb_1, omega[0]);
        let lower = joint(coulomb_2, omega[1] - omega[0]);
        torques[0] = upper - lower + air(quadratic_1, omega[0]);
        torques[1] = lower + air(quadratic_2, omega[1]);
    }
}

impl Family for Rubbing {
    type Equations<T: Scalar> = UnderTorques<Chain<T>, Laws<T>>;

    fn parameters(&self) -> Vec<String> {
        let names = <Chain as Parametric<f64>>::PARAMETERS.iter().chain(&LAWS);
        names.map(|name| (*name).to_owned()).collect()
    }

    fn links(&self) -> Vec<String> {
        vec!["upper".to_owned(), "lower".to_owned()]
    }

    fn equations<T: Scalar>(&self, values: &[T]) -> Self::Equations<T> {
        let own = <Chain as Parametric<f64>>::PARAMETERS.len();
        let chain = Chain::<f64>::with_parameters(|index| values[index]);
        UnderTorques::of(chain, Laws([0, 1, 2, 3].map(|law| values[own + law])))
    }

    fn check(&self, values: &[f64]) -> Result<(), ImpossibleValue> {
        Ok(Chain::<f64>::check_parameters(|index| values[index])?)
    }
}

pub(crate) const GRAVITY: f64 = 9.80858023;

/// Masses, lengths, inertias and friction of a real chain, in SI units
/// (arXiv:2205.06231).
pub(crate) const REAL: [(&str, f64); 9] = [
    ("mass_1", 0.0938439748),
    ("mass_2", 0.137595970),
    ("com_1", 0.108565215),
    ("com_2", 0.116779018),
    ("joint_1", 0.172719204),
    ("inertia_1", 4.37529430e-4),
    ("inertia_2", 1.26882939e-3),
    ("viscous_1", 2.37142783e-4),
    ("viscous_2", 1.0e-5),
];

/// Uniform numbers between −1 and 1, from a xorshift generator.
pub(crate) struct Uniform(pub(crate) u64);

impl Uniform {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Normal by sums of twelve (Irwin and Hall).
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| 0.5 * self.next()).sum()
    }
}

/// All of [`REAL`] unknown, each taken to a start of its own.
pub(crate) fn all_unknown<F: Family>(
    family: F,
    mut start: impl FnMut(f64) -> f64,
) -> Identification<F> {
    let task = Identification::new(family).known("gravity", GRAVITY);
    let unknown =
        |task: Identification<F>, &(name, value): &(&str, f64)| task.unknown(name, start(value));
    REAL.iter().fold(task, unknown)
}

/// Both masses and a centre known, so that all others are determined.
pub(crate) fn five_unknown(mut start: impl FnMut(f64) -> f64) -> Identification<FamilyOf<Chain>> {
    let known = ["mass_1", "mass_2", "com_1"];
    let task = Identification::new(FamilyOf::<Chain>::new()).known("gravity", GRAVITY);
    REAL.iter()
        .fold(task, |task, &(name, value)| match known.contains(&name) {
            true => task.known(name, value),
            false => task.unknown(name, start(value)),
        })
}

/// The chain with the parameters of [`REAL`].
pub(crate) fn real() -> Chain {
    let names = <Chain as Parametric<f64>>::PARAMETERS;
    Chain::<f64>::with_parameters(|index| {
        let of = REAL.iter().find(|(name, _)| *name == names[index]);
        of.map_or(GRAVITY, |(_, value)| *value)
    })
}

/// Angles of the real chain's equations, `rate` a second, with white noise of this size.
pub(crate) fn simulated(
    start: [f64; 2],
    span: f64,
    rate: f64,
    noise: f64,
    seed: u64,
) -> AngleRecord {
    with_errors(start, span, rate, noise, 0.0, seed)
}

/// Such angles, whose errors forget themselves by a factor from one to the next.
pub(crate) fn with_errors(
    start: [f64; 2],
    span: f64,
    rate: f64,
    noise: f64,
    memory: f64,
    seed: u64,
) -> AngleRecord {
    let count = (span * rate).round() as usize;
    let times: Vec<f64> = (0..=count).map(|picture| picture as f64 / rate).collect();
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let start = State::at_rest(0.0, &start);
    let motion = method.sample_to_vec(&AbsoluteAngles(real()), &start, &times);
    let motion = motion.expect("it swings");
    let mut random = Uniform(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let angles = [0, 1].map(|link| {
        let mut error = 0.0;
        let angle = |state: &State<f64>| {
            error = memory * error + (1.0 - memory * memory).sqrt() * random.normal();
            Some(state.values[link] + noise * error)
        };
        motion.iter().map(angle).collect::<Vec<_>>()
    });
    AngleRecord::new(&times)
        .with_link("upper", &angles[0], 1e-3)
        .with_link("lower", &angles[1], 1e-3)
}

/// The true value of a parameter, of an offset or of a ratio.
pub(crate) fn truth(name: &str) -> f64 {
    let of = |factor: &str| {
        let own = REAL.iter().find(|(name, _)| *name == factor);
        own.map_or(0.0, |(_, value)| *value)
    };
    let mut divided = name.split(" / ");
    let product: f64 = divided.next().unwrap_or("").split(" · ").map(of).product();
    divided.fold(product, |value, divisor| value / of(divisor))
}
