//! Rounding errors of the compared implementations.
//!
//! The reference is the dense system in double-double arithmetic, with the decimal constants of the
//! scene to 31 digits. Errors are in units of the *conditioning bound* u |M⁻¹| (|M| |ω̇| + |b|),
//! where u is half the distance between 1 and the next larger number, and |M| and |b| are the sums
//! of the magnitudes of their terms. To first order this is the change of the accelerations if each
//! term is rounded once.

use branched_pendulum::Pendulum;
use branched_pendulum::scalar::{Double, Real, Scalar};
use nalgebra::{DMatrix, DVector};

use super::articulated::Articulated;
use super::by_hand::ByHand;
use super::dense::Dense;
use super::measure::CONTENDERS;
use super::scenes::{factorization, recursion};
use super::states::random;
use super::table::{self, Link};

/// Largest errors of one scene in units of the bound, in the order of [`CONTENDERS`]. Batches are
/// left out, since their results are identical to those of single states.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Name of the scene.
    pub scene: &'static str,
    /// Number of its links.
    pub links: usize,
    /// Largest errors, in units of the bound.
    pub worst: [Option<f64>; CONTENDERS.len()],
    /// Median errors, in units in the last place of the acceleration.
    pub ulps: [Option<f64>; CONTENDERS.len()],
}

/// Reference accelerations, with their change if every term is rounded once.
struct Reference {
    alpha: Vec<Double>,
    sensitivity: DVector<f64>,
}

impl Reference {
    /// Solves the system of `docs/physics.md`, section 1, by Gaussian elimination.
    fn new(links: &[Link<Double>], theta: &[f64], omega: &[f64]) -> Self {
        let n = links.len();
        let zero = Double::from_f64(0.0);
        let gravity: Double = table::decimal(980_665.0, 1e5);
        let (coupling, moment) = table::couplings(links);
        let turned: Vec<(Double, Double)> = theta
            .iter()
            .map(|&theta| Double::from_f64(theta).sin_cos())
            .collect();
        let mut matrix = coupling.clone();
        let mut right = vec![zero; n];
        let mut bias_terms = DVector::zeros(n);
        let mut mass_terms = DMatrix::zeros(n, n);
        for i in 0..n {
            let (sin_i, cos_i) = turned[i];
            let weight = gravity * moment[i] * sin_i;
            right[i] = -weight;
            bias_terms[i] = weight.high().abs();
            for j in 0..n {
                let (sin_j, cos_j) = turned[j];
                let square = Double::from_f64(omega[j]) * Double::from_f64(omega[j]);
                let sine = coupling[i][j] * (sin_i * cos_j - cos_i * sin_j);
                right[i] = right[i] - sine * square;
                matrix[i][j] = coupling[i][j] * (cos_i * cos_j + sin_i * sin_j);
                let size = coupling[i][j].high();
                let products = |a: Double, b: Double| (a * b).high().abs();
                mass_terms[(i, j)] = size * (products(cos_i, cos_j) + products(sin_i, sin_j));
                bias_terms[i] +=
                    size * square.high() * (products(sin_i, cos_j) + products(cos_i, sin_j));
            }
        }
        let rounded = DMatrix::from_fn(n, n, |i, j| matrix[i][j].high());
        let alpha = solve(matrix, right);
        let sizes = DVector::from_fn(n, |i, _| alpha[i].high().abs());
        let residual = mass_terms * sizes + bias_terms;
        let inverse = rounded.try_inverse().map(|inverse| inverse.abs());
        Self {
            sensitivity: inverse.map_or(DVector::zeros(n), |inverse| inverse * residual),
            alpha,
        }
    }
}

/// Solves A x = b by Gaussian elimination, for a symmetric and positive definite A.
fn solve(mut matrix: Vec<Vec<Double>>, mut right: Vec<Double>) -> Vec<Double> {
    let n = right.len();
    for k in 0..n {
        let pivot_row = matrix[k].clone();
        for i in k + 1..n {
            let ratio = matrix[i][k] / pivot_row[k];
            if ratio.high() != 0.0 {
                for j in k..n {
                    matrix[i][j] = matrix[i][j] - ratio * pivot_row[j];
                }
                right[i] = right[i] - ratio * right[k];
            }
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            right[k] = right[k] - matrix[k][j] * right[j];
        }
        right[k] = right[k] / matrix[k][k];
    }
    right
}

/// Errors of one implementation over all states and links.
#[derive(Default)]
struct Seen {
    worst: f64,
    ulps: Vec<f64>,
}

impl Seen {
    fn note<T: Real>(&mut self, found: &[T], reference: &Reference) {
        let rounding = T::EPSILON.to_f64() / 2.0;
        for (i, found) in found.iter().enumerate() {
            let expected = reference.alpha[i];
            let error = Double::from_f64(found.to_f64()) - expected;
            let error = error.high().abs();
            let bound = rounding * reference.sensitivity[i];
            self.worst = self.worst.max(error / bound);
            let exponent = expected.high().abs().log2().floor();
            self.ulps.push(error / (2.0 * rounding * exponent.exp2()));
        }
    }

    fn median(mut self) -> f64 {
        self.ulps.sort_by(f64::total_cmp);
        self.ulps
            .get(self.ulps.len() / 2)
            .copied()
            .unwrap_or(f64::NAN)
    }
}

/// Measures the errors for all scenes, at `states` random states each; fewer for large trees.
#[must_use]
pub fn all(states: usize) -> Vec<Errors> {
    macro_rules! errors {
        ($links:literal, $scene:ident, $name:literal, $table:expr) => {{
            let models = (
                factorization::$scene::<f64>::default(),
                recursion::$scene::<f64>::default(),
                factorization::$scene::<f32>::default(),
                recursion::$scene::<f32>::default(),
            );
            errors::<$links>(
                $name,
                &models,
                $table,
                states.min(1_000_000 / $links / $links),
            )
        }};
    }
    vec![
        errors!(3, Paper, "paper", (table::paper(), table::paper())),
        errors!(7, Tree7, "tree", (table::tree(3), table::tree(3))),
        errors!(15, Tree15, "tree", (table::tree(4), table::tree(4))),
        errors!(31, Tree31, "tree", (table::tree(5), table::tree(5))),
        errors!(127, Tree127, "tree", (table::tree(7), table::tree(7))),
    ]
}

fn errors<const N: usize>(
    scene: &'static str,
    models: &(
        impl Pendulum<f64>,
        impl Pendulum<f64>,
        impl Pendulum<f32>,
        impl Pendulum<f32>,
    ),
    (exact, links): (Vec<Link<Double>>, Vec<Link>),
    states: usize,
) -> Errors {
    let mut seen: [Option<Seen>; CONTENDERS.len()] = Default::default();
    let (mut recursion, mut dense) = (Articulated::new(&links), Dense::new(&links));
    let angles = random(11, N, states, std::f64::consts::PI).by_state;
    let velocities = random(12, N, states, 9.0).by_state;
    for (theta, omega) in angles.iter().zip(&velocities) {
        // The values are exact in single precision too.
        let narrow = |values: &[f64]| values.iter().map(|&x| x as f32).collect::<Vec<_>>();
        let (narrow_theta, narrow_omega) = (narrow(theta), narrow(omega));
        let widen = |values: &[f32]| values.iter().map(|&x| f64::from(x)).collect::<Vec<_>>();
        let (theta, omega) = (widen(&narrow_theta), widen(&narrow_omega));
        let reference = Reference::new(&exact, &theta, &omega);
        let mut alpha = [0.0; N];
        let mut note = |index: usize, alpha: &[f64]| {
            seen[index].get_or_insert_default().note(alpha, &reference);
        };
        models.0.accelerations_into(0.0, &theta, &omega, &mut alpha);
        note(1, &alpha);
        models.1.accelerations_into(0.0, &theta, &omega, &mut alpha);
        note(2, &alpha);
        if let ([a, b, c], [d, e, f]) = (theta.as_slice(), omega.as_slice())
            && N == 3
        {
            note(
                7,
                &ByHand::default().accelerations(&[*a, *b, *c], &[*d, *e, *f]),
            );
        }
        recursion.accelerations(&theta, &omega, &mut alpha);
        note(8, &alpha);
        dense.accelerations(&theta, &omega, &mut alpha);
        note(9, &alpha);
        let mut single = [0.0_f32; N];
        models
            .2
            .accelerations_into(0.0, &narrow_theta, &narrow_omega, &mut single);
        seen[5].get_or_insert_default().note(&single, &reference);
        models
            .3
            .accelerations_into(0.0, &narrow_theta, &narrow_omega, &mut single);
        seen[6].get_or_insert_default().note(&single, &reference);
    }
    let worst = seen
        .each_ref()
        .map(|seen| seen.as_ref().map(|seen| seen.worst));
    Errors {
        scene,
        links: N,
        worst,
        ulps: seen.map(|seen| seen.map(Seen::median)),
    }
}
