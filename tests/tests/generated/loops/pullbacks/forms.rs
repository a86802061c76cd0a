//! Forms of a pullback of a tree in loops, gradients of its motions, and the number of operations.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use branched_pendulum::Parametric;
use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, Real, Scalar};
use branched_pendulum::system::functions::{
    AccelerationsPullback as Free, AccelerationsUnderTorquesPullback as Under,
};
use branched_pendulum::system::{At, Computes, Model, PullbackOde, PullbackWorkspace, Workspace};
use branched_pendulum_compiler_tests::random::Random;

use super::{
    Large, Point, RuleLoops, RuleUnrolled, TableLoops, Tangent, apart, double, in_order, name_of,
    sum,
};

/// A tree without parameters and without a drive. All links of a kind have the same friction and
/// springs, which other trees in loops have in their equations.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 0.3, length = 0.3, friction = 1e-3) [
        arm: rod(mass = 0.1, length = 0.2, spring = 1e-2) * 2,
    ],
    emit(gradient),
)]
struct Constant;

/// Arrays, batches, the arithmetic of the scalar and equations of motion have the same derivatives.
#[test]
fn all_forms_of_a_pullback_agree() {
    const STATES: usize = 5;
    const LINKS: usize = 6;
    let values: [f64; 8] = [9.8, 0.3, 0.02, 0.4, 1.1, 0.01, 0.02, 0.3];
    let parameters = <TableLoops as Parametric<f64>>::PARAMETERS.len();
    let model = TableLoops::<f64>::with_parameters(|index| values[index]);
    assert_eq!([model.links(), parameters], [LINKS, values.len()]);
    let mut random = Random::new(47);
    let points: Vec<Point<f64>> = (0..STATES)
        .map(|_| Point {
            time: 0.3,
            ..Point::<f64>::random(LINKS, &mut random)
        })
        .collect();
    let column = |of: &dyn Fn(&Point<f64>) -> f64| points.iter().map(of).collect::<Vec<f64>>();
    let columns = |of: &dyn Fn(&Point<f64>) -> &Vec<f64>| -> Vec<Vec<f64>> {
        (0..LINKS)
            .map(|link| column(&|point| of(point)[link]))
            .collect()
    };
    let given = [
        columns(&|point| &point.theta),
        columns(&|point| &point.omega),
        columns(&|point| &point.torques),
        columns(&|point| &point.weights),
    ];
    let mut batch = [LINKS, LINKS, LINKS, parameters].map(|rows| vec![vec![0.0; STATES]; rows]);
    let [theta, omega, torques, by_parameters] = &mut batch;
    Batch::new(&model)
        .compute(
            Under,
            At::time(0.3),
            given.each_ref().map(Vec::as_slice),
            [theta, omega, torques, by_parameters].map(Vec::as_mut_slice),
        )
        .expect("all columns have one length");
    for (state, point) in points.iter().enumerate() {
        let expected = point.pulled_back(&model, parameters);
        for (columns, expected) in batch.iter().zip(&expected) {
            let found: Vec<f64> = columns.iter().map(|column| column[state]).collect();
            assert!(apart(&found, expected) < 1e-12);
        }
        let array = |values: &[f64]| -> [f64; LINKS] { values.try_into().expect("a link each") };
        let [theta, omega, torques, weights] =
            [&point.theta, &point.omega, &point.torques, &point.weights].map(|own| array(own));
        let found = model.accelerations_under_pullback(0.3, &theta, &omega, &torques, &weights);
        assert_eq!(found.0.to_vec(), expected[0]);
        assert_eq!(found.1.to_vec(), expected[1]);
        assert_eq!(found.2.to_vec(), expected[2]);
        assert_eq!(found.3.to_vec(), expected[3]);

        // Without torques, as equations of motion.
        let (free_theta, free_omega, free_parameters) =
            model.accelerations_pullback(0.3, &theta, &omega, &weights);
        let still = Point {
            torques: vec![0.0; LINKS],
            ..point.map(|value| value)
        };
        let expected = still.pulled_back(&model, parameters);
        assert!(apart(&free_theta, &expected[0]) < 1e-12);
        assert!(apart(&free_omega, &expected[1]) < 1e-12);
        assert!(apart(&free_parameters, &expected[3]) < 1e-12);
        let state = [theta, omega].concat();
        let (mut by_state, mut by_parameters) = (vec![0.0; 2 * LINKS], vec![0.0; parameters]);
        AbsoluteAngles(&model).add_pullback(
            &mut PullbackWorkspace::new(),
            0.3,
            &state,
            &[[0.0; LINKS], weights].concat(),
            &mut by_state,
            &mut by_parameters,
        );
        assert_eq!(by_state, [free_theta, free_omega].concat());
        assert_eq!(by_parameters, free_parameters);
    }
}

/// Models without parameters; slices of a wrong length.
#[test]
fn models_without_parameters_have_pullbacks() {
    let model = Constant::<Double>::default();
    let (theta, omega) = ([0.3, -0.5, 0.9].map(double), [1.0, 2.0, -1.0].map(double));
    let weights = [0.7, -0.2, 0.4].map(double);
    let (by_theta, by_omega, []) = model.accelerations_pullback(&theta, &omega, &weights);
    let varied = model.cast(Tangent::constant);
    let expected: Vec<Double> = (0..6)
        .map(|index| {
            let state = [theta, omega].concat().into_iter();
            let mut state: Vec<Tangent> = state.map(Tangent::constant).collect();
            state[index] = Dual::variable(state[index].value, 0);
            let mut alpha = [Tangent::constant(double(f64::NAN)); 3];
            let (theta, omega) = state.split_at(3);
            varied.accelerations_into(Tangent::constant(double(0.0)), theta, omega, &mut alpha);
            let terms = alpha.iter().zip(weights);
            sum(terms.map(|(own, weight)| own.tangents[0] * weight))
        })
        .collect();
    let error = apart(&[by_theta, by_omega].concat(), &expected);
    assert!(error < 1e-24, "{error:e}");
    let (mut short, mut long) = (vec![double(0.0); 2], vec![double(0.0); 3]);
    Computes::<Free, Double>::compute_with(
        &model,
        &mut Workspace::new(),
        At::time(double(0.0)),
        &[&theta, &omega, &weights],
        &mut [&mut short, &mut long, &mut []],
    );
    assert!(short.iter().chain(&long).all(|own| own.to_f64().is_nan()));
}

/// The gradient of a motion by its start and by all parameters.
#[test]
fn gradients_of_motions_agree_with_code_written_out() {
    let values = [1.0, 0.3, 0.3, 0.02, 0.7, 0.01, 0.1, 0.2, 1.0];
    let loops = RuleLoops::<f64>::with_parameters(|index| values[index]);
    let unrolled = RuleUnrolled::<f64>::with_parameters(|index| values[index]);
    let parameters = <RuleLoops as Parametric<f64>>::PARAMETERS.len();
    let links = Model::<f64>::links(&loops);
    let names: Vec<String> = (0..links).map(|link| name_of(&unrolled, link)).collect();
    let own = |name| (0..links).find(|&link| name_of(&loops, link) == name);
    let order: Vec<usize> = names
        .into_iter()
        .map(|name| own(name).expect("a link"))
        .collect();
    let angles: Vec<f64> = (0..links).map(|link| 0.3 + 0.05 * link as f64).collect();
    let weights: Vec<f64> = (0..links).map(|link| 0.4 * link as f64 - 1.0).collect();

    let gradient = |ode: &dyn PullbackOde<f64>, angles: &[f64], weights: &[f64]| {
        let cost = |_: usize, state: &[f64], slopes: &mut [f64]| {
            slopes[..links].copy_from_slice(weights);
            let terms = state.iter().zip(weights);
            terms.map(|(value, weight)| value * weight).sum()
        };
        let method = Dop853::new(Options::with_tolerance(1e-12));
        let start = State::at_rest(0.0, angles);
        let found = method.gradient(ode, parameters, &start, &[1.5], cost);
        found.expect("a motion")
    };
    let found = gradient(&AbsoluteAngles(&loops), &angles, &weights);
    let [angles, weights] = [&angles, &weights].map(|own| in_order(own, &order));
    let expected = gradient(&AbsoluteAngles(&unrolled), &angles, &weights);
    let errors = [
        apart(&found.parameters, &expected.parameters),
        apart(&in_order(&found.start, &order), &expected.start[..links]),
    ];
    println!("{errors:?} after {} steps", found.steps);
    assert!(errors.iter().all(|own| *own < 1e-10), "{errors:?}");
}

thread_local! {
    static COST: Cell<u64> = const { Cell::new(0) };
}

/// A number that counts its operations: a sine with its cosine as 19 products, a division or a root
/// as 6.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Counted(f64);

impl Counted {
    fn costing(value: f64, cost: u64) -> Self {
        COST.with(|own| own.set(own.get() + cost));
        Self(value)
    }
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::costing(self.0 + other.0, 1)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::costing(self.0 - other.0, 1)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::costing(self.0 * other.0, 1)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::costing(self.0 / other.0, 6)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self::costing(-self.0, 1)
    }
}

impl Scalar for Counted {
    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (Self::costing(sine, 19), Self(cosine))
    }

    fn sqrt(self) -> Self {
        Self::costing(self.0.sqrt(), 6)
    }
}

/// A pullback of 63 links, with derivatives by six parameters, costs some evaluations.
#[test]
fn a_pullback_costs_few_evaluations() {
    let values = [9.8, 0.3, 0.4, 0.8, 0.01, 0.02];
    let parameters = <Large as Parametric<f64>>::PARAMETERS.len();
    let model = Large::<f64>::with_parameters(|index| Counted(values[index]));
    let links = model.links();
    let point = Point::<f64>::random(links, &mut Random::new(3)).map(Counted);
    let mut alpha = vec![Counted(0.0); links];
    let cost = |run: &mut dyn FnMut()| {
        COST.with(|own| own.set(0));
        run();
        COST.with(Cell::get)
    };
    let once = cost(&mut || {
        model.accelerations_into(point.time, &point.theta, &point.omega, &mut alpha);
    });
    let all = cost(&mut || {
        let _ = point.pulled_back(&model, parameters);
    });
    let ratio = all as f64 / once as f64;
    println!("{once} and {all}: {ratio:.2}");
    assert!(once > 50 * links as u64);
    assert!(ratio < 5.0, "{ratio}");
}
