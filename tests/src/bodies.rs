//! Scenes that are written out as bodies in plain numbers, for the oracles.

use branched_pendulum_codegen::scene::{Link, Offset, Quantity, Scene};

use crate::oracle::{self, Law, Tree};

/// Returns the tree of a scene without parameters.
///
/// # Panics
/// If a quantity depends on parameters.
pub fn bodies_of(scene: &Scene) -> Tree {
    let links = scene.links.iter().map(|link| oracle::Link {
        parent: link.parent.map(|parent| parent.0),
        mass: number(&link.mass),
        inertia: number(&link.inertia),
        com: point(&link.com),
        pivot: point(&link.pivot),
        friction: number(&link.passive.friction),
        drag: number(&link.passive.drag),
        spring: number(&link.passive.spring),
        rest: number(&link.passive.rest),
        laws: laws(link),
    });
    Tree {
        gravity: number(&scene.gravity),
        links: links.collect(),
    }
}

/// Returns a point along and across its link.
///
/// # Panics
/// As [`bodies_of`].
pub fn point(offset: &Offset) -> [f64; 2] {
    [number(&offset.along), number(&offset.lateral)]
}

fn number(quantity: &Quantity) -> f64 {
    quantity.exact().expect("no parameters").to_f64()
}

fn laws(link: &Link) -> [Law; 2] {
    link.passive.laws.each_ref().map(|law| match law.is_none() {
        false => Law {
            coulomb: number(&law.coulomb),
            quadratic: number(&law.quadratic),
            width: number(&law.width),
        },
        true => Law::default(),
    })
}
