//! Error bars, on a process whose errors are known.

use branched_pendulum::analysis::statistics::{
    Average, BlockLevel, Blocking, Drift, StatisticsError, jackknife, transient,
};

use crate::normal::Normal;

/// Loss of memory of the process from one sample to the next.
const MEMORY: f64 = 0.9;

/// An autoregressive process of variance 1 about zero, in its steady state: τ = 19.
fn process(normal: &mut Normal, samples: usize) -> Vec<f64> {
    process_with(MEMORY, normal, samples)
}

/// The same with another memory a: τ = (1 + a)/(1 − a).
fn process_with(memory: f64, normal: &mut Normal, samples: usize) -> Vec<f64> {
    let push = (1.0 - memory * memory).sqrt();
    let mut value = normal.next();
    let mut next = || {
        value = memory * value + push * normal.next();
        value
    };
    (0..samples).map(|_| next()).collect()
}

/// Variance of the mean of so many samples: (τ − 2 a (1 − aⁿ)/(n (1 − a)²))/n.
fn variance_of_mean(memory: f64, samples: usize) -> f64 {
    let number = samples as f64;
    let time = (1.0 + memory) / (1.0 - memory);
    let ends = 2.0 * memory * (1.0 - memory.powf(number)) / (1.0 - memory).powi(2);
    (time - ends / number) / number
}

/// Mean over repetitions of what each finds.
fn mean_over(repetitions: u64, mut find: impl FnMut(&mut Normal) -> f64) -> f64 {
    let seeds = (1..=repetitions).map(|seed| seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    seeds.map(|seed| find(&mut Normal(seed))).sum::<f64>() / repetitions as f64
}

fn assert_within(found: f64, [low, high]: [f64; 2], what: &str) {
    println!("{what}: {found}");
    assert!((low..=high).contains(&found), "{what}: {found}");
}

/// Variances and squares of errors have no bias, of short series too.
#[test]
fn averages_know_variance_and_error() {
    // Alternating: independent by the rule, so that the variance is that of n − 1.
    for count in [2_u32, 7, 8, 12, 101] {
        let series: Vec<f64> = (0..count).map(|i| f64::from(i % 2)).collect();
        let number = f64::from(count);
        let mean = series.iter().sum::<f64>() / number;
        let squares: f64 = series.iter().map(|x| (x - mean).powi(2)).sum();
        let average = Average::of(&[series]);
        assert_eq!(average.is_ok(), count >= 8, "{count}");
        let Ok(average) = average else { continue };
        let exact = squares / (number - 1.0);
        assert!(
            (average.deviation.powi(2) / exact - 1.0).abs() < 1e-12,
            "{average:?}"
        );
        assert!((average.error.powi(2) * number / exact - 1.0).abs() < 1e-12);
    }
    for (memory, samples, starts) in [(0.5, 150, 1), (0.8, 640, 1), (0.8, 400, 3), (0.0, 400, 1)] {
        let mut errors = 0.0;
        let variance = mean_over(3000, |normal| {
            let series = (0..starts).map(|_| process_with(memory, normal, samples));
            let average = Average::of(&series.collect::<Vec<_>>()).unwrap();
            errors += average.error.powi(2) / 3000.0;
            average.deviation.powi(2)
        });
        let exact = variance_of_mean(memory, samples) / f64::from(starts);
        assert_within(variance, [0.99, 1.01], "variance");
        assert_within(errors / exact, [0.9, 1.12], "square of the error");
    }
}

/// The plateau is where the rule has it, and its error that of the mean but for what the rule
/// leaves: some hundredths.
#[test]
fn blocks_know_the_error() {
    for (samples, ratio, length) in [
        (1000, 3.0, 64),
        (4000, 1.5, 64),
        (4000, 6.0, 256),
        (100_000, 1.0, 64),
    ] {
        let level = |power: u32| BlockLevel {
            length: 1 << power,
            blocks: samples >> power,
            error: if power == 0 { 1.0 } else { ratio },
            uncertainty: 0.0,
        };
        let blocking = Blocking {
            mean: 0.0,
            samples,
            levels: (0..10).map(level).collect(),
        };
        // The shortest with b³ > 2 n r⁴.
        assert_eq!(
            blocking.error().unwrap().length,
            length,
            "{samples} {ratio}"
        );
    }
    let few = Blocking::of(&[[1.0, 2.0, 4.0, 3.0, 5.0]]).unwrap();
    let [alone, pairs] = [few.levels[0], few.levels[1]];
    assert!((alone.error - 0.5_f64.sqrt()).abs() < 1e-15 && few.mean == 3.0);
    assert!((alone.uncertainty - 0.25).abs() < 1e-15 && alone.blocks == 5);
    // (1 + 2)/2 and (4 + 3)/2.
    assert!((pairs.error - 1.0).abs() < 1e-15 && (pairs.length, pairs.blocks) == (2, 2));
    for (memory, samples, starts) in [(0.9, 4000, 1), (0.8, 2000, 1), (0.9, 800, 5)] {
        let found = mean_over(1000, |normal| {
            let series = (0..starts).map(|_| process_with(memory, normal, samples));
            let blocking = Blocking::of(&series.collect::<Vec<_>>()).unwrap();
            blocking.error().unwrap().error.powi(2)
        });
        let exact = variance_of_mean(memory, samples) / f64::from(starts);
        assert_within(found / exact, [0.91, 1.03], "square of the error by blocks");
    }
    // Of independent samples every level has the error, and spreads by its uncertainty.
    for power in [0, 2] {
        let (mut squares, mut spread, mut reported) = (0.0, 0.0, 0.0);
        let error = mean_over(2000, |normal| {
            let level = Blocking::of(&[process_with(0.0, normal, 256)])
                .unwrap()
                .levels[power];
            squares += level.error.powi(2) / 2000.0;
            spread += (level.error - 1.0 / 16.0).powi(2) / 2000.0;
            reported += level.uncertainty / 2000.0;
            level.error
        });
        assert_within(
            256.0 * squares,
            [0.98, 1.02],
            "square of the error of a level",
        );
        let spread = (spread - (error - 1.0 / 16.0).powi(2)).sqrt();
        assert_within(reported / spread, [0.93, 1.07], "uncertainty of an error");
    }
}

#[test]
fn drifts_and_left_out_members_know_their_errors() {
    let mut errors = 0.0;
    let squares = mean_over(2000, |normal| {
        let drift = Drift::of(&[process_with(0.8, normal, 800)]).unwrap();
        errors += drift.error.powi(2) / 2000.0;
        drift.change.powi(2)
    });
    // The halves are correlated at their ends alone.
    let exact = 2.0 * variance_of_mean(0.8, 400);
    assert_within(squares / exact, [0.9, 1.1], "square of a drift");
    assert_within(errors / exact, [0.9, 1.1], "square of the error of a drift");
    // Mean square of normal numbers: variance 2/k.
    for members in [8, 40] {
        let found = mean_over(2000, |normal| {
            let values = process_with(0.0, normal, members);
            let estimate = jackknife(members, |left_out| {
                let kept = (0..members).filter(|member| Some(*member) != left_out);
                let squares: Vec<f64> = kept.map(|member| values[member].powi(2)).collect();
                squares.iter().sum::<f64>() / squares.len() as f64
            });
            estimate.unwrap().error.powi(2)
        });
        // Numbers by sums of twelve have a fourth moment of 2.9.
        assert_within(found * members as f64 / 1.9, [0.93, 1.07], "jackknife");
    }
}

/// Share of 200 repetitions whose interval of one standard error holds the true mean.
fn coverage(interval: impl Fn(&mut Normal) -> (f64, f64)) -> f64 {
    let covered = (1..=200).filter(|seed| {
        let (mean, error) = interval(&mut Normal(seed * 0x9e37_79b9));
        mean.abs() < error
    });
    covered.count() as f64 / 200.0
}

#[test]
fn the_correlation_time_is_that_of_the_process() {
    let average = Average::of(&[process(&mut Normal(9), 400_000)]).unwrap();
    // Less the tail below 0.05.
    assert!(
        (17.0..20.0).contains(&average.correlation_time),
        "{average:?}"
    );
    assert!((average.deviation - 1.0).abs() < 0.03);
}

#[test]
fn bars_cover_the_truth_as_often_as_they_say() {
    let one = coverage(|normal| {
        let average = Average::of(&[process(normal, 4000)]).unwrap();
        (average.mean, average.error)
    });
    let ensemble = coverage(|normal| {
        let starts: Vec<_> = (0..16).map(|_| process(normal, 250)).collect();
        let average = Average::of(&starts).unwrap();
        (average.mean, average.error)
    });
    let blocks = coverage(|normal| {
        let blocking = Blocking::of(&[process(normal, 4000)]).unwrap();
        (blocking.mean, blocking.error().unwrap().error)
    });
    for share in [one, ensemble, blocks] {
        assert!((0.6..=0.76).contains(&share), "{one} {ensemble} {blocks}");
    }
    println!("covered: {one} by τ, {ensemble} by τ of 16 starts, {blocks} by blocks");
}

/// Starts that stay apart are few samples, however long they are.
#[test]
fn starts_that_do_not_mix_have_no_average() {
    let mut normal = Normal(7);
    let apart: Vec<Vec<f64>> = (0..10)
        .map(|start| {
            let own = process(&mut normal, 1000);
            own.iter()
                .map(|value| value + 3.0 * f64::from(start))
                .collect()
        })
        .collect();
    let refused = Average::of(&apart);
    assert!(
        matches!(refused, Err(StatisticsError::Correlated { .. })),
        "{refused:?}"
    );
    assert!(Average::of(&[&apart[0]]).is_ok());
}

#[test]
fn a_drift_is_seen_and_noise_is_none() {
    let mut normal = Normal(3);
    let mut steady = 0;
    for _ in 0..100 {
        let noise: Vec<_> = (0..8).map(|_| process(&mut normal, 1000)).collect();
        steady += usize::from(Drift::of(&noise).unwrap().is_within(2.0));
    }
    assert!((88..=100).contains(&steady), "{steady} of 100");
    let heated: Vec<Vec<f64>> = (0..8)
        .map(|_| {
            let own = process(&mut normal, 1000);
            let along = own.iter().enumerate();
            along.map(|(i, value)| value + 1e-3 * i as f64).collect()
        })
        .collect();
    assert!(!Drift::of(&heated).unwrap().is_within(2.0));
    // One that does nothing but drift has no average at all.
    let ramp: Vec<f64> = (0..1000).map(f64::from).collect();
    assert!(Drift::of(&[ramp]).is_err());
}

#[test]
fn transients_are_found_or_refused() {
    let mut normal = Normal(5);
    for scale in [20.0, 60.0] {
        let series: Vec<f64> = process(&mut normal, 4000)
            .into_iter()
            .enumerate()
            .map(|(i, value)| value + 30.0 * (-(i as f64) / scale).exp())
            .collect();
        let start = transient(&series).unwrap() as f64;
        assert!(
            (3.0 * scale..12.0 * scale).contains(&start),
            "{start} of {scale}"
        );
        let cut = &series[..(3.0 * scale) as usize];
        assert_eq!(transient(cut), Err(StatisticsError::Unsettled));
    }
    assert!(transient(&process(&mut normal, 4000)).unwrap() < 1000);
}

#[test]
fn what_has_no_answer_is_refused() {
    let few = StatisticsError::TooFew {
        found: 1,
        needed: 2,
    };
    assert_eq!(Average::of(&[[1.0]]), Err(few));
    let nan = StatisticsError::NotFinite {
        series: 1,
        index: 0,
    };
    assert_eq!(Average::of(&[vec![1.0, 2.0], vec![f64::NAN]]), Err(nan));
    let still = Average::of(&[[0.3; 100]]).unwrap();
    assert_eq!((still.error, still.correlation_time), (0.0, 1.0));
    assert!(jackknife(3, |_| 1.0).is_err() && jackknife(9, |_| f64::NAN).is_err());
}
