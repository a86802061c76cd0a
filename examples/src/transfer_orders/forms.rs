//! The scene, and all forms of W at one state.

use branched_pendulum::branched_pendulum;

/// The paper's apparatus with W in every form: to first order in θ_d as
/// published, to orders 2 to 8 in the amplitude (θ_d and p_d together), and
/// exact. Its numbers are those of
/// [`branched_double::scenes`](crate::branched_double::scenes).
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(
        energies, momenta, symmetric,
        transfer(angle = 1, amplitude = 2, amplitude = 4, amplitude = 6, amplitude = 8, exact)
    ),
)]
pub struct Apparatus;

/// The approximate forms of W, in the order of [`Powers::forms`].
pub const FORMS: [&str; 5] = [
    "angle 1 (published)",
    "amplitude 2",
    "amplitude 4",
    "amplitude 6",
    "amplitude 8",
];

/// Coordinates (θ_1, θ_m, θ_d), rad, and their rates, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// θ_1, θ_m, θ_d.
    pub coordinates: [f64; 3],
    /// Their rates.
    pub rates: [f64; 3],
}

impl Motion {
    /// Amplitude of the antiphase motion at this instant, rad: of the linear
    /// oscillation that passes through (θ_d, ω_d).
    pub fn amplitude(&self) -> f64 {
        let [_, _, theta_d] = self.coordinates;
        let [_, _, omega_d] = self.rates;
        theta_d.hypot(omega_d / antiphase_frequency())
    }
}

/// W in watts in each form, at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// The approximate forms, in the order of [`FORMS`].
    pub forms: [f64; 5],
    /// The exact form.
    pub exact: f64,
}

impl Powers {
    /// W at a state.
    pub fn at(motion: &Motion) -> Self {
        let model = Apparatus::new();
        let q = &motion.coordinates;
        let p = &model.symmetric_momenta(q, &motion.rates);
        Self {
            forms: [
                model.transfer_angle_1(q, p).total(),
                model.transfer_amplitude_2(q, p).total(),
                model.transfer_amplitude_4(q, p).total(),
                model.transfer_amplitude_6(q, p).total(),
                model.transfer_amplitude_8(q, p).total(),
            ],
            exact: model.transfer_exact(q, p).total(),
        }
    }
}

/// Angular frequency of small antiphase oscillations, rad/s: √(G_2/M_2), 2π
/// times 1.2580584 Hz.
pub fn antiphase_frequency() -> f64 {
    let model = Apparatus::<f64>::new();
    (model.gravity_child() / model.inertia_child()).sqrt()
}
