//! Variational equations against differences of motions, and the exponents of
//! motions that are known.

use core::ops::{Add, Div, Mul, Neg, Sub};

use branched_pendulum::analysis::variational::{
    ByTangents, Linearised, Lyapunov, LyapunovError, Tangent, WithDerivative, flow_jacobian,
    trusted_until,
};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{OdeFn, Workspace};

use crate::problems::{BranchedDouble, harmonic, watch};

/// A number and one derivative, written for this test alone.
#[derive(Clone, Copy, Debug)]
struct First(f64, f64);

impl Add for First {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl Sub for First {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl Mul for First {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.0 + self.0 * other.1)
    }
}

impl Div for First {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let ratio = self.0 / other.0;
        Self(ratio, (self.1 - ratio * other.1) / other.0)
    }
}

impl Neg for First {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Scalar for First {
    fn from_f64(value: f64) -> Self {
        Self(value, 0.0)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (Self(sine, cosine * self.1), Self(cosine, -sine * self.1))
    }
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        Self(root, 0.5 * self.1 / root)
    }
}

impl Tangent<f64> for First {
    fn with_tangent(value: f64, tangent: f64) -> Self {
        Self(value, tangent)
    }
    fn value_and_tangent(self) -> (f64, f64) {
        (self.0, self.1)
    }
}

fn near_threshold() -> State<f64> {
    State::at_rest(0.0, &[47.8_f64.to_radians(), 1e-3, -1e-3])
}

fn regular() -> State<f64> {
    State::at_rest(0.0, &[0.3, 1e-3, -1e-3])
}

fn method() -> Dop853<f64> {
    Dop853::new(Options::with_tolerance(1e-11))
}

#[test]
fn the_derivative_of_the_flow_is_that_of_differences() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, First>::new(&ode);
    let (end, columns) = flow_jacobian(&method(), &system, &near_threshold(), 2.0).unwrap();
    let plain = method()
        .integrate(&ode, &near_threshold(), 2.0, watch)
        .unwrap();
    for (a, b) in end.values.iter().zip(&plain.state.values) {
        assert!((a - b).abs() < 1e-9);
    }
    let tight = Dop853::new(Options::with_tolerance(1e-13));
    for (j, column) in columns.chunks(6).enumerate() {
        let moved = |by: f64| {
            let mut start = near_threshold();
            start.values[j] += by;
            tight
                .integrate(&ode, &start, 2.0, watch)
                .unwrap()
                .state
                .values
        };
        let (plus, minus) = (moved(1e-4), moved(-1e-4));
        let size = column.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
        for (i, derivative) in column.iter().enumerate() {
            let difference = (plus[i] - minus[i]) / 2e-4;
            assert!((derivative - difference).abs() < 1e-4 * size, "{i} {j}");
        }
    }
}

#[test]
fn a_flow_in_canonical_variables_is_symplectic() {
    // The mathematical pendulum, its derivative by hand.
    let system = WithDerivative::new(
        OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = y[1];
            rates[1] = -y[0].sin();
        }),
        |_time: f64, y: &[f64], v: &[f64], out: &mut [f64]| {
            out[0] = v[1];
            out[1] = -y[0].cos() * v[0];
        },
    );
    let start = State::at_rest(0.0, &[2.5]);
    let (_, columns) = flow_jacobian(&method(), &system, &start, 20.0).unwrap();
    let [a, b, c, d] = columns[..] else {
        panic!("{columns:?}");
    };
    assert!((a * d - b * c - 1.0).abs() < 1e-8, "{columns:?}");
    // Gauss methods keep that of their own flow.
    let gauss = Gauss::new(GaussOrder::Four, 0.2);
    let (_, columns) = flow_jacobian(&gauss, &system, &start, 20.0).unwrap();
    let determinant = columns[0] * columns[3] - columns[1] * columns[2];
    assert!((determinant - 1.0).abs() < 1e-12, "{determinant}");
}

#[test]
fn growth_is_that_of_the_reference() {
    // The note in trajectories.json: about 100 times by t = 10 in the regular
    // case, 3e7 times near the threshold.
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, First>::new(&ode);
    let growth = |start: &State<f64>| {
        let (_, columns) = flow_jacobian(&method(), &system, start, 10.0).unwrap();
        columns
            .iter()
            .fold(0.0_f64, |largest, v| largest.max(v.abs()))
    };
    let (calm, wild) = (growth(&regular()), growth(&near_threshold()));
    assert!((30.0..300.0).contains(&calm), "{calm}");
    assert!((1e7..1e8).contains(&wild), "{wild}");
}

#[test]
fn exponents_of_motions_that_are_known() {
    // y' = diag(1, −2) y: the exponents are 1 and −2.
    let saddle = WithDerivative::new(
        OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = y[0];
            rates[1] = -2.0 * y[1];
        }),
        |_time: f64, _y: &[f64], v: &[f64], out: &mut [f64]| {
            out[0] = v[0];
            out[1] = -2.0 * v[1];
        },
    );
    let request = Lyapunov {
        count: 2,
        interval: 0.5,
        settling: 10,
        intervals: 40,
    };
    let start = State::new(0.0, vec![0.0, 1.0]);
    let spectrum = request.spectrum(&method(), &saddle, &start).unwrap();
    assert!((spectrum.exponents[0] - 1.0).abs() < 1e-9, "{spectrum:?}");
    assert!((spectrum.exponents[1] + 2.0).abs() < 1e-9, "{spectrum:?}");
    assert_eq!(spectrum.end.time, 25.0);
    let horizon = spectrum.horizon(1e-16, 1.0).unwrap();
    assert!((horizon - 16.0 * 10.0_f64.ln()).abs() < 1e-6);
}

#[test]
fn the_exponents_of_the_pendulum() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, First>::new(&ode);
    let request = |count, intervals| Lyapunov {
        count,
        interval: 0.5,
        settling: 40,
        intervals,
    };
    let wild = request(6, 2000)
        .spectrum(&method(), &system, &near_threshold())
        .unwrap();
    let sum: f64 = wild.exponents.iter().sum();
    // A conservative flow keeps volumes, and exponents come in pairs ±λ.
    assert!(wild.exponents[0] > 0.5, "{wild:?}");
    assert!(sum.abs() < 1e-3, "{sum} {wild:?}");
    for (a, b) in wild.exponents.iter().zip(wild.exponents.iter().rev()) {
        assert!((a + b).abs() < 0.02, "{wild:?}");
    }
    let calm = request(1, 2000)
        .spectrum(&method(), &system, &regular())
        .unwrap();
    assert!(calm.exponents[0] < 0.02, "{calm:?}");
}

#[test]
fn two_methods_agree_up_to_the_horizon_and_not_beyond() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let system = ByTangents::<_, First>::new(&ode);
    // Errors per step of some 1e-13, and what of them is too much.
    let horizon = trusted_until(&method(), &system, &near_threshold(), 40.0, 1e-13, 1e-3)
        .unwrap()
        .unwrap();
    assert!((10.0..25.0).contains(&horizon), "{horizon}");
    let end = |time: f64| {
        let options = || Options::with_tolerance(1e-13);
        let a = Dop853::new(options()).integrate(&ode, &near_threshold(), time, watch);
        let b = Verner98::new(options()).integrate(&ode, &near_threshold(), time, watch);
        let (a, b) = (a.unwrap().state, b.unwrap().state);
        let both = a.values.iter().zip(&b.values);
        both.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
    };
    assert!(end(horizon) < 1e-2, "{horizon} {}", end(horizon));
    assert!(end(horizon + 30.0) > 0.1, "{}", end(horizon + 30.0));
    // Regular motion is trusted throughout.
    let trusted = trusted_until(&method(), &system, &regular(), 40.0, 1e-13, 1e-3);
    assert_eq!(trusted.unwrap(), None);
}

#[test]
fn refusals() {
    let system = WithDerivative::new(
        harmonic(),
        |_: f64, _: &[f64], v: &[f64], out: &mut [f64]| {
            out[0] = v[1];
            out[1] = -v[0];
        },
    );
    let start = State::at_rest(0.0, &[1.0]);
    let request = Lyapunov {
        count: 1,
        interval: 1.0,
        settling: 0,
        intervals: 5,
    };
    let refused = |request: Lyapunov, start: &State<f64>| {
        request.spectrum(&method(), &system, start).unwrap_err()
    };
    for count in [0, 3] {
        let error = refused(Lyapunov { count, ..request }, &start);
        assert_eq!(
            error,
            LyapunovError::Count {
                count,
                deviations: 2
            }
        );
    }
    for interval in [0.0, -1.0, f64::NAN] {
        let error = refused(
            Lyapunov {
                interval,
                ..request
            },
            &start,
        );
        assert!(matches!(error, LyapunovError::Interval { .. }));
    }
    let error = refused(request, &State::new(0.0, vec![1.0]));
    assert_eq!(
        error.to_string(),
        "the state has 1 components, the equations have 2"
    );
    let mut rates = ([0.0; 2], [0.0; 2]);
    system.linearised_rates(
        &mut Workspace::new(),
        0.0,
        &[1.0, 2.0],
        &[3.0, 4.0],
        &mut rates.0,
        &mut rates.1,
    );
    assert_eq!(rates, ([2.0, -1.0], [4.0, -3.0]));
    assert!(
        request
            .spectrum(&method(), &system, &start)
            .unwrap()
            .exponents[0]
            .abs()
            < 0.2
    );
}
