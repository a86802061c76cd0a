//! A torque on the root in all vectors that the machine has, against links taken
//! one by one: of the root alone, of the first generations in a register, and of a
//! tree that is taken apart.

use super::super::evaluate::Kernels;
use super::super::{Generations, RootDrive};
use super::tests::{agree, arguments, kernels_in, largest};
use crate::generations::{Motion, Recursion};
use crate::scalar::register::Fused;
use crate::scalar::{Lane, Real, Scalar};
use alloc::vec::Vec;

const SHAPES: [&[usize]; 4] = [
    &[1, 2],
    &[1, 9, 2],
    &[1, 2, 2, 2, 2, 2],
    &[1, 3, 1, 11, 41, 7],
];

/// A tree of a shape, its last constant a torque.
struct Turned<const NUMBER: usize>;

const fn links(copies: &[usize]) -> usize {
    let (mut links, mut count, mut generation) = (0, 1, 0);
    while generation < copies.len() {
        count *= copies[generation];
        links += count;
        generation += 1;
    }
    links
}

fn node<V: Scalar>(
    &[_, inertia, moment, _, _, _, root_torque]: &[V; 7],
    link: Motion<V>,
    [xx, xy, yy]: [V; 3],
    [x, y]: [V; 2],
) -> ([V; 5], [V; 3]) {
    let (sine, cosine) = (link.sine, link.cosine);
    let pull_x = xx.mul_add(cosine, xy * sine);
    let pull_y = xy.mul_add(cosine, yy * sine);
    let (b_x, b_y) = (moment.mul_add(cosine, pull_x), moment.mul_add(sine, pull_y));
    let whole = sine.mul_add(pull_y, cosine.mul_add(pull_x, inertia));
    let square = link.omega * link.omega;
    let trace = xx + yy + moment;
    let f_x = square.mul_add((-trace).mul_add(sine, pull_y), x);
    let f_y = (-square).mul_add((-trace).mul_add(cosine, pull_x), y);
    let kappa = cosine.mul_add(f_x, sine * f_y) - root_torque;
    let inverse = V::from_f64(1.0) / whole;
    let (g_x, g_y) = (b_x * inverse, b_y * inverse);
    (
        [
            (-b_x).mul_add(g_x, xx),
            (-b_x).mul_add(g_y, xy),
            (-b_y).mul_add(g_y, yy),
            (-g_x).mul_add(kappa, f_x),
            (-g_y).mul_add(kappa, f_y),
        ],
        [g_x, g_y, kappa * inverse],
    )
}

impl<const NUMBER: usize> Recursion<7, 5, 5, 3> for Turned<NUMBER> {
    const LINKS: usize = links(SHAPES[NUMBER]);
    const COPIES: &'static [usize] = SHAPES[NUMBER];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = false;
    const TORQUE: bool = true;

    fn leaf<V: Scalar>(_: &[V; 7], link: Motion<V>) -> [V; 5] {
        let square = link.omega * link.omega;
        [
            link.sine * link.sine,
            link.cosine * link.sine,
            link.cosine * link.cosine,
            square * link.sine,
            square * link.cosine,
        ]
    }

    fn joined<V: Scalar>([xx, xy, yy, x, y]: [V; 5]) -> [V; 5] {
        [xx, -xy, yy, -x, y]
    }

    fn inner<V: Scalar>(
        constants: &[V; 7],
        link: Motion<V>,
        [xx, xy, yy, x, y]: [V; 5],
    ) -> ([V; 5], [V; 3]) {
        let &[rest, _, _, square, ratio, ..] = constants;
        let (xx, yy) = (square.mul_add(xx, rest), square.mul_add(yy, rest));
        node(
            constants,
            link,
            [xx, square * xy, yy],
            [ratio * x, ratio * y],
        )
    }

    fn turn<V: Scalar>(
        constants: &[V; 7],
        link: Motion<V>,
        [g_x, g_y, turn]: [V; 3],
        [x, y]: [V; 2],
    ) -> (V, [V; 2]) {
        let reach = constants[5];
        let alpha = g_x.mul_add(x, g_y.mul_add(y, -turn));
        let square = link.omega * link.omega;
        let end_x = square.mul_add(link.sine, (-alpha).mul_add(link.cosine, x));
        let end_y = (-square).mul_add(link.cosine, (-alpha).mul_add(link.sine, y));
        (alpha, [reach * end_x, reach * end_y])
    }

    fn turn_leaf<V: Scalar>(_: &[V; 7], link: Motion<V>, [x, y]: [V; 2]) -> V {
        link.cosine.mul_add(x, link.sine * y)
    }
}

fn evaluated<T: Scalar, const NUMBER: usize>(torque: f64, kernels: Option<Kernels<T>>) -> Vec<T> {
    let row = [0.5, 1.5, 0.3, 0.2, 0.4, 0.6, 0.0].map(T::from_f64);
    let rows = SHAPES[NUMBER].iter().map(|_| row).collect();
    let root = [0.0, -9.81].map(T::from_f64);
    let tree = Generations::<Turned<NUMBER>, T, 7, 5, 5, 3>::new(rows, root, &[]);
    let links = <Turned<NUMBER> as Recursion<7, 5, 5, 3>>::LINKS;
    let [theta, omega, mut alpha] = arguments(links);
    let drive = RootDrive {
        pivot: [0.7, -0.4].map(T::from_f64),
        torque: T::from_f64(torque),
    };
    match kernels {
        None => tree.driven_accelerations_into(drive, &theta, &omega, &mut alpha),
        Some(kernels) => {
            let loops = T::loops();
            let evaluate = loops.driven_accelerations_into;
            evaluate(&tree.tree, &kernels, drive, &theta, &omega, &mut alpha);
        }
    }
    alpha
}

fn kernels<T: Lane, const SET: usize, const NUMBER: usize>() -> Kernels<T> {
    kernels_in::<Turned<NUMBER>, T, SET, 7, 5, 5, 3>()
}

fn compare<T: Lane + Real, const NUMBER: usize>(one_by_one: impl Fn(usize) -> T) {
    let build = evaluated::<T, NUMBER>(5.0, Some(kernels::<T, 0, NUMBER>()));
    let avx2 = evaluated::<T, NUMBER>(5.0, Some(kernels::<T, 1, NUMBER>()));
    let widest = evaluated::<T, NUMBER>(5.0, None);
    agree(&widest, [&build, &avx2], one_by_one);
    let rounding = T::from_f64(64.0) * T::EPSILON * largest(&widest);
    // The torque is in the equations once: accelerations are linear in it.
    let still = evaluated::<T, NUMBER>(0.0, None);
    let twice = evaluated::<T, NUMBER>(10.0, None);
    assert!(widest[0] > still[0]);
    for ((&one, &none), &two) in widest.iter().zip(&still).zip(&twice) {
        let bend = Real::abs((one - none) - (two - one));
        assert!(bend <= rounding, "{none} {one} {two}");
    }
}

fn each_scalar<const NUMBER: usize>() {
    let one = evaluated::<Fused<f64>, NUMBER>(5.0, None);
    compare::<f64, NUMBER>(|link| one[link].0);
    let one = evaluated::<Fused<f32>, NUMBER>(5.0, None);
    compare::<f32, NUMBER>(|link| one[link].0);
}

#[test]
fn a_torque_on_the_root_has_the_same_bits_in_all_vectors() {
    each_scalar::<0>();
    each_scalar::<1>();
    each_scalar::<2>();
    // Taken apart.
    each_scalar::<3>();
}
