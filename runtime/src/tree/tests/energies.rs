//! Energies and momentum of bodies: equal bits for several links at a time and one by one.

use alloc::vec::Vec;

use super::{motion, numbers};
use crate::scalar::{Lane, Lanes, Scalar};
use crate::system::Workspace;
use crate::tree::bodies::Bodies;
use crate::tree::shape::Shape;

/// Copies of the generations: fewer neighbours than any register holds, as many as some
/// do, and others.
const COPIES: &[usize] = &[1, 2, 2, 3, 1, 2, 3];

/// Parent and generation of each link.
fn listed() -> (Vec<u32>, Vec<usize>) {
    let (mut parents, mut generations) = (Vec::new(), Vec::new());
    let (mut above, mut count) = (0, 1);
    for (generation, &copies) in COPIES.iter().enumerate() {
        let start = parents.len();
        for link in 0..copies * count {
            parents.push((above + link % count) as u32);
            generations.push(generation);
        }
        (above, count) = (start, copies * count);
    }
    (parents, generations)
}

fn all<T: Scalar>(bodies: &Bodies<T>, links: usize) -> [T; 4] {
    let [theta, omega, _] = motion(links);
    let workspace = &mut Workspace::new();
    let [x, y] = bodies.momentum(workspace, &theta, &omega);
    let kinetic = bodies.kinetic_energy(workspace, &theta, &omega);
    [kinetic, bodies.potential_energy(workspace, &theta), x, y]
}

fn each_way<T: Lane>() {
    let (parents, generations) = listed();
    let links = parents.len();
    let rows = |width: usize, seed| -> Vec<T> {
        let rows = numbers(width * COPIES.len(), seed, 1.0);
        rows.into_iter().map(T::from_f64).collect()
    };
    let (own, rests) = (rows(12, 3), rows(1, 7));
    let by_rule = Bodies::new(Shape::Generations(COPIES), own.clone()).with_rests(rests.clone());
    let of_link = |rows: &[T], width: usize| -> Vec<T> {
        let row = |&generation: &usize| rows[generation * width..][..width].iter().copied();
        generations.iter().flat_map(row).collect()
    };
    let shape = Shape::Shared(parents.into());
    let by_link = Bodies::new(shape, of_link(&own, 12)).with_rests(of_link(&rests, 1));
    let right = all(&by_link, links);
    assert!(right.iter().all(|value| value.is_finite()));
    assert_eq!(all(&by_rule, links), right);
    // In one lane, which no register holds.
    let lane = by_rule.cast(|value| Lanes([value]));
    assert_eq!(all(&lane, links).map(|Lanes([value])| value), right);
}

#[test]
fn energies_have_the_same_bits_in_registers_and_one_by_one() {
    each_way::<f64>();
    each_way::<f32>();
}

#[test]
fn rows_that_are_lacking_give_nan() {
    let bodies = Bodies::new(Shape::Generations(&[1, 2]), numbers(12, 3, 1.0));
    assert!(all(&bodies, 3).iter().all(|value: &f64| value.is_nan()));
}
