//! Froude's pendulum: a rod that hangs on a turning shaft by dry friction. Coulomb friction alone
//! only shifts its rest position. Friction that falls with the rate (Stribeck friction) feeds the
//! swing, until the rod sticks to the shaft for a part of each swing. With a folder as the argument
//! it draws the laws there, as `friction-laws.png`.

use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::prelude::*;
use branched_pendulum::system::PrescribedOde;
use branched_pendulum_charts::{Axis, Chart, Panel};

/// The rod's friction acts on its rate relative to the shaft.
#[branched_pendulum(
    gravity = 9.80665,
    shaft(mass = 1, com = 0, inertia = 1e-3) [
        rod: rod(mass = 0.2, length = 0.3, at = 0,
            friction(viscous = 1e-4, coulomb = 0.02, static = breakaway, stribeck = 1, width = 0.02))
    ],
    prescribed(shaft),
    emit(energies),
)]
struct Froude;

/// Rate of the shaft, rad/s.
const SHAFT: f64 = 1.2;
/// Static friction, N m: as large as Coulomb friction, and two and three times as large.
const STATIC: [f64; 3] = [0.02, 0.04, 0.06];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("static N m   swing at 1 s, 10 s, 30 s (mrad)   sticks");
    for breakaway in STATIC {
        let model = Froude::new(FroudeParameters { breakaway })?;
        let turning = |time: f64, course: &mut [[f64; 3]]| course[0] = [SHAFT * time, SHAFT, 0.0];
        let system = PrescribedOde::new(&model, 0, turning).ok_or("no such set of links")?;
        let start = State::new(0.0, vec![0.0, 0.05, SHAFT, 0.0]);
        let times: Vec<f64> = (0..=30_000).map(|i| 1e-3 * f64::from(i)).collect();
        let (mut rod, mut sticking) = (Vec::new(), 0);
        let method = Dop853::new(Options::with_tolerance(1e-9));
        method.sample(&system, &start, &times, |time, state| {
            rod.push(state[1]);
            // The rod creeps on the shaft where the static friction holds it.
            let is_stuck = (state[3] - SHAFT).abs() < 0.05;
            sticking += usize::from(time > 20.0 && is_stuck);
        })?;
        // Half of the range in the two seconds before each time.
        let swing = |second: usize| {
            let part = &rod[(1000 * second).saturating_sub(2000)..=1000 * second];
            let [least, most] =
                [f64::min, f64::max].map(|of| part.iter().copied().fold(rod[1000 * second], of));
            500.0 * (most - least)
        };
        println!(
            "{breakaway:10.2}   {:12.1} {:8.1} {:8.1}   {:8.1} %",
            swing(1),
            swing(10),
            swing(30),
            1e-2 * f64::from(u32::try_from(sticking)?)
        );
    }
    match std::env::args().nth(1) {
        Some(folder) => draw(&folder),
        None => Ok(()),
    }
}

/// Draws the torque of the laws against the rate.
fn draw(folder: &str) -> Result<(), Box<dyn std::error::Error>> {
    let rates: Vec<f64> = (-400..=400).map(|i| 0.01 * f64::from(i)).collect();
    let mut panel = Panel::new(Axis::linear("torque (N m)"));
    for breakaway in STATIC {
        let law = FrictionLaw {
            coulomb: 0.02,
            width: 0.02,
            excess: breakaway - 0.02,
            stribeck: 1.0,
            ..FrictionLaw::none()
        };
        let torques: Vec<f64> = rates.iter().map(|&rate| law.torque(rate)).collect();
        panel = panel.line(format!("static friction {breakaway} N m"), &rates, &torques);
    }
    let title = "Friction of a joint: Coulomb friction 0.02 N m, Stribeck rate 1 rad/s";
    let chart = Chart::new(title, Axis::linear("rate (rad/s)")).panel(panel);
    chart.write_png(std::path::Path::new(folder).join("friction-laws.png"))?;
    Ok(())
}
