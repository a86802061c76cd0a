//! The two trees, all of whose properties are parameters.

use branched_pendulum::Parametric;
use branched_pendulum::prelude::*;

/// A chain of two links.
#[branched_pendulum(
    gravity = gravity,
    upper(mass = mass_1, com = com_1, inertia = inertia_1, joint = joint_1,
        friction(viscous = viscous_1, coulomb = coulomb_1, width = 0.05),
        drag(quadratic = quadratic_1, width = 0.05)) [
        lower(mass = mass_2, com = com_2, inertia = inertia_2,
            friction(viscous = viscous_2, coulomb = coulomb_2, width = 0.05),
            drag(quadratic = quadratic_2, width = 0.05))
    ],
    emit(energies, modes),
)]
pub struct Chain;

/// Two equal links hang from one: the paper's apparatus.
#[branched_pendulum(
    gravity = gravity,
    parent(mass = mass_1, com = com_1, inertia = inertia_1, joint = joint_1,
        friction(viscous = viscous_1, coulomb = coulomb_1, width = 0.05),
        drag(quadratic = quadratic_1, width = 0.05)) [
        child(mass = mass_2, com = com_2, inertia = inertia_2,
            friction(viscous = viscous_2, coulomb = coulomb_2, width = 0.05),
            drag(quadratic = quadratic_2, width = 0.05)) * 2
    ],
    emit(energies),
)]
pub struct Branched;

/// A tree with the values from which its parameters are searched.
pub trait Described:
    Parametric<f64> + Pendulum<f64> + Model<f64, Of<f64> = Self> + Energy<f64>
{
    /// Rough values of the parameters, in SI units, but for gravity and laws of friction that
    /// are not viscous.
    const ROUGH: [(&'static str, f64); 9];
    /// Angles of a release at rest, rad, for simulations.
    const RELEASE: &'static [f64];
}

impl Described for Chain {
    const ROUGH: [(&'static str, f64); 9] = [
        ("mass_1", 0.11),
        ("mass_2", 0.12),
        ("com_1", 0.10),
        ("com_2", 0.13),
        ("joint_1", 0.17),
        ("inertia_1", 4e-4),
        ("inertia_2", 1.1e-3),
        ("viscous_1", 2e-4),
        ("viscous_2", 2e-5),
    ];
    const RELEASE: &'static [f64] = &[-0.8, 0.5];
}

impl Described for Branched {
    const ROUGH: [(&'static str, f64); 9] = [
        ("mass_1", 0.12880),
        ("mass_2", 0.10531),
        ("com_1", 0.084),
        ("com_2", 0.043),
        ("joint_1", 0.27),
        ("inertia_1", 1.88e-3),
        ("inertia_2", 0.516e-3),
        ("viscous_1", 1e-4),
        ("viscous_2", 2e-5),
    ];
    const RELEASE: &'static [f64] = &[0.8, 0.3, -0.2];
}

/// Coulomb friction in the pivots, with the sizes from which it is searched, N m.
pub const COULOMB: [(&str, f64); 2] = [("coulomb_1", 1e-4), ("coulomb_2", 1e-4)];
/// Quadratic drag of the links, with the sizes from which it is searched, N m s².
pub const QUADRATIC: [(&str, f64); 2] = [("quadratic_1", 1e-5), ("quadratic_2", 1e-5)];

/// How names of coefficients of friction begin.
pub const FRICTION: [&str; 3] = ["viscous", "coulomb", "quadratic"];
/// How names of what a scale or a ruler tells begin.
pub const MEASURABLE: [&str; 3] = ["mass", "com", "joint"];

/// Gravity where nothing else is given, m/s².
pub const GRAVITY: f64 = 9.80665;

/// Parameters of simulated trees: the rough ones, each a little off, and these.
pub fn simulated<M: Described>() -> Vec<f64> {
    let value = |name: &&str| {
        let rough = M::ROUGH.iter().position(|(own, _)| own == name);
        let others = COULOMB.iter().chain(&QUADRATIC);
        match rough {
            // From 20 % below to 20 % above.
            Some(index) => M::ROUGH[index].1 * (0.8 + 0.05 * index as f64),
            None if *name == "gravity" => GRAVITY,
            None => others
                .filter(|(own, _)| own == name)
                .map(|(_, size)| size)
                .sum(),
        }
    };
    M::PARAMETERS.iter().map(value).collect()
}
