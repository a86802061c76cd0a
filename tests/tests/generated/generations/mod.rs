//! Trees whose code is loops over generations, against the same trees written
//! out and against the closed form.

mod threads;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::{Link, Tree, closed_form};
use nalgebra::DMatrix;

/// A tree in loops and the same one written out.
macro_rules! pair {
    ($loops:ident, $unrolled:ident: $($rule:tt)*) => {
        #[branched_pendulum(
            gravity = 9.80665,
            tree: generations($($rule)*, code = loops),
            emit(energies),
        )]
        struct $loops;

        #[branched_pendulum(
            gravity = 9.80665,
            tree: generations($($rule)*, code = unrolled),
            emit(energies),
        )]
        struct $unrolled;
    };
}

pair!(BinaryLoops, BinaryUnrolled: count = 5, branching = 2, shape = rod, mass = 0.12,
    length = 0.3, mass_ratio = 0.5, length_ratio = 0.7);
pair!(TernaryLoops, TernaryUnrolled: count = 4, branching = 3, mass = 0.2, com = 0.05,
    inertia = 1e-4, joint = 0.2, mass_ratio = 0.4, length_ratio = 0.8, friction = 2e-4,
    drag = 1e-4, spring = 3e-3);
pair!(ChainLoops, ChainUnrolled: count = 9, branching = 1, shape = point, mass = 0.2,
    length = 0.1, friction = 1e-4);
pair!(ShortLoops, ShortUnrolled: count = 2, branching = 5, shape = disc, mass = 0.3,
    length = 0.2, radius = 0.05, spring = 0.01);

/// The number in `loops` of each link of `unrolled`, by name.
fn order<L: Pendulum<f64>, U: Pendulum<f64>>(loops: &L, unrolled: &U) -> Vec<usize> {
    let names = loops.link_names();
    assert!(loops.link_name(loops.links()).is_none());
    let find = |name: &String| names.iter().position(|other| other == name).unwrap();
    unrolled.link_names().iter().map(find).collect()
}

/// Both models at random states: accelerations within the conditioning bound of
/// each other, |M⁻¹| (|M| |ω̇| + |b|) with |b| term by term, and energies.
fn agree<L: Energy<f64>, U: Energy<f64>>(loops: &L, unrolled: &U, tree: &Tree) {
    let n = unrolled.links();
    assert_eq!(loops.links(), n);
    let order = order(loops, unrolled);
    let mut random = Random::new(7);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let state: Vec<[f64; 2]> = (0..n).map(|_| random.array::<2>(-3.0, 3.0)).collect();
        let theta: Vec<f64> = state.iter().map(|[theta, _]| *theta).collect();
        let omega: Vec<f64> = state.iter().map(|[_, omega]| 3.0 * omega).collect();
        let mut expected = vec![0.0; n];
        unrolled.accelerations_into(0.0, &theta, &omega, &mut expected);

        let (mut own_theta, mut own_omega) = (vec![0.0; n], vec![0.0; n]);
        for (link, &place) in order.iter().enumerate() {
            (own_theta[place], own_omega[place]) = (theta[link], omega[link]);
        }
        let mut alpha = vec![0.0; n];
        loops.accelerations_into(0.0, &own_theta, &own_omega, &mut alpha);

        let (mass, bias) = closed_form::equations(tree, &theta, &omega);
        let inverse: DMatrix<f64> = mass.clone().try_inverse().unwrap();
        let forces: Vec<f64> = (0..n)
            .map(|i| {
                let row = (0..n).map(|j| {
                    let coupling =
                        (mass[(i, i)] * mass[(j, j)]).sqrt() * f64::from(mass[(i, j)] != 0.0);
                    mass[(i, j)].abs() * expected[j].abs() + coupling * omega[j] * omega[j]
                });
                row.sum::<f64>() + bias[i].abs()
            })
            .collect();
        for (link, &place) in order.iter().enumerate() {
            let bound: f64 = (0..n).map(|j| inverse[(link, j)].abs() * forces[j]).sum();
            worst = worst.max((alpha[place] - expected[link]).abs() / bound);
            let right = -(0..n).map(|j| inverse[(link, j)] * bias[j]).sum::<f64>();
            assert!((alpha[place] - right).abs() <= 1e-12 * bound, "{link}");
        }
        let energies = [
            (
                loops.kinetic_energy_of(&own_theta, &own_omega),
                unrolled.kinetic_energy_of(&theta, &omega),
            ),
            (
                loops.potential_energy_of(&own_theta),
                unrolled.potential_energy_of(&theta),
            ),
        ];
        for (own, other) in energies {
            assert!((own - other).abs() <= 1e-14 * other, "{own} {other}");
        }
    }
    println!("{n} links: worst {worst:.1e} of the bound");
    assert!(worst < 2.0 * f64::EPSILON, "{worst:e}");
}

/// A rule as the oracle's table, in the order of unrolled code.
struct Rule {
    generations: i32,
    branching: usize,
    first: Link,
    joint: f64,
    mass_ratio: f64,
    length_ratio: f64,
}

impl Rule {
    fn tree(&self) -> Tree {
        let mut tree = Tree {
            gravity: 9.80665,
            links: Vec::new(),
            between: Vec::new(),
        };
        self.grow(&mut tree, None, 0);
        tree
    }

    fn grow(&self, tree: &mut Tree, parent: Option<usize>, generation: i32) {
        if generation == self.generations {
            return;
        }
        let (mass, length) = (
            self.mass_ratio.powi(generation),
            self.length_ratio.powi(generation),
        );
        let above = parent.map_or(0.0, |_| self.joint * self.length_ratio.powi(generation - 1));
        let index = tree.links.len();
        tree.links.push(Link {
            parent,
            mass: self.first.mass * mass,
            inertia: self.first.inertia * mass * length * length,
            com: [self.first.com[0] * length, 0.0],
            pivot: [above, 0.0],
            ..self.first
        });
        for _ in 0..self.branching {
            self.grow(tree, Some(index), generation + 1);
        }
    }
}

fn link(mass: f64, com: f64, inertia: f64, [friction, drag, spring]: [f64; 3]) -> Link {
    Link {
        parent: None,
        mass,
        inertia,
        com: [com, 0.0],
        pivot: [0.0, 0.0],
        friction,
        drag,
        spring,
        rest: 0.0,
        laws: Default::default(),
    }
}

#[test]
fn loops_agree_with_code_written_out_and_with_the_closed_form() {
    let binary = Rule {
        generations: 5,
        branching: 2,
        first: link(0.12, 0.15, 0.12 * 0.09 / 12.0, [0.0; 3]),
        joint: 0.3,
        mass_ratio: 0.5,
        length_ratio: 0.7,
    };
    agree(
        &BinaryLoops::<f64>::new(),
        &BinaryUnrolled::<f64>::new(),
        &binary.tree(),
    );
    let ternary = Rule {
        generations: 4,
        branching: 3,
        first: link(0.2, 0.05, 1e-4, [2e-4, 1e-4, 3e-3]),
        joint: 0.2,
        mass_ratio: 0.4,
        length_ratio: 0.8,
    };
    agree(
        &TernaryLoops::<f64>::new(),
        &TernaryUnrolled::<f64>::new(),
        &ternary.tree(),
    );
    let chain = Rule {
        generations: 9,
        branching: 1,
        first: link(0.2, 0.1, 0.0, [1e-4, 0.0, 0.0]),
        joint: 0.1,
        mass_ratio: 1.0,
        length_ratio: 1.0,
    };
    agree(
        &ChainLoops::<f64>::new(),
        &ChainUnrolled::<f64>::new(),
        &chain.tree(),
    );
    let short = Rule {
        generations: 2,
        branching: 5,
        first: link(0.3, 0.2, 0.3 * 0.05 * 0.05 / 2.0, [0.0, 0.0, 0.01]),
        joint: 0.2,
        mass_ratio: 1.0,
        length_ratio: 1.0,
    };
    agree(
        &ShortLoops::<f64>::new(),
        &ShortUnrolled::<f64>::new(),
        &short.tree(),
    );
}

#[test]
fn a_path_leads_to_the_link_of_that_name() {
    type Tree = TernaryLoops<f64>;
    assert_eq!(Tree::link(&[]), Some(0));
    assert_eq!(Tree::link(&[2]), Some(3));
    assert_eq!(Tree::link(&[2, 1]), Some(4 + 3 + 2));
    let place = Tree::link(&[2, 0, 1]).unwrap();
    let tree = Tree::new();
    let name = tree.link_name(place).unwrap();
    assert_eq!(name.to_string(), "tree_4_3_1_2");
    assert_eq!(Tree::link(&[3]), None);
    assert_eq!(Tree::link(&[0, 0, 0, 0]), None);
}

/// Other scalars, one by one: double-double against double.
#[test]
fn other_scalars_compute_the_same_tree() {
    let n = TernaryLoops::LINKS;
    let mut random = Random::new(11);
    let theta: Vec<f64> = (0..n).map(|_| random.array::<1>(-3.0, 3.0)[0]).collect();
    let omega: Vec<f64> = theta.iter().map(|theta| 2.0 - theta).collect();
    let mut alpha = vec![0.0; n];
    TernaryLoops::<f64>::new().accelerations_into(0.0, &theta, &omega, &mut alpha);

    let wide = |numbers: &[f64]| -> Vec<Double> {
        numbers
            .iter()
            .map(|&number| Double::from_f64(number))
            .collect()
    };
    let mut doubles = vec![Double::from_f64(0.0); n];
    TernaryLoops::<Double>::default().accelerations_into(
        Double::from_f64(0.0),
        &wide(&theta),
        &wide(&omega),
        &mut doubles,
    );
    let narrow = |numbers: &[f64]| -> Vec<f32> { numbers.iter().map(|&x| x as f32).collect() };
    let mut singles = vec![0.0_f32; n];
    TernaryLoops::<f32>::default().accelerations_into(
        0.0,
        &narrow(&theta),
        &narrow(&omega),
        &mut singles,
    );
    let size = alpha
        .iter()
        .fold(0.0, |size: f64, alpha| size.max(alpha.abs()));
    for ((alpha, double), single) in alpha.iter().zip(&doubles).zip(&singles) {
        assert!((alpha - double.to_f64()).abs() < 1e-13 * size);
        assert!((alpha - f64::from(*single)).abs() < 1e-3 * size);
    }
}

/// The ternary tree with its numbers as parameters.
#[branched_pendulum(
    gravity = g,
    tree: generations(count = 4, branching = 3, mass = m, com = 0.05, inertia = 1e-4, joint = l,
        mass_ratio = r, length_ratio = 0.8, friction = c, drag = 1e-4, spring = 3e-3, code = loops),
    emit(energies),
)]
struct Named;

#[test]
fn parameters_give_the_tree_of_their_values() {
    let parameters = NamedParameters {
        g: 9.80665,
        m: 0.2,
        l: 0.2,
        r: 0.4,
        c: 2e-4,
    };
    let named = Named::new(parameters).unwrap();
    let literal = TernaryLoops::<f64>::new();
    let n = Named::LINKS;
    let mut random = Random::new(13);
    let theta: Vec<f64> = (0..n).map(|_| random.array::<1>(-3.0, 3.0)[0]).collect();
    let (mut own, mut other) = (vec![0.0; n], vec![0.0; n]);
    named.accelerations_into(0.0, &theta, &theta, &mut own);
    literal.accelerations_into(0.0, &theta, &theta, &mut other);
    let size = other
        .iter()
        .fold(0.0, |size: f64, alpha| size.max(alpha.abs()));
    for (own, other) in own.iter().zip(&other) {
        assert!((own - other).abs() < 1e-12 * size);
    }
    let energy = literal.kinetic_energy(&theta, &theta);
    assert!((named.kinetic_energy(&theta, &theta) - energy).abs() < 1e-14 * energy);
    assert!(
        Named::new(NamedParameters {
            m: -1.0,
            ..parameters
        })
        .is_err()
    );
}

#[test]
fn slices_of_another_length_give_nan() {
    let model = BinaryLoops::<f64>::new();
    let mut alpha = [0.0; 31];
    model.accelerations_into(0.0, &[0.0; 30], &[0.0; 31], &mut alpha);
    assert!(alpha.iter().all(|alpha| alpha.is_nan()));
    assert!(model.potential_energy(&[0.0; 3]).is_nan());
    assert!(model.kinetic_energy(&[0.0; 31], &[]).is_nan());
}
