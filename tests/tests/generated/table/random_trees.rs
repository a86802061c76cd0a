//! The equations of one model in tables of random trees.

use super::{bodies_of, expected, largest, states};
use branched_pendulum::prelude::*;
use branched_pendulum::tree::{LinkEquations, Row, Tree};
use branched_pendulum_codegen::program::Column;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source;
use std::fmt::Write;

/// Lends its equations, those of links with all forces, to random trees.
#[branched_pendulum(
    gravity = 1,
    code = loops,
    trunk(mass = 1, com = 0.7, inertia = 0.3, joint = 1, friction = 1, drag = 1, spring = 1) [
        bough(mass = 2.5, com = 1.1, inertia = 1.7, joint = 3, friction = 2, drag = 2, spring = 2) [
            twig(mass = 3, com = 0.9, inertia = 2.3, friction = 3, drag = 3, spring = 3),
        ],
        leaf(mass = 4, com = 2.1, inertia = 7, friction = 4, drag = 4, spring = 4),
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

/// Columns of constants that the lent equations read.
fn columns() -> Vec<Column> {
    let lender = include_str!("random_trees.rs");
    let (_, rest) = lender
        .split_once("#[branched_pendulum(")
        .expect("it is above");
    let (attribute, _) = rest.split_once(")]\n").expect("it ends");
    let text = format!("#[branched_pendulum({attribute})] struct Sample;");
    let strips = source::stages_of(&text).program.strips;
    strips.expect("loops are asked for").columns
}

#[test]
fn random_trees_agree_with_the_closed_form() {
    const LINKS: usize = 24;
    // All columns, as of the random trees: none is the same in all rows.
    const COLUMNS: usize = <<LenderEquations as LinkEquations>::Constants<f64> as Row<f64>>::LENGTH;
    let columns = columns();
    let mut worst = 0.0_f64;
    for seed in 0..20 {
        let text = random_tree(LINKS, seed);
        let stages = source::stages_of(&format!("#[branched_pendulum({text})] struct Sample;"));
        let (scene, program) = (&stages.scene, &stages.program);
        let strips = program.strips.as_ref().expect("loops are asked for");
        assert_eq!(strips.columns, columns, "the equations read these");
        let parents = scene.links.iter().map(|link| {
            let parent = link.parent.map_or(0, |parent| parent.0);
            u32::try_from(parent).unwrap()
        });
        let parents: Vec<u32> = parents.collect();
        let constants = program.setup.evaluate(&[]);
        let rows = strips.strips.iter().flat_map(|strip| -> [f64; COLUMNS] {
            std::array::from_fn(|column| constants[strip.constants[column].0 as usize])
        });
        let rows: Vec<f64> = rows.collect();
        let root = program.evaluate(f64::sin_cos, "root_gravity", &[], |_, _| 0.0);
        let root = root.expect("every tree has gravity");
        let model = Tree::<LenderEquations, f64>::with_parents(&parents, &rows, [root[0], root[1]]);
        let tree = bodies_of(scene);
        for [theta, omega] in states(LINKS, 20) {
            let mut alpha = vec![f64::NAN; LINKS];
            model.accelerations_into(None, &theta, &omega, &mut alpha);
            let [right, bound] = expected(&tree, &theta, &omega);
            worst = worst.max(largest(&alpha, &right, &bound));
        }
    }
    println!("random trees: worst {worst:.1e} of the bound");
    assert!(worst < 16.0 * f64::EPSILON, "{worst:e}");
}
