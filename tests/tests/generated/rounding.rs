//! The rounding errors that docs state, against double-double numbers of the runtime.

use branched_pendulum::scalar::{Double, Real};
use branched_pendulum::{Model, Scalar};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::paper_expanded::Paper;

/// The error that the docs of a function state.
fn stated(function: &str) -> f64 {
    let code = include_str!("../../fixtures/expanded/paper.rs");
    let place = code
        .find(&format!("pub fn {function}("))
        .expect("the function");
    let docs = &code[..place];
    let words = docs[docs.rfind("Cost: ").expect("its cost")..].replace("\n    ///", "");
    let (_, error) = words
        .split_once("Rounding error: at most ")
        .expect("its error");
    let number = error.split(' ').next().expect("a number");
    number.parse().expect("a number")
}

/// A function of a state in any number.
trait Function {
    fn of<T: Scalar>(model: &Paper<T>, angles: &[T; 3], rates: &[T; 3]) -> Vec<T>;
}

/// The largest error in units in the last place of the largest result of a state, at
/// many states.
fn measured<F: Function>() -> f64 {
    let model = Paper::new();
    let precise = model.cast(Double::from_f64);
    let mut random = Random::new(7);
    let errors = (0..400).map(|_| {
        let angles: [f64; 3] = random.array(-3.0, 3.0);
        let rates: [f64; 3] = random.array(-8.0, 8.0);
        let [wide_angles, wide_rates] = [angles, rates].map(|state| state.map(Double::from_f64));
        let rounded = F::of(&model, &angles, &rates);
        let exact = F::of(&precise, &wide_angles, &wide_rates);
        let size = exact.iter().map(|value| value.to_f64().abs());
        let size = size.fold(0.0, f64::max);
        let distances = rounded.iter().zip(exact);
        let distances = distances.map(|(a, b)| (b - Double::from_f64(*a)).to_f64().abs());
        distances.fold(0.0, f64::max) / (size.next_up() - size)
    });
    errors.fold(0.0, f64::max)
}

/// Docs state the worst of sixteen states without the errors of sines; of many states, with
/// sines and cosines of angles, the worst is of the same order.
#[test]
fn docs_state_what_is_measured() {
    macro_rules! function {
        ($name:ident) => {{
            struct Own;
            impl Function for Own {
                fn of<T: Scalar>(model: &Paper<T>, angles: &[T; 3], rates: &[T; 3]) -> Vec<T> {
                    model.$name(angles, rates).to_vec()
                }
            }
            (stringify!($name), measured::<Own>())
        }};
    }
    for (name, found) in [
        function!(accelerations),
        function!(momenta),
        function!(symmetric_accelerations),
        function!(symmetric_momenta),
    ] {
        let stated = stated(name);
        println!("{name}: {stated} ulp stated, {found} found");
        assert!(
            stated > 0.5 && found > 0.8 * stated && found < 8.0 * stated,
            "{name}"
        );
    }
}
