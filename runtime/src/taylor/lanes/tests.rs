use crate::scalar::{Lanes, Scalar};
use crate::taylor::expand::{Known, Start, Tree, expand, workspace};
use crate::taylor::levers::Coupling;
use crate::taylor::quad::Quad;

/// A tree of six links that lean on each other, and a torque that depends on
/// all there is.
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
    let couplings = [
        [0, 1],
        [0, 2],
        [1, 3],
        [0, 3],
        [2, 4],
        [0, 4],
        [2, 5],
        [0, 5],
    ];
    let couplings = couplings.map(|links| Coupling {
        links,
        cosine: number(0.03 * (links[0] + links[1]) as f64),
        sine: (links[1] % 2 == 0).then(|| number(0.02 * links[1] as f64)),
    });
    let tree = Tree {
        inertias: core::array::from_fn(|i| number(1.0 - 0.1 * i as f64)),
        couplings: &couplings,
        weights: core::array::from_fn(|i| number(5.0 - 0.5 * i as f64)),
        lateral_weights: core::array::from_fn(|i| number(0.1 * i as f64)),
    };
    let mut rows = vec![[[number(f64::NAN); 6]; 2]; orders];
    let mut work = vec![Quad([number(f64::NAN); 4]); workspace(6, orders)];
    let bias = |known: &Known<T, 6>| torque(known.sines, known.cosines, known.omega, known.theta);
    expand::<T, 6, 2, _>(&start, &tree, &mut rows, &mut work, Some(bias));
    rows
}

/// In every lane the coefficients are those of one state but for rounding.
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
