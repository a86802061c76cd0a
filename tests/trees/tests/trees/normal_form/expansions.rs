//! Expansions of functions and of energies.

use branched_pendulum::analysis::normal_form::{
    MotionSubspace, NormalForm, NormalFormError, NormalFormOptions,
};
use branched_pendulum::scalar::{Exponents, Polynomial, Scalar, Truncation};
use branched_pendulum_trees::PendulumTree;

use super::{PAPER, of, release};

#[test]
fn polynomials_expand_functions() {
    let to = Truncation::by_degree(6);
    let expanded = Polynomial::expand(2, to, |variables| {
        let [x, y] = [variables[0], variables[1]];
        let one = Polynomial::from_f64(1.0);
        let (sine, cosine) = (Polynomial::from_f64(0.3) + x + y * y).sin_cos();
        let root = (one + x).sqrt();
        vec![
            sine * sine + cosine * cosine - one,
            root * root - one - x,
            (one / (one - x - y)) * (one - x - y) - one,
            sine,
        ]
    });
    for identity in &expanded[..3] {
        assert!(
            identity.iter().all(|(_, value)| value.abs() < 1e-14),
            "{identity:?}"
        );
    }
    // ∂³/∂x³ and ∂³/∂x∂y² of sin(0.3 + x + y²).
    let [x, y] = [0, 1].map(Exponents::of_variable);
    let third = expanded[3].coefficient(x.times(x).times(x));
    assert!((third + 0.3_f64.cos() / 6.0).abs() < 1e-15);
    let mixed = expanded[3].coefficient(x.times(y).times(y));
    assert!((mixed + 0.3_f64.sin()).abs() < 1e-15);
    // Only what belongs to the running expansion has a value.
    let mut kept = None;
    let _ = Polynomial::expand(1, to, |variables| {
        kept = variables.first().copied();
        Vec::new()
    });
    let late = Polynomial::expand(1, to, |variables| vec![kept.unwrap() * variables[0]]);
    assert!(late[0].coefficient(Exponents::default()).is_nan());
}

#[test]
fn impossible_requests_are_refused() {
    let tree = PendulumTree::parse(PAPER).unwrap();
    let odd = NormalFormOptions {
        degree: 7,
        ..NormalFormOptions::default()
    };
    let error = NormalForm::new(&tree, &[0.0; 3], &MotionSubspace::whole(3), odd).unwrap_err();
    assert_eq!(error, NormalFormError::Degree(7));
    let tall = NormalForm::new(
        &tree,
        &[std::f64::consts::PI, 0.0, 0.0],
        &MotionSubspace::whole(3),
        NormalFormOptions::default(),
    );
    assert!(matches!(tall, Err(NormalFormError::Modes(_))), "{tall:?}");
    // The children straight up: the series has long ceased to converge.
    let form = of(PAPER, 8);
    let refused = form.predict(&release(0.0, 150.0)).unwrap_err();
    assert!(
        refused.to_string().contains("does not converge"),
        "{refused}"
    );
}
