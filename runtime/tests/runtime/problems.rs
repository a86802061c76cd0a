//! Problems that come with their answers.

use branched_pendulum::prelude::*;
use branched_pendulum::system::functions::{CanonicalRates, SymmetricAccelerations};
use branched_pendulum::system::{At, Computes, LinkName};

/// A system of any rates. Rates are called by their address, so that each method is compiled
/// once for all such systems.
pub(crate) struct Problem<T> {
    dimension: usize,
    rates: Box<Rates<T>>,
}

type Rates<T> = dyn Fn(T, &[T], &mut [T]) + Send + Sync;

impl<T> Problem<T> {
    pub(crate) fn new(
        dimension: usize,
        rates: impl Fn(T, &[T], &mut [T]) + Send + Sync + 'static,
    ) -> Self {
        let rates = Box::new(rates);
        Self { dimension, rates }
    }
}

impl<T> Ode<T> for Problem<T> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        (self.rates)(time, state, rates);
    }
}

/// y' = y cos t, y(0) = 1: smooth, depends on time, y = exp(sin t).
pub(crate) fn growth_and_decay() -> Problem<f64> {
    Problem::new(1, |time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[0] * time.cos()
    })
}

pub(crate) fn growth_and_decay_at(time: f64) -> f64 {
    time.sin().exp()
}

/// y'' + y = sin 2t.
pub(crate) fn driven_oscillator() -> Problem<f64> {
    Problem::new(2, |time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = (2.0 * time).sin() - y[0];
    })
}

/// The motion of [`driven_oscillator`] that starts at rest from zero.
pub(crate) fn driven_oscillator_at(time: f64) -> [f64; 2] {
    let (single, double) = (time.sin_cos(), (2.0 * time).sin_cos());
    [
        (2.0 * single.0 - double.0) / 3.0,
        2.0 * (single.1 - double.1) / 3.0,
    ]
}

/// y₁' = −2 t y₁², y₂' = y₁ y₂: not linear, y₁ = 1/(1 + t²), y₂ = exp(arctan t).
pub(crate) fn bell() -> Problem<f64> {
    Problem::new(2, |time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = -2.0 * time * y[0] * y[0];
        rates[1] = y[0] * y[1];
    })
}

pub(crate) fn bell_at(time: f64) -> [f64; 2] {
    [1.0 / (1.0 + time * time), time.atan().exp()]
}

/// Two bodies; period 2π. State: position, velocity in the plane.
pub(crate) fn kepler<T: Real>() -> Problem<T> {
    Problem::new(4, |_time: T, y: &[T], rates: &mut [T]| {
        let squared = y[0] * y[0] + y[1] * y[1];
        let cubed = squared * squared.sqrt();
        rates[0] = y[2];
        rates[1] = y[3];
        rates[2] = -(y[0] / cubed);
        rates[3] = -(y[1] / cubed);
    })
}

/// Start of [`kepler`] at the point nearest to the centre.
pub(crate) fn perihelion<T: Real>(eccentricity: f64) -> State<T> {
    let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    let values = [1.0 - eccentricity, 0.0, 0.0, speed];
    State::new(T::ZERO, values.map(T::from_f64).to_vec())
}

pub(crate) fn harmonic<T: Real>() -> Problem<T> {
    Problem::new(2, |_time: T, y: &[T], rates: &mut [T]| {
        rates[0] = y[1];
        rates[1] = -y[0];
    })
}

/// The paper's pendulum (`docs/physics.md`, sections 1 and 6), its equations
/// of motion solved by hand: A₁₁, A₂₂ = A₃₃, A₁₂ = A₁₃, g h₁, g h₂ = g h₃.
#[derive(Clone, Copy)]
pub(crate) struct BranchedDouble {
    pub(crate) m1: f64,
    pub(crate) m2: f64,
    pub(crate) mu: f64,
    pub(crate) g1: f64,
    pub(crate) g2: f64,
}

impl BranchedDouble {
    pub(crate) fn paper() -> Self {
        let (mass_1, com_1, inertia_1, joint) = (0.12880, 0.084, 1.88e-3, 0.270);
        let (mass_2, com_2, inertia_2) = (0.10531, 0.043, 0.516e-3);
        let gravity = 9.80665;
        Self {
            m1: inertia_1 + mass_1 * com_1 * com_1 + 2.0 * mass_2 * joint * joint,
            m2: inertia_2 + mass_2 * com_2 * com_2,
            mu: mass_2 * com_2 * joint,
            g1: gravity * (mass_1 * com_1 + 2.0 * mass_2 * joint),
            g2: gravity * mass_2 * com_2,
        }
    }
}

impl<T: Scalar> Model<T> for BranchedDouble {
    type Of<S: Scalar> = BranchedDouble;
    const KNOWN_LINKS: Option<usize> = Some(3);

    fn links(&self) -> usize {
        3
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        LinkName::in_list(&["parent", "left", "right"], index)
    }

    fn cast<S: Scalar>(&self, _: impl Fn(T) -> S) -> BranchedDouble {
        *self
    }
}

impl<T: Scalar> Pendulum<T> for BranchedDouble {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let number = T::from_f64;
        let (m2, mu, g2) = (number(self.m2), number(self.mu), number(self.g2));
        // M2 α_j + μ c_j α_1 = -f_j; eliminating both α_j leaves the root.
        let mut inertia = number(self.m1);
        let mut torque = -(number(self.g1) * theta(0).sin_cos().0);
        let mut children = [(number(0.0), number(0.0)); 2];
        for (j, child) in [1, 2].into_iter().zip(&mut children) {
            let (sine, cosine) = (theta(j) - theta(0)).sin_cos();
            let force = mu * sine * omega(0) * omega(0) + g2 * theta(j).sin_cos().0;
            let coupling = mu * cosine;
            inertia = inertia - coupling * coupling / m2;
            torque = torque + mu * sine * omega(j) * omega(j) + coupling * force / m2;
            *child = (coupling, force);
        }
        let root = torque / inertia;
        alpha(0, root);
        for (j, (coupling, force)) in [1, 2].into_iter().zip(children) {
            alpha(j, -((coupling * root + force) / m2));
        }
    }
}

/// θ_1, θ_m = (θ_2 + θ_3)/2, θ_d = (θ_2 − θ_3)/2. With Δ = θ_m − θ_1 the sum and
/// the difference of the children's equations are
/// M_2 α_m + cosθ_d [μ (cosΔ α_1 + sinΔ ω_1²) + G_2 sinθ_m] = 0,
/// M_2 α_d + sinθ_d [μ (cosΔ ω_1² − sinΔ α_1) + G_2 cosθ_m] = 0.
impl<T: Scalar> SymmetricPendulum<T> for BranchedDouble {
    const COORDINATE_NAMES: &'static [&'static str] = &["theta_1", "theta_m", "theta_d"];
}

impl<T: Scalar> Computes<SymmetricAccelerations, T> for BranchedDouble {
    type On<S: Scalar> = BranchedDouble;

    fn on<S: Scalar>(&self, _: impl Fn(T) -> S) -> BranchedDouble {
        *self
    }

    fn compute(&self, _: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        let (&[q, rates], [alpha]) = (given, results) else {
            return;
        };
        let number = T::from_f64;
        let (m2, mu, g2, two) = (
            number(self.m2),
            number(self.mu),
            number(self.g2),
            number(2.0),
        );
        let (sine, cosine) = (q[1] - q[0]).sin_cos();
        let (sine_m, cosine_m) = q[1].sin_cos();
        let (sine_d, cosine_d) = q[2].sin_cos();
        let squared = rates[0] * rates[0];
        let (couple_m, couple_d) = (mu * cosine * cosine_d, -(mu * sine * sine_d));
        let force_m = cosine_d * (mu * sine * squared + g2 * sine_m);
        let force_d = sine_d * (mu * cosine * squared + g2 * cosine_m);
        let spin = sine * cosine_d * (rates[1] * rates[1] + rates[2] * rates[2])
            + two * cosine * sine_d * rates[1] * rates[2];
        let inertia = number(self.m1) - two * (couple_m * couple_m + couple_d * couple_d) / m2;
        let torque = two * (couple_m * force_m + couple_d * force_d) / m2 + two * mu * spin
            - number(self.g1) * q[0].sin_cos().0;
        alpha[0] = torque / inertia;
        alpha[1] = -((couple_m * alpha[0] + force_m) / m2);
        alpha[2] = -((couple_d * alpha[0] + force_d) / m2);
    }
}

/// In absolute angles and their momenta p = M ω: ω by elimination, and
/// ∂L/∂θ_1 = μ ω_1 Σ sin(θ_j − θ_1) ω_j − G_1 sin θ_1,
/// ∂L/∂θ_j = −μ ω_1 sin(θ_j − θ_1) ω_j − G_2 sin θ_j.
impl<T: Scalar> Computes<CanonicalRates, T> for BranchedDouble {
    type On<S: Scalar> = BranchedDouble;

    fn on<S: Scalar>(&self, _: impl Fn(T) -> S) -> BranchedDouble {
        *self
    }

    fn compute(&self, _: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        let (&[q, p], [omega, f]) = (given, results) else {
            return;
        };
        let number = T::from_f64;
        let (m2, mu, g2) = (number(self.m2), number(self.mu), number(self.g2));
        let coupling = [1, 2].map(|j| {
            let (sine, cosine) = (q[j] - q[0]).sin_cos();
            (mu * sine, mu * cosine)
        });
        let (mut inertia, mut momentum) = (number(self.m1), p[0]);
        for (j, (_, cosine)) in [1, 2].into_iter().zip(coupling) {
            inertia = inertia - cosine * cosine / m2;
            momentum = momentum - cosine * p[j] / m2;
        }
        omega[0] = momentum / inertia;
        f[0] = -(number(self.g1) * q[0].sin_cos().0);
        for (j, (sine, cosine)) in [1, 2].into_iter().zip(coupling) {
            omega[j] = (p[j] - cosine * omega[0]) / m2;
            let exchange = sine * omega[0] * omega[j];
            f[0] = f[0] + exchange;
            f[j] = -exchange - g2 * q[j].sin_cos().0;
        }
    }
}

impl BranchedDouble {
    /// H of a state of angles and momenta.
    pub(crate) fn hamiltonian(&self, state: &[f64]) -> f64 {
        let (q, p) = state.split_at(3);
        let (mut omega, mut rates) = ([0.0; 3], [0.0; 3]);
        self.canonical_rates_into(0.0, q, p, &mut omega, &mut rates);
        let kinetic: f64 = omega.iter().zip(p).map(|(w, p)| 0.5 * w * p).sum();
        kinetic + self.potential_energy_of(q)
    }
}

impl<T: Scalar> Energy<T> for BranchedDouble {
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
        let number = T::from_f64;
        let mut sum = number(0.5 * self.m1) * omega[0] * omega[0];
        for j in [1, 2] {
            let cosine = (theta[j] - theta[0]).sin_cos().1;
            sum = sum
                + number(0.5 * self.m2) * omega[j] * omega[j]
                + number(self.mu) * cosine * omega[0] * omega[j];
        }
        sum
    }

    fn potential_energy_of(&self, theta: &[T]) -> T {
        let lift = |angle: T| {
            let half = (angle * T::from_f64(0.5)).sin_cos().0;
            T::from_f64(2.0) * half * half
        };
        T::from_f64(self.g1) * lift(theta[0])
            + T::from_f64(self.g2) * (lift(theta[1]) + lift(theta[2]))
    }
}

/// An observer that lets the run go on.
pub(crate) fn watch<T>(_step: &mut DenseStep<'_, T>) -> core::ops::ControlFlow<()> {
    core::ops::ControlFlow::Continue(())
}
