//! Constants of the Lagrangian of a tree, in absolute angles (physics (1.6), (1.7)).

use alloc::vec::Vec;

use super::pattern::MatrixPattern;
use crate::friction::FrictionLaw;
use crate::scalar::{Double, Scalar};

/// Constants of a rigid link, in SI units. Points are given by their components along the link and
/// across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidLink<T> {
    /// Index of the parent, which is smaller than that of the link; `None` for the root.
    pub parent: Option<usize>,
    /// Mass, in kg.
    pub mass: T,
    /// Moment of inertia about the centre of mass, in kg m².
    pub inertia: T,
    /// Centre of mass relative to the link's own pivot, in m.
    pub com: [T; 2],
    /// The link's pivot relative to the parent's pivot, in the parent's frame, in m.
    pub pivot: [T; 2],
    /// Stiffness of the spring in the link's pivot, in N m.
    pub spring: T,
    /// Rest angle of that spring, relative to the parent, in rad.
    pub rest: T,
    /// Coefficient of viscous friction in the link's pivot, in N m s.
    pub friction: T,
    /// Coefficient of viscous drag against the ground, in N m s.
    pub drag: T,
    /// Laws of friction that is not viscous: in the pivot, and against the ground.
    pub laws: [FrictionLaw<T>; 2],
}

impl<T: Copy> RigidLink<T> {
    /// Converts the link to another scalar.
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
            laws: self.laws.map(|law| law.map(&convert)),
        }
    }
}

/// Constants of the mass matrix M and the potential energy U of a tree: one number per link, and
/// one per pair of a link and an ancestor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MassConstants<T> {
    /// Diagonal entries M_ii.
    pub(super) inertia: Vec<T>,
    /// Coefficients μ_ij of the entries M_ij = μ_ij cos (θ_i − θ_j) + ν_ij sin (θ_i − θ_j) of the
    /// mass matrix.
    pub(super) coupling: Vec<T>,
    /// Coefficients ν_ij of the sines in the mass matrix; empty if all points lie on the axes of
    /// their links.
    pub(super) lateral_coupling: Vec<T>,
    /// Coefficients G_i (N m) of the potential energy U = Σ G_i (1 − cos θ_i) + F_i sin θ_i.
    pub(super) gravity: Vec<T>,
    /// Coefficients F_i (N m) of the sines in the potential energy; empty if all points lie on the
    /// axes of their links.
    pub(super) lateral_gravity: Vec<T>,
    /// Stiffnesses of the springs in the pivots; empty without springs.
    pub(super) spring: Vec<T>,
    /// Rest angles of the springs in the pivots; empty without springs.
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

    /// Converts the constants to another scalar.
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> MassConstants<S> {
        self.map(convert)
    }
}

/// Returns the first moment of mass (kg m) of each link about its pivot. The links that hang from
/// it count as point masses at their pivots.
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

/// Returns for each link the total mass (kg) of the link and of all links below it.
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
    /// Computes the constants of a tree from its links and the gravity (m/s²).
    pub(super) fn new(
        pattern: &MatrixPattern,
        links: &[RigidLink<Double>],
        gravity: Double,
    ) -> Self {
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
            // `child` is the child of each ancestor on the path to this link.
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

    /// Returns the constants of the mean tree (physics (14.1)): all links of a node get the mean of
    /// their constants.
    pub(super) fn mean(&self, pattern: &MatrixPattern, nodes: &[Vec<usize>]) -> Self {
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

    /// Returns the differences between these constants and those of another tree.
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

    /// Returns the constants, rounded from `Double` to the scalar type `T`.
    pub(super) fn rounded<T: Scalar>(&self) -> MassConstants<T> {
        self.map(rounded)
    }
}

/// Rounds a constant to a scalar type with fewer digits.
pub(super) fn rounded<T: Scalar>(value: Double) -> T {
    T::from_parts(value.high(), value.low())
}

/// Replaces the numbers at the indices `places` by their mean.
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
