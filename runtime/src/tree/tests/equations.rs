//! Equations of links written by hand, with forces in the joints, torques from outside and
//! one on the root: `docs/physics.md`, section 2.

use alloc::vec::Vec;

use super::super::memory::Sizes;
use super::super::skeleton::Skeleton;
use super::super::{LinkEquations, LinkMotion, Tree};
use super::numbers;
use crate::scalar::Scalar;

/// Copies of each generation, of trees that one set of compiled equations serves: those that
/// it is compiled for come last. Numbers of siblings below, at and above the lanes of every
/// register, and none that is a power of two.
pub(super) type Shapes = &'static [&'static [usize]];

pub(super) const CHAINS: Shapes = &[&[1, 1, 1, 1, 1]];
/// One of them in more than one block: for states in lanes, and for one state.
pub(super) const PAIRS: Shapes = &[
    &[1, 2],
    &[1, 2, 2, 2, 2, 2, 2],
    &[1, 2, 2, 2, 2, 2, 2, 2, 2],
];
pub(super) const TRIPLES: Shapes = &[&[1, 3, 3]];
pub(super) const FOURS: Shapes = &[&[1, 4, 4, 4]];
pub(super) const MIXED: Shapes = &[
    &[1, 5, 1, 2],
    &[1, 7, 3],
    &[1, 9, 2],
    &[1, 17, 2],
    &[1, 3, 1, 11, 41, 7],
    // Blocks of blocks, so many that they go up twice.
    &[1, 600, 14, 11, 4],
];

/// All of them, each as `CommonPivot<PLACE>` knows it.
pub(super) const ALL: [Shapes; 5] = [CHAINS, PAIRS, TRIPLES, FOURS, MIXED];

/// A body and its joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampleBody {
    pub(super) mass: f64,
    /// About the pivot.
    pub(super) inertia: f64,
    /// First moment.
    pub(super) moment: f64,
    /// Place of its own pivot on the parent, along and across.
    pub(super) place: [f64; 2],
    pub(super) friction: f64,
    pub(super) spring: f64,
}

impl SampleBody {
    pub(super) fn new(kind: usize) -> Self {
        let size = 1.0 + 0.1 * (kind % 7) as f64;
        Self {
            mass: 0.5 * size,
            inertia: 0.3 * size,
            moment: 0.2 / size,
            place: [0.4 * size, 0.1 * (kind % 3) as f64],
            friction: 0.01 * size,
            spring: 0.02,
        }
    }
}

fn scaled<V: Scalar>([x, y]: [V; 2], factor: V) -> [V; 2] {
    [x * factor, y * factor]
}

fn plus<V: Scalar>([x, y]: [V; 2], [u, v]: [V; 2]) -> [V; 2] {
    [x + u, y + v]
}

fn dot<V: Scalar>([x, y]: [V; 2], [u, v]: [V; 2]) -> V {
    x.mul_add(u, y * v)
}

fn times<V: Scalar>([xx, xy, yy]: [V; 3], vector: [V; 2]) -> [V; 2] {
    [dot([xx, xy], vector), dot([xy, yy], vector)]
}

/// The place (along, across) on a link, from its pivot, and its derivative by the
/// angle.
fn place<V: Scalar>(link: LinkMotion<V>, [along, across]: [V; 2]) -> [[V; 2]; 2] {
    let (u, v) = ([link.sine, -link.cosine], [link.cosine, link.sine]);
    [
        plus(scaled(u, along), scaled(v, across)),
        plus(scaled(v, along), scaled(u, -across)),
    ]
}

/// Sums over the children of a link: articulated inertia Φ, Φ w, w Φ w, bias
/// force, w · bias force, torque; w the derivatives of their pivots.
type Sums<V> = [V; 10];

type Constants<V> = [V; 8];

fn attached<V: Scalar>(link: LinkMotion<V>, at: [V; 2], response: [V; 6]) -> Sums<V> {
    let [xx, xy, yy, x, y, torque] = response;
    let [p, w] = place(link, at);
    let (inertia, square) = ([xx, xy, yy], link.omega * link.omega);
    let pull = times(inertia, w);
    let force = plus([x, y], scaled(times(inertia, p), -square));
    let [pull_x, pull_y] = pull;
    let [f_x, f_y] = force;
    [
        xx,
        xy,
        yy,
        pull_x,
        pull_y,
        dot(w, pull),
        f_x,
        f_y,
        dot(w, force),
        torque,
    ]
}

fn solved<V: Scalar>(
    constants: &Constants<V>,
    link: LinkMotion<V>,
    sums: Sums<V>,
) -> ([V; 6], [V; 3]) {
    let &[mass, inertia, moment, _, _, friction, spring, root_torque] = constants;
    let [xx, xy, yy, pull_x, pull_y, whole, f_x, f_y, along, below] = sums;
    let (u, v) = ([link.sine, -link.cosine], [link.cosine, link.sine]);
    let b = plus(scaled(v, moment), [pull_x, pull_y]);
    let whole = inertia + whole;
    let joint = friction * link.joint_rate + spring * link.joint_angle;
    let kappa = along - (below + root_torque + link.outside_torque - joint);
    let square = link.omega * link.omega;
    let force = plus([f_x, f_y], scaled(u, -(square * moment)));
    let g = scaled(b, V::from_f64(1.0) / whole);
    let force = plus(force, scaled(g, -kappa));
    let ([b_x, b_y], [g_x, g_y]) = (b, g);
    (
        [
            mass + xx - b_x * g_x,
            xy - b_x * g_y,
            mass + yy - b_y * g_y,
            force[0],
            force[1],
            joint,
        ],
        [g_x, g_y, kappa / whole],
    )
}

fn carried<V: Scalar>(link: LinkMotion<V>, at: [V; 2], [x, y, alpha]: [V; 3]) -> [V; 2] {
    let [p, w] = place(link, at);
    let square = link.omega * link.omega;
    plus([x, y], plus(scaled(w, alpha), scaled(p, -square)))
}

fn accelerated<V: Scalar>([g_x, g_y, kappa]: [V; 3], pivot: [V; 2]) -> V {
    -(dot([g_x, g_y], pivot) + kappa)
}

/// Links whose children share one pivot; its place is among the constants of the
/// link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CommonPivot<const PLACE: usize>;

impl<const PLACE: usize> LinkEquations for CommonPivot<PLACE> {
    type Constants<V: Scalar> = Constants<V>;
    type Response<V: Scalar> = [V; 6];
    type Sums<V: Scalar> = [V; 6];
    type Elimination<V: Scalar> = [V; 3];
    type Carried<V: Scalar> = [V; 2];

    const COPIES: &'static [usize] = ALL[PLACE][ALL[PLACE].len() - 1];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = true;
    const TORQUE: bool = true;
    const FORCED: bool = true;

    fn leaf<V: Scalar>(constants: &Constants<V>, link: LinkMotion<V>) -> [V; 6] {
        solved(constants, link, [V::from_f64(0.0); 10]).0
    }

    fn attach<V: Scalar>(_: &Constants<V>, _: LinkMotion<V>, response: [V; 6]) -> [V; 6] {
        response
    }

    fn inner<V: Scalar>(
        constants: &Constants<V>,
        link: LinkMotion<V>,
        below: [V; 6],
    ) -> ([V; 6], [V; 3]) {
        let at = [constants[3], constants[4]];
        solved(constants, link, attached(link, at, below))
    }

    fn pivot<V: Scalar>(_: &Constants<V>, _: LinkMotion<V>, carried: [V; 2]) -> [V; 2] {
        carried
    }

    fn accelerate<V: Scalar>(
        constants: &Constants<V>,
        link: LinkMotion<V>,
        elimination: [V; 3],
        pivot: [V; 2],
    ) -> (V, [V; 2]) {
        let alpha = accelerated(elimination, pivot);
        let at = [constants[3], constants[4]];
        (alpha, carried(link, at, [pivot[0], pivot[1], alpha]))
    }

    fn accelerate_leaf<V: Scalar>(
        constants: &Constants<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
    ) -> V {
        let (_, elimination) = solved(constants, link, [V::from_f64(0.0); 10]);
        accelerated(elimination, pivot)
    }
}

/// Links that carry each child at a place of its own, in trees of any shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OwnPivots;

impl LinkEquations for OwnPivots {
    type Constants<V: Scalar> = Constants<V>;
    type Response<V: Scalar> = [V; 6];
    type Sums<V: Scalar> = Sums<V>;
    type Elimination<V: Scalar> = [V; 3];
    type Carried<V: Scalar> = [V; 3];

    const COPIES: &'static [usize] = &[];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = true;
    const TORQUE: bool = true;
    const FORCED: bool = true;

    fn leaf<V: Scalar>(constants: &Constants<V>, link: LinkMotion<V>) -> [V; 6] {
        solved(constants, link, [V::from_f64(0.0); 10]).0
    }

    fn attach<V: Scalar>(child: &Constants<V>, parent: LinkMotion<V>, response: [V; 6]) -> Sums<V> {
        attached(parent, [child[3], child[4]], response)
    }

    fn inner<V: Scalar>(
        constants: &Constants<V>,
        link: LinkMotion<V>,
        below: Sums<V>,
    ) -> ([V; 6], [V; 3]) {
        solved(constants, link, below)
    }

    fn pivot<V: Scalar>(child: &Constants<V>, parent: LinkMotion<V>, handed: [V; 3]) -> [V; 2] {
        carried(parent, [child[3], child[4]], handed)
    }

    fn accelerate<V: Scalar>(
        _: &Constants<V>,
        _: LinkMotion<V>,
        elimination: [V; 3],
        [x, y]: [V; 2],
    ) -> (V, [V; 3]) {
        let alpha = accelerated(elimination, [x, y]);
        (alpha, [x, y, alpha])
    }

    fn accelerate_leaf<V: Scalar>(
        constants: &Constants<V>,
        link: LinkMotion<V>,
        pivot: [V; 2],
    ) -> V {
        let (_, elimination) = solved(constants, link, [V::from_f64(0.0); 10]);
        accelerated(elimination, pivot)
    }
}

fn row<T: Scalar>(body: SampleBody, place: [f64; 2]) -> Constants<T> {
    let [along, across] = place;
    [
        body.mass,
        body.inertia,
        body.moment,
        along,
        across,
        body.friction,
        body.spring,
        0.0,
    ]
    .map(T::from_f64)
}

const GRAVITY: [f64; 2] = [0.0, 9.81];

/// A tree by generations of these copies, or of fewer than the equations are compiled for.
pub(super) fn by_generation<T: Scalar, const PLACE: usize>(
    copies: &[usize],
) -> Tree<CommonPivot<PLACE>, T> {
    // The children's place is a constant of the link.
    let rows = (0..copies.len()).flat_map(|generation| {
        row(
            SampleBody::new(generation),
            SampleBody::new(generation + 1).place,
        )
    });
    let root = GRAVITY.map(T::from_f64);
    let sizes = Sizes::of::<CommonPivot<PLACE>, T>();
    Tree::of_skeleton(Skeleton::by_generation(
        copies,
        sizes,
        rows.collect(),
        root,
        1,
    ))
}

/// The links of a rule one by one: their parents and bodies.
pub(super) fn links(copies: &[usize]) -> (Vec<u32>, Vec<SampleBody>) {
    let (mut parents, mut bodies) = (Vec::new(), Vec::new());
    let (mut above, mut count) = (0, 1);
    for (generation, &copies) in copies.iter().enumerate() {
        let start = parents.len();
        for _ in 0..copies {
            for i in 0..count {
                parents.push(if generation == 0 { 0 } else { above + i });
                bodies.push(SampleBody::new(generation));
            }
        }
        (above, count) = (start as u32, count * copies as u32);
    }
    (parents, bodies)
}

/// A tree of any shape of these links.
pub(super) fn by_link<T: Scalar>(parents: &[u32], bodies: &[SampleBody]) -> Tree<OwnPivots, T> {
    let rows = bodies.iter().flat_map(|&body| row(body, body.place));
    Tree::with_parents(parents, &rows.collect::<Vec<T>>(), GRAVITY.map(T::from_f64))
}

/// Links that hang anywhere on links before them.
pub(super) fn any(count: usize, seed: usize) -> (Vec<u32>, Vec<SampleBody>) {
    let places = numbers(count, seed, 0.5);
    let parent = |(link, place): (usize, &f64)| ((place + 0.5) * link as f64) as u32;
    let parents: Vec<u32> = places.iter().enumerate().map(parent).collect();
    (
        parents,
        (0..count)
            .map(|link| SampleBody::new(link + seed))
            .collect(),
    )
}
