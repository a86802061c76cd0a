//! A model that changes while it moves: what is kept, what is lost.

use branched_pendulum::prelude::*;

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [
        fruit: ball(mass = weight, length = 0.1, radius = 0.03),
        twig: rod(mass = 0.1, length = 0.3)
    ],
    emit(energies, momenta, positions),
)]
struct Laden;

#[branched_pendulum(
    gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3)],
    emit(energies, momenta),
)]
struct Bare;

fn laden(fruit: f64) -> Laden {
    Laden::new(LadenParameters { weight: fruit }).expect("possible")
}

/// A fruit that falls keeps its own motion, and takes the energy and the momentum with it
/// that it had: no torque acts, and the velocities of the others stay.
#[test]
fn a_fruit_falls() {
    let (before, after) = (laden(0.2), Bare::new());
    let state = State::from_positions_and_velocities(1.5, &[0.5, 0.3, -0.2], &[2.0, 1.0, -3.0])
        .expect("as many");
    let rest = state.of_links(&[0, 2]).expect("it has these links");
    assert_eq!(rest.time, 1.5);
    assert_eq!(rest.values, [0.5, -0.2, 2.0, -3.0]);
    let (theta, omega) = ([0.5, 0.3, -0.2], [2.0, 1.0, -3.0]);
    let (kept_theta, kept_omega) = ([0.5, -0.2], [2.0, -3.0]);
    // The fruit by itself: as a body in flight.
    let body = before.properties_of(1).expect("it has that link");
    let [x, y] = before.centre_velocities(&theta, &omega)[1];
    let flying = 0.5 * body.mass * (x * x + y * y) + 0.5 * body.inertia * omega[1] * omega[1];
    let kinetic = before.kinetic_energy(&theta, &omega);
    let kept = after.kinetic_energy(&kept_theta, &kept_omega);
    assert!((kinetic - kept - flying).abs() < 1e-14);
    let rise = before.centres(&theta)[1][1] - before.centres(&[0.0; 3])[1][1];
    let potential = before.potential_energy(&theta) - after.potential_energy(&kept_theta);
    assert!((potential - body.mass * 9.80665 * rise).abs() < 1e-14);
    // Angular momentum about the root's pivot.
    let whole: f64 = before.momenta(&theta, &omega).iter().sum();
    let rest: f64 = after.momenta(&kept_theta, &kept_omega).iter().sum();
    let [place_x, place_y] = before.centres(&theta)[1];
    let of_fruit = body.mass * (place_x * y - place_y * x) + body.inertia * omega[1];
    assert!((whole - rest - of_fruit).abs() < 1e-14);
}

/// A part that lands at rest and sticks leaves all momenta as they are, and takes energy.
#[test]
fn snow_lands() {
    let (before, after) = (laden(0.2), laden(0.5));
    let (theta, omega) = ([0.5, 0.3, -0.2], [2.0, 1.0, -3.0]);
    let momenta = before.momenta(&theta, &omega);
    let slowed = after.velocities(&theta, &momenta);
    let same = after.momenta(&theta, &slowed);
    for (p, same) in momenta.iter().zip(same) {
        assert!((p - same).abs() < 1e-14);
    }
    let [kinetic, kept] = [
        before.kinetic_energy(&theta, &omega),
        after.kinetic_energy(&theta, &slowed),
    ];
    assert!(kept < kinetic);
    // The loss is that of an inelastic blow: ½ Δωᵀ M Δω + ½ ω'ᵀ (M' − M) ω', M without
    // and M' with the snow.
    let change: [f64; 3] = std::array::from_fn(|link| omega[link] - slowed[link]);
    let lost = before.kinetic_energy(&theta, &change) + after.kinetic_energy(&theta, &slowed)
        - before.kinetic_energy(&theta, &slowed);
    assert!((kinetic - kept - lost).abs() < 1e-14);
}

#[test]
fn links_that_are_not_there() {
    let state = State::at_rest(0.0, &[0.5, 0.3]);
    assert!(state.of_links(&[2]).is_none());
    assert_eq!(
        state.of_links(&[1, 1]).expect("both").values,
        [0.3, 0.3, 0.0, 0.0]
    );
}
