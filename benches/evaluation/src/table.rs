//! The scenes as tables, as a program for arbitrary trees reads them at run time; used by the
//! implementations for comparison. They exist for any scalar type, for the references.

use branched_pendulum::Scalar;

/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.80665;

/// A link. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<T = f64> {
    /// Index of the parent, which is an earlier link.
    pub parent: Option<usize>,
    /// Mass.
    pub mass: T,
    /// Distance of the centre of mass from the pivot, in m.
    pub com: T,
    /// Moment of inertia about the centre of mass, in kg m².
    pub inertia: T,
    /// Distance of the pivot from the parent's pivot, in m.
    pub lever: T,
}

/// A decimal, rounded once.
pub fn decimal<T: Scalar>(digits: f64, scale: f64) -> T {
    T::from_f64(digits) / T::from_f64(scale)
}

/// The paper's pendulum.
#[must_use]
pub fn paper<T: Scalar>() -> Vec<Link<T>> {
    let child = Link {
        parent: Some(0),
        mass: decimal(10531.0, 1e5),
        com: decimal(43.0, 1e3),
        inertia: decimal(516.0, 1e6),
        lever: decimal(27.0, 1e2),
    };
    let parent = Link {
        parent: None,
        mass: decimal(12880.0, 1e5),
        com: decimal(84.0, 1e3),
        inertia: decimal(188.0, 1e5),
        lever: T::from_f64(0.0),
    };
    vec![parent, child, child]
}

/// Returns a full binary tree of rods, in the order of the emitted code: each link, then its first
/// subtree, then its second one.
#[must_use]
pub fn tree<T: Scalar>(generations: usize) -> Vec<Link<T>> {
    let mut links = Vec::new();
    let sizes = [decimal(12.0, 1e2), decimal(3.0, 1e1), T::from_f64(0.0)];
    grow(&mut links, None, [generations, 2], sizes);
    links
}

/// Returns a rod from which full trees hang, each with this number of generations and of children
/// per link, in the order of the emitted code. All rods have the same size.
#[must_use]
pub fn bush(trees: &[[usize; 2]]) -> Vec<Link> {
    let mut links = Vec::new();
    grow(&mut links, None, [1, 0], [0.12, 0.3, 0.0]);
    for &tree in trees {
        grow(&mut links, Some(0), tree, [0.12, 0.3, 0.3]);
    }
    links
}

fn grow<T: Scalar>(
    links: &mut Vec<Link<T>>,
    parent: Option<usize>,
    [generations, branching]: [usize; 2],
    [mass, length, lever]: [T; 3],
) {
    if generations == 0 {
        return;
    }
    let index = links.len();
    links.push(Link {
        parent,
        mass,
        com: length / T::from_f64(2.0),
        inertia: mass * length * length / T::from_f64(12.0),
        lever,
    });
    let next = [mass / T::from_f64(2.0), length * decimal(7.0, 10.0), length];
    for _ in 0..branching {
        grow(links, Some(index), [generations - 1, branching], next);
    }
}

/// Returns the constants A_ij of the mass matrix, and the constants of the weights divided by g:
/// see `docs/physics.md`, section 1.
pub fn couplings<T: Scalar>(links: &[Link<T>]) -> (Vec<Vec<T>>, Vec<T>) {
    let n = links.len();
    let mut carried: Vec<T> = links.iter().map(|link| link.mass).collect();
    let mut moment: Vec<T> = links.iter().map(|link| link.mass * link.com).collect();
    let mut coupling = vec![vec![T::from_f64(0.0); n]; n];
    for (i, link) in links.iter().enumerate() {
        coupling[i][i] = link.inertia + link.mass * link.com * link.com;
    }
    for (i, link) in links.iter().enumerate().rev() {
        if let Some(parent) = link.parent {
            let (mass, lever) = (carried[i], link.lever);
            carried[parent] = carried[parent] + mass;
            moment[parent] = moment[parent] + lever * mass;
            coupling[parent][parent] = coupling[parent][parent] + lever * lever * mass;
        }
    }
    for j in 0..n {
        let mut below = j;
        while let Some(above) = links[below].parent {
            coupling[above][j] = links[below].lever * moment[j];
            coupling[j][above] = coupling[above][j];
            below = above;
        }
    }
    (coupling, moment)
}
