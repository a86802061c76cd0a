//! Taylor coefficients of trees that are described at run time, against those of models that
//! are compiled from the same text.

use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::Quad;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::damped_series::DampedSeries;
use branched_pendulum_tests::scenes::driven_series::DrivenSeries;
use branched_pendulum_tests::scenes::series::Series;
use branched_pendulum_trees::TreeDescription;

use crate::taylor::PARAMETERS;

const ORDER: usize = 31;

fn coefficients<P: TaylorPendulum<f64>>(model: &P, time: f64, y: &[f64]) -> Vec<f64> {
    let mut coefficients = vec![f64::NAN; y.len() * (ORDER + 1)];
    let mut work = vec![Quad([f64::NAN; 4]); model.taylor_workspace(ORDER)];
    let (theta, omega) = y.split_at(y.len() / 2);
    model.taylor_coefficients_into(time, theta, omega, &mut coefficients, &mut work);
    coefficients
}

/// Of each order to the rounding of its largest coefficient. Errors grow with the order.
fn agrees(compiled: &impl TaylorPendulum<f64>, scene: &str, values: &[(&str, f64)]) {
    let (_, text) = scene
        .split_once("#[branched_pendulum(")
        .expect("it has one");
    let (text, _) = text.rsplit_once(")]").expect("it has an end");
    let description = TreeDescription::parse(text).expect("the compiler takes it");
    let tree = description.tree(values).expect("the model takes them");
    let n = compiled.links();
    let mut random = Random::new(17);
    for _ in 0..100 {
        let y = [random.around_zero(n, 3.0), random.around_zero(n, 5.0)].concat();
        let time = random.around_zero(1, 2.0)[0];
        let [own, right] = [
            coefficients(&tree, time, &y),
            coefficients(compiled, time, &y),
        ];
        for (order, (own, right)) in own.chunks(2 * n).zip(right.chunks(2 * n)).enumerate() {
            let size = right.iter().fold(0.0_f64, |size, c| size.max(c.abs()));
            for (own, right) in own.iter().zip(right) {
                let error = (own - right).abs() / size;
                assert!(
                    error < 1e-12 * (1 + order) as f64,
                    "order {order}: {error:e}"
                );
            }
        }
    }
}

#[test]
fn coefficients_are_those_of_compiled_models() {
    let free = include_str!("../../../fixtures/scenes/series.rs");
    agrees(&Series::new(), free, &[]);
    let damped = include_str!("../../../fixtures/scenes/damped_series.rs");
    agrees(&DampedSeries::new(), damped, &[]);
    let driven = include_str!("../../../fixtures/scenes/driven_series.rs");
    let model = DrivenSeries::from_parameters_unchecked(PARAMETERS);
    let values = [
        ("gravity", PARAMETERS.gravity),
        ("mass", PARAMETERS.mass),
        ("com", PARAMETERS.com),
        ("aside", PARAMETERS.aside),
        ("joint", PARAMETERS.joint),
        ("inertia", PARAMETERS.inertia),
        ("twig_mass", PARAMETERS.twig_mass),
        ("twig_length", PARAMETERS.twig_length),
        ("stiffness", PARAMETERS.stiffness),
        ("bob_mass", PARAMETERS.bob_mass),
        ("bob_length", PARAMETERS.bob_length),
        ("push", PARAMETERS.push),
        ("pace", PARAMETERS.pace),
    ];
    agrees(&model, driven, &values);
}
