//! Torques that a link has by its own motion: friction and a spring in its pivot, and drag
//! against the ground.

use super::Quantity;
use super::bodies::{Dimension, GivenProperties};
use crate::description::Property;
use crate::exact::Rational;
use crate::report::{Faults, SyntaxMessage, TreeMessage, nearest};

/// Friction and spring of a link; what it does not have is zero. Every stage has them with
/// constants `V` of its own.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PassiveTorques<V = Quantity> {
    /// Viscous friction in the link's pivot, N m s, on the angular velocity
    /// relative to the parent (to the ground for the root).
    pub friction: V,
    /// Viscous drag against the ground, N m s, on the link's own angular velocity.
    pub drag: V,
    /// Stiffness of a torsion spring in the link's pivot, N m, on the angle
    /// relative to the parent (to the vertical for the root).
    pub spring: V,
    /// Relative angle at which the spring is at rest, rad.
    pub rest: V,
    /// Friction that is not viscous, by [`FrictionPlace`].
    pub laws: [FrictionLaw<V>; 2],
}

/// Law of the torque at the rate w, −(C/s + q s) w with the speed s = √(w² + ε²): Coulomb's
/// −C sign w and −q w |w| where |w| is large beside the width ε, and smooth where it is not.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionLaw<V = Quantity> {
    /// Coulomb friction C, N m.
    pub coulomb: V,
    /// Quadratic friction q, N m s².
    pub quadratic: V,
    /// Width ε, rad/s.
    pub width: V,
}

/// The part of a link that friction acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionPlace {
    /// The link's pivot, on the rate relative to the parent.
    Joint,
    /// Itself, against the ground, on its own rate.
    Ground,
}

impl FrictionPlace {
    /// Both, in the order of [`PassiveTorques::laws`].
    pub const ALL: [Self; 2] = [Self::Joint, Self::Ground];
}

impl<V> FrictionLaw<V> {
    /// The law with constants that are formed of its own.
    pub fn map<W>(&self, mut formed: impl FnMut(&V) -> W) -> FrictionLaw<W> {
        FrictionLaw {
            coulomb: formed(&self.coulomb),
            quadratic: formed(&self.quadratic),
            width: formed(&self.width),
        }
    }
}

impl<V> PassiveTorques<V> {
    /// The torques with constants that are formed of their own.
    pub fn map<W>(&self, mut formed: impl FnMut(&V) -> W) -> PassiveTorques<W> {
        PassiveTorques {
            friction: formed(&self.friction),
            drag: formed(&self.drag),
            spring: formed(&self.spring),
            rest: formed(&self.rest),
            laws: self.laws.each_ref().map(|law| law.map(&mut formed)),
        }
    }

    /// The law of friction at a place.
    pub fn law(&self, place: FrictionPlace) -> &FrictionLaw<V> {
        &self.laws[place as usize]
    }
}

impl FrictionLaw {
    /// The law in these parentheses of a link. The width divides, so that it is one where
    /// there is no law.
    fn of(given: &GivenProperties, force: &str) -> Self {
        let member = |name: &str| format!("{force}({name})");
        let mut law = Self {
            coulomb: given.get(&member("coulomb")),
            quadratic: given.get(&member("quadratic")),
            width: Quantity::integer(1),
        };
        if !law.is_none() {
            let width = given.value(&member("width")).cloned();
            law.width = width.unwrap_or_else(default_width);
        }
        law
    }

    /// Returns true if there is no such friction.
    pub fn is_none(&self) -> bool {
        self.coulomb.is_zero() && self.quadratic.is_zero()
    }

    /// The law of links that turn as one, as heavy as so many.
    fn times(&mut self, count: usize) {
        for value in [&mut self.coulomb, &mut self.quadratic] {
            *value = value.times(count);
        }
    }
}

/// One hundredth of a radian a second.
fn default_width() -> Quantity {
    Rational::from_ratio(1, 100).map_or_else(Quantity::zero, Quantity::number)
}

impl PassiveTorques {
    /// The torques that a link gives.
    pub(super) fn of(given: &GivenProperties) -> Self {
        let spring = given.get("spring");
        let rest = match spring.is_zero() {
            true => Quantity::zero(),
            false => given.get("rest"),
        };
        Self {
            friction: given.get("friction"),
            drag: given.get("drag"),
            spring,
            rest,
            laws: ["friction", "drag"].map(|force| FrictionLaw::of(given, force)),
        }
    }

    /// The torques that keep the energy: the spring alone.
    #[must_use]
    pub fn frictionless(&self) -> Self {
        Self {
            spring: self.spring.clone(),
            rest: self.rest.clone(),
            friction: Quantity::zero(),
            drag: Quantity::zero(),
            laws: FrictionPlace::ALL.map(|_| FrictionLaw {
                coulomb: Quantity::zero(),
                quadratic: Quantity::zero(),
                width: Quantity::integer(1),
            }),
        }
    }

    /// Returns true if all friction is viscous.
    pub fn is_viscous(&self) -> bool {
        self.laws.iter().all(FrictionLaw::is_none)
    }

    /// Returns true if friction acts in the link's pivot.
    pub fn has_friction(&self) -> bool {
        !self.friction.is_zero() || !self.law(FrictionPlace::Joint).is_none()
    }

    /// Returns true if the link drags at the ground.
    pub fn has_drag(&self) -> bool {
        !self.drag.is_zero() || !self.law(FrictionPlace::Ground).is_none()
    }

    /// Returns true if the joint has a torque of its own.
    pub fn has_joint_torque(&self) -> bool {
        self.has_friction() || !self.spring.is_zero()
    }

    /// Torques of so many links that turn as one.
    pub(super) fn times(&mut self, count: usize) {
        for value in [&mut self.friction, &mut self.drag, &mut self.spring] {
            *value = value.times(count);
        }
        self.laws.iter_mut().for_each(|law| law.times(count));
    }

    /// Takes over the drag of links that do not turn by themselves. False where its width
    /// is another one.
    pub(super) fn take_drag(&mut self, other: &Self, count: usize) -> bool {
        let mut other = other.clone();
        other.times(count);
        self.drag = Quantity::sum([self.drag.clone(), other.drag]);
        let [_, own] = &mut self.laws;
        let [_, law] = other.laws;
        if own.is_none() {
            *own = law;
            return true;
        }
        own.coulomb = Quantity::sum([own.coulomb.clone(), law.coulomb.clone()]);
        own.quadratic = Quantity::sum([own.quadratic.clone(), law.quadratic.clone()]);
        law.is_none() || own.width == law.width
    }
}

/// The properties that are among the known ones, each once; others go to `report`.
pub(super) fn known_once<'c>(
    properties: &'c [Property],
    known: &[&'static Dimension],
    body: String,
    report: &mut Faults,
) -> Vec<(&'static Dimension, &'c Property)> {
    let names: Vec<&'static str> = known.iter().map(|known| known.name).collect();
    let mut seen: Vec<String> = Vec::new();
    let mut found = Vec::new();
    for property in properties {
        let (name, span) = (property.key(), property.name.span());
        match known.iter().find(|known| known.name == name) {
            _ if seen.contains(&name) => {
                report.error(span, SyntaxMessage::duplicate_property(&name))
            }
            Some(known) => found.push((*known, property)),
            None => {
                let message = TreeMessage::UnknownProperty {
                    nearest: nearest(&name, &names),
                    name: name.clone(),
                    body: body.clone(),
                    known: names.clone(),
                };
                report.error(span, message);
            }
        }
        seen.push(name);
    }
    found
}

/// Checks that what is at rest is a spring, whose stiffness has this unit.
pub(super) fn check_rest(
    properties: &[Property],
    owner: &str,
    unit: &'static str,
    report: &mut Faults,
) {
    let find = |name: &str| properties.iter().find(|p| p.key() == name);
    if let (Some(rest), None) = (find("rest"), find("spring")) {
        let link = owner.to_owned();
        let message = TreeMessage::RestWithoutSpring { link, unit };
        report.error(rest.name.span(), message);
    }
}

/// Checks that a rest angle is that of a spring, and a width that of a law.
pub(super) fn check_idle(properties: &[Property], owner: &str, report: &mut Faults) {
    check_rest(properties, owner, "N m", report);
    let find = |name: &str| properties.iter().find(|p| p.key() == name);
    let link = || owner.to_owned();
    for force in ["friction", "drag"] {
        let member = |member: &str| find(&format!("{force}({member})"));
        if let (Some(width), None, None) = (member("width"), member("coulomb"), member("quadratic"))
        {
            report.error(width.name.span(), TreeMessage::IdleWidth { link: link() });
        }
    }
}
