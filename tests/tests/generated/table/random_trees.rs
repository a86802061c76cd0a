//! The equations of one model in tables of random trees.

use super::{expected, largest, number, oracle_of, scene_of, states};
use branched_pendulum::generations::{Recursion, Table, rows};
use branched_pendulum::prelude::*;
use branched_pendulum_codegen::scene::Quantity;
use branched_pendulum_tests::random::Random;
use std::fmt::Write;

/// Lends its equations, those of 24 links with all forces, to random trees.
#[branched_pendulum(
    gravity = 1,
    code = loops,
    trunk: rod(mass = 1, length = 1, friction = 1, drag = 1, spring = 1) [
        twig: rod(mass = 1, length = 1) * 23,
    ],
)]
struct Lender;

/// The text of a random tree of `links` links: half of them hang from the one
/// before, the others from any.
fn random_tree(links: usize, seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut children = vec![Vec::new(); links];
    for link in 1..links {
        let parent = match random.below(2) {
            0 => link - 1,
            _ => random.below(link),
        };
        children[parent].push(link);
    }
    let mut text = "gravity = 9.81, code = loops, ".to_owned();
    write_link(&children, 0, &mut random, &mut text);
    text
}

fn write_link(children: &[Vec<usize>], link: usize, random: &mut Random, text: &mut String) {
    let mut between = |low: f64, high: f64| random.between(low, high);
    let joint = between(0.1, 0.5) * [-1.0, 1.0, 1.0][link % 3];
    let _ = write!(
        text,
        "link_{link}(mass = {:.3}, com = {:.3}, inertia = {:.6}, joint = {joint:.3}, \
         friction = {:.5}, drag = {:.5}, spring = {:.4})",
        between(0.02, 0.5),
        between(0.05, 0.3),
        between(0.0, 1e-3),
        between(0.0, 1e-3),
        between(0.0, 1e-3),
        between(0.0, 1e-1),
    );
    if !children[link].is_empty() {
        text.push('[');
        for &child in &children[link] {
            write_link(children, child, random, text);
            text.push(',');
        }
        text.push(']');
    }
}

#[test]
fn random_trees_agree_with_the_closed_form() {
    const LINKS: usize = <LenderEquations as Recursion<9, 6, 6, 3>>::LINKS;
    assert_eq!(LINKS, 24);
    let mut worst = 0.0_f64;
    for seed in 0..20 {
        let scene = scene_of(&random_tree(LINKS, seed));
        let table = scene.table.as_ref().expect("loops are asked for");
        let parents = scene.links.iter().map(|link| {
            let parent = link.parent.map_or(0, |parent| parent.0);
            u32::try_from(parent).unwrap()
        });
        let parents: &[u32] = parents.collect::<Vec<u32>>().leak();
        let exact = |row: &Vec<Quantity>| -> [[f64; 2]; 9] {
            std::array::from_fn(|column| [number(&row[column]), 0.0])
        };
        let motion: Vec<[[f64; 2]; 9]> = table.motion.iter().map(exact).collect();
        let model = Table::<LenderEquations, f64, 9, 6, 3>::new(
            parents,
            rows(&motion),
            [0.0, number(&table.root)],
            Vec::new(),
        );
        let tree = oracle_of(&scene);
        for [theta, omega] in states(LINKS, 20) {
            let mut alpha = vec![f64::NAN; LINKS];
            model.accelerations_into(&theta, &omega, &mut alpha);
            let [right, bound] = expected(&tree, &theta, &omega);
            worst = worst.max(largest(&alpha, &right, &bound));
        }
    }
    println!("random trees: worst {worst:.1e} of the bound");
    assert!(worst < 16.0 * f64::EPSILON, "{worst:e}");
}
