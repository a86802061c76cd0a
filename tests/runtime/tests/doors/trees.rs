//! Trees in loops: neither lengths nor equations make them read or write beyond their memory.
//! What does not fit gives NaN or other numbers, and nothing else.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{
    Bodies, BodyEquations, LinkEquations, LinkMotion, RootDrive, Shape, Tree,
};

/// Equations whose rows are as long as they please, of a tree whose copies are any of
/// these, and which claim to need everything.
#[derive(Clone, Copy, Debug)]
struct Odd<const SHAPE: usize>;

const SHAPES: [&[usize]; 8] = [
    &[],
    &[1],
    &[1, 0],
    &[0, 3],
    &[3, 2],
    &[1, 17, 1, 3],
    &[1, 2, 0, 5],
    &[3, 20, 300, 0],
];

impl<const SHAPE: usize> LinkEquations for Odd<SHAPE> {
    type Constants<V: Scalar> = [V; 1];
    type Response<V: Scalar> = [V; 1];
    type Sums<V: Scalar> = [V; 3];
    type Elimination<V: Scalar> = [V; 0];
    type Carried<V: Scalar> = [V; 7];

    const COPIES: &'static [usize] = SHAPES[SHAPE];
    const NAMES: &'static [&'static str] = &["only one"];
    const JOINTS: bool = true;
    const TORQUE: bool = true;

    fn leaf<V: Scalar>(&[constant]: &[V; 1], link: LinkMotion<V>) -> [V; 1] {
        [constant * link.sine]
    }

    fn attach<V: Scalar>(_: &[V; 1], _: LinkMotion<V>, [response]: [V; 1]) -> [V; 3] {
        [response; 3]
    }

    fn inner<V: Scalar>(_: &[V; 1], _: LinkMotion<V>, below: [V; 3]) -> ([V; 1], [V; 0]) {
        ([below[0]], [])
    }

    fn pivot<V: Scalar>(_: &[V; 1], _: LinkMotion<V>, carried: [V; 7]) -> [V; 2] {
        [carried[0], carried[6]]
    }

    fn accelerate<V: Scalar>(
        _: &[V; 1],
        link: LinkMotion<V>,
        _: [V; 0],
        [x, _]: [V; 2],
    ) -> (V, [V; 7]) {
        (link.joint_rate, [x; 7])
    }

    fn accelerate_leaf<V: Scalar>(_: &[V; 1], link: LinkMotion<V>, _: [V; 2]) -> V {
        link.joint_angle
    }
}

impl<const SHAPE: usize> BodyEquations for Odd<SHAPE> {
    type Body<V: Scalar> = [V; 12];

    fn pivot_velocity<V: Scalar>(body: &[V; 12], link: LinkMotion<V>, given: [V; 2]) -> [V; 2] {
        [body[0] * link.sine + given[1], body[11] + given[0]]
    }

    fn kinetic_energy<V: Scalar>(body: &[V; 12], link: LinkMotion<V>, given: [V; 2]) -> [V; 1] {
        [body[3] * link.omega + given[0]]
    }

    fn potential_energy<V: Scalar>(body: &[V; 12], link: LinkMotion<V>) -> [V; 1] {
        [body[4] * link.joint_angle]
    }

    fn friction_loss<V: Scalar>(body: &[V; 12], link: LinkMotion<V>) -> [V; 1] {
        [body[5] * link.joint_rate]
    }

    fn drive_power<V: Scalar>(body: &[V; 12], link: LinkMotion<V>, given: [V; 3]) -> [V; 1] {
        [body[6] * link.omega * given[2]]
    }

    fn outside_power<V: Scalar>(body: &[V; 12], link: LinkMotion<V>) -> [V; 1] {
        [body[7] * link.outside_torque]
    }
}

/// Evaluates with slices of all lengths around the number of links, and other memory.
fn evaluate<const SHAPE: usize, T: Scalar>(tree: &Tree<Odd<SHAPE>, T>, links: usize) {
    let zero = T::from_f64(0.0);
    let mut workspace = Workspace::new();
    for lengths in [[0, 0, 0], [1, 1, 1], [links; 3], [links, links, links + 1]] {
        let [theta, omega, alpha] = lengths.map(|length| vec![zero; length]);
        let mut alpha = alpha;
        for drive in [
            None,
            Some(RootDrive {
                pivot: [zero; 2],
                torque: zero,
            }),
        ] {
            tree.accelerations_with(&mut workspace, drive, &theta, &omega, &mut alpha);
            tree.accelerations_into(drive, &theta, &omega, &mut alpha);
        }
    }
}

fn by_generation<const SHAPE: usize>() {
    let links = SHAPES[SHAPE]
        .iter()
        .scan(1, |count, copies| {
            *count *= copies;
            Some(*count)
        })
        .sum();
    for rows in [0, 1, 2, 100] {
        evaluate(
            &Tree::<Odd<SHAPE>, f64>::new(vec![1.0; rows], [0.0; 2]),
            links,
        );
        evaluate(
            &Tree::<Odd<SHAPE>, f32>::new(vec![1.0; rows], [0.0; 2]),
            links,
        );
    }
    let tree = Tree::<Odd<SHAPE>, Dual<f64, 1>>::new(Vec::new(), [Dual::constant(0.0); 2]);
    evaluate(&tree, links);
}

#[test]
fn equations_and_lengths_of_any_kind_stay_within_their_memory() {
    by_generation::<0>();
    by_generation::<1>();
    by_generation::<2>();
    by_generation::<3>();
    by_generation::<4>();
    by_generation::<5>();
    by_generation::<6>();
    by_generation::<7>();
    for parents in [&[][..], &[7], &[0, 1, 2, 9], &[u32::MAX; 40]] {
        for rows in [0, 1, 40, 41] {
            let rows = vec![1.0; rows];
            let tree = Tree::<Odd<0>, f64>::with_parents(parents, &rows, [0.0; 2]);
            evaluate(&tree, parents.len());
            // Equations of generations in a tree that has none.
            let tree = Tree::<Odd<5>, f64>::with_parents(parents, &rows, [0.0; 2]);
            evaluate(&tree, parents.len());
        }
    }
}

#[test]
fn bodies_of_any_shape_stay_within_their_memory() {
    let mut workspace = Workspace::new();
    for shape in [
        Shape::Parents(&[]),
        Shape::Parents(&[9, 9, 9]),
        Shape::Generations(&[]),
        Shape::Generations(&[0, 4]),
        Shape::Generations(&[2, 3]),
    ] {
        for rows in [0, 11, 12, 100] {
            let bodies = Bodies::<Odd<0>, f64>::new(shape.clone(), vec![1.0; rows]);
            for length in [0, 1, 3, 8] {
                let motion = vec![0.5; length];
                let _ = bodies.kinetic_energy(&mut workspace, &motion, &motion);
                let _ = bodies.potential_energy(&mut workspace, &motion);
                let _ = bodies.drive_power(&mut workspace, [0.5; 3], &motion, &motion);
                let _ = bodies.friction_power(&motion);
                let _ = bodies.outside_power(&motion, &motion);
            }
        }
    }
}
