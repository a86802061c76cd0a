//! Scenes that are written out as bodies in plain numbers, for the oracles.

use branched_pendulum_codegen::scene::{FrictionLaw, Link, Offset, Quantity, Scene};

use crate::oracle::{self, Between, Law, Tree};

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
        between: between(scene),
    }
}

fn between(scene: &Scene) -> Vec<Between> {
    let pairs = scene.link_pairs().into_iter().map(|pair| {
        let passive = &scene.spring_dampers[pair.spring_damper].torques;
        Between {
            links: pair.links.map(|link| link.0),
            friction: number(&passive.friction),
            spring: number(&passive.spring),
            rest: number(&passive.rest),
            law: law(&passive.laws[0]),
        }
    });
    pairs.collect()
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
    link.passive.laws.each_ref().map(law)
}

fn law(law: &FrictionLaw) -> Law {
    match law.is_none() {
        false => Law {
            coulomb: number(&law.coulomb),
            quadratic: number(&law.quadratic),
            width: number(&law.width),
            excess: number(&law.excess),
            stribeck: number(&law.stribeck),
        },
        true => Law::default(),
    }
}
