//! Times up to which motions are determined by their starts: found between output times too.

use core::f64::consts::PI;

use branched_pendulum::integrate::Horizon;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{OdeFn, RatesOnly};

/// Two equal rods in a chain, of unit lengths and masses in their ends, with gravity 1.
fn chain(_: f64, y: &[f64], rates: &mut [f64]) {
    let (sin, cos) = (y[0] - y[1]).sin_cos();
    let upper = -sin * y[3] * y[3] - 2.0 * y[0].sin();
    let lower = sin * y[2] * y[2] - y[1].sin();
    let determinant = 2.0 - cos * cos;
    rates[0] = y[2];
    rates[1] = y[3];
    rates[2] = (upper - cos * lower) / determinant;
    rates[3] = (2.0 * lower - cos * upper) / determinant;
}

/// The equations of Lorenz.
fn lorenz(_: f64, y: &[f64], rates: &mut [f64]) {
    rates[0] = 10.0 * (y[1] - y[0]);
    rates[1] = y[0] * (28.0 - y[2]) - y[1];
    rates[2] = y[0] * y[1] - 8.0 / 3.0 * y[2];
}

/// A rod with gravity 1.
fn rod(_: f64, y: &[f64], rates: &mut [f64]) {
    (rates[0], rates[1]) = (y[1], -y[0].sin());
}

type Rates = fn(f64, &[f64], &mut [f64]);

/// Returns the horizons for two precisions, and the length of the longest step.
fn exceeded(method: Method, (rates, start): (Rates, &[f64]), times: &[f64]) -> ([f64; 2], f64) {
    let ode = &RatesOnly(OdeFn::new(start.len(), rates));
    let methods = [1e-9, method.finer(1e-9)].map(|own| method.with(own));
    let start = State::new(0.0, start.to_vec());
    let components = start.values.len() / 2;
    let precisions = [1e-4, 1e-1];
    let [coarse, finer] = &methods;
    let found = Horizon::find([coarse, finer], ode, &start, times, components, &precisions);
    let exceeded = found.unwrap().exceeded.into_iter();
    let exceeded: Vec<f64> = exceeded.map(|time| time.unwrap().abs()).collect();
    let end = times[times.len() - 1];
    let report = coarse.run(ode, &start, end).unwrap().report;
    (exceeded.try_into().unwrap(), report.longest_step)
}

/// The end alone, few times and many give the same horizon, as closely as the steps are: chaos is
/// noticed where it begins and not only where a state is asked for.
#[test]
fn few_output_times_do_not_hide_the_horizon() {
    let motions: [((Rates, &[f64]), f64); 5] = [
        ((rod, &[PI, 0.0]), 100.0),
        ((rod, &[PI, 0.0]), -100.0),
        ((chain, &[2.1, -2.0, 0.0, 0.0]), 200.0),
        ((chain, &[2.1, -2.0, 0.0, 0.0]), -200.0),
        ((lorenz, &[1.0, 1.0, 20.0]), 60.0),
    ];
    for (motion, end) in motions {
        for method in [Method::Dop853, Method::Verner98, Method::Dopri5] {
            let (alone, longest) = exceeded(method, motion, &[end]);
            let times: Vec<f64> = (0..=20_000).map(|k| f64::from(k) * end / 2e4).collect();
            let (many, _) = exceeded(method, motion, &times);
            let (few, _) = exceeded(method, motion, &[0.0, 0.4 * end, end]);
            for ((alone, many), few) in alone.into_iter().zip(many).zip(few) {
                assert!((1.0..0.9 * end.abs()).contains(&many), "{method}: {many}");
                assert!(
                    many <= few && few <= alone && alone <= many + 1.01 * longest,
                    "{method}: {many} {few} {alone}, steps up to {longest}"
                );
            }
        }
    }
}

/// Regular motions have no horizon, and their differences at the end are known.
#[test]
fn regular_motions_have_no_horizon() {
    for (start, end) in [([0.1, 0.0], 60.0), ([1.0, 0.5], 40.0), ([2.0, 0.0], -30.0)] {
        let methods = [1e-10, 1e-12].map(|own| Method::Dop853.with(own));
        let start = State::new(0.0, start.to_vec());
        let ode = &RatesOnly(OdeFn::new(2, rod as Rates));
        let found = Horizon::find(methods.each_ref(), ode, &start, &[end], 1, &[1e-6]).unwrap();
        assert_eq!(found.exceeded, [None]);
        let [difference] = found.at_end.unwrap().try_into().unwrap();
        assert!((0.0..1e-7).contains(&difference), "{difference}");
    }
}
