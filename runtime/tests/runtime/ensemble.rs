//! Ensembles: order, isolation of failures, independence of threads.

use core::num::NonZeroUsize;
use std::collections::{BTreeSet, HashSet};
use std::sync::Mutex;

use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, Problem, watch};

fn threads(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).unwrap()
}

#[test]
fn results_stand_in_the_order_of_the_items() {
    let items: Vec<u64> = (0..1000).collect();
    for count in [1, 2, 7, 2000] {
        let squares = Ensemble::new()
            .threads(threads(count))
            .map(&items, |index, &item| {
                assert_eq!(index as u64, item);
                // The first ones take longest.
                let work = if item < 3 { 100_000 } else { 1 };
                (0..work).fold(item, |sum, i| std::hint::black_box(sum ^ i ^ i)) * item
            });
        assert!(
            squares
                .into_iter()
                .zip(&items)
                .all(|(square, item)| square == item * item)
        );
    }
    assert!(Ensemble::new().map(&[] as &[u8], |_, _| ()).is_empty());
}

#[test]
fn trajectories_do_not_depend_on_threads_and_failures_stay_alone() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let starts: Vec<State<f64>> = (0..60)
        .map(|i| {
            let angle = if i % 20 == 7 {
                f64::INFINITY
            } else {
                0.7 + 0.005 * f64::from(i)
            };
            State::at_rest(0.0, &[angle, 1e-3, -1e-3])
        })
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let one = Ensemble::new()
        .threads(threads(1))
        .integrate(&method, &ode, &starts, 5.0);
    let many = Ensemble::new()
        .threads(threads(5))
        .integrate(&method, &ode, &starts, 5.0);
    for (index, (a, b)) in one.iter().zip(&many).enumerate() {
        assert_eq!(a.is_err(), index % 20 == 7);
        if let (Ok(a), Ok(b)) = (a, b) {
            assert_eq!(a, b);
            assert_eq!(
                a,
                &method.integrate(&ode, &starts[index], 5.0, watch).unwrap()
            );
        }
    }
}

#[test]
fn no_more_threads_than_the_machine_has() {
    let offered = std::thread::available_parallelism().unwrap().get();
    for count in [1, offered, 64 * offered, 1 << 20, usize::MAX] {
        let used = Ensemble::new()
            .threads(threads(count))
            .map(&[0; 20_000], |_, _| std::thread::current().id());
        let used: HashSet<_> = used.into_iter().collect();
        assert!(used.len() <= count.min(offered), "{count}: {}", used.len());
    }
}

#[test]
fn progress_counts_every_item_once() {
    let seen = Mutex::new(BTreeSet::new());
    let progress = |done: usize| assert!(seen.lock().unwrap().insert(done));
    Ensemble::new()
        .threads(threads(3))
        .progress(&progress)
        .map(&[0; 50], |_, _| ());
    assert_eq!(*seen.lock().unwrap(), (1..=50).collect());
}

#[test]
fn parameters_vary_as_well_as_starts() {
    let rates = [1.0, 2.0, f64::NAN, 4.0];
    let ends = Ensemble::new().map(&rates, |_, &rate| {
        let decay = Problem::new(1, move |_time: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = -rate * y[0]
        });
        Dop853::new(Options::with_tolerance(1e-12))
            .integrate(&decay, &State::new(0.0, vec![1.0]), 1.0, watch)
            .map(|solution| solution.state.values[0])
    });
    for (end, rate) in ends.iter().zip(rates) {
        match end {
            Ok(value) => assert!((value - (-rate).exp()).abs() < 1e-12),
            Err(error) => assert!(rate.is_nan(), "{error}"),
        }
    }
    assert!(ends[2].is_err());
}
