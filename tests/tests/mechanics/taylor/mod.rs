//! Taylor coefficients of the motion against the equations themselves, and the
//! method that uses them.

mod trajectories;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::Quad;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::driven_series::{DrivenSeries, DrivenSeriesParameters};
use branched_pendulum_tests::scenes::free_series::{FreeSeries, FreeSeriesParameters};
use branched_pendulum_tests::scenes::series::Series;

/// The polynomials through order `order`, for which the equation's own
/// accelerations differ from the second derivative by O(τ^order).
struct Expansion<T> {
    coefficients: Vec<[[T; 3]; 2]>,
}

impl<T: Scalar> Expansion<T> {
    fn new(
        model: &impl TaylorPendulum<T>,
        order: u32,
        expand: impl FnOnce(&mut [[[T; 3]; 2]], &mut [Quad<T>]),
    ) -> Self {
        let (zero, order) = (T::from_f64(0.0), order as usize);
        let mut coefficients = vec![[[zero; 3]; 2]; order + 1];
        // Numbers that stand in the workspace before do not count.
        let nan = T::from_f64(f64::NAN);
        let mut work = vec![Quad([nan; 4]); model.taylor_workspace(order)];
        expand(&mut coefficients, &mut work);
        Self { coefficients }
    }

    fn state(&self, tau: T) -> ([T; 3], [T; 3]) {
        let mut sum = [[T::from_f64(0.0); 3]; 2];
        for row in self.coefficients.iter().rev() {
            for (sum, coefficient) in sum.as_flattened_mut().iter_mut().zip(row.as_flattened()) {
                *sum = *sum * tau + *coefficient;
            }
        }
        let [theta, omega] = sum;
        (theta, omega)
    }

    /// dω/dτ of the polynomial.
    fn derivative(&self, tau: T) -> [T; 3] {
        let mut sum = [T::from_f64(0.0); 3];
        for (k, row) in self.coefficients.iter().enumerate().skip(1).rev() {
            for (sum, coefficient) in sum.iter_mut().zip(&row[1]) {
                *sum = *sum * tau + T::from_f64(k as f64) * *coefficient;
            }
        }
        sum
    }
}

fn doubles(values: [f64; 3]) -> [Double; 3] {
    values.map(Double::from_f64)
}

/// Largest violation of the equation of motion by the polynomial at `tau`.
fn violation(
    expansion: &Expansion<Double>,
    tau: f64,
    accelerations: impl Fn(&[Double; 3], &[Double; 3]) -> [Double; 3],
) -> f64 {
    let tau = Double::from_f64(tau);
    let (theta, omega) = expansion.state(tau);
    let rates = expansion.derivative(tau);
    let alpha = accelerations(&theta, &omega);
    let differences = rates
        .iter()
        .zip(&alpha)
        .map(|(a, b)| (*a - *b).to_f64().abs());
    differences.fold(0.0, f64::max)
}

/// Through order p the polynomial solves the equation up to a term of order p:
/// at half the distance, 2^−p of the violation in the mean over many states. A
/// wrong coefficient of any order would show by a smaller power.
/// `pace` is how fast the motion is, beside the free one.
fn solves_the_equation(
    pace: f64,
    expand: impl Fn(u32, &[Double; 3], &[Double; 3]) -> Expansion<Double>,
    accelerations: impl Fn(Double, &[Double; 3], &[Double; 3]) -> [Double; 3],
) {
    const STATES: usize = 40;
    for (order, tau) in [(2, 1e-4), (3, 1e-4), (5, 5e-4), (8, 1e-3), (12, 5e-3)] {
        let mut random = Random::new(11);
        let mut mean = 0.0;
        for _ in 0..STATES {
            let theta = doubles(random.array(-3.0, 3.0));
            let omega = doubles(random.array(-3.0, 3.0));
            let expansion = expand(order, &theta, &omega);
            let at = |tau: f64| {
                violation(&expansion, tau, |q, v| {
                    accelerations(Double::from_f64(tau), q, v)
                })
            };
            let (far, near) = (at(tau / pace), at(tau / (2.0 * pace)));
            // Rounding is some 1e-30.
            assert!(near > 1e-27, "order {order}: nothing left to compare");
            mean += (far / near).log2() / STATES as f64;
        }
        println!("order {order}: {mean}");
        assert!(
            (mean - f64::from(order)).abs() < 0.1,
            "order {order}: {mean}"
        );
    }
}

/// The paper's tree with constants of 32 digits. A scene of numbers has them
/// rounded to `f64`, each for itself.
fn exact_tree() -> FreeSeries<Double> {
    let decimal = |digits: i64, power: i32| {
        Double::from_f64(digits as f64) / Double::from_f64(10.0_f64.powi(power))
    };
    let parameters = FreeSeriesParameters {
        gravity: decimal(980_665, 5),
        parent_mass: decimal(12_880, 5),
        parent_com: decimal(84, 3),
        parent_inertia: decimal(188, 5),
        joint: decimal(27, 2),
        child_mass: decimal(10_531, 5),
        child_com: decimal(43, 3),
        child_inertia: decimal(516, 6),
    };
    FreeSeries::from_parameters_unchecked(parameters)
}

#[test]
fn polynomials_of_the_free_tree_solve_its_equation() {
    let model = exact_tree();
    solves_the_equation(
        1.0,
        |order, theta, omega| {
            Expansion::new(&model, order, |coefficients, work| {
                model.taylor_coefficients(theta, omega, coefficients, work);
            })
        },
        |_, theta, omega| model.accelerations(theta, omega),
    );
}

pub(crate) const PARAMETERS: DrivenSeriesParameters<f64> = DrivenSeriesParameters {
    gravity: 9.80665,
    mass: 0.2,
    com: 0.15,
    aside: 0.02,
    joint: 0.3,
    inertia: 2e-3,
    twig_mass: 0.1,
    twig_length: 0.2,
    stiffness: 0.3,
    bob_mass: 0.08,
    bob_length: 0.1,
    push: 0.4,
    pace: 5.0,
};

#[test]
fn polynomials_of_the_driven_tree_solve_its_equation() {
    let exact = Double::from_f64;
    let parameters = DrivenSeriesParameters {
        gravity: exact(PARAMETERS.gravity),
        mass: exact(PARAMETERS.mass),
        com: exact(PARAMETERS.com),
        aside: exact(PARAMETERS.aside),
        joint: exact(PARAMETERS.joint),
        inertia: exact(PARAMETERS.inertia),
        twig_mass: exact(PARAMETERS.twig_mass),
        twig_length: exact(PARAMETERS.twig_length),
        stiffness: exact(PARAMETERS.stiffness),
        bob_mass: exact(PARAMETERS.bob_mass),
        bob_length: exact(PARAMETERS.bob_length),
        push: exact(PARAMETERS.push),
        pace: exact(PARAMETERS.pace),
    };
    let model = DrivenSeries::from_parameters_unchecked(parameters);
    let start = 0.75;
    solves_the_equation(
        2.5,
        |order, theta, omega| {
            Expansion::new(&model, order, |coefficients, work| {
                let time = Double::from_f64(start);
                model.taylor_coefficients(time, theta, omega, coefficients, work);
            })
        },
        |tau, theta, omega| model.accelerations(Double::from_f64(start) + tau, theta, omega),
    );
}

/// Order 0 and 1 are the state, its velocities and its accelerations; a
/// workspace that is too short gives no number.
#[test]
fn low_orders_are_the_accelerations() {
    let model = Series::new();
    let mut random = Random::new(5);
    for _ in 0..100 {
        let (theta, omega): ([f64; 3], [f64; 3]) =
            (random.array(-3.0, 3.0), random.array(-9.0, 9.0));
        let mut coefficients = [[[0.0; 3]; 2]; 4];
        let mut work = vec![Quad([0.0; 4]); model.taylor_workspace(3)];
        model.taylor_coefficients(&theta, &omega, &mut coefficients, &mut work);
        let alpha = model.accelerations(&theta, &omega);
        assert_eq!(coefficients[0], [theta, omega]);
        assert_eq!(coefficients[1][0], omega);
        let largest = alpha
            .iter()
            .fold(0.0_f64, |most, alpha| most.max(alpha.abs()));
        for (link, alpha) in alpha.into_iter().enumerate() {
            assert!((coefficients[1][1][link] - alpha).abs() < 1e-14 * largest);
            assert_eq!(coefficients[2][0][link], coefficients[1][1][link] / 2.0);
        }
        let mut lower = [[[0.0; 3]; 2]; 1];
        model.taylor_coefficients(&theta, &omega, &mut lower, &mut work);
        assert_eq!(lower[0], coefficients[0]);
        let short = work.len() - 1;
        model.taylor_coefficients(&theta, &omega, &mut coefficients, &mut work[..short]);
        let flat = coefficients.as_flattened().as_flattened();
        assert!(flat.iter().all(|c| c.is_nan()));
    }
}
