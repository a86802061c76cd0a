//! Springs and dampers between links.

use std::hash::Hash;

use branched_pendulum::scalar::Scalar;
use branched_pendulum::spring_dampers::SpringDampers;
use branched_pendulum::translational::{
    LineArm, LinePotential, TranslationalSpringDamper, TranslationalSpringDampers,
};
use branched_pendulum_codegen::scene::{DescribedLinePotential, LinkId, Quantity, Scene};

use crate::numbers::{self, RepeatedValues};

/// Springs and dampers between links and to the ground: torsion spring-dampers, and straight ones.
#[derive(Clone, Debug)]
pub(crate) struct Between<T> {
    pub(crate) torsional: SpringDampers<T>,
    pub(crate) translational: TranslationalSpringDampers<T>,
}

impl<T: Scalar> Between<T> {
    /// Returns the springs and dampers between the links of a scene with `links` links, for values
    /// of its parameters that are not checked.
    pub(crate) fn of(scene: &Scene, links: usize, parameters: &[T]) -> Self {
        let torsional = numbers::spring_dampers(scene, parameters);
        let translational = straight(scene, parameters);
        // A scene names links that it has.
        Self {
            torsional: SpringDampers::of_runs(links, torsional).unwrap_or_default(),
            translational: TranslationalSpringDampers::new(links, translational)
                .unwrap_or_default(),
        }
    }

    /// Returns an empty set of springs and dampers, for a tree with this number of links.
    pub(crate) fn none(links: usize) -> Self {
        Self {
            torsional: SpringDampers::new(links, Vec::new()).unwrap_or_default(),
            translational: TranslationalSpringDampers::new(links, Vec::new()).unwrap_or_default(),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Between<S> {
        Between {
            torsional: self.torsional.cast(&convert),
            translational: self.translational.cast(convert),
        }
    }

    /// All that is no constant.
    pub(crate) fn shape(&self) -> impl Hash + use<T> {
        let torsional = self.torsional.iter();
        let torsional: Vec<_> = torsional
            .map(|own| (own.links, own.law.is_some()))
            .collect();
        let translational = self.translational.iter().map(|own| own.map(|_| ()));
        (torsional, translational.collect::<Vec<_>>())
    }

    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.torsional.is_empty() && self.translational.is_empty()
    }

    /// Writes the sum of all torques on the links: the torques in `outside`, if given, and the
    /// torques of springs and dampers between links. NaN if a slice does not have one number per
    /// link.
    #[inline(always)]
    pub(crate) fn write_torques(&self, outside: Option<&[T]>, given: [&[T]; 2], torques: &mut [T]) {
        self.torsional.write_torques(outside, given, torques);
        if !self.translational.is_empty() {
            self.translational.add_torques(given, torques);
        }
    }

    pub(crate) fn energy(&self, theta: &[T]) -> T {
        let torsional = self.torsional.energy(theta);
        match self.translational.is_empty() {
            true => torsional,
            false => torsional + self.translational.energy(theta),
        }
    }

    pub(crate) fn power(&self, theta: &[T], omega: &[T]) -> T {
        let torsional = self.torsional.power(omega);
        match self.translational.is_empty() {
            true => torsional,
            false => torsional + self.translational.power(theta, omega),
        }
    }
}

/// Returns the straight springs and dampers of a scene.
fn straight<S: Scalar>(scene: &Scene, parameters: &[S]) -> Vec<TranslationalSpringDamper<S>> {
    let values = RepeatedValues::new(parameters);
    let at = |quantity: &Quantity| values.value(quantity);
    let given = |quantity: &Quantity| (!quantity.is_zero()).then(|| at(quantity));
    let potential = |own: &DescribedLinePotential| match own {
        DescribedLinePotential::Spring { stiffness, rest } => LinePotential::Spring {
            stiffness: at(stiffness),
            rest: given(rest),
        },
        DescribedLinePotential::InversePower { strength, exponent } => {
            LinePotential::InversePower {
                strength: at(strength),
                exponent: *exponent,
            }
        }
    };
    let lines = scene.lines().into_iter().filter_map(|line| {
        let own = scene.translational.get(line.spring_damper)?;
        let arms = line.arms.iter().map(|(LinkId(link), arm)| LineArm {
            link: *link,
            along: at(&arm.along),
            lateral: at(&arm.lateral),
        });
        Some(TranslationalSpringDamper {
            arms: arms.collect(),
            offset: line.offset.each_ref().map(at),
            potentials: own.potentials.iter().map(potential).collect(),
            friction: given(&own.friction),
        })
    });
    lines.collect()
}
