//! Numbers that notice memory which is none: each refers to a text, and looks at it whenever
//! something is computed.

use core::ops::{Add, Div, Mul, Neg, Sub};
use std::panic::catch_unwind;
use std::sync::atomic::{AtomicBool, Ordering};

use branched_pendulum::emitted::Simd;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Lanes;
use branched_pendulum::system::{InRegisters, Workspace};
use branched_pendulum::tree::{LinkEquations, LinkMotion, LinkStates, SmallTree, Tree};

/// A number and what it refers to.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Marked {
    mark: &'static str,
    value: f64,
}

const MARK: &str = "a number";

impl Marked {
    fn of(value: f64) -> Self {
        Self { mark: MARK, value }
    }

    fn value(self) -> f64 {
        assert_eq!(self.mark, MARK);
        self.value
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Marked {
            type Output = Self;

            fn $function(self, other: Self) -> Self {
                Self::of(self.value() $operator other.value())
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Marked {
    type Output = Self;

    fn neg(self) -> Self {
        Self::of(-self.value())
    }
}

impl Scalar for Marked {
    fn from_f64(value: f64) -> Self {
        Self::of(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.value());
        (Self::of(sine), Self::of(cosine))
    }

    fn sqrt(self) -> Self {
        Self::of(Scalar::sqrt(self.value()))
    }
}

/// Equations that mix all numbers that they are given, of a tree by rule or by links.
#[derive(Clone, Copy, Debug)]
struct Mixed<const SHAPE: usize>;

const SHAPES: [&[usize]; 5] = [
    &[],
    &[1, 2, 2, 2, 2],
    &[1, 5, 1, 3],
    &[1, 19, 7],
    &[1, 3, 2, 4, 2, 2],
];

impl<const SHAPE: usize> LinkEquations for Mixed<SHAPE> {
    type Constants<V: Scalar> = [V; 3];
    type Response<V: Scalar> = [V; 2];
    type Sums<V: Scalar> = [V; 2];
    type Elimination<V: Scalar> = [V; 1];
    type Carried<V: Scalar> = [V; 4];

    const COPIES: &'static [usize] = SHAPES[SHAPE];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = true;
    const TORQUE: bool = true;
    const FORCED: bool = true;

    fn leaf<V: Scalar>(&[a, b, torque]: &[V; 3], link: LinkMotion<V>) -> [V; 2] {
        let turned = a * link.sine + b * link.cosine + torque;
        [turned + link.outside_torque, turned * link.joint_angle]
    }

    fn attach<V: Scalar>(&[a, ..]: &[V; 3], parent: LinkMotion<V>, [x, y]: [V; 2]) -> [V; 2] {
        [x + a * parent.omega, y - a * parent.sine]
    }

    fn inner<V: Scalar>(
        constants: &[V; 3],
        link: LinkMotion<V>,
        [x, y]: [V; 2],
    ) -> ([V; 2], [V; 1]) {
        let [own, other] = Self::leaf(constants, link);
        ([own + x, other + y], [own - y])
    }

    fn pivot<V: Scalar>(&[_, b, _]: &[V; 3], parent: LinkMotion<V>, row: [V; 4]) -> [V; 2] {
        let [a, c, d, e] = row;
        [a + b * parent.cosine, c - d * e]
    }

    fn accelerate<V: Scalar>(
        &[a, b, torque]: &[V; 3],
        link: LinkMotion<V>,
        [kept]: [V; 1],
        [x, y]: [V; 2],
    ) -> (V, [V; 4]) {
        let tenth = V::from_f64(0.1);
        let alpha = tenth * (kept + a * x + b * y + torque + link.joint_rate);
        (alpha, [alpha, x * tenth, tenth * y, link.omega])
    }

    fn accelerate_leaf<V: Scalar>(&[a, b, _]: &[V; 3], link: LinkMotion<V>, p: [V; 2]) -> V {
        a * p[0] + b * p[1] - link.joint_angle + link.outside_torque
    }
}

fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count)
        .map(|i| ((i * 37 + seed * 11) % 101) as f64 / 101.0 - 0.5)
        .collect()
}

fn marked(numbers: &[f64]) -> Vec<Marked> {
    numbers.iter().copied().map(Marked::of).collect()
}

/// Compares marked numbers, and several of them side by side, with plain ones.
fn agrees<const SHAPE: usize>(plain: &Tree<Mixed<SHAPE>, f64>, links: usize) {
    let tree = plain.cast(Marked::of);
    let state = [1, 2, 3].map(|seed| numbers(links, seed));
    let [theta, omega, torques] = state.each_ref().map(|numbers| marked(numbers));
    let mut expected = vec![f64::NAN; links];
    let states = state.each_ref().map(Vec::as_slice);
    plain.evaluate_under(None, states, &mut expected);

    let mut alpha = vec![Marked::of(0.0); links];
    tree.evaluate_under(None, [&theta, &omega, &torques], &mut alpha);
    assert_eq!(alpha, marked(&expected));
    let mut alpha = vec![Marked::of(0.0); links];
    let mut workspace = Workspace::new();
    tree.accelerations_under_with(&mut workspace, None, [&theta, &omega, &torques], &mut alpha);
    for (own, other) in alpha.iter().zip(&expected) {
        assert!((own.value() - other).abs() < 1e-9, "{alpha:?} {expected:?}");
    }
    in_registers::<Lanes<f64, 1>, f64, SHAPE>(plain, &state[0], &state[1]);
    in_registers::<Lanes<f64, 3>, f64, SHAPE>(plain, &state[0], &state[1]);
    in_registers::<f64, f64, SHAPE>(plain, &state[0], &state[1]);
    in_registers::<Lanes<Marked, 1>, Marked, SHAPE>(&tree, &theta, &omega);
    in_registers::<Lanes<Marked, 17>, Marked, SHAPE>(&tree, &theta, &omega);
}

/// States in registers that another crate may name: the first lane has the numbers of the
/// state alone, whatever the room.
fn in_registers<V: Simd<T>, T: Scalar + PartialEq, const SHAPE: usize>(
    tree: &Tree<Mixed<SHAPE>, T>,
    theta: &[T],
    omega: &[T],
) {
    let mut expected = vec![T::from_f64(0.0); theta.len()];
    let of = |numbers: &[T], link: usize| numbers[link];
    tree.evaluate(
        None,
        |link| of(theta, link),
        |link| of(omega, link),
        |link, value| expected[link] = value,
    );
    for values in [
        0,
        1,
        tree.workspace_len() / 2,
        tree.workspace_len(),
        tree.workspace_len() + 1,
    ] {
        let mut buffer = vec![T::from_f64(0.0); values * V::LANES];
        let mut alpha = vec![None; theta.len()];
        tree.in_registers::<V>(None, &mut buffer).evaluate(
            |link| V::splat(of(theta, link)),
            |link| V::splat(of(omega, link)),
            |link, value: V| alpha[link] = Some(value.first()),
        );
        let reported: Vec<T> = alpha.iter().copied().flatten().collect();
        // All of them, or none where the room is too small.
        assert!(reported.is_empty() && values < tree.workspace_len() || reported == expected);
    }
}

fn by_rule<const SHAPE: usize>() {
    let copies = SHAPES[SHAPE].iter();
    let counts = copies.scan(1, |count, copies| {
        *count *= copies;
        Some(*count)
    });
    let rows = numbers(3 * SHAPES[SHAPE].len(), 5);
    agrees(
        &Tree::<Mixed<SHAPE>, f64>::new(rows, [0.0, 1.0]),
        counts.sum(),
    );
}

#[test]
fn trees_read_nothing_but_numbers() {
    by_rule::<1>();
    by_rule::<2>();
    by_rule::<3>();
    by_rule::<4>();
    for links in [1, 2, 7, 40, 300] {
        for spread in [1, 2, 5, 100] {
            let parents: Vec<u32> = (0..links)
                .map(|link| link.max(1) - 1)
                .map(|i| i / spread)
                .collect();
            let rows = numbers(3 * parents.len(), 4);
            let tree = Tree::<Mixed<0>, f64>::with_parents(&parents, &rows, [0.0, 1.0]);
            agrees(&tree, parents.len());
            small(&parents, rows);
        }
    }
}

/// A small tree in marked numbers, under torques or not, with too few and too many rows.
fn small(parents: &[u32], rows: Vec<f64>) {
    let state = [1, 2, 3].map(|seed| marked(&numbers(parents.len(), seed)));
    for rows in [&rows[..], &rows[..1], &[]] {
        let tree = SmallTree::<Mixed<0>, _>::new(parents, marked(rows), [Marked::of(0.1); 2]);
        for torques in [None, Some(&*state[2])] {
            let mut alpha = vec![Marked::of(f64::NAN); parents.len()];
            let states = LinkStates {
                theta: &state[0],
                omega: &state[1],
                torques,
            };
            tree.accelerations_with(&mut Workspace::new(), None, states, &mut alpha);
            assert!(alpha.iter().all(|number| number.value().is_finite()));
        }
    }
}

/// Equations that give up on the way.
#[derive(Clone, Copy, Debug)]
struct Fails;

static FAILS: AtomicBool = AtomicBool::new(false);

impl LinkEquations for Fails {
    type Constants<V: Scalar> = [V; 0];
    type Response<V: Scalar> = [V; 1];
    type Sums<V: Scalar> = [V; 1];
    type Elimination<V: Scalar> = [V; 0];
    type Carried<V: Scalar> = [V; 0];

    const COPIES: &'static [usize] = &[1, 20, 700];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = false;
    const TORQUE: bool = false;

    fn leaf<V: Scalar>(_: &[V; 0], link: LinkMotion<V>) -> [V; 1] {
        [link.sine]
    }

    fn attach<V: Scalar>(_: &[V; 0], _: LinkMotion<V>, response: [V; 1]) -> [V; 1] {
        response
    }

    fn inner<V: Scalar>(_: &[V; 0], _: LinkMotion<V>, below: [V; 1]) -> ([V; 1], [V; 0]) {
        assert!(!FAILS.load(Ordering::Relaxed), "as it was told to");
        (below, [])
    }

    fn pivot<V: Scalar>(_: &[V; 0], link: LinkMotion<V>, _: [V; 0]) -> [V; 2] {
        [link.sine; 2]
    }

    fn accelerate<V: Scalar>(_: &[V; 0], _: LinkMotion<V>, _: [V; 0], p: [V; 2]) -> (V, [V; 0]) {
        (p[0], [])
    }

    fn accelerate_leaf<V: Scalar>(_: &[V; 0], _: LinkMotion<V>, pivot: [V; 2]) -> V {
        pivot[1]
    }
}

#[test]
fn equations_that_panic_leave_memory_in_order() {
    let mut tree = Tree::<Fails, f64>::new(Vec::new(), [1.0; 2]);
    // More threads than there are blocks.
    tree.set_threads(std::num::NonZeroUsize::MAX);
    let links = 1 + 20 + 20 * 700;
    let theta = vec![0.5; links];
    let evaluate = || {
        let mut alpha = vec![f64::NAN; links];
        tree.accelerations_with(&mut Workspace::new(), None, &theta, &theta, &mut alpha);
        alpha
    };
    let before = evaluate();
    assert!(before.iter().all(|alpha| alpha.is_finite()));
    FAILS.store(true, Ordering::Relaxed);
    assert!(catch_unwind(evaluate).is_err());
    FAILS.store(false, Ordering::Relaxed);
    assert_eq!(evaluate(), before);
}
