//! The scenes as tables, for the baselines: what a program knows that takes any
//! tree at run time.

/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.80665;

/// A link. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Index of the parent, which stands before the link.
    pub parent: Option<usize>,
    /// Mass.
    pub mass: f64,
    /// Distance of the centre of mass from the pivot.
    pub com: f64,
    /// Moment of inertia about the centre of mass.
    pub inertia: f64,
    /// Distance of the pivot from that of the parent.
    pub lever: f64,
}

/// The paper's pendulum.
#[must_use]
pub fn paper() -> Vec<Link> {
    let child = Link {
        parent: Some(0),
        mass: 0.10531,
        com: 0.043,
        inertia: 0.516e-3,
        lever: 0.27,
    };
    let parent = Link {
        parent: None,
        mass: 0.12880,
        com: 0.084,
        inertia: 1.88e-3,
        lever: 0.0,
    };
    vec![parent, child, child]
}

/// A full binary tree of rods, in the order of the emitted code: each link
/// before its first subtree, that before the second.
#[must_use]
pub fn tree(generations: usize) -> Vec<Link> {
    let mut links = Vec::new();
    grow(&mut links, None, generations, 0.12, 0.3, 0.0);
    links
}

fn grow(
    links: &mut Vec<Link>,
    parent: Option<usize>,
    generations: usize,
    mass: f64,
    length: f64,
    lever: f64,
) {
    if generations == 0 {
        return;
    }
    let index = links.len();
    links.push(Link {
        parent,
        mass,
        com: length / 2.0,
        inertia: mass * length * length / 12.0,
        lever,
    });
    for _ in 0..2 {
        grow(
            links,
            Some(index),
            generations - 1,
            mass * 0.5,
            length * 0.7,
            length,
        );
    }
}
