//! Energies and powers of bodies: equal bits for several links at a time and one by one.

use alloc::vec::Vec;

use super::{motion, numbers};
use crate::scalar::{Lane, Lanes, Scalar};
use crate::system::Workspace;
use crate::tree::LinkMotion;
use crate::tree::bodies::{Bodies, BodyEquations};
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

/// Half of the mass, centre of mass along and across, half of the moment of inertia about it,
/// pivot on the parent along and across, weight times its levers, half of the spring's
/// stiffness, the angle at which it is at rest, friction, drag.
#[derive(Clone, Copy)]
struct Link;

impl BodyEquations for Link {
    type Body<V: Scalar> = [V; 12];

    fn pivot_velocity<V: Scalar>(
        &[_, _, _, _, along, across, ..]: &[V; 12],
        link: LinkMotion<V>,
        [x, y]: [V; 2],
    ) -> [V; 2] {
        let (slope_x, slope_y) = (link.omega * link.cosine, link.omega * link.sine);
        [
            x + (along * slope_x - across * slope_y),
            y + (along * slope_y + across * slope_x),
        ]
    }

    fn kinetic_energy<V: Scalar>(
        &[half_mass, along, across, half_inertia, ..]: &[V; 12],
        link: LinkMotion<V>,
        [x, y]: [V; 2],
    ) -> [V; 1] {
        let (slope_x, slope_y) = (link.omega * link.cosine, link.omega * link.sine);
        let x = x + (along * slope_x - across * slope_y);
        let y = y + (along * slope_y + across * slope_x);
        [half_mass * (x * x + y * y) + half_inertia * link.omega * link.omega]
    }

    fn potential_energy<V: Scalar>(
        &[_, _, _, _, _, _, weight, lateral, spring, rest, ..]: &[V; 12],
        link: LinkMotion<V>,
    ) -> [V; 1] {
        let strain = link.joint_angle - rest;
        let raised = weight * (V::from_f64(1.0) - link.cosine) + lateral * link.sine;
        [raised + spring * strain * strain]
    }

    fn friction_loss<V: Scalar>(&[.., friction, drag]: &[V; 12], link: LinkMotion<V>) -> [V; 1] {
        let joint = friction * link.joint_rate * link.joint_rate;
        [joint + drag * link.omega * link.omega]
    }

    fn drive_power<V: Scalar>(
        &[_, along, ..]: &[V; 12],
        link: LinkMotion<V>,
        [x, y, torque]: [V; 3],
    ) -> [V; 1] {
        let pull = along * (x * link.cosine + y * link.sine);
        [(torque - pull) * link.omega]
    }

    fn outside_power<V: Scalar>(_: &[V; 12], link: LinkMotion<V>) -> [V; 1] {
        [link.outside_torque * link.omega]
    }
}

fn all<T: Scalar>(bodies: &Bodies<Link, T>, links: usize) -> [T; 5] {
    let [theta, omega, torques] = motion(links);
    let workspace = &mut Workspace::new();
    let drive = [0.7, -0.4, 0.3].map(T::from_f64);
    [
        bodies.kinetic_energy(workspace, &theta, &omega),
        bodies.potential_energy(workspace, &theta),
        bodies.drive_power(workspace, drive, &theta, &omega),
        bodies.friction_power(&omega),
        bodies.outside_power(&omega, &torques),
    ]
}

fn each_way<T: Lane>() {
    let (parents, generations) = listed();
    let links = parents.len();
    let own = numbers(12 * COPIES.len(), 3, 1.0);
    let own: Vec<T> = own.into_iter().map(T::from_f64).collect();
    let by_rule = Bodies::<Link, T>::new(Shape::Generations(COPIES), own.clone());
    let row = |&generation: &usize| own[generation * 12..][..12].iter().copied();
    let rows = generations.iter().flat_map(row).collect();
    let by_link = Bodies::<Link, T>::new(Shape::Shared(parents.into()), rows);
    let right = all(&by_link, links);
    assert!(right.iter().all(|value| value.is_finite()));
    // Sums of powers go strip by strip, and so do links one by one.
    assert_eq!(all(&by_rule, links), right);
    // In one lane, which no register holds.
    let lane = by_rule.cast(|value| Lanes([value]));
    assert_eq!(all(&lane, links).map(|Lanes([value])| value), right);
}

/// One link against its energies by hand.
#[test]
fn powers_of_one_link_are_those_of_its_torques() {
    let mut row = [0.0; 12];
    [row[1], row[10], row[11]] = [0.5, 0.2, 0.1];
    let bodies = Bodies::<Link, f64>::new(Shape::Generations(&[1]), row.to_vec());
    let workspace = &mut Workspace::new();
    let power = bodies.drive_power(workspace, [3.0, 4.0, 5.0], &[0.0], &[2.0]);
    assert_eq!(power, (5.0 - 0.5 * 3.0) * 2.0);
    assert!((bodies.friction_power(&[2.0]) + 1.2).abs() < 1e-15);
    assert_eq!(bodies.outside_power(&[2.0], &[7.0]), 14.0);
}

#[test]
fn energies_have_the_same_bits_in_registers_and_one_by_one() {
    each_way::<f64>();
    each_way::<f32>();
}

#[test]
fn rows_that_are_lacking_give_nan() {
    let bodies = Bodies::<Link, f64>::new(Shape::Generations(&[1, 2]), numbers(12, 3, 1.0));
    let values = all(&bodies, 3);
    assert!(values.iter().all(|value| value.is_nan()), "{values:?}");
}
