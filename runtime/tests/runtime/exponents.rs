//! Exponents of motions that stay in an invariant subspace, against those in closed form, and
//! runs backwards.

use branched_pendulum::analysis::growth::Growth;
use branched_pendulum::analysis::variational::{
    ByTangents, Copies, Linearised, Lyapunov, LyapunovError, LyapunovSpectrum, WithDerivative,
    flow_jacobian, trusted_until,
};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;

use crate::problems::{BranchedDouble, Problem, growth_and_decay};

fn method() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-11))
}

/// y' = A y.
fn linear<const N: usize>(rows: [[f64; N]; N]) -> impl Linearised<f64> {
    let product = move |y: &[f64], out: &mut [f64]| {
        for (out, row) in out.iter_mut().zip(rows) {
            *out = row.iter().zip(y).map(|(a, y)| a * y).sum();
        }
    };
    WithDerivative::new(
        Problem::new(N, move |_: f64, y: &[f64], rates: &mut [f64]| {
            product(y, rates)
        }),
        move |_: f64, _: &[f64], v: &[f64], out: &mut [f64]| product(v, out),
    )
}

fn request(count: usize) -> Lyapunov {
    Lyapunov {
        count,
        interval: 0.25,
        settling: 80,
        intervals: 40,
    }
}

fn near(found: &LyapunovSpectrum, expected: &[f64]) {
    assert_eq!(found.exponents.len(), expected.len());
    for (found, expected) in found.exponents.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
}

/// The first coordinates stay apart from where the growth is, or the largest exponent is that
/// of the last one.
#[test]
fn the_largest_exponent_is_found_wherever_it_is() {
    let last = linear([[-2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]]);
    let start = State::new(0.0, vec![1e-9; 3]);
    for count in 1..=3 {
        let found = request(count).spectrum(&method(), &last, &start).unwrap();
        near(&found, &[3.0, 1.0, -2.0][..count]);
    }
    // What the first block does the second one feels, and not the other way round.
    // It turns four times in the intervals that count.
    let turn = core::f64::consts::TAU / 2.5;
    let one_way = linear([
        [0.5, turn, 0.0, 0.0],
        [-turn, 0.5, 0.0, 0.0],
        [0.3, 0.2, 2.0, 1.0],
        [0.1, 0.7, 0.0, -1.0],
    ]);
    let start = State::new(0.0, vec![0.0, 0.0, 1e-9, 0.0]);
    for count in [1, 4] {
        let found = request(count)
            .spectrum(&method(), &one_way, &start)
            .unwrap();
        near(&found, &[2.0, 0.5, 0.5, -1.0][..count]);
    }
}

/// A rod upright on the axis of a wheel that feels nothing of it: √(3g/2l), at any length.
#[test]
fn an_upright_rod_on_a_wheel() {
    for length in [0.3, 1.0, 2.5] {
        let squared = 1.5 * 9.81 / length;
        let system = WithDerivative::new(
            Problem::new(4, move |_: f64, y: &[f64], rates: &mut [f64]| {
                rates.copy_from_slice(&[y[2], y[3], 0.0, -squared * y[1].sin()]);
            }),
            move |_: f64, y: &[f64], v: &[f64], out: &mut [f64]| {
                out.copy_from_slice(&[v[2], v[3], 0.0, -squared * y[1].cos() * v[1]]);
            },
        );
        let start = State::at_rest(0.0, &[0.0, core::f64::consts::PI]);
        let exact = f64::sqrt(squared);
        // Not so long that the rod falls by rounding.
        let request = |count| Lyapunov {
            interval: 0.2 / exact,
            ..request(count)
        };
        for count in [1, 2, 4] {
            let found = request(count).spectrum(&method(), &system, &start).unwrap();
            assert!((found.exponents[0] / exact - 1.0).abs() < 1e-5, "{found:?}");
        }
    }
}

/// x_i'' = −x_i + c Σ_j (x_i − x_j) for k copies: those in phase swing, differences grow by
/// √(k c − 1).
#[test]
fn copies_in_phase_have_exponents_of_two_kinds() {
    let (k, coupling) = (3, 0.75);
    let rates = move |y: &[f64], out: &mut [f64]| {
        let sum: f64 = y[..k].iter().sum();
        for i in 0..k {
            out[i] = y[k + i];
            out[k + i] = -y[i] + coupling * (k as f64 * y[i] - sum);
        }
    };
    let system = WithDerivative::new(
        Problem::new(2 * k, move |_: f64, y: &[f64], out: &mut [f64]| {
            rates(y, out)
        }),
        move |_: f64, _: &[f64], v: &[f64], out: &mut [f64]| rates(v, out),
    );
    let start = State::at_rest(0.0, &[0.4; 3]);
    let copies = Copies::of_links(&[None; 3], &[&[0, 1, 2]]).unwrap();
    assert_eq!(copies.differences(), 4);
    let exact = f64::sqrt(k as f64 * coupling - 1.0);
    let long = |count| Lyapunov {
        interval: core::f64::consts::TAU / 8.0,
        ..request(count)
    };
    let largest = long(1).spectrum(&method(), &system, &start).unwrap();
    near(&largest, &[exact]);
    let within = long(2).within(&copies, &method(), &system, &start).unwrap();
    near(&within, &[0.0, 0.0]);
    let transverse = long(4).transverse(&copies, &method(), &system, &start);
    near(&transverse.unwrap(), &[exact, exact, -exact, -exact]);

    let refused = |count, copies: &Copies, start: &State<f64>| {
        let found = long(count).within(copies, &method(), &system, start);
        found.unwrap_err()
    };
    let (count, deviations) = (3, 2);
    assert_eq!(
        refused(3, &copies, &start),
        LyapunovError::Count { count, deviations }
    );
    let apart = State::at_rest(0.0, &[0.4, 0.4, 0.41]);
    assert_eq!(refused(1, &copies, &apart), LyapunovError::NotInPhase);
    // Alike at the start, but moved by other springs.
    let other = Copies::of_links(&[None; 6], &[&[0, 5]]).unwrap();
    assert_eq!(refused(1, &other, &start), LyapunovError::NotInPhase);
}

/// The paper's pendulum in phase: what grows is the difference, at the rate that its own
/// equation tells.
#[test]
fn the_paper_s_pendulum_in_phase() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, Dual<f64, 1>>::new(&ode);
    let copies = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
    let lyapunov = |count| Lyapunov {
        count,
        interval: 0.5,
        settling: 40,
        intervals: 400,
    };
    for (degrees, grows) in [(44.0_f64, true), (30.0, false)] {
        let start = State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0]);
        let all = lyapunov(6).spectrum(&method(), &system, &start).unwrap();
        let one = lyapunov(1).spectrum(&method(), &system, &start).unwrap();
        // One motion, and beside it one deviation that is among all.
        assert_eq!(one.end, all.end);
        let distance = |exponent: &f64| (exponent - one.exponents[0]).abs();
        assert!(
            all.exponents.iter().any(|own| distance(own) < 1e-6),
            "{one:?} {all:?}"
        );
        assert!(
            distance(&all.exponents[0]) < all.standard_errors[0],
            "{one:?} {all:?}"
        );
        let [within, transverse] = [
            lyapunov(4).within(&copies, &method(), &system, &start),
            lyapunov(2).transverse(&copies, &method(), &system, &start),
        ]
        .map(Result::unwrap);
        let (own, other) = (transverse.exponents[0], within.exponents[0]);
        let bar = transverse.standard_errors[0];
        assert!(
            (all.exponents[0] - own.max(other)).abs() < 2.0 * bar,
            "{all:?} {transverse:?}"
        );
        assert_eq!(
            own > 10.0 * bar && own > 3.0 * other,
            grows,
            "{within:?} {transverse:?}"
        );
        // Pairs of opposite ones: no friction.
        assert!((transverse.exponents[1] + own).abs() < 1e-6);
        let growth = Growth {
            frequency_hz: 1.2581,
            horizons: vec![220.0],
            tolerance: 1e-10,
        };
        let opposite = copies.opposite(6);
        let grown = growth.along(&system, &start, &opposite, [1..2, 4..5]);
        let grown = grown.unwrap();
        assert!(
            (grown.rate.value - own).abs() < 2.0 * bar,
            "{grown:?} {transverse:?}"
        );
    }
}

/// y' = cos t y, of which the logarithm is the sine: ten parts of a run.
#[test]
fn standard_errors_are_by_the_spread_of_ten_parts() {
    let system = WithDerivative::new(
        growth_and_decay(),
        |time: f64, _: &[f64], v: &[f64], out: &mut [f64]| out[0] = v[0] * time.cos(),
    );
    for (interval, settling, intervals) in [(0.3, 7, 50), (0.11, 0, 200), (1.7, 3, 10)] {
        let lyapunov = Lyapunov {
            count: 1,
            interval,
            settling,
            intervals,
        };
        let start = State::new(0.0, vec![1.0]);
        let found = lyapunov.spectrum(&method(), &system, &start).unwrap();
        let part = interval * f64::from(intervals) / 10.0;
        let begin = interval * f64::from(settling);
        let means = (0..10).map(|number| {
            let from = begin + part * f64::from(number);
            ((from + part).sin() - from.sin()) / part
        });
        let means: Vec<f64> = means.collect();
        let mean = means.iter().sum::<f64>() / 10.0;
        let squares: f64 = means.iter().map(|own| (own - mean).powi(2)).sum();
        assert!((found.exponents[0] - mean).abs() < 1e-9, "{found:?} {mean}");
        assert!(
            (found.standard_errors[0] - (squares / 90.0).sqrt()).abs() < 1e-9,
            "{found:?}"
        );
        let few = Lyapunov {
            intervals: 9,
            ..lyapunov
        };
        let found = few.spectrum(&method(), &system, &start).unwrap();
        assert!(found.standard_errors[0].is_nan());
    }
}

/// Back the way it came: the derivative of a flow is the inverse of that of the flow back, and
/// errors grow backwards as they do forwards where friction makes no difference.
#[test]
fn flows_backwards() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, Dual<f64, 1>>::new(&ode);
    for angles in [[0.3, 1e-3, -1e-3], [0.9, 0.2, 0.5], [-2.0, 1.0, 0.1]] {
        let start = State::at_rest(1.0, &angles);
        let (end, there) = flow_jacobian(&method(), &system, &start, 2.5).unwrap();
        let (back, here) = flow_jacobian(&method(), &system, &end, 1.0).unwrap();
        for (found, exact) in back.values.iter().zip(&start.values) {
            assert!((found - exact).abs() < 1e-8);
        }
        for row in 0..6 {
            for column in 0..6 {
                let product: f64 = (0..6)
                    .map(|k| here[6 * k + row] * there[6 * column + k])
                    .sum();
                let unit = if row == column { 1.0 } else { 0.0 };
                assert!((product - unit).abs() < 1e-6, "{row} {column} {product}");
            }
        }
        // From rest, where time turned about is the motion itself.
        let until = |end| trusted_until(&method(), &system, &start, end, 1e-9, 1e-7).unwrap();
        let [after, before] = [until(60.0), until(-58.0)].map(|time| time.unwrap() - 1.0);
        assert!(
            after > 0.0 && (after + before).abs() < 1e-6 * after,
            "{after} {before}"
        );
    }
}
