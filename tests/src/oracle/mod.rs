//! Pendulum trees once more, from first principles and in plain numbers: what
//! the derived mechanics is compared with.
//!
//! Nothing here knows the library under test. A tree is a list of bodies with
//! their masses and vectors; three routes lead from it to accelerations:
//! Cartesian Jacobians ([`cartesian`]), maximal coordinates with constraint
//! forces ([`constrained`]), and the closed form of the literature
//! ([`closed_form`]).

pub mod cartesian;
pub mod closed_form;
pub mod constrained;
pub mod drive;
pub mod generator;
pub mod observable;
pub mod points;

/// A vector in the plane of motion: x to the side, y upwards, m.
pub type Vector = [f64; 2];

/// A rigid link.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Index of the link that it hangs from, an earlier one; `None` for the
    /// root.
    pub parent: Option<usize>,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the centre of mass, kg m².
    pub inertia: f64,
    /// Centre of mass from the pivot: along the link and across it, m.
    pub com: [f64; 2],
    /// Pivot on the parent, from the parent's pivot: along the parent and
    /// across it, m.
    pub pivot: [f64; 2],
    /// Viscous friction in the pivot, N m s.
    pub friction: f64,
    /// Viscous drag against the ground, N m s.
    pub drag: f64,
    /// Stiffness of a torsion spring in the pivot, N m.
    pub spring: f64,
    /// Relative angle at which the spring is at rest, rad.
    pub rest: f64,
    /// Friction beside viscous friction: in the pivot, and against the ground.
    pub laws: [Law; 2],
}

/// A torque of Coulomb, Stribeck and quadratic friction, smooth at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Coulomb friction, N m.
    pub coulomb: f64,
    /// Quadratic friction, N m s².
    pub quadratic: f64,
    /// Rate at which both are as smooth as they are strong, rad/s.
    pub width: f64,
    /// Static friction minus Coulomb friction, N m.
    pub excess: f64,
    /// Rate at which half of the excess is left, rad/s.
    pub stribeck: f64,
}

impl Default for Law {
    fn default() -> Self {
        Self {
            coulomb: 0.0,
            quadratic: 0.0,
            width: 1.0,
            excess: 0.0,
            stribeck: 1.0,
        }
    }
}

impl Law {
    /// Torque against a rate, N m, and by how much it may change where every term that
    /// the rate is the sum of changes by one part in one.
    pub(crate) fn torque(&self, rate: f64, terms: f64) -> (f64, f64) {
        let speed = rate.hypot(self.width);
        let ratio = (rate / self.stribeck).powi(2);
        let excess = self.excess / (1.0 + ratio);
        let dry = self.coulomb + excess;
        let torque = dry * (rate / speed) + self.quadratic * rate * speed;
        let slope = dry * (self.width / speed).powi(2) / speed
            + 2.0 * excess * ratio / (1.0 + ratio) / speed
            + self.quadratic * (speed + rate * rate / speed);
        (torque, torque.abs() + slope * terms)
    }
}

impl Link {
    /// Torque of drag on the link at its angular velocity, N m, and its size.
    pub(crate) fn ground_torque(&self, omega: f64) -> (f64, f64) {
        let (torque, terms) = self.laws[1].torque(omega, 0.0);
        (
            -self.drag * omega - torque,
            (self.drag * omega).abs() + terms,
        )
    }

    /// The link's value less its parent's.
    fn relative(&self, own: f64, all: &[f64]) -> f64 {
        own - self.parent.map_or(0.0, |parent| all[parent])
    }

    /// Torque of friction and spring that the parent exerts on the link in its
    /// pivot, N m, and the sum of its absolute terms. Angles and rates are what they are:
    /// their differences are terms, and angles and rates themselves are none.
    pub(crate) fn pivot_torque(&self, index: usize, theta: &[f64], omega: &[f64]) -> (f64, f64) {
        let angle = self.relative(theta[index], theta);
        let (strain, rate) = (angle - self.rest, self.relative(omega[index], omega));
        let torque = self.friction * rate + self.spring * strain;
        let rounded = if self.rest == 0.0 { 0.0 } else { angle.abs() };
        let terms = self.friction * rate.abs() + self.spring * (strain.abs() + rounded);
        let (braking, braking_terms) = self.laws[0].torque(rate, rate.abs());
        (-torque - braking, terms + braking_terms)
    }
}

/// A torsion spring and friction between any two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// The links.
    pub links: [usize; 2],
    /// Viscous friction, N m s.
    pub friction: f64,
    /// Stiffness of the torsion spring, N m.
    pub spring: f64,
    /// Angle of the first link less the second one's at which the spring is at rest, rad.
    pub rest: f64,
    /// Friction beside viscous friction.
    pub law: Law,
}

impl Between {
    fn difference(&self, all: &[f64]) -> f64 {
        let [a, b] = self.links;
        all[a] - all[b]
    }

    /// Torque on the first link, N m, and the sum of its absolute terms.
    fn torque(&self, theta: &[f64], omega: &[f64]) -> (f64, f64) {
        let (angle, rate) = (self.difference(theta), self.difference(omega));
        let strain = angle - self.rest;
        let rounded = if self.rest == 0.0 { 0.0 } else { angle.abs() };
        let terms = self.friction * rate.abs() + self.spring * (strain.abs() + rounded);
        let (braking, braking_terms) = self.law.torque(rate, rate.abs());
        let torque = self.friction * rate + self.spring * strain + braking;
        (-torque, terms + braking_terms)
    }

    /// Energy of the spring, J.
    fn energy(&self, theta: &[f64]) -> f64 {
        0.5 * self.spring * (self.difference(theta) - self.rest).powi(2)
    }
}

/// A tree of links under gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Gravitational acceleration, m/s².
    pub gravity: f64,
    /// Links, parents before children.
    pub links: Vec<Link>,
    /// Springs and friction between links.
    pub between: Vec<Between>,
}

impl Tree {
    /// The links from `link` up to the root, both included.
    pub fn lineage(&self, link: usize) -> Vec<usize> {
        let mut lineage = vec![link];
        while let Some(parent) = self.links[lineage[lineage.len() - 1]].parent {
            lineage.push(parent);
        }
        lineage
    }
}

/// A point of a link in the plane: at angle 0 `along` points down and `across`
/// to the side; positive angles turn counter-clockwise.
fn turned([along, across]: [f64; 2], theta: f64) -> Vector {
    let (sin, cos) = theta.sin_cos();
    [along * sin + across * cos, across * sin - along * cos]
}

/// The sizes of the two terms of each component of [`turned`].
fn turned_terms([along, across]: [f64; 2], theta: f64) -> Vector {
    let (sin, cos) = theta.sin_cos();
    [
        (along * sin).abs() + (across * cos).abs(),
        (across * sin).abs() + (along * cos).abs(),
    ]
}

/// The vector turned by a right angle, counter-clockwise: the velocity that
/// unit angular velocity gives to the end of `r`.
fn perpendicular([x, y]: Vector) -> Vector {
    [-y, x]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
