//! An ensemble: 1024 releases of a double pendulum are integrated together, several in each vector
//! register, and the distances between neighbours are printed.

use branched_pendulum::prelude::*;

/// Two rods, the second hanging from the first.
#[branched_pendulum(
    gravity = 9.80665,
    upper: rod(mass = 0.2, length = 0.3) [lower: rod(mass = 0.1, length = 0.2)],
)]
struct Chain;

fn main() -> Result<(), IntegrationError<f64>> {
    let chain = Chain::new();
    let starts: Vec<State<f64>> = (0..1024)
        .map(|k| State::at_rest(0.0, &[0.003 * f64::from(k), 0.0]))
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let system = AbsoluteAngles(&chain);
    let ends = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 5.0);
    let angles: Vec<f64> = ends
        .into_iter()
        .map(|end| Ok(end?.state.values[1]))
        .collect::<Result<_, IntegrationError<f64>>>()?;
    for (block, angles) in angles.chunks(128).enumerate() {
        let apart = angles.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        println!(
            "released from {:5.1}° on: neighbours 0.17° apart end {:8.2}° apart at most",
            (0.003 * 128.0 * block as f64).to_degrees(),
            apart.fold(0.0, f64::max).to_degrees()
        );
    }
    Ok(())
}
