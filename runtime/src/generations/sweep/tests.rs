//! Trees of many shapes in all vectors that the machine has, against links taken
//! one by one.

use super::super::Generations;
use super::super::evaluate::Kernels;
use super::super::vectors::run_in;
use super::equations::{Down, Up};
use crate::generations::vector::SliceKernel;
use crate::generations::{Motion, Recursion};
use crate::scalar::register::Fused;
use crate::scalar::{InstructionSet, Lane, Real, Scalar};
use alloc::vec::Vec;
use core::marker::PhantomData;

/// Copies of each generation: numbers of siblings below, at and above the lanes of
/// every register, and none that is a power of two.
const SHAPES: [&[usize]; 10] = [
    &[1, 1, 1, 1, 1],
    &[1, 2],
    &[1, 3, 3],
    &[1, 5, 1, 2],
    &[1, 7, 3],
    &[1, 9, 2],
    &[1, 17, 2],
    &[1, 2, 2, 2, 2, 2, 2],
    &[1, 3, 1, 11, 41, 7],
    &[1, 600, 14, 11, 4],
];

/// A tree of a shape whose joints have friction and springs.
pub(in crate::generations) struct Shape<const NUMBER: usize>;

const fn links(copies: &[usize]) -> usize {
    let (mut links, mut count, mut generation) = (0, 1, 0);
    while generation < copies.len() {
        count *= copies[generation];
        links += count;
        generation += 1;
    }
    links
}

/// The torque in a link's pivot.
fn torque<V: Scalar>(constants: &[V; 8], link: Motion<V>) -> V {
    constants[6] * link.bend_rate + constants[7] * link.bend
}

fn node<V: Scalar>(
    constants: &[V; 8],
    link: Motion<V>,
    [xx, xy, yy]: [V; 3],
    [x, y]: [V; 2],
    below: V,
) -> ([V; 6], [V; 3]) {
    let &[_, inertia, moment, ..] = constants;
    let (sine, cosine) = (link.sine, link.cosine);
    let pull_x = xx.mul_add(cosine, xy * sine);
    let pull_y = xy.mul_add(cosine, yy * sine);
    let (b_x, b_y) = (moment.mul_add(cosine, pull_x), moment.mul_add(sine, pull_y));
    let whole = sine.mul_add(pull_y, cosine.mul_add(pull_x, inertia));
    let square = link.omega * link.omega;
    let trace = xx + yy + moment;
    let f_x = square.mul_add((-trace).mul_add(sine, pull_y), x);
    let f_y = (-square).mul_add((-trace).mul_add(cosine, pull_x), y);
    let kappa = cosine.mul_add(f_x, sine * f_y) - (below - torque(constants, link));
    let inverse = V::from_f64(1.0) / whole;
    let (g_x, g_y) = (b_x * inverse, b_y * inverse);
    (
        [
            (-b_x).mul_add(g_x, xx),
            (-b_x).mul_add(g_y, xy),
            (-b_y).mul_add(g_y, yy),
            (-g_x).mul_add(kappa, f_x),
            (-g_y).mul_add(kappa, f_y),
            torque(constants, link),
        ],
        [g_x, g_y, kappa * inverse],
    )
}

impl<const NUMBER: usize> Recursion<8, 6, 6, 3> for Shape<NUMBER> {
    const LINKS: usize = links(SHAPES[NUMBER]);
    const COPIES: &'static [usize] = SHAPES[NUMBER];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = true;

    fn leaf<V: Scalar>(constants: &[V; 8], link: Motion<V>) -> [V; 6] {
        let square = link.omega * link.omega;
        let push = -(torque(constants, link)) * constants[1];
        [
            link.sine * link.sine,
            link.cosine * link.sine,
            link.cosine * link.cosine,
            square * link.sine - push * link.cosine,
            square.mul_add(link.cosine, push * link.sine),
            torque(constants, link),
        ]
    }

    fn joined<V: Scalar>([xx, xy, yy, x, y, below]: [V; 6]) -> [V; 6] {
        [xx, -xy, yy, -x, y, below]
    }

    fn inner<V: Scalar>(
        constants: &[V; 8],
        link: Motion<V>,
        [xx, xy, yy, x, y, below]: [V; 6],
    ) -> ([V; 6], [V; 3]) {
        let &[rest, _, _, square, ratio, ..] = constants;
        let phi = [
            square.mul_add(xx, rest),
            square * xy,
            square.mul_add(yy, rest),
        ];
        node(constants, link, phi, [ratio * x, ratio * y], below)
    }

    fn turn<V: Scalar>(
        constants: &[V; 8],
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

    fn turn_leaf<V: Scalar>(constants: &[V; 8], link: Motion<V>, [x, y]: [V; 2]) -> V {
        let swing = link.cosine.mul_add(x, link.sine * y);
        swing - torque(constants, link) * constants[1]
    }
}

type Tree<T, const NUMBER: usize> = Generations<Shape<NUMBER>, T, 8, 6, 6, 3>;

fn tree<T: Scalar, const NUMBER: usize>() -> Tree<T, NUMBER> {
    let row = [0.5, 1.5, 0.3, 0.2, 0.4, 0.6, 0.01, 0.02].map(T::from_f64);
    let rows = SHAPES[NUMBER].iter().map(|_| row).collect();
    Generations::new(rows, [0.0, -9.81].map(T::from_f64), &[])
}

/// Numbers between −`size` and `size`.
pub(in crate::generations) fn numbers(links: usize, seed: usize, size: f64) -> Vec<f64> {
    let number = |i: usize| (((i + seed) * 7919) % 1009) as f64 / 504.5 - 1.0;
    (0..links).map(|i| size * number(i)).collect()
}

/// Angles and velocities of so many links, and where accelerations are to be written.
pub(super) fn arguments<T: Scalar>(links: usize) -> [Vec<T>; 3] {
    [(1, 3.0), (500, 2.0), (0, f64::NAN)].map(|(seed, size)| {
        let numbers = numbers(links, seed, size);
        numbers.into_iter().map(T::from_f64).collect()
    })
}

fn evaluated<T: Scalar, const NUMBER: usize>(kernels: Option<Kernels<T>>) -> Vec<T> {
    let tree = tree::<T, NUMBER>();
    let [theta, omega, mut alpha] = arguments(links(SHAPES[NUMBER]));
    match kernels {
        None => tree.accelerations_into(&theta, &omega, &mut alpha),
        Some(kernels) => {
            (T::loops().accelerations_into)(&tree.tree, &kernels, &theta, &omega, &mut alpha);
        }
    }
    alpha
}

/// Equations in the vectors of one instruction set, by its number.
pub(super) fn kernels_in<
    P,
    T,
    const SET: usize,
    const C: usize,
    const L: usize,
    const R: usize,
    const K: usize,
>() -> Kernels<T>
where
    P: Recursion<C, L, R, K>,
    T: Lane,
{
    fn of<const SET: usize, T: Lane>(kernel: impl SliceKernel<T>) {
        run_in(InstructionSet::ALL[SET], kernel);
    }
    Kernels {
        up: |access| of::<SET, T>(Up::<P, T, C, L, R, K>(access, PhantomData)),
        down: |access| of::<SET, T>(Down::<P, T, C, L, R, K>(access, PhantomData)),
    }
}

fn kernels<T: Lane, const SET: usize, const NUMBER: usize>() -> Kernels<T> {
    kernels_in::<Shape<NUMBER>, T, SET, 8, 6, 6, 3>()
}

/// Compares accelerations in the widest vectors with those in the build's own and in
/// AVX2, where there is AVX-512 too, and with links one by one.
pub(super) fn agree<T: Real>(
    widest: &[T],
    [build, avx2]: [&[T]; 2],
    one_by_one: impl Fn(usize) -> T,
) {
    let links = widest.len();
    assert_eq!([build.len(), avx2.len()], [links; 2]);
    if InstructionSet::widest() >= InstructionSet::Avx2 {
        for (link, (own, other)) in widest.iter().zip(avx2).enumerate() {
            assert!(own == other, "link {link} of {links}: {own} {other}");
        }
        for (link, &own) in widest.iter().enumerate() {
            let one = one_by_one(link);
            assert!(own == one, "link {link} of {links}: {own} {one}");
        }
    } else {
        std::println!("skipped: no vectors that fuse on this machine");
    }
    // What does not fuse rounds otherwise.
    let rounding = T::from_f64(64.0) * T::EPSILON * largest(widest);
    for (&own, &other) in widest.iter().zip(build) {
        assert!(own.is_finite() && Real::abs(own - other) <= rounding);
    }
}

pub(super) fn largest<T: Real>(alpha: &[T]) -> T {
    let sizes = alpha.iter().map(|&alpha| Real::abs(alpha));
    sizes.fold(T::ZERO, |largest, size| largest.max(size))
}

fn compare<T: Lane + Real, const NUMBER: usize>(one_by_one: impl Fn(usize) -> T) {
    let build = evaluated::<T, NUMBER>(Some(kernels::<T, 0, NUMBER>()));
    let avx2 = evaluated::<T, NUMBER>(Some(kernels::<T, 1, NUMBER>()));
    let widest = evaluated::<T, NUMBER>(None);
    agree(&widest, [&build, &avx2], one_by_one);
}

fn each_scalar<const NUMBER: usize>() {
    let one = evaluated::<Fused<f64>, NUMBER>(None);
    compare::<f64, NUMBER>(|link| one[link].0);
    let one = evaluated::<Fused<f32>, NUMBER>(None);
    compare::<f32, NUMBER>(|link| one[link].0);
}

#[test]
fn vectors_have_the_bits_of_links_one_by_one() {
    each_scalar::<0>();
    each_scalar::<1>();
    each_scalar::<2>();
    each_scalar::<3>();
    each_scalar::<4>();
    each_scalar::<5>();
    each_scalar::<6>();
    each_scalar::<7>();
    // Taken apart.
    each_scalar::<8>();
    // Twice, and so large that parts go up twice.
    each_scalar::<9>();
}
