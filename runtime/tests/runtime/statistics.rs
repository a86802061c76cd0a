//! Error bars, on a process whose errors are known.

use branched_pendulum::analysis::statistics::{
    Average, Blocking, Drift, StatisticsError, jackknife, transient,
};

use crate::normal::Normal;

/// Loss of memory of the process from one sample to the next.
const MEMORY: f64 = 0.9;

/// An autoregressive process of variance 1 about zero, in its steady state: τ = 19.
fn process(normal: &mut Normal, samples: usize) -> Vec<f64> {
    let push = (1.0 - MEMORY * MEMORY).sqrt();
    let mut value = normal.next();
    let mut next = || {
        value = MEMORY * value + push * normal.next();
        value
    };
    (0..samples).map(|_| next()).collect()
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
