//! Constants of the Lagrangian of a tree, in absolute angles (physics (1.6), (1.7)).

use alloc::vec::Vec;

use super::pattern::Pattern;
use crate::scalar::{Double, Scalar};

/// A rigid link in numbers, SI units; places are along the link and across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidLink<T> {
    /// The link that it hangs from, which stands before it.
    pub parent: Option<usize>,
    /// Mass.
    pub mass: T,
    /// Moment of inertia about the centre of mass.
    pub inertia: T,
    /// Centre of mass, from the link's own pivot.
    pub com: [T; 2],
    /// The link's pivot, from that of its parent and in the parent's directions.
    pub pivot: [T; 2],
    /// Stiffness of the spring in its pivot.
    pub spring: T,
    /// Angle to the parent at which that spring is at rest.
    pub rest: T,
    /// Viscous friction in its pivot.
    pub friction: T,
    /// Viscous drag against the ground.
    pub drag: T,
    /// C, q and ε of the torque (C/s + q s) w in the pivot, s = √(w² + ε²), then q and ε of
    /// the torque q s w against the ground.
    pub laws: [T; 5],
}

impl<T: Copy> RigidLink<T> {
    /// Returns the link on other scalars.
    pub(super) fn cast<S>(&self, convert: impl Fn(T) -> S) -> RigidLink<S> {
        RigidLink {
            parent: self.parent,
            mass: convert(self.mass),
            inertia: convert(self.inertia),
            com: self.com.map(&convert),
            pivot: self.pivot.map(&convert),
            spring: convert(self.spring),
            rest: convert(self.rest),
            friction: convert(self.friction),
            drag: convert(self.drag),
            laws: self.laws.map(&convert),
        }
    }
}

/// M and U: numbers of each link, and of each pair of a link and one above it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MassConstants<T> {
    /// M_ii.
    pub(super) inertia: Vec<T>,
    /// μ_ij of M_ij = μ_ij cos (θ_i − θ_j) + ν_ij sin (θ_i − θ_j).
    pub(super) coupling: Vec<T>,
    /// ν_ij; empty without lateral offsets.
    pub(super) lateral_coupling: Vec<T>,
    /// G_i of U = Σ G_i (1 − cos θ_i) + F_i sin θ_i.
    pub(super) gravity: Vec<T>,
    /// F_i; empty without lateral offsets.
    pub(super) lateral_gravity: Vec<T>,
    /// Stiffness of springs; empty without any.
    pub(super) spring: Vec<T>,
    /// Angles at which they are at rest, likewise.
    pub(super) rest: Vec<T>,
}

impl<T: Scalar> MassConstants<T> {
    fn map<S>(&self, convert: impl Fn(T) -> S) -> MassConstants<S> {
        let list = |own: &Vec<T>| own.iter().map(|&value| convert(value)).collect();
        MassConstants {
            inertia: list(&self.inertia),
            coupling: list(&self.coupling),
            lateral_coupling: list(&self.lateral_coupling),
            gravity: list(&self.gravity),
            lateral_gravity: list(&self.lateral_gravity),
            spring: list(&self.spring),
            rest: list(&self.rest),
        }
    }

    /// Returns the constants on other scalars.
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> MassConstants<S> {
        self.map(convert)
    }
}

/// First moments of mass about the pivots, with all that hangs from each link as points.
pub(super) fn moments(links: &[RigidLink<Double>]) -> Vec<[Double; 2]> {
    let mut moments: Vec<[Double; 2]> = links
        .iter()
        .map(|link| link.com.map(|place| link.mass * place))
        .collect();
    for (link, carried) in links.iter().zip(carried(links)) {
        if let Some(parent) = link.parent {
            for axis in [0, 1] {
                moments[parent][axis] += carried * link.pivot[axis];
            }
        }
    }
    moments
}

/// Mass of each link with all that hangs from it.
fn carried(links: &[RigidLink<Double>]) -> Vec<Double> {
    let mut carried: Vec<Double> = links.iter().map(|link| link.mass).collect();
    for (index, link) in links.iter().enumerate().rev() {
        if let Some(parent) = link.parent {
            carried[parent] = carried[parent] + carried[index];
        }
    }
    carried
}

impl MassConstants<Double> {
    /// The constants of a tree.
    pub(super) fn new(pattern: &Pattern, links: &[RigidLink<Double>], gravity: Double) -> Self {
        let zero = Double::from_f64(0.0);
        let moments = moments(links);
        let own = links.iter().map(|link| {
            let [along, across] = link.com;
            link.inertia + link.mass * (along * along + across * across)
        });
        let mut inertia: Vec<Double> = own.collect();
        for (link, carried) in links.iter().zip(carried(links)) {
            if let Some(parent) = link.parent {
                let [along, across] = link.pivot;
                let far = along * along + across * across;
                inertia[parent] += carried * far;
            }
        }
        let (mut coupling, mut lateral) = (Vec::new(), Vec::new());
        for (row, &[along, across]) in moments.iter().enumerate() {
            // Of the links upwards, each one's child on this way.
            let mut child = row;
            for (_, above) in pattern.upwards(row) {
                let [x, y] = links[child].pivot;
                coupling.push(along * x + across * y);
                lateral.push(along * y - across * x);
                child = above;
            }
        }
        let weight = |axis: usize| moments.iter().map(move |moment| gravity * moment[axis]);
        let lateral_gravity: Vec<Double> = weight(1).collect();
        let has_springs = links.iter().any(|link| link.spring != zero);
        let is_lateral = links
            .iter()
            .any(|link| link.com[1] != zero || link.pivot[1] != zero);
        let where_there_are = |asked: bool, list: Vec<Double>| match asked {
            true => list,
            false => Vec::new(),
        };
        let springs = links.iter().map(|link| link.spring).collect();
        let rests = links.iter().map(|link| link.rest).collect();
        Self {
            inertia,
            coupling,
            lateral_coupling: where_there_are(is_lateral, lateral),
            gravity: weight(0).collect(),
            lateral_gravity: where_there_are(is_lateral, lateral_gravity),
            spring: where_there_are(has_springs, springs),
            rest: where_there_are(has_springs, rests),
        }
    }

    /// The constants of the mean tree (physics (14.1)): of links of one node each those that
    /// they have in the mean.
    pub(super) fn mean(&self, pattern: &Pattern, nodes: &[Vec<usize>]) -> Self {
        let mut mean = self.clone();
        for node in nodes {
            let lists = [
                &mut mean.inertia,
                &mut mean.gravity,
                &mut mean.lateral_gravity,
                &mut mean.spring,
                &mut mean.rest,
            ];
            lists.into_iter().for_each(|list| level(list, node));
            let depth = node.iter().map(|&link| pattern.upwards(link).count()).min();
            for step in 0..depth.unwrap_or(0) {
                let places = node.iter();
                let places = places.filter_map(|&link| pattern.upwards(link).nth(step));
                let places: Vec<usize> = places.map(|(place, _)| place).collect();
                level(&mut mean.coupling, &places);
                level(&mut mean.lateral_coupling, &places);
            }
        }
        mean
    }

    /// The constants less others.
    pub(super) fn less(&self, other: &Self) -> Self {
        let list = |own: &Vec<Double>, other: &Vec<Double>| {
            let pairs = own.iter().zip(other);
            pairs.map(|(&own, &other)| own - other).collect()
        };
        Self {
            inertia: list(&self.inertia, &other.inertia),
            coupling: list(&self.coupling, &other.coupling),
            lateral_coupling: list(&self.lateral_coupling, &other.lateral_coupling),
            gravity: list(&self.gravity, &other.gravity),
            lateral_gravity: list(&self.lateral_gravity, &other.lateral_gravity),
            spring: list(&self.spring, &other.spring),
            rest: list(&self.rest, &other.rest),
        }
    }

    /// The constants, each rounded once.
    pub(super) fn rounded<T: Scalar>(&self) -> MassConstants<T> {
        self.map(rounded)
    }
}

/// A constant in numbers of fewer digits.
pub(super) fn rounded<T: Scalar>(value: Double) -> T {
    T::from_parts(value.high(), value.low())
}

/// Gives all of these numbers their mean.
fn level(list: &mut [Double], places: &[usize]) {
    let zero = Double::from_f64(0.0);
    let own = places.iter().filter_map(|&place| list.get(place).copied());
    let sum = own.fold(zero, |sum, value| sum + value);
    let mean = sum / Double::from_f64(places.len() as f64);
    for &place in places {
        if let Some(value) = list.get_mut(place) {
            *value = mean;
        }
    }
}
