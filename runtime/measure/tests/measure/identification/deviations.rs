//! Deviations of what was found, against truths and against fits without a part of the record.

use branched_pendulum_measure::identification::{FamilyOf, Shooting};

use super::chain::{Chain, REAL, all_unknown, five_unknown, simulated, truth, with_errors};

/// How many bars of 95 % hold the truth, and how large errors are in deviations (rms): of
/// naive ones, of those by blocks.
fn coverage(runs: u64, memory: f64) -> [[f64; 2]; 2] {
    let mut sums = [[0.0; 2]; 2];
    let mut count = 0.0;
    for seed in 1..=runs {
        let record = with_errors([0.8, -0.5], 15.0, 50.0, 2e-3, memory, seed);
        let fit = five_unknown(|value| value).fit(&record).unwrap();
        for (name, value) in &REAL[3..] {
            let estimate = fit.determined(name).unwrap();
            let error = (estimate.value - value).abs();
            // Normal, and Student's distribution of 29 degrees of freedom.
            let bars = [(estimate.naive, 1.960), (estimate.by_blocks, 2.045)];
            for ([holds, squares], (deviation, wide)) in sums.iter_mut().zip(bars) {
                let deviations = error / deviation.unwrap();
                *holds += f64::from(u8::from(deviations < wide));
                *squares += deviations * deviations;
            }
            count += 1.0;
        }
    }
    sums.map(|[holds, squares]| [holds / count, (squares / count).sqrt()])
}

#[test]
fn bars_hold_the_truth() {
    // 120 intervals, of independent and dependent parameters: three deviations.
    for [holds, size] in coverage(20, 0.0) {
        assert!(holds >= 0.86, "{holds}");
        assert!((0.8..1.25).contains(&size), "{size}");
    }
}

#[test]
fn bars_by_blocks_hold_the_truth_where_errors_go_on() {
    // Errors that last for five pictures: naive bars are three times too small.
    let [[naive, _], [holds, size]] = coverage(20, 0.8);
    assert!(naive < 0.7, "{naive}");
    assert!(holds >= 0.85, "{holds}");
    assert!((0.75..1.35).contains(&size), "{size}");
}

/// Some minutes: `cargo test --release -p branched-pendulum-measure --test measure -- --ignored --nocapture two_hundred`.
#[test]
#[ignore = "some minutes"]
fn bars_hold_the_truth_in_two_hundred_runs() {
    for memory in [0.0, 0.8] {
        let [naive, by_blocks] = coverage(200, memory);
        println!("memory {memory}: naive {naive:.3?}, by blocks {by_blocks:.3?}");
        assert!((0.92..=0.97).contains(&by_blocks[0]), "{by_blocks:?}");
        assert_eq!(
            (0.93..=0.97).contains(&naive[0]),
            memory == 0.0,
            "{naive:?}"
        );
    }
}

/// Both error bars of a ratio are in its unit: a ratio of a mass and an inertia is some hundreds, so
/// that a relative one would be far off.
#[test]
fn deviations_of_ratios_hold_the_truth() {
    let (mut squares, mut by_blocks, mut count) = (0.0, 0.0, 0.0);
    for seed in 1..=10 {
        let record = simulated([0.8, -0.5], 15.0, 50.0, 2e-3, seed);
        let task = all_unknown(FamilyOf::<Chain>::new(), |value| 1.2 * value);
        let fit = task.fit(&record).unwrap();
        assert!(fit.ratios.len() >= 2, "{:?}", fit.ratios);
        for ratio in &fit.ratios {
            let error = ratio.value - truth(&ratio.name);
            squares += (error / ratio.naive.unwrap()).powi(2);
            by_blocks += (error / ratio.by_blocks.unwrap()).powi(2);
            count += 1.0;
            let bars = ratio.by_blocks.unwrap() / ratio.naive.unwrap();
            assert!((0.4..2.5).contains(&bars), "{ratio:?}");
        }
    }
    for squares in [squares, by_blocks] {
        let size = f64::sqrt(squares / count);
        assert!((0.6..1.5).contains(&size), "{size}");
    }
}

/// With errors that go on for some pictures the bars by blocks of ratios are larger, as those of
/// single parameters are.
#[test]
fn bars_by_blocks_of_ratios_hold_the_truth_where_errors_go_on() {
    let (mut squares, mut naive, mut count) = (0.0, 0.0, 0.0);
    for seed in 1..=6 {
        let record = with_errors([0.8, -0.5], 15.0, 50.0, 2e-3, 0.8, seed);
        let fit = all_unknown(FamilyOf::<Chain>::new(), |value| value).fit(&record);
        for ratio in &fit.unwrap().ratios {
            let error = ratio.value - truth(&ratio.name);
            squares += (error / ratio.by_blocks.unwrap()).powi(2);
            naive += (error / ratio.naive.unwrap()).powi(2);
            count += 1.0;
        }
    }
    let [by_blocks, naive] = [squares, naive].map(|squares| f64::sqrt(squares / count));
    assert!((0.5..1.6).contains(&by_blocks), "{by_blocks}");
    assert!(naive > by_blocks, "{naive} {by_blocks}");
}

/// Blocks that are hardly more than the unknowns have no error bars: one that is left out would
/// leave nothing to judge it by. Two more than unknowns are enough.
#[test]
fn few_blocks_have_no_error_bars() {
    for (span, seed) in [(6.0, 1), (9.0, 2), (12.0, 3)] {
        let record = simulated([0.8, -0.5], span, 50.0, 1e-3, seed);
        // On both sides of the limit, and far from it.
        for blocks in [2, 6, 7, 10] {
            let task = five_unknown(|value| value).with_shooting(Shooting {
                block: Some(1.001 * span / f64::from(blocks)),
                ..Shooting::default()
            });
            let fit = task.fit(&record).unwrap();
            assert_eq!(fit.blocks, blocks as usize);
            let unknowns = fit.estimates.len();
            for own in &fit.estimates {
                let by_blocks = own.by_blocks.unwrap();
                assert_eq!(
                    by_blocks.is_finite(),
                    fit.blocks >= unknowns + 2,
                    "{blocks} {own:?}"
                );
                assert_eq!(own.deviation().unwrap().is_finite(), by_blocks.is_finite());
            }
        }
    }
}
