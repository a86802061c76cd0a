//! Derivatives of the virtual power where its parts do not fit together.

use alloc::vec;
use alloc::vec::Vec;

use crate::friction::LAW_CONSTANTS;
use crate::tree::{PassiveLink, Shape, VirtualMotion, VirtualPower};

/// Returns true if all derivatives of a tree of two generations, with three links in all, are
/// finite, and false if all are NaN. It has constants of `rows` generations.
fn is_answered(rows: usize, memory: usize) -> bool {
    let constants = vec![0.1; rows * (10 + 2 * LAW_CONSTANTS)];
    let links = PassiveLink::of_rows(&constants, [false; 2]);
    let power = VirtualPower::new(Shape::Generations(&[1, 2]), 9.81, links);
    let state = [0.3, -0.5, 0.9];
    let motion = VirtualMotion {
        theta: &state,
        omega: &state,
        alpha: &state,
        lambda: &state,
        pivot: [0.0; 2],
    };
    let (mut theta, mut omega) = ([0.0; 3], [0.0; 3]);
    let by = [&mut theta[..], &mut omega, &mut []];
    let pivot = power.add_derivatives(motion, &mut vec![0.0; memory], by);
    let all: Vec<f64> = [theta.as_slice(), &omega, &pivot].concat();
    let finite = all.iter().filter(|own| own.is_finite()).count();
    assert!([0, all.len()].contains(&finite), "{all:?}");
    finite > 0
}

#[test]
fn constants_of_other_generations_and_short_memory_give_nan() {
    let memory = 3 * VirtualPower::<f64>::NUMBERS;
    assert!(is_answered(2, memory));
    assert!(!is_answered(1, memory));
    assert!(!is_answered(3, memory));
    assert!(!is_answered(2, memory - 1));
}
