//! The full model and its approximation in turn.

use branched_pendulum::approximate::{Linear, Switched};
use branched_pendulum::integrate::{Frames, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::UnderTorques;

use crate::scenes::{Branched, branched};

const FRAME: f64 = 1.0 / 60.0;

/// A swing that dies out, a kick after 20 s, and rest again: the switched motion stays
/// within the tolerance of the full one, and takes the full model only where it must.
fn run(tolerance: f64) -> (f64, u64, u64) {
    let model: Branched = branched(8e-3);
    let start = State::at_rest(0.0, &[1.2, 0.8, 1.0]);
    let sub_step = longest_sub_step(&model);
    let frames = || Frames::new(UnderTorques::of(&model, vec![0.0; 3]), &start, sub_step).unwrap();
    let linear = Linear::about(&model, &[0.0; 3]).unwrap();
    let seconds = linear.fading_time();
    let linear = linear.frames(FRAME).unwrap();
    let (mut full, mut switched) = (
        frames(),
        Switched::new(frames(), linear, tolerance, seconds),
    );
    let mut worst = 0.0_f64;
    for frame in 0..2400 {
        let kick = if (1200..1206).contains(&frame) {
            1.5
        } else {
            0.0
        };
        let torques = [kick, 0.0, 0.0];
        full.ode_mut().torques_mut().copy_from_slice(&torques);
        full.advance(FRAME);
        switched.advance_under(&torques);
        for (a, b) in full.state().iter().zip(switched.state()).take(3) {
            worst = worst.max((a - b).abs());
        }
    }
    let log = switched.log();
    assert_eq!(log.full_frames + log.approximate_frames, 2400);
    (worst, log.approximate_frames, log.switches)
}

#[test]
fn the_switched_motion_meets_the_tolerance() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let (worst, approximate, switches) = run(tolerance);
        assert!(worst < tolerance, "{tolerance}: {worst}");
        // To the approximation, back at the kick, and to it again.
        assert_eq!(switches, 3, "{tolerance}");
        assert!(approximate > 250, "{tolerance}: {approximate}");
    }
}

/// Torques that are no numbers are dealt with by the full model, which stops the links.
#[test]
fn the_state_stays_finite() {
    let model = branched(8e-3);
    let start = State::at_rest(0.0, &[0.01; 3]);
    let full = Frames::new(
        UnderTorques::of(&model, vec![0.0; 3]),
        &start,
        longest_sub_step(&model),
    )
    .unwrap();
    let linear = Linear::about(&model, &[0.0; 3]).unwrap();
    let mut motion = Switched::new(full, linear.frames(FRAME).unwrap(), 0.1, 1.0);
    for (frame, torque) in [0.0, f64::NAN, 0.0, 1e6, f64::INFINITY, 0.0]
        .iter()
        .enumerate()
    {
        motion.advance_under(&[*torque; 3]);
        assert!(
            motion.state().iter().all(|value| value.is_finite()),
            "{frame}"
        );
        assert_eq!(motion.is_approximate(), frame == 0, "{frame}");
    }
    assert!((motion.time() - 6.0 * FRAME).abs() < 1e-15);
    assert_eq!(motion.log().switches, 2);
}

#[test]
fn a_tolerance_that_is_none_leaves_all_to_the_full_model() {
    for tolerance in [0.0, -1.0, f64::NAN] {
        let (worst, approximate, switches) = run(tolerance);
        assert_eq!((worst, approximate, switches), (0.0, 0, 0));
    }
}
