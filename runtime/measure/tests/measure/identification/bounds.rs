//! Searches that end: by their work, by their observer, and at constants that no pendulum has.

use std::cell::Cell;
use std::ops::ControlFlow;

use branched_pendulum_measure::identification::{
    AngleRecord, FamilyOf, Identification, IdentificationError, SearchFailure, SearchOutcome,
    SearchProgress, Shooting, best,
};

use super::chain::{Chain, GRAVITY, REAL, Rubbing, Uniform, all_unknown, five_unknown, simulated};

fn on(_: &SearchProgress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Angles of two links that no chain moves by.
fn nonsense(number: u64, count: usize, rate: f64) -> AngleRecord {
    let mut random = Uniform((number + 3).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let times: Vec<f64> = (0..count).map(|picture| picture as f64 / rate).collect();
    let mut link = || {
        let waves: Vec<[f64; 3]> = (0..3)
            .map(|_| {
                [
                    4.0 * random.next(),
                    30.0 * random.next(),
                    3.0 * random.next(),
                ]
            })
            .collect();
        let angle = |time: &f64| {
            let waves = waves
                .iter()
                .map(|[size, rate, phase]| size * (rate * time + phase).sin());
            Some(waves.sum::<f64>())
        };
        times.iter().map(angle).collect::<Vec<_>>()
    };
    AngleRecord::new(&times)
        .with_link("upper", &link(), 1e-3)
        .with_link("lower", &link(), 1e-3)
}

/// The share of the work that a search reports never goes beyond all of it, and it ends.
#[test]
fn records_of_another_thing_are_refused_within_the_work() {
    for number in 0..4 {
        let record = nonsense(number, 120, 60.0);
        let most = Cell::new(0.0_f64);
        let observer = |progress: &SearchProgress| {
            most.set(most.get().max(progress.share));
            ControlFlow::Continue(())
        };
        let task = all_unknown(Rubbing, |value| value).known("coulomb_1", 0.0);
        let task = ["coulomb_2", "quadratic_1", "quadratic_2"]
            .iter()
            .fold(task, |task, law| task.known(law, 0.0))
            .with_offsets();
        let found = match task.fit_by_windows(&record, 1.0, None, &observer) {
            Ok(found) => found,
            // No part of it can be followed.
            Err(error) => {
                assert!(
                    matches!(error, IdentificationError::NoMotion { .. }),
                    "{error}"
                );
                continue;
            }
        };
        println!(
            "{number}: {:.3} {:?}",
            most.get(),
            found.result().map(|fit| fit.rms())
        );
        assert!(most.get() <= 1.01, "{}", most.get());
        assert!(found.one_motion.is_err());
        // Windows may follow it, but none with constants of no pendulum or too short ones.
        match found.result() {
            Ok(fit) => {
                assert!(fit.impossible.is_none());
                assert!(found.window().unwrap() >= 0.124);
            }
            Err(unfound) => {
                let own = unfound.best.estimates.iter();
                own.for_each(|own| assert_eq!((own.naive, own.by_blocks), (None, None)));
            }
        }
    }
}

#[test]
fn an_observer_ends_a_search_with_the_best_so_far() {
    let record = simulated([0.8, -0.5], 8.0, 50.0, 1e-3, 3);
    let task = five_unknown(|value| 1.25 * value).with_offsets();
    let calls = |limit: u64| {
        let count = Cell::new(0);
        let observer = |_: &SearchProgress| {
            count.set(count.get() + 1);
            match count.get() > limit {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let found = task.fit_by_windows(&record, 1.0, None, &observer);
        (found, count.get())
    };
    let (whole, all) = calls(u64::MAX);
    assert!(whole.unwrap().one_motion.is_ok());
    // Not even one step was made.
    assert_eq!(calls(0).0.unwrap_err(), IdentificationError::Ended);
    for part in [0.05, 0.3, 0.6, 0.95] {
        let limit = (part * all as f64) as u64;
        let (found, asked) = calls(limit);
        assert_eq!(asked, limit + 1, "it is asked no more");
        let found = found.unwrap();
        match &found.one_motion {
            Err(unfound) => {
                assert_eq!(unfound.failure, SearchFailure::Interrupted);
                let own = unfound.best.estimates.iter();
                own.for_each(|own| assert!(own.value.is_finite() && own.naive.is_none()));
                assert!(unfound.to_string().contains("interrupted"));
            }
            // It was at its end.
            Ok(fit) => assert!(part > 0.5 && fit.convergence.is_settled()),
        }
    }
}

/// The observer is called within segments too, however long they are, so that a search can be ended
/// at any time: between two calls the work grows by some ten thousand evaluations of a link.
#[test]
fn an_observer_is_called_within_long_segments() {
    for (span, seed) in [(8.0, 4), (16.0, 5), (30.0, 6)] {
        let record = simulated([0.8, -0.5], span, 50.0, 1e-3, seed);
        let [last, largest] = [(); 2].map(|()| Cell::new(0.0_f64));
        let observer = |progress: &SearchProgress| {
            let more = progress.share - last.replace(progress.share);
            largest.set(largest.get().max(more));
            ControlFlow::Continue(())
        };
        let task = five_unknown(|value| 1.1 * value);
        let found = task.fit_by_windows(&record, 1.0, None, &observer);
        assert!(found.unwrap().one_motion.is_ok());
        // Of some hundred million evaluations that are allowed.
        assert!(largest.get() < 3e-4, "{span} s: {}", largest.get());
    }
}

/// The same result as windows first and one motion from them, step by step.
#[test]
fn windows_and_one_motion_are_those_of_single_calls() {
    for (start, seed) in [([0.8, -0.5], 1), ([1.5, 1.2], 2), ([0.3, 0.9], 3)] {
        let record = simulated(start, 6.0, 50.0, 1e-3, seed);
        let task = five_unknown(|value| 1.2 * value).with_offsets();
        let found = task.fit_by_windows(&record, 1.0, None, &on).unwrap();
        let short = task.clone().with_shooting(Shooting {
            longest: 1.0,
            ..Shooting::default()
        });
        let windows = short.fit(&record).unwrap();
        assert_eq!(best(&found.in_windows), &windows);
        let motion = task.fit_from(&windows, &record).unwrap();
        assert_eq!(found.result().unwrap(), &motion);
        assert_eq!(found.window(), Some(1.0));
        assert_eq!(found.motion(), Some(&motion));
    }
}

/// A centre of mass that is known wrongly leaves the motion as it is if masses and inertias make up for
/// it, with an inertia that nothing has: no fit, and no error bars.
#[test]
fn constants_of_no_pendulum_are_no_fit() {
    let value = |name: &str| REAL.iter().find(|(own, _)| *own == name).unwrap().1;
    let [m1, m2, c1, c2] = ["mass_1", "mass_2", "com_1", "com_2"].map(value);
    let [l1, i1, i2] = ["joint_1", "inertia_1", "inertia_2"].map(value);
    for (factor, seed) in [(1.9, 1), (2.2, 2), (2.6, 3)] {
        // What keeps the equations of motion.
        let lighter = m2 / factor;
        let heavier = m1 + (m2 - lighter) * l1 / c1;
        let about_first = i1 + (m1 - heavier) * c1 * c1 + (m2 - lighter) * l1 * l1;
        let about_second = i2 + m2 * c2 * c2 * (1.0 - factor);
        assert!(about_first > 0.0 && about_second < 0.0);
        let record = simulated([0.8, -0.5], 6.0, 50.0, 1e-3, seed);
        let task = Identification::new(FamilyOf::<Chain>::new())
            .known("gravity", GRAVITY)
            .known("com_1", c1)
            .known("com_2", factor * c2)
            .known("joint_1", l1)
            .known("mass_2", lighter)
            .unknown("mass_1", 1.05 * heavier)
            .unknown("inertia_1", about_first)
            .unknown("inertia_2", 0.1 * i2)
            .unknown("viscous_1", value("viscous_1") / factor)
            .unknown("viscous_2", value("viscous_2"));
        let found = task.fit_by_windows(&record, 1.0, None, &on).unwrap();
        for found in [&found.in_windows, &found.one_motion] {
            let unfound = found.as_ref().unwrap_err();
            assert_eq!(unfound.failure, SearchFailure::Unphysical, "{unfound}");
            let own = unfound.best.estimates.iter();
            own.for_each(|own| assert_eq!((own.naive, own.by_blocks), (None, None)));
            let words = unfound.best.impossible.as_ref().unwrap().to_string();
            assert!(words.contains("inertia"), "{words}");
            assert!(unfound.to_string().contains(&words), "{unfound}");
            let found = unfound.best.value("inertia_2").unwrap();
            assert!(
                (found / about_second - 1.0).abs() < 0.2,
                "{found} {about_second}"
            );
        }
    }
}

/// Asserts that a fit of constants which no pendulum has is no fit and has no error bars.
fn assert_no_bars_of_no_pendulum(found: &SearchOutcome, words: &str) {
    let fit = best(found);
    if fit.impossible.is_some() {
        assert!(found.is_err(), "{words}");
        let mut own = fit.estimates.iter();
        assert!(
            own.all(|own| (own.naive, own.by_blocks) == (None, None)),
            "{words}"
        );
    }
}

/// Sixty records of 2 to 60 s, regular and chaotic ones and two kinds of nonsense, with six
/// unknowns, or with nine that are not determined: each search ends within its work, with an answer or a refusal.
///
/// `cargo test -p branched-pendulum-measure --test measure sixty_records -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn sixty_records_have_an_end() {
    let records: u64 = std::env::var("RECORDS").map_or(60, |count| count.parse().unwrap());
    let [mut fits, mut windows, mut refused] = [0; 3];
    for number in 0..records {
        let mut random = Uniform(number.wrapping_mul(0x2545_f491_4f6c_dd1d) | 1);
        let mut part = || 0.5 * (1.0 + random.next());
        let span = 2.0 * f64::powf(30.0, part());
        let rate = [30.0, 60.0, 100.0][(2.999 * part()) as usize];
        // At most 2,000 rows.
        let rate = f64::min(rate, 2000.0 / span);
        let size = 0.3 + 2.7 * part();
        let start = [size, size * (2.0 * part() - 1.0)];
        let noise = 1e-3 * f64::powf(10.0, part() - 0.5);
        let is_nonsense = number % 6 == 5;
        let record = match is_nonsense {
            true => nonsense(number, (span * rate) as usize, rate),
            false => simulated(start, span, rate, noise, number),
        };
        let far = 0.7 + 0.6 * part();
        let is_determined = number % 2 == 0;
        let task = match is_determined {
            true => five_unknown(|value| far * value),
            false => all_unknown(FamilyOf::<Chain>::new(), |value| far * value),
        };
        let most = Cell::new(0.0_f64);
        let observer = |progress: &SearchProgress| {
            most.set(most.get().max(progress.share));
            ControlFlow::Continue(())
        };
        let begun = std::time::Instant::now();
        let found = task
            .with_offsets()
            .fit_by_windows(&record, 1.0, None, &observer);
        let words = format!(
            "{number:>2}: {span:4.1} s at {rate:5.1} Hz, {size:.2} rad, determined {is_determined}, nonsense \
             {is_nonsense}: {:.0} s, {:.0} % of the work",
            begun.elapsed().as_secs_f64(),
            100.0 * most.get()
        );
        assert!(most.get() <= 1.01, "{words}");
        match found {
            Ok(found) => {
                assert_no_bars_of_no_pendulum(&found.in_windows, &words);
                assert_no_bars_of_no_pendulum(&found.one_motion, &words);
                match (&found.one_motion, found.result()) {
                    (Ok(_), _) => fits += 1,
                    (Err(_), Ok(_)) => windows += 1,
                    (Err(_), Err(_)) => refused += 1,
                }
                let result = found.result().map(|fit| 1e3 * fit.rms());
                println!("{words}: {:?} mrad", result.map_err(|own| own.failure));
            }
            Err(error) => {
                refused += 1;
                println!("{words}: {error}");
            }
        }
    }
    println!("{fits} by one motion, {windows} by windows, {refused} refused, of {records}");
    assert!(fits + windows + refused == records);
}
