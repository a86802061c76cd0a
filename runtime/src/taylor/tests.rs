use crate::scalar::{Lanes, Scalar};
use crate::simd::Quad;
use crate::taylor::{Connectivity, KnownOrder, LinkConstants, Start, expand, workspace};

struct Six;

impl Connectivity<6> for Six {
    const PARENTS: [usize; 6] = [0, 0, 0, 1, 2, 2];
    const LATERAL: bool = true;
}

/// Returns the Taylor coefficients of a tree of six links with lateral offsets, and with a torque
/// that depends on every quantity it can depend on.
fn coefficients<T: Scalar>(orders: usize, state: impl Fn(usize) -> T) -> Vec<[[T; 6]; 2]> {
    let number = T::from_f64;
    let (theta, omega) = (
        core::array::from_fn(&state),
        core::array::from_fn(|i| state(6 + i)),
    );
    let (sines, cosines) = T::sin_cos_each(&theta);
    let torque = |sines: [T; 6], cosines: [T; 6], omega: [T; 6], theta: [T; 6]| {
        core::array::from_fn(|i| {
            number(0.1) * omega[i] + number(0.2) * theta[i] + number(0.3) * cosines[i]
                - number(0.4) * sines[5 - i]
        })
    };
    let start = Start {
        theta: &theta,
        omega: &omega,
        sines,
        cosines,
        bias: torque(sines, cosines, omega, theta),
    };
    let constants = LinkConstants {
        inertias: core::array::from_fn(|i| number(1.0 - 0.1 * i as f64)),
        moments: core::array::from_fn(|i| [0.2, -0.03 * i as f64].map(number)),
        attachments: core::array::from_fn(|i| [0.5, 0.05 * i as f64].map(number)),
        weights: core::array::from_fn(|i| number(5.0 - 0.5 * i as f64)),
        lateral_weights: core::array::from_fn(|i| number(0.1 * i as f64)),
    };
    let mut rows = vec![[[number(f64::NAN); 6]; 2]; orders];
    let mut work = vec![Quad([number(f64::NAN); 4]); workspace(6, orders)];
    let bias =
        |known: &KnownOrder<T, 6>| torque(known.sines, known.cosines, known.omega, known.theta);
    expand::<T, Six, 6, 2, _>(&start, &constants, &mut rows, &mut work, Some(bias));
    rows
}

/// Checks that the coefficients in every lane are those of a single state, up to rounding.
#[test]
fn lanes_have_the_coefficients_of_one_state() {
    let angle = |i: usize, lane: usize| (0.7 * i as f64 + 1.9 * lane as f64).sin();
    for orders in (0..12).chain([23, 24, 31]) {
        let lanes = coefficients(orders, |i| Lanes([angle(i, 0), angle(i, 1)]));
        for lane in 0..2 {
            let one = coefficients(orders, |i| angle(i, lane));
            assert_eq!(one.len(), lanes.len());
            for (k, (one, lanes)) in one.iter().zip(&lanes).enumerate() {
                let both = one.as_flattened().iter().zip(lanes.as_flattened());
                let largest = one
                    .as_flattened()
                    .iter()
                    .fold(0.0, |a: f64, b| a.max(b.abs()));
                for (one, lanes) in both {
                    let difference = (one - lanes.0[lane]).abs();
                    assert!(difference <= 1e-12 * largest, "order {k} of {orders}");
                }
            }
        }
    }
}
