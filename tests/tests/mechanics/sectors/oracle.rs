//! Sector energies link by link: dense matrices and Cartesian velocities, from
//! the numbers of the tree alone.

use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;
use nalgebra::{Cholesky, DMatrix, DVector};

use crate::support::Compiled;

/// Definition of the kinetic energy of a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Definition {
    Rest,
    Canonical,
    Parseval,
    Velocity,
}

pub(crate) const DEFINITIONS: [(Definition, &str); 4] = [
    (Definition::Rest, "budget_rest"),
    (Definition::Canonical, "budget_canonical"),
    (Definition::Parseval, "budget_parseval"),
    (Definition::Velocity, "budget_velocity"),
];

/// θ = J q, with the sector of every column.
pub(crate) struct Basis {
    pub(crate) j: DMatrix<f64>,
    pub(crate) sectors: Vec<Vec<usize>>,
}

impl Basis {
    pub(crate) fn new(compiled: &Compiled) -> Self {
        let coordinates = &compiled.mechanics.coordinates;
        let n = coordinates.len();
        let mut j = DMatrix::zeros(n, n);
        for (column, coordinate) in coordinates.iter().enumerate() {
            for &(link, weight) in &coordinate.weights {
                j[(link.0, column)] = weight as f64;
            }
        }
        let sectors = compiled.mechanics.sectors.as_ref();
        let sectors = sectors.expect("the scene asks for a budget");
        let sectors = sectors.sectors.iter();
        Self {
            j,
            sectors: sectors.map(|sector| sector.coordinates.clone()).collect(),
        }
    }

    /// The block of JᵀMJ of a sector.
    pub(crate) fn block(&self, matrix: &DMatrix<f64>, sector: usize) -> DMatrix<f64> {
        let whole = self.j.transpose() * matrix * &self.j;
        let columns = &self.sectors[sector];
        whole.select_rows(columns).select_columns(columns)
    }

    /// Σ weight² of a coordinate.
    fn norm(&self, coordinate: usize) -> f64 {
        self.j.column(coordinate).norm_squared()
    }

    /// The mean or difference of the links' values.
    fn coordinate(&self, coordinate: usize, values: &DVector<f64>) -> f64 {
        self.j.column(coordinate).dot(values) / self.norm(coordinate)
    }

    /// A link that the coordinate concerns.
    fn link(&self, coordinate: usize) -> usize {
        let column = self.j.column(coordinate);
        let link = column.iter().position(|weight| *weight != 0.0);
        link.expect("a coordinate of no link")
    }
}

/// g Σ m × lever of all that a link carries, along and across.
fn weights(tree: &Tree) -> Vec<[f64; 2]> {
    let n = tree.links.len();
    let mut carried: Vec<f64> = tree.links.iter().map(|link| link.mass).collect();
    for index in (0..n).rev() {
        if let Some(parent) = tree.links[index].parent {
            carried[parent] += carried[index];
        }
    }
    (0..n)
        .map(|index| {
            let link = &tree.links[index];
            [0, 1].map(|axis| {
                let children = tree.links.iter().zip(&carried);
                let below: f64 = children
                    .filter(|(child, _)| child.parent == Some(index))
                    .map(|(child, mass)| mass * child.pivot[axis])
                    .sum();
                tree.gravity * (link.mass * link.com[axis] + below)
            })
        })
        .collect()
}

/// Velocities of the centres of mass, x and y.
fn velocities(tree: &Tree, theta: &[f64], omega: &[f64]) -> [DVector<f64>; 2] {
    let n = tree.links.len();
    let of_link = |index: usize| {
        let mut velocity = [0.0; 2];
        let mut offset = tree.links[index].com;
        for link in tree.lineage(index) {
            let (sin, cos) = theta[link].sin_cos();
            let [along, across] = offset;
            velocity[0] += (along * cos - across * sin) * omega[link];
            velocity[1] += (along * sin + across * cos) * omega[link];
            offset = tree.links[link].pivot;
        }
        velocity
    };
    let all: Vec<[f64; 2]> = (0..n).map(of_link).collect();
    [0, 1].map(|axis| DVector::from_fn(n, |index, _| all[index][axis]))
}

/// V of every sector.
pub(crate) fn potentials(tree: &Tree, basis: &Basis, theta: &[f64]) -> Vec<f64> {
    let n = tree.links.len();
    let weights = weights(tree);
    let cos = DVector::from_fn(n, |i, _| 1.0 - theta[i].cos());
    let sin = DVector::from_fn(n, |i, _| theta[i].sin());
    let relative = DVector::from_fn(n, |i, _| {
        theta[i] - tree.links[i].parent.map_or(0.0, |parent| theta[parent]) - tree.links[i].rest
    });
    basis
        .sectors
        .iter()
        .enumerate()
        .map(|(sector, coordinates)| {
            coordinates
                .iter()
                .map(|&coordinate| {
                    let link = basis.link(coordinate);
                    let norm = basis.norm(coordinate);
                    let [x, y, turn] =
                        [&cos, &sin, &relative].map(|values| basis.coordinate(coordinate, values));
                    let chord = weights[link][0] * (x * x + y * y);
                    let spring = tree.links[link].spring * turn * turn;
                    // The sector of the means comes first.
                    let lateral = if sector == 0 {
                        weights[link][1] * y
                    } else {
                        0.0
                    };
                    norm * (0.5 * (chord + spring) + lateral)
                })
                .sum()
        })
        .collect()
}

/// E of every sector.
pub(crate) fn energies(
    tree: &Tree,
    basis: &Basis,
    definition: Definition,
    theta: &[f64],
    omega: &[f64],
) -> Vec<f64> {
    let potentials = potentials(tree, basis, theta);
    let mass = Motion::new(tree, theta, omega).mass;
    let rest = Motion::new(tree, &vec![0.0; theta.len()], omega).mass;
    let rates = DVector::from_row_slice(omega);
    let momenta = basis.j.transpose() * (&mass * &rates);
    let velocities = velocities(tree, theta, omega);
    let kinetic = |sector: usize| {
        let coordinates = &basis.sectors[sector];
        let own_momenta = momenta.select_rows(coordinates);
        let by_momenta = |matrix: &DMatrix<f64>| {
            let block = basis.block(matrix, sector);
            let block = Cholesky::new(block).expect("blocks are positive definite");
            0.5 * own_momenta.dot(&block.solve(&own_momenta))
        };
        match definition {
            Definition::Rest => by_momenta(&rest),
            Definition::Canonical => by_momenta(&mass),
            Definition::Velocity => {
                let own = DVector::from_iterator(
                    coordinates.len(),
                    coordinates.iter().map(|&c| basis.coordinate(c, &rates)),
                );
                0.5 * own.dot(&(basis.block(&mass, sector) * &own))
            }
            Definition::Parseval => coordinates
                .iter()
                .map(|&c| {
                    let link = &tree.links[basis.link(c)];
                    let [x, y] = [0, 1].map(|axis| basis.coordinate(c, &velocities[axis]));
                    let turn = basis.coordinate(c, &rates);
                    let norm = basis.norm(c);
                    0.5 * norm * (link.mass * (x * x + y * y) + link.inertia * turn * turn)
                })
                .sum(),
        }
    };
    (0..basis.sectors.len())
        .map(|sector| kinetic(sector) + potentials[sector])
        .collect()
}

/// The tree without friction and drag.
pub(crate) fn conservative(tree: &Tree) -> Tree {
    let mut tree = tree.clone();
    for link in &mut tree.links {
        link.friction = 0.0;
        link.drag = 0.0;
    }
    for own in &mut tree.between {
        own.friction = 0.0;
    }
    tree
}

/// d/dh of several functions at h = 0, by central differences of sixth order.
pub(crate) fn derivative(step: f64, f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let weights = [45.0, -9.0, 1.0];
    let mut sum: Vec<f64> = vec![0.0; f(0.0).len()];
    for (k, weight) in weights.iter().enumerate() {
        let h = step * (k + 1) as f64;
        for ((sum, plus), minus) in sum.iter_mut().zip(f(h)).zip(f(-h)) {
            *sum += weight * (plus - minus) / (60.0 * step);
        }
    }
    sum
}
