//! Forms of the energy transfer W, the power that the antiphase mode of the paper's tree receives:
//! exact, as published, and by orders in the amplitude.

use branched_pendulum::prelude::*;

/// The apparatus of Toda and Ooshida.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(momenta, symmetric, transfer(angle = 1, amplitude = 2, amplitude = 4, exact)),
)]
struct BranchedDouble;

fn main() -> Result<(), IntegrationError<f64>> {
    let model = BranchedDouble::new();
    // θ_1, θ_m and θ_d, rad: the parent aside, the children vertical but for θ_d.
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 0.0, 0.01]);
    let times: Vec<f64> = (0..=3000).map(|k| 1e-3 * f64::from(k)).collect();
    let (mut energies, mut sums, mut before) = (Vec::new(), [0.0; 4], [0.0; 4]);
    Dop853::new(Options::with_tolerance(1e-12)).sample(
        &SymmetricCoordinates(&model),
        &start,
        &times,
        |_, y| {
            let q = [y[0], y[1], y[2]];
            let p = model.symmetric_momenta(&q, &[y[3], y[4], y[5]]);
            let powers = [
                model.transfer_exact(&q, &p),
                model.transfer_angle_1(&q, &p),
                model.transfer_amplitude_2(&q, &p),
                model.transfer_amplitude_4(&q, &p),
            ];
            for ((sum, before), power) in sums.iter_mut().zip(&mut before).zip(powers) {
                // The trapezoidal rule; W is zero at the release, where all is at rest.
                *sum += 0.5e-3 * (*before + power.total());
                *before = power.total();
            }
            energies.push(model.antiphase_energy(&q, &p));
        },
    )?;
    let gained = energies[energies.len() - 1] - energies[0];
    println!("H_d gains {gained:.6e} J in 3 s; the integral of W is");
    for (name, sum) in ["exact", "published", "order 2", "order 4"]
        .iter()
        .zip(sums)
    {
        println!(
            "  {name:10} {sum:.6e} J, {:+.4} of it too much",
            sum / gained - 1.0
        );
    }
    Ok(())
}
