//! A parameter sweep: the same tree with many coefficients of friction, all in the vector registers
//! of one run.

use branched_pendulum::prelude::*;

/// Two equal links that hang from one, with friction in the pivots.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    emit(energies),
)]
struct Damped;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = State::at_rest(0.0, &[0.8, 0.1, -0.1]);
    let frictions = [0.0, 1e-6, 1e-5, 1e-4, 1e-3];
    let models = frictions.map(|friction| Damped::new(DampedParameters { friction }));
    let models: Vec<Damped> = models.into_iter().collect::<Result<_, _>>()?;
    let cases: Vec<_> = models
        .iter()
        .map(|model| (AbsoluteAngles(model), start.clone()))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-10));
    let ends = Ensemble::new().integrate_models_in_lanes(&method, &cases, 20.0);
    for ((friction, model), end) in frictions.iter().zip(&models).zip(ends) {
        let energy = |state: &State<f64>| model.energy_of(state.positions(), state.velocities());
        let left = energy(&end?.state) / energy(&start);
        println!(
            "{friction:5.0e} N m s: {:8.4} % of the energy is left after 20 s",
            100.0 * left
        );
    }
    Ok(())
}
