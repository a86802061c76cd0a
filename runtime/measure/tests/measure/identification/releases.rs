//! Releases of links that rest, are lifted and are held before.

use branched_pendulum_measure::identification::AngleRecord;

use super::chain::{Uniform, simulated};

/// A record of a chain that hangs, is lifted, is held and then released: the times at which each of
/// these begins.
fn lifted(hold: [f64; 3], rate: f64, noise: f64, start: [f64; 2], seed: u64) -> (AngleRecord, f64) {
    let [rest, lift, held] = hold;
    let motion = simulated(start, 8.0, rate, noise, seed);
    let mut random = Uniform(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let before = (rate * (rest + lift + held)).round() as usize;
    let release = before as f64 / rate;
    let count = before + motion.times().len();
    let times: Vec<f64> = (0..count).map(|picture| picture as f64 / rate).collect();
    let links = ["upper", "lower"].into_iter().zip(start);
    let record = links.fold(AngleRecord::new(&times), |record, (name, start)| {
        let own = motion.angles(name).unwrap();
        let before = times[..before].iter().map(|time| {
            // Half a wave from hanging to where the hand holds.
            let share = ((time - rest) / lift).clamp(0.0, 1.0);
            let place = 0.5 * start * (1.0 - (std::f64::consts::PI * share).cos());
            Some(place + noise * random.normal())
        });
        let angles: Vec<Option<f64>> = before.chain(own.iter().copied()).collect();
        record.with_link(name, &angles, 1e-3)
    });
    (record, release)
}

#[test]
fn the_last_hold_is_found() {
    for (hold, rate, noise, start) in [
        ([1.5, 0.5, 0.5], 60.0, 1e-3, [0.8, -0.5]),
        ([1.0, 1.0, 0.8], 120.0, 5e-4, [1.5, 1.2]),
        ([0.6, 0.7, 1.5], 240.0, 2e-3, [-1.0, -1.6]),
        ([2.0, 0.4, 0.6], 30.0, 2e-3, [0.5, 0.9]),
    ] {
        for seed in 1..=4 {
            let (record, release) = lifted(hold, rate, noise, start, seed);
            let found = record.release().unwrap();
            assert!(
                (-0.06..0.13).contains(&(found - release)),
                "{hold:?} {rate}: {found} for {release}"
            );
        }
    }
}

/// What has no hold has no release: motions that begin at once, among them slow and fast pictures,
/// and one that is taken away where it has come to rest.
#[test]
fn free_motions_have_no_release() {
    for (rate, noise, start) in [
        (30.0, 1e-3, [0.8, -0.5]),
        (100.0, 1e-4, [1.9, 2.4]),
        (240.0, 5e-4, [0.3, 0.4]),
        (1000.0, 5e-4, [0.8, -0.5]),
        (1000.0, 2e-3, [2.5, 0.3]),
    ] {
        for seed in 1..=3 {
            let record = simulated(start, 4.0, rate, noise, seed);
            let found = record.release();
            assert!(
                found.is_none_or(|time| time < 0.15),
                "{rate} {start:?} {found:?}"
            );
        }
    }
    let times: Vec<f64> = (0..900).map(|picture| f64::from(picture) / 60.0).collect();
    let mut random = Uniform(77);
    let angles: Vec<Option<f64>> = times
        .iter()
        .map(|time| {
            let swing = 0.8 * (-0.9 * time).exp() * (7.0 * time).cos();
            // Taken away after 13 s.
            let away = 1.5 * (time - 13.0).max(0.0).powi(2);
            Some(swing + away + 1e-3 * random.normal())
        })
        .collect();
    let record = AngleRecord::new(&times).with_link("bar", &angles, 1e-3);
    assert!(
        record.release().is_none_or(|time| time < 0.15),
        "{:?}",
        record.release()
    );
}
