//! Large trees with a workspace, and batches, allocate nothing after their first
//! evaluation, and energies with a workspace nothing after the first, counted.

#[path = "../../../runtime/tests/counting/mod.rs"]
mod counting;

use std::num::NonZeroUsize;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Lane;
use branched_pendulum::system::{PullbackOde, PullbackWorkspace, Workspace};
use branched_pendulum::{Parametric, Pendulum};
use counting::allocations;

/// Allocations of a first and of a second call.
fn of_two(mut call: impl FnMut()) -> [u64; 2] {
    let start = allocations();
    call();
    let between = allocations();
    call();
    [between - start, allocations() - between]
}

/// A tree in one piece.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 10, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
    emit(energies),
)]
struct Whole;

/// A tree in parts.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 15, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.9),
    emit(energies),
)]
struct Parts;

/// A tree in a table.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 1, length = 1) [
        twig: rod(mass = 0.1, length = 0.5) * 70,
        bough: rod(mass = 0.2, length = 0.5) [
            leaf: rod(mass = 0.01, length = 0.1) * 61,
        ],
    ],
    emit(energies),
)]
struct Irregular;

/// Driven, and with children at several places.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 1, length = 1, friction = 1e-3) [
        twig: rod(mass = 0.1, length = 0.5, at = 0.3) * 70,
        bough: rod(mass = 0.2, length = 0.5) [
            leaf: rod(mass = 0.01, length = 0.1) * 61,
        ],
    ],
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t)),
    emit(energies),
)]
struct Mobile;

fn evaluations<T: Lane, P: Pendulum<T> + Energy<T>>(model: &P) {
    let n = model.links();
    let (theta, omega) = (vec![T::from_f64(0.3); n], vec![T::from_f64(0.1); n]);
    let mut alpha = vec![T::from_f64(0.0); n];
    let mut workspace = Workspace::new();
    let [first, second] = of_two(|| {
        let time = T::from_f64(0.0);
        model.accelerations_with(&mut workspace, time, &theta, &omega, &mut alpha);
    });
    // Where nothing is counted, the second zero says nothing.
    assert!(first > 0);
    assert_eq!(second, 0);
    let (mut workspace, mut energy) = (Workspace::new(), T::from_f64(0.0));
    let [first, second] = of_two(|| {
        energy = model.kinetic_energy_with(&mut workspace, &theta, &omega)
            + model.potential_energy_with(&mut workspace, &theta);
    });
    assert!(first > 0);
    assert_eq!(second, 0);
    assert!(energy > T::from_f64(0.0));
}

#[test]
fn large_trees() {
    let one = NonZeroUsize::MIN;
    evaluations::<f64, _>(&Whole::<f64>::new());
    evaluations::<f32, _>(&Whole::<f32>::default());
    let (mut double, mut single) = (Parts::<f64>::new(), Parts::<f32>::default());
    // A thread that is started allocates.
    double.set_threads(one);
    single.set_threads(one);
    evaluations::<f64, _>(&double);
    evaluations::<f32, _>(&single);
    evaluations::<f64, _>(&Irregular::<f64>::new());
    evaluations::<f32, _>(&Irregular::<f32>::default());
    evaluations::<f64, _>(&Mobile::<f64>::new());
    evaluations::<f32, _>(&Mobile::<f32>::default());
}

/// A tree whose accelerations have derivatives, with every kind of force.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 1, length = l, friction(viscous = f, coulomb = f)) [
        twig: rod(mass = 0.1, length = 0.5, at = 0.3, spring = k) * 40,
        bough: rod(mass = 0.2, length = l / 2),
    ],
    siblings(twig, spring = k, friction(quadratic = f)),
    between(trunk, twig_7, at = each(0.1, 0.2), spring = k, rest = 0.1, friction = f),
    guy(bough, at = l / 4, to = (0.3, 0.2), spring = k, rest = 0.1),
    drive(torque = push * cos(3 * t)),
    emit(gradient(accelerations)),
)]
struct Differentiated;

#[test]
fn pullbacks() {
    let values = [0.9, 1e-3, 0.2, 0.1];
    let model = Differentiated::<f64>::with_parameters(|index| values[index]);
    let ode = AbsoluteAngles(&model);
    let n = ode.dimension();
    let state: Vec<f64> = (0..n).map(|index| 0.1 + 0.01 * index as f64).collect();
    let weights = vec![1.0; n];
    let (mut by_state, mut by_parameters) = (vec![0.0; n], vec![0.0; values.len()]);
    let mut workspace = PullbackWorkspace::new();
    let [first, second] = of_two(|| {
        let by = (&mut by_state, &mut by_parameters);
        ode.add_pullback(&mut workspace, 0.3, &state, &weights, by.0, by.1);
    });
    assert!(first > 0);
    assert_eq!(second, 0);
    let all = by_state.iter().chain(&by_parameters);
    assert!(all.into_iter().all(|own| own.is_finite() && *own != 0.0));
}

#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
)]
struct Small;

fn batch_of<T: Lane, P: Pendulum<T>>(model: &P) {
    let mut batch = Batch::new(model);
    let states = vec![vec![T::from_f64(0.1); 67]; model.links()];
    let mut alpha = vec![vec![T::from_f64(0.0); 67]; model.links()];
    let allocations = of_two(|| {
        batch
            .accelerations(T::from_f64(0.0), &states, &states, &mut alpha)
            .unwrap();
    });
    assert_eq!(allocations, [0, 0]);
}

/// A batch allocates when it is built, and any count of states after that is free.
#[test]
fn batches() {
    batch_of::<f64, _>(&Small::<f64>::new());
    batch_of::<f64, _>(&Whole::<f64>::new());
    batch_of::<f32, _>(&Whole::<f32>::default());
    batch_of::<f64, _>(&Irregular::<f64>::new());
    batch_of::<f32, _>(&Irregular::<f32>::default());
    batch_of::<f64, _>(&Mobile::<f64>::new());
    batch_of::<f32, _>(&Mobile::<f32>::default());
}

/// Where there are too few states for a register, a model in loops makes room for one
/// when it is first asked, as it does without a batch.
#[test]
fn few_states_of_a_large_tree() {
    let model = Whole::<f64>::new();
    let mut batch = Batch::new(&model);
    let states = vec![vec![0.1; 1]; 1023];
    let mut alpha = states.clone();
    let [first, second] = of_two(|| {
        batch
            .accelerations(0.0, &states, &states, &mut alpha)
            .unwrap();
    });
    assert!(first > 0);
    assert_eq!(second, 0);
}

#[branched_pendulum(
    gravity = 9.80665,
    branch: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    emit(taylor),
)]
struct Branch;

/// Frames of an animation, with a push at each of them.
#[test]
fn frames() {
    let model = Branch::<f32>::default();
    let start = State::at_rest(0.0, &[0.3; 31]);
    for &method in Method::ALL {
        let setting = if method.is_adaptive() {
            1e-4
        } else {
            1.0 / 240.0
        };
        let mut stepper = method
            .with(setting)
            .start(AbsoluteAngles(&model), &start)
            .unwrap();
        let mut pushed = start.values.clone();
        let allocations = of_two(|| {
            for _ in 0..30 {
                stepper.advance(1.0 / 60.0).unwrap();
                pushed.copy_from_slice(stepper.state());
                pushed[61] += 0.1;
                stepper.set_state(stepper.time(), &pushed).unwrap();
            }
            for _ in 0..30 {
                stepper.advance(1.0 / 60.0).unwrap();
            }
        });
        assert_eq!(allocations, [0, 0], "{method}");
        assert!(stepper.state().iter().all(|value| value.is_finite()));
    }
}
