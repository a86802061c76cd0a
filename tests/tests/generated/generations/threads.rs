//! Trees in loops in parts, on any number of threads.

use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_compiler_tests::random::Random;

/// 32,767 links, taken apart.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 15, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.9, friction = 1e-7),
)]
struct Many;

/// 265,720 links in generations that no vector divides.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 12, branching = 3, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.4, length_ratio = 0.9),
)]
struct Odd;

fn threads_agree<P: Pendulum<f64>>(model: &mut P, set: impl Fn(&mut P, NonZeroUsize)) {
    let mut random = Random::new(3);
    let mut numbers = |size: f64| -> Vec<f64> {
        (0..model.links())
            .map(|_| random.array::<1>(-size, size)[0])
            .collect()
    };
    let (theta, omega) = (numbers(3.0), numbers(2.0));
    let mut results = [1, 2, 3].map(|threads| {
        set(model, NonZeroUsize::new(threads).unwrap());
        let mut alpha = vec![f64::NAN; model.links()];
        model.accelerations_into(0.0, &theta, &omega, &mut alpha);
        alpha.into_iter().map(f64::to_bits).collect::<Vec<u64>>()
    });
    assert!(
        results[0]
            .iter()
            .all(|&bits| f64::from_bits(bits).is_finite())
    );
    let [one, others @ ..] = &mut results;
    assert!(others.iter().all(|other| other == one));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    threads_agree(&mut Many::<f64>::new(), Many::set_threads);
    threads_agree(&mut Odd::<f64>::new(), Odd::set_threads);
}

/// Parts of 256 links leave one over; and one number at a time is another way
/// through registers.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 257, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.01, length_ratio = 0.7, friction = 1e-5),
)]
struct Broad;

#[test]
fn links_left_over_are_computed_like_the_others() {
    threads_agree(&mut Broad::<f64>::new(), Broad::set_threads);
    let n = Broad::LINKS;
    let mut random = Random::new(13);
    let (theta, omega) = (random.around_zero(n, 3.0), random.around_zero(n, 2.0));
    let mut alpha = vec![0.0; n];
    Broad::<f64>::new().accelerations_into(0.0, &theta, &omega, &mut alpha);
    let wide = |numbers: &[f64]| -> Vec<Double> {
        let numbers = numbers.iter();
        numbers.map(|&number| Double::from_f64(number)).collect()
    };
    let mut doubles = wide(&alpha);
    Broad::<Double>::default().accelerations_into(
        Double::from_f64(0.0),
        &wide(&theta),
        &wide(&omega),
        &mut doubles,
    );
    let largest = alpha.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    for (alpha, double) in alpha.iter().zip(&doubles) {
        assert!((alpha - double.to_f64()).abs() < 1e-10 * largest);
    }
}
