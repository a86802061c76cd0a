//! Titles of the maps, and the reach of the orders of W.

use branched_pendulum_studies::stability_map::output::SURVEYS;
use branched_pendulum_studies::stability_map::truncation::{Worth, after};
use branched_pendulum_studies::stability_map::verdict::{
    DAMPED_ANGLE, DAMPED_DURATION, IDEAL_DURATION,
};

#[test]
fn titles_tell_the_runs() {
    let [amplitude, tolerance, friction] = SURVEYS.map(|survey| survey.title);
    let ideal = format!("{IDEAL_DURATION} s without friction");
    assert!(amplitude.starts_with(&ideal) && tolerance.starts_with(&ideal));
    assert!(friction.starts_with(&format!("{DAMPED_DURATION} s from {DAMPED_ANGLE}°")));
}

/// Checks that the published form is never accurate, that a higher order is never worse at
/// small amplitudes, and that no order is accurate at the largest.
#[test]
fn orders_reach_further_one_after_the_other() {
    let places = after(45.0).unwrap();
    let reach = |form: usize| {
        let own = places.iter().skip(form).step_by(5);
        own.take_while(|place| Worth::of(place.error) == Worth::Accurate)
            .last()
            .map_or(0.0, |place| place.amplitude)
    };
    let reaches: Vec<f64> = (0..5).map(reach).collect();
    assert_eq!(reaches[0], 0.0);
    assert!(reaches[1] > 0.1 && reaches[2] > 0.5, "{reaches:?}");
    assert!(reaches.windows(2).all(|pair| pair[0] <= pair[1]));
    let half_a_radian = places.chunks(5).find(|row| row[0].amplitude > 0.5);
    let orders = &half_a_radian.unwrap()[1..];
    assert!(
        orders
            .windows(2)
            .all(|pair| pair[1].error < 0.3 * pair[0].error)
    );
    let last = &places[places.len() - 5..];
    assert!(last.iter().all(|place| place.error > 0.1), "{last:?}");
}
