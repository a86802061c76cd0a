//! Passive torques of a link: friction and a spring in its pivot, and drag against the ground.

use super::Quantity;
use super::bodies::{Dimension, GivenProperties};
use super::friction_law::{FrictionContact, FrictionLaw};
use crate::description::Property;
use crate::report::{Faults, SyntaxMessage, TreeMessage, nearest};

/// Friction, drag and spring of a link; absent ones are zero. `V` is the type of the constants,
/// which differs between stages.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PassiveTorques<V = Quantity> {
    /// Coefficient of viscous friction in the link's pivot, in N m s; it acts on the angular
    /// velocity relative to the parent (to the ground for the root).
    pub friction: V,
    /// Coefficient of viscous drag against the ground, in N m s; it acts on the link's own angular
    /// velocity.
    pub drag: V,
    /// Stiffness of a torsion spring in the link's pivot, in N m; it acts on the angle
    /// relative to the parent (to the vertical for the root).
    pub spring: V,
    /// Angle at which the spring is at rest, in rad.
    pub rest: V,
    /// Friction that is not viscous, in the order of [`FrictionContact::ALL`].
    pub laws: [FrictionLaw<V>; 2],
}

impl<V> PassiveTorques<V> {
    /// Returns the torques with `formed` applied to every constant.
    pub fn map<W>(&self, mut formed: impl FnMut(&V) -> W) -> PassiveTorques<W> {
        PassiveTorques {
            friction: formed(&self.friction),
            drag: formed(&self.drag),
            spring: formed(&self.spring),
            rest: formed(&self.rest),
            laws: self.laws.each_ref().map(|law| law.map(&mut formed)),
        }
    }

    /// Returns the friction law at a contact.
    pub fn law(&self, place: FrictionContact) -> &FrictionLaw<V> {
        &self.laws[place as usize]
    }
}

impl PassiveTorques {
    /// Reads the passive torques from a link's properties.
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
            laws: FrictionContact::ALL.map(|place| FrictionLaw::of(given, place)),
        }
    }

    /// Returns the torques without friction and drag: the spring alone, which conserves energy.
    #[must_use]
    pub fn frictionless(&self) -> Self {
        Self {
            spring: self.spring.clone(),
            rest: self.rest.clone(),
            friction: Quantity::zero(),
            drag: Quantity::zero(),
            laws: FrictionContact::ALL.map(|_| FrictionLaw::none()),
        }
    }

    /// Returns true if all friction is viscous.
    pub fn is_viscous(&self) -> bool {
        self.laws.iter().all(FrictionLaw::is_none)
    }

    /// Returns true if friction acts in the link's pivot.
    pub fn has_friction(&self) -> bool {
        !self.friction.is_zero() || !self.law(FrictionContact::Joint).is_none()
    }

    /// Returns true if the link has drag against the ground.
    pub fn has_drag(&self) -> bool {
        !self.drag.is_zero() || !self.law(FrictionContact::Ground).is_none()
    }

    /// Returns true if the joint has friction or a spring.
    pub fn has_joint_torque(&self) -> bool {
        self.has_friction() || !self.spring.is_zero()
    }

    /// Multiplies the torques by the number of links that move as one.
    pub(super) fn times(&mut self, count: usize) {
        for value in [&mut self.friction, &mut self.drag, &mut self.spring] {
            *value = value.times(count);
        }
        self.laws.iter_mut().for_each(|law| law.times(count));
    }

    /// Adds the drag of links that are locked to this one. Returns false if their smoothing width
    /// differs from that of this link.
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
        let fits = law.is_none() || own.shape() == law.shape();
        *own = own.combined(&law, |a, b| Quantity::sum([a.clone(), b.clone()]));
        fits
    }
}

/// Returns the properties with known names, each once; reports unknown and repeated ones.
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

/// Reports `rest` without a spring. `unit` is the unit of the spring's stiffness.
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

/// Reports a rest angle without a spring, a smoothing width without a friction law, and a static
/// friction or a Stribeck rate without the other.
pub(super) fn check_idle(properties: &[Property], owner: &str, report: &mut Faults) {
    check_rest(properties, owner, "N m", report);
    let find = |name: &str| properties.iter().find(|p| p.key() == name);
    let link = || owner.to_owned();
    for force in ["friction", "drag"] {
        let member = |member: &str| find(&format!("{force}({member})"));
        let laws = ["coulomb", "static", "quadratic"].map(member);
        if let (Some(width), [None, None, None]) = (member("width"), laws) {
            report.error(width.name.span(), TreeMessage::IdleWidth { link: link() });
        }
    }
    let link = link();
    match (find("friction(static)"), find("friction(stribeck)")) {
        (Some(own), None) => {
            report.error(own.name.span(), TreeMessage::StaticWithoutRate { link });
        }
        (None, Some(own)) => {
            report.error(own.name.span(), TreeMessage::RateWithoutStatic { link });
        }
        (Some(_), Some(_)) | (None, None) => {}
    }
}
