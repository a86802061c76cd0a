//! Irregular trees whose code is a loop over a table, against the same trees
//! written out, against the closed form, and random.

mod random_trees;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_codegen::scene::{Layout, Scene};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source;
use branched_pendulum_tests::bodies::bodies_of;
use branched_pendulum_tests::oracle::{Tree, closed_form};
use nalgebra::DMatrix;

/// A tree in a table, the same one written out, and its text.
macro_rules! pair {
    ($table:ident, $unrolled:ident, $text:ident: $($tree:tt)*) => {
        #[branched_pendulum(gravity = 9.80665, code = loops, emit(energies), $($tree)*)]
        struct $table;

        #[branched_pendulum(gravity = 9.80665, code = unrolled, emit(energies), $($tree)*)]
        struct $unrolled;

        const $text: &str = concat!("gravity = 9.80665, code = loops, ", stringify!($($tree)*));
    };
}

pair!(BushTable, BushUnrolled, BUSH:
    trunk: rod(mass = 0.3, length = 0.4) [
        twig: point(mass = 0.05, length = 0.2),
        bough: rod(mass = 0.1, length = 0.3) [
            stick: rod(mass = 0.03, length = 0.1) * 3,
            chain: generations(count = 4, branching = 1, shape = rod, mass = 0.02, length = 0.1),
            leaf: disc(mass = 0.01, length = 0.05, radius = 0.02),
        ],
    ]
);
pair!(SprungTable, SprungUnrolled, SPRUNG:
    trunk(mass = 0.2, com = -0.03, inertia = 1e-3, joint = -0.2, friction = 1e-4) [
        arm: rod(mass = 0.1, length = 0.25, spring = 0.01) [
            hand(mass = 0.04, com = 0.1, inertia = 0, drag = 2e-4),
            fork: generations(count = 3, branching = 2, shape = rod, mass = 0.02, length = 0.1,
                length_ratio = 0.8, friction = 1e-5),
        ] * 2,
        tail: point(mass = 0.03, length = 0.3, spring = 0.02),
    ]
);
// 158 links.
pair!(LargeTable, LargeUnrolled, LARGE:
    trunk: rod(mass = 0.5, length = 0.4) [
        left: generations(count = 6, branching = 2, shape = rod, mass = 0.1, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        right: generations(count = 4, branching = 3, shape = rod, mass = 0.1, length = 0.2,
            mass_ratio = 0.4, length_ratio = 0.8),
        tail: generations(count = 11, branching = 1, shape = point, mass = 0.02, length = 0.05),
        bough: rod(mass = 0.1, length = 0.3) [ stick: rod(mass = 0.02, length = 0.1) * 13 ] * 3,
        twig: point(mass = 0.05, length = 0.2),
    ]
);

fn scene_of(text: &str) -> Scene {
    source::stages_of(&format!("#[branched_pendulum({text})] struct Sample;")).scene
}

fn states(n: usize, count: usize) -> impl Iterator<Item = [Vec<f64>; 2]> {
    let mut random = Random::new(7);
    (0..count).map(move |_| [random.around_zero(n, 3.0), random.around_zero(n, 9.0)])
}

/// The closed form's accelerations, and their conditioning bound
/// |M⁻¹| (|M| |ω̇| + |b|) with |b| term by term.
fn expected(tree: &Tree, theta: &[f64], omega: &[f64]) -> [Vec<f64>; 2] {
    let n = tree.links.len();
    let (mass, bias) = closed_form::equations(tree, theta, omega);
    let inverse: DMatrix<f64> = mass.clone().try_inverse().unwrap();
    let alpha: Vec<f64> = (0..n)
        .map(|i| -(0..n).map(|j| inverse[(i, j)] * bias[j]).sum::<f64>())
        .collect();
    let force = |i: usize| {
        let row = (0..n).map(|j| {
            let coupling = (mass[(i, i)] * mass[(j, j)]).sqrt() * f64::from(mass[(i, j)] != 0.0);
            mass[(i, j)].abs() * alpha[j].abs() + coupling * omega[j] * omega[j]
        });
        row.sum::<f64>() + bias[i].abs()
    };
    let forces: Vec<f64> = (0..n).map(force).collect();
    let bound = (0..n).map(|i| (0..n).map(|j| inverse[(i, j)].abs() * forces[j]).sum());
    let bound = bound.collect();
    [alpha, bound]
}

fn largest(own: &[f64], other: &[f64], bound: &[f64]) -> f64 {
    let parts = own.iter().zip(other).zip(bound);
    parts
        .map(|((own, other), bound)| (own - other).abs() / bound)
        .inspect(|part| assert!(part.is_finite()))
        .fold(0.0, f64::max)
}

/// Weights times the farthest that their bodies can be from the root's pivot:
/// potential energies of links that point up and down cancel.
fn lifted(tree: &Tree) -> f64 {
    let links = tree.links.iter().enumerate();
    let sizes = links.map(|(index, link)| {
        let levers = tree.lineage(index).into_iter();
        let reach: f64 = levers.map(|link| tree.links[link].pivot[0].abs()).sum();
        tree.gravity * link.mass * (reach + link.com[0].abs())
    });
    sizes.sum()
}

fn agree<L: Energy<f64>, U: Energy<f64>>(table: &L, unrolled: &U, text: &str) {
    let n = unrolled.links();
    assert_eq!(table.links(), n);
    assert_eq!(table.link_names(), unrolled.link_names());
    let tree = bodies_of(&scene_of(text));
    let mut worst = 0.0_f64;
    for [theta, omega] in states(n, 50) {
        let (mut own, mut other) = (vec![f64::NAN; n], vec![f64::NAN; n]);
        table.accelerations_into(0.0, &theta, &omega, &mut own);
        unrolled.accelerations_into(0.0, &theta, &omega, &mut other);
        let [right, bound] = expected(&tree, &theta, &omega);
        worst = worst.max(largest(&own, &other, &bound));
        assert!(largest(&own, &right, &bound) <= 1e-12);
        let energies = [
            (
                table.kinetic_energy_of(&theta, &omega),
                unrolled.kinetic_energy_of(&theta, &omega),
            ),
            (
                table.potential_energy_of(&theta),
                unrolled.potential_energy_of(&theta),
            ),
        ];
        for ((own, other), size) in energies.into_iter().zip([0.0, lifted(&tree)]) {
            let size = size.max(other.abs());
            assert!((own - other).abs() <= 1e-14 * size, "{own} {other}");
        }
    }
    println!("{n} links: worst {worst:.1e} of the bound");
    assert!(worst < 2.0 * f64::EPSILON, "{worst:e}");
}

#[test]
fn tables_agree_with_code_written_out_and_with_the_closed_form() {
    agree(&BushTable::<f64>::new(), &BushUnrolled::<f64>::new(), BUSH);
    agree(
        &SprungTable::<f64>::new(),
        &SprungUnrolled::<f64>::new(),
        SPRUNG,
    );
    agree(
        &LargeTable::<f64>::new(),
        &LargeUnrolled::<f64>::new(),
        LARGE,
    );
}

/// The sprung tree, more or less, with parameters.
#[branched_pendulum(
    gravity = g,
    code = loops,
    trunk: rod(mass = m, length = l, friction = c) [
        arm: rod(mass = m / 2, length = 0.25) [ hand: point(mass = 0.04, length = l / 3) * 2 ],
        tail: point(mass = 0.03, length = 0.3, spring = k),
    ],
    emit(energies),
)]
struct Named;

#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 0.2, length = 0.3, friction = 1e-3) [
        arm: rod(mass = 0.1, length = 0.25) [ hand: point(mass = 0.04, length = 0.1) * 2 ],
        tail: point(mass = 0.03, length = 0.3, spring = 0.02),
    ],
    emit(energies),
)]
struct Literal;

#[test]
fn parameters_give_the_tree_of_their_values() {
    let parameters = NamedParameters {
        g: 9.80665,
        m: 0.2,
        l: 0.3,
        c: 1e-3,
        k: 0.02,
    };
    let (named, literal) = (Named::new(parameters).unwrap(), Literal::<f64>::new());
    for [theta, omega] in states(5, 20) {
        let (theta, omega) = (
            theta.as_slice().try_into().unwrap(),
            omega.as_slice().try_into().unwrap(),
        );
        let own = named.accelerations(theta, omega);
        let other = literal.accelerations(theta, omega);
        let size = other
            .iter()
            .fold(0.0, |size: f64, alpha| size.max(alpha.abs()));
        for (own, other) in own.iter().zip(&other) {
            assert!((own - other).abs() < 1e-12 * size);
        }
        let (own, other) = (
            named.kinetic_energy(theta, omega) + named.potential_energy(theta),
            literal.kinetic_energy(theta, omega) + literal.potential_energy(theta),
        );
        assert!((own - other).abs() < 1e-14 * other);
    }
    let impossible = NamedParameters {
        m: -1.0,
        ..parameters
    };
    assert!(Named::new(impossible).is_err());
}

/// Other scalars, one by one: double-double and single against double.
#[test]
fn other_scalars_compute_the_same_tree() {
    let n = SprungTable::LINKS;
    let [theta, omega] = states(n, 1).next().unwrap();
    let mut alpha = vec![0.0; n];
    SprungTable::<f64>::new().accelerations_into(0.0, &theta, &omega, &mut alpha);
    let wide = |numbers: &[f64]| -> Vec<Double> {
        numbers.iter().copied().map(Double::from_f64).collect()
    };
    let mut doubles = vec![Double::from_f64(0.0); n];
    let zero = Double::from_f64(0.0);
    SprungTable::<Double>::default().accelerations_into(
        zero,
        &wide(&theta),
        &wide(&omega),
        &mut doubles,
    );
    let mut unrolled = vec![zero; n];
    SprungUnrolled::<Double>::default().accelerations_into(
        zero,
        &wide(&theta),
        &wide(&omega),
        &mut unrolled,
    );
    let size = alpha
        .iter()
        .fold(0.0, |size: f64, alpha| size.max(alpha.abs()));
    for ((alpha, double), other) in alpha.iter().zip(&doubles).zip(&unrolled) {
        assert!((alpha - double.to_f64()).abs() < 1e-13 * size);
        // Constants are exact in 106 bits too.
        assert!((*double - *other).to_f64().abs() < 1e-27 * size);
    }
}

#[test]
fn a_table_keeps_its_energy() {
    let model = LargeTable::<f64>::new();
    let n = LargeTable::LINKS;
    let start = State::at_rest(0.0, &Random::new(5).around_zero(n, 1.0));
    let energy = |state: &State<f64>| {
        model.kinetic_energy(state.positions(), state.velocities())
            + model.potential_energy(state.positions())
    };
    let end = Rk4::new(1e-4)
        .run(&AbsoluteAngles(&model), &start, 0.1)
        .unwrap()
        .state;
    let moved = model.kinetic_energy(end.positions(), end.velocities());
    let change = energy(&end) - energy(&start);
    println!("kinetic energy {moved:e} J, change of the whole {change:e} J");
    assert!(moved > 0.01, "{moved:e}");
    assert!(change.abs() < 1e-9 * moved, "{change:e}");
}

#[test]
fn slices_of_another_length_give_nan() {
    let model = BushTable::<f64>::new();
    let mut alpha = [0.0; 11];
    model.accelerations_into(0.0, &[0.0; 3], &[0.0; 11], &mut alpha);
    assert!(alpha.iter().all(|alpha| alpha.is_nan()));
    assert!(model.potential_energy(&[0.0; 3]).is_nan());
    assert!(model.kinetic_energy(&[0.0; 11], &[]).is_nan());
}

/// A chain under another link: `links` links.
fn comb(links: usize, more: &str) -> String {
    let (teeth, chain) = (links / 2, links - links / 2 - 1);
    format!(
        "gravity = 9.81, trunk: rod(mass = 0.3, length = 0.4) [
             tooth: rod(mass = 0.1, length = 0.2) * {teeth},
             chain: generations(count = {chain}, branching = 1, shape = rod, mass = 0.1,
                 length = 0.1),
         ]{more}"
    )
}

#[test]
fn large_trees_get_a_table_of_a_few_lines_a_link() {
    let lines = |links: usize| {
        let stages = source::stages_of(&format!(
            "#[branched_pendulum({})] struct Sample;",
            comb(links, ", emit(energies)")
        ));
        assert_eq!(stages.scene.links.len(), links);
        assert_eq!(stages.scene.layout, Layout::Links);
        let text = branched_pendulum_codegen::layout(stages.tokens().clone()).unwrap();
        text.lines().count()
    };
    let [few, many] = [101, 401].map(lines);
    println!("{few} and {many} lines");
    // A number on each line, up to seventeen of two constants a row.
    assert!(many - few <= 300 * 20, "{few} {many}");
    // Head with an example of fifteen lines, traits and link functions beside the tables.
    assert!(few <= 101 * 20 + 345, "{few}");
}

#[test]
fn small_trees_and_what_no_loop_does_are_written_out() {
    assert_eq!(scene_of(&comb(12, "")).layout, Layout::Unrolled);
    assert_eq!(
        scene_of(&comb(101, ", code = unrolled")).layout,
        Layout::Unrolled
    );
    assert_eq!(
        scene_of(&comb(101, ", solve = factorization")).layout,
        Layout::Unrolled
    );
}
