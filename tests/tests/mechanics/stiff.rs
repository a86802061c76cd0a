//! Stiff springs and strong friction in joints that hardly turn: what depends on the small
//! differences of large angles keeps its digits, in every form.
//!
//! There is no gravity, so that torques of joints are all there is. References take the
//! differences in twice the digits.

use branched_pendulum::scalar::{Double, Real, Scalar};
use branched_pendulum_tests::bodies::bodies_of;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::{Link, Tree};
use nalgebra::{DMatrix, DVector};

use crate::support::{Compiled, Worst, compile};

/// Largest deflections, rad, and rates of joints, rad/s.
const DEFLECTIONS: [f64; 4] = [1e-3, 1e-5, 1e-7, 1e-9];

/// Common angle of all links, rad.
const TURN: f64 = 1.3;

/// A tree in coordinates q with θ = J q.
struct Case {
    compiled: Compiled,
    tree: Tree,
    /// J, of whole numbers.
    transform: DMatrix<f64>,
}

impl Case {
    fn absolute(text: &str) -> Self {
        let compiled = compile(text);
        let tree = bodies_of(&compiled.scene);
        let transform = DMatrix::identity(tree.links.len(), tree.links.len());
        Self {
            compiled,
            tree,
            transform,
        }
    }

    fn symmetric(text: &str) -> Self {
        let mut case = Self::absolute(&format!("{text}, emit(energies, symmetric)"));
        let n = case.tree.links.len();
        for column in 0..n {
            let mut unit = vec![0.0; n];
            unit[column] = 1.0;
            let link_angles = case.compiled.evaluate("from_symmetric", &[&unit]);
            case.transform
                .set_column(column, &DVector::from_vec(link_angles));
        }
        case
    }

    /// Differences of joints in these coordinates, D J with whole numbers: θ_i − θ_parent.
    fn joints(&self) -> DMatrix<f64> {
        let mut joints = self.transform.clone();
        for (link, own) in self.tree.links.iter().enumerate() {
            if let Some(parent) = own.parent {
                let difference = self.transform.row(link) - self.transform.row(parent);
                joints.set_row(link, &difference);
            }
        }
        joints
    }

    /// Differences of joints of these values, less `rests`: rounded once.
    fn differences(&self, values: &[f64], rests: &[f64]) -> DVector<f64> {
        let joints = self.joints();
        DVector::from_fn(rests.len(), |link, _| {
            let mut sum = Double::from_f64(-rests[link]);
            for (&weight, &value) in joints.row(link).iter().zip(values) {
                sum += Double::from_f64(weight) * Double::from_f64(value);
            }
            sum.to_f64()
        })
    }

    fn constants(&self, of: fn(&Link) -> f64) -> DVector<f64> {
        DVector::from_iterator(self.tree.links.len(), self.tree.links.iter().map(of))
    }

    /// Coordinates at which all joints are turned by about so much beside their rests.
    fn turned(&self, deflection: f64) -> Vec<f64> {
        let n = self.tree.links.len();
        let mut theta = vec![0.0; n];
        for (link, own) in self.tree.links.iter().enumerate() {
            let share = deflection * [1.0, -0.7, 0.4, 0.9, -0.3, 0.6, -0.8][link % 7];
            theta[link] = match own.parent {
                Some(parent) => theta[parent] + own.rest + share,
                None => TURN,
            };
        }
        self.coordinates(theta)
    }

    fn coordinates(&self, theta: Vec<f64>) -> Vec<f64> {
        let gram = self.transform.transpose() * &self.transform;
        let q = self.transform.transpose() * DVector::from_vec(theta);
        let inverse = gram.try_inverse().expect("columns are orthogonal");
        (inverse * q).as_slice().to_vec()
    }

    /// The torques of joints as generalized forces, and the sum of their sizes.
    fn forces(&self, torques: &DVector<f64>) -> [DVector<f64>; 2] {
        let joints = self.joints().transpose();
        [-(&joints * torques), joints.abs() * torques.abs()]
    }

    /// Accelerations under such forces and centrifugal ones, and their conditioning.
    fn accelerations(&self, [q, v]: [&[f64]; 2], forces: [DVector<f64>; 2]) -> [DVector<f64>; 2] {
        let [theta, omega] =
            [q, v].map(|values| &self.transform * DVector::from_column_slice(values));
        let mut free = self.tree.clone();
        for link in &mut free.links {
            (link.spring, link.friction) = (0.0, 0.0);
        }
        let motion = Motion::new(&free, theta.as_slice(), omega.as_slice());
        let transposed = self.transform.transpose();
        let mass = &transposed * &motion.mass * &self.transform;
        let inverse = mass.try_inverse().expect("it is positive definite");
        let [force, size] = forces;
        let found = &inverse * (force - &transposed * &motion.bias);
        let terms = transposed.abs() * &motion.mass_terms * self.transform.abs() * found.abs();
        let bound = inverse.abs() * (size + terms + transposed.abs() * &motion.bias_terms);
        [found, bound]
    }
}

/// Descriptions without their last entries, all with springs and friction in all joints but
/// that of the root.
const TREES: [&str; 4] = [
    "gravity = 0, a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.1, length = 0.3, spring = 1e5, friction = 200) [
            c: rod(mass = 0.05, length = 0.2, spring = 1e6, friction = 1000)
        ]
    ]",
    "gravity = 0, a(mass = 0.4, com = (0.2, 0.03), inertia = 2e-3, joint = (0.5, -0.02)) [
        b: rod(mass = 0.1, length = 0.3, spring = 1e4, rest = 0.25, friction = 50) * 2,
        c: rod(mass = 0.05, length = 0.2, spring = 2e5, rest = -0.5, friction = 300)
    ]",
    "gravity = 0, a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.1, length = 0.3, spring = 1e6, friction = 30) * 3
    ]",
    "gravity = 0, a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = 0.1, length = 0.3, spring = 1e5, friction = 80) [
            c: rod(mass = 0.02, length = 0.1, spring = 1e3, rest = 0.125, friction = 10) * 2
        ] * 2
    ]",
];

const UNEQUAL: &str = "gravity = 0, a: rod(mass = 0.4, length = 0.5) [
        b: rod(mass = each(0.1, 0.12), length = 0.3, spring = each(1e5, 3e5),
            rest = each(0.25, -0.125), friction = each(40, 90)) * 2
    ]";

fn note(worst: &mut Worst, found: &[f64], [expected, bound]: &[DVector<f64>; 2], place: &str) {
    for (index, found) in found.iter().enumerate() {
        let place = || format!("{place}, {index}");
        worst.note(found - expected[index], bound[index], place);
    }
}

/// All cases in absolute angles by both solves, and in symmetric coordinates.
fn cases() -> Vec<(String, &'static str, Case)> {
    let mut cases = Vec::new();
    for (number, text) in TREES.into_iter().chain([UNEQUAL]).enumerate() {
        for solve in ["factorization", "recursion"] {
            let text = format!("{text}, solve = {solve}, emit(energies, momenta, forces)");
            let name = format!("tree {number} by {solve}");
            cases.push((name, "accelerations", Case::absolute(&text)));
        }
        if number > 0 {
            let name = format!("tree {number} in symmetric coordinates");
            cases.push((name, "symmetric_accelerations", Case::symmetric(text)));
        }
    }
    cases
}

#[test]
fn springs_keep_their_digits() {
    let [mut accelerations, mut momenta, mut energies] = std::array::from_fn(|_| Worst::default());
    for (name, entry, case) in cases() {
        let (rests, springs) = (
            case.constants(|link| link.rest),
            case.constants(|l| l.spring),
        );
        for deflection in DEFLECTIONS {
            let place = format!("{name} at {deflection}");
            let q = case.turned(deflection);
            let still = vec![0.0; q.len()];
            let strains = case.differences(&q, rests.as_slice());
            let largest = strains.rows_range(1..).amax();
            assert!((0.3 * deflection..2.0 * deflection).contains(&largest));
            let torques = springs.component_mul(&strains);
            let forces = case.forces(&torques);
            let found = case.compiled.evaluate(entry, &[&q, &still]);
            let expected = case.accelerations([&q, &still], forces.clone());
            note(&mut accelerations, &found, &expected, &place);
            if entry == "accelerations" {
                let rates = case.compiled.evaluate("canonical_rates", &[&q, &still]);
                note(&mut momenta, &rates[q.len()..], &forces, &place);
                let energy = case.compiled.evaluate("potential_energy", &[&q])[0];
                let expected = 0.5 * torques.dot(&strains);
                energies.note(energy - expected, expected, || place.clone());
            }
        }
    }
    accelerations.assert_below(1e-14, "accelerations");
    momenta.assert_below(1e-15, "rates of momenta");
    energies.assert_below(1e-15, "energies");
}

/// Links that turn alike, but for a little.
#[test]
fn friction_keeps_its_digits() {
    let [mut accelerations, mut powers] = std::array::from_fn(|_| Worst::default());
    for (name, entry, case) in cases() {
        let n = case.tree.links.len();
        let (rests, none) = (case.constants(|link| link.rest), vec![0.0; n]);
        let q = case.turned(0.0);
        let strains = case.differences(&q, rests.as_slice());
        let springs = case.constants(|link| link.spring).component_mul(&strains);
        for rate in DEFLECTIONS {
            let place = format!("{name} at {rate}");
            let omega = (0..n).map(|link| 0.1 + rate * (link as f64 - 0.4));
            let v = case.coordinates(omega.collect());
            let differences = case.differences(&v, &none);
            let torques = case
                .constants(|link| link.friction)
                .component_mul(&differences);
            let found = case.compiled.evaluate(entry, &[&q, &v]);
            let forces = case.forces(&(&torques + &springs));
            let expected = case.accelerations([&q, &v], forces);
            note(&mut accelerations, &found, &expected, &place);
            if entry == "accelerations" {
                let power = case.compiled.evaluate("friction_power", &[&v])[0];
                let expected = -torques.dot(&differences);
                powers.note(power - expected, expected, || place.clone());
            }
        }
    }
    accelerations.assert_below(1e-14, "accelerations");
    powers.assert_below(1e-15, "powers of friction");
}

/// Small differences of arms and of hands on them that hardly differ from each other.
#[test]
fn small_differences_keep_their_digits() {
    let compiled = compile(
        "gravity = 0, trunk: rod(mass = 0.4, length = 0.5) [
            arm: rod(mass = 0.1, length = 0.3, spring = 1e2, friction = 2) [
                hand: rod(mass = 0.02, length = 0.1, spring = 1e6, friction = 1e3)
            ] * 2
        ], in_phase(arm), emit(transverse)",
    );
    // Each link stands for both copies.
    let tree = bodies_of(&compiled.scene);
    let none = [0.0; 3];
    let mass = Motion::new(&tree, &none, &none).mass;
    let mass = DMatrix::from_fn(2, 2, |row, column| mass[(row + 1, column + 1)]);
    let inverse = mass.try_inverse().expect("it is positive definite");
    let [mut accelerations, mut powers] = std::array::from_fn(|_| Worst::default());
    for apart in DEFLECTIONS {
        let [delta, rate] = [1.3, 0.7].map(|size| [size, size + apart]);
        // Exact: the two are close.
        let [strain, change] = [delta, rate].map(|[arm, hand]| hand - arm);
        let torque = |link: usize, angle: f64, rate: f64| {
            tree.links[link].spring * angle + tree.links[link].friction * rate
        };
        let of_arm = torque(1, delta[0], rate[0]);
        let of_hand = torque(2, strain, change);
        let expected = &inverse * DVector::from_vec(vec![of_hand - of_arm, -of_hand]);
        let size = DVector::from_vec(vec![of_hand.abs() + of_arm.abs(), of_hand.abs()]);
        let inputs: [&[f64]; 5] = [&none, &none, &none, &delta, &rate];
        let found = compiled.evaluate("transverse_accelerations_arm", &inputs);
        let bound = inverse.abs() * size;
        note(
            &mut accelerations,
            &found,
            &[expected, bound],
            &format!("at {apart}"),
        );
        let power = compiled.evaluate("transverse_friction_power_arm", &[&rate])[0];
        let friction = |link: usize, rate: f64| tree.links[link].friction * rate * rate;
        let expected = -(friction(1, rate[0]) + friction(2, change));
        powers.note(power - expected, expected, || format!("at {apart}"));
        let inputs: [&[f64]; 3] = [&none, &delta, &none[..2]];
        let energy = compiled.evaluate("transverse_energy_arm", &inputs)[0];
        let stored = |link: usize, angle: f64| 0.5 * tree.links[link].spring * angle * angle;
        let expected = stored(1, delta[0]) + stored(2, strain);
        powers.note(energy - expected, expected, || format!("at {apart}"));
    }
    accelerations.assert_below(1e-14, "accelerations");
    powers.assert_below(1e-15, "energy and power of friction");
}
