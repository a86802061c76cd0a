//! A pendulum that a shaken pivot holds upright.

use std::f64::consts::PI;

use branched_pendulum::prelude::*;

mod scene {
    #![allow(missing_docs)]
    use branched_pendulum::branched_pendulum;

    /// A rod whose pivot is shaken up and down; it swings like a point at
    /// 2/3 of its length.
    #[branched_pendulum(
        gravity = 9.8,
        rod: rod(mass = 0.1, length = 0.3),
        drive(y = height * cos(rate * t)),
    )]
    pub struct Shaken;
}

/// The largest angle from upright over 6 s, and the number of crossings of it.
fn upright(height: f64, rate: f64) -> (f64, usize) {
    let parameters = scene::ShakenParameters { height, rate };
    let model = scene::Shaken::new(parameters).expect("possible parameters");
    let start = State::at_rest(0.0, &[PI + 0.02]);
    let times: Vec<f64> = (1..=6000).map(|i| 1e-3 * f64::from(i)).collect();
    let mut angles = Vec::new();
    Dop853::new(Options::with_tolerance(1e-10))
        .sample(&AbsoluteAngles(&model), &start, &times, |_, state| {
            angles.push(state[0] - PI);
        })
        .expect("it runs");
    let crossings = angles.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
    let largest = angles.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    (largest, crossings)
}

/// Kapitza's pendulum (Landau and Lifshitz, Mechanics, §30): upright is stable
/// where the pivot moves fast enough, a² Ω² > 2 g l, and the slow oscillation
/// about it has the frequency √(a² Ω²/2 l² − g/l).
#[test]
fn a_fast_pivot_holds_the_pendulum_upright() {
    const HEIGHT: f64 = 0.005;
    const LENGTH: f64 = 0.2;
    let threshold = (2.0 * 9.8 * LENGTH).sqrt() / HEIGHT;
    let (largest, crossings) = upright(HEIGHT, 0.95 * threshold);
    assert!(largest > 1.0, "{largest} {crossings}");
    for factor in [1.05, 1.5, 3.0] {
        let rate = factor * threshold;
        let (largest, crossings) = upright(HEIGHT, rate);
        assert!(largest < 0.03, "{factor}: {largest}");
        let square = (HEIGHT * rate / LENGTH).powi(2) / 2.0 - 9.8 / LENGTH;
        let expected = 6.0 * square.sqrt() / PI;
        // Two crossings a period; the fast motion adds none away from zero.
        assert!(
            (crossings as f64 - expected).abs() < 2.0,
            "{crossings} {expected}"
        );
    }
}
