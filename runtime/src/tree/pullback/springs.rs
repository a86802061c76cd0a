//! Virtual power of torsion springs and friction, with its derivatives.

use super::constants::PassiveTorque;
use super::power::{Derivatives, VirtualMotion};
use crate::friction::{FrictionLaw, LAW_CONSTANTS};
use crate::scalar::{Dual, Scalar};

impl<T: Scalar> Derivatives<'_, T> {
    /// Adds the derivatives of the springs and friction between links that are not parent and child.
    pub(super) fn add_springs(&mut self) {
        let power = self.power;
        let group = 1 + power.links.len();
        for (run, own) in power.springs.runs().enumerate() {
            for spring in own {
                let torque = PassiveTorque::of(&spring);
                let by = self.add_torque(&torque, spring.links.map(Some));
                let constants = [by.spring, by.rest, by.friction];
                self.add_by_parameters(group + run, 0, &constants);
                self.add_by_law(group + run, constants.len(), by.law);
            }
        }
    }

    /// Adds the derivatives of a torsion spring and friction between two `links`, where `None` is the
    /// ground. Returns the derivatives by the constants.
    pub(super) fn add_torque(
        &mut self,
        own: &PassiveTorque<T>,
        links: [Option<usize>; 2],
    ) -> PassiveTorque<T> {
        let zero = T::from_f64(0.0);
        let VirtualMotion {
            theta,
            omega,
            lambda,
            ..
        } = self.motion;
        let [angle, rate, across] = [theta, omega, lambda].map(|values| {
            let [own, other] = links.map(|link| link.map_or(zero, |link| values[link]));
            own - other
        });
        let (law, slope) = match &own.law {
            Some(law) => {
                let (by, slope) = law_slopes(law, rate);
                (Some(by.map(|slope| -(across * slope))), slope)
            }
            None => (None, zero),
        };
        let [by_theta, by_omega, _] = &mut self.by;
        let by_angle = across * own.spring;
        let by_rate = across * (own.friction + slope);
        let [own_link, other] = links;
        if let Some(link) = own_link {
            by_theta[link] = by_theta[link] - by_angle;
            by_omega[link] = by_omega[link] - by_rate;
        }
        if let Some(link) = other {
            by_theta[link] = by_theta[link] + by_angle;
            by_omega[link] = by_omega[link] + by_rate;
        }
        PassiveTorque {
            spring: -(across * (angle - own.rest)),
            rest: by_angle,
            friction: -(across * rate),
            law,
        }
    }
}

/// Returns the derivatives of the torque of a law of friction by its constants and by the rate.
fn law_slopes<T: Scalar>(law: &FrictionLaw<T>, rate: T) -> (FrictionLaw<T>, T) {
    let mut index = 0..=LAW_CONSTANTS;
    let mut variable = |value: T| {
        let index = index.next().unwrap_or(LAW_CONSTANTS);
        Dual::<T, { LAW_CONSTANTS + 1 }>::variable(value, index)
    };
    let varied = law.map(&mut variable);
    let [constants @ .., slope] = varied.torque(variable(rate)).tangents;
    (FrictionLaw::of_constants(constants), slope)
}
