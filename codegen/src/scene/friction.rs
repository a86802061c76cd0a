//! Friction that is not viscous: laws of joints and of the ground.

use super::bodies::GivenProperties;
use super::reduction::times;
use super::template::Template;
use super::{Link, Quantity};
use crate::description::Node;
use crate::exact::Rational;
use crate::report::{Report, TreeMessage};

/// Law of the torque at the rate w, −(C/s + q s) w with the speed s = √(w² + ε²): Coulomb's
/// −C sign w and −q w |w| where |w| is large beside the width ε, and smooth where it is not.
/// Every stage has it with constants `V` of its own.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionLaw<V = Quantity> {
    /// Coulomb friction C, N m.
    pub coulomb: V,
    /// Quadratic friction q, N m s².
    pub quadratic: V,
    /// Width ε, rad/s.
    pub width: V,
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

/// Friction of a link beside viscous friction and drag.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NonlinearFriction {
    /// Law in the pivot, on the rate relative to the parent; `None` without.
    pub joint: Option<FrictionLaw>,
    /// Law against the ground, on the link's own rate; `None` without.
    pub ground: Option<FrictionLaw>,
}

impl FrictionLaw {
    /// The law in these parentheses of a link, if there is one.
    fn of(given: &GivenProperties, force: &str) -> Option<Self> {
        let member = |name: &str| given.value(&format!("{force}({name})")).cloned();
        let [coulomb, quadratic] =
            ["coulomb", "quadratic"].map(|name| member(name).unwrap_or_else(Quantity::zero));
        let is_none = coulomb.is_zero() && quadratic.is_zero();
        let width = member("width").unwrap_or_else(default_width);
        (!is_none).then_some(Self {
            coulomb,
            quadratic,
            width,
        })
    }

    /// The law of links that turn as one, as heavy as so many.
    fn times(&mut self, count: usize) {
        for value in [&mut self.coulomb, &mut self.quadratic] {
            *value = times(count, value);
        }
    }
}

/// One hundredth of a radian a second.
fn default_width() -> Quantity {
    Rational::from_ratio(1, 100).map_or_else(Quantity::zero, Quantity::Exact)
}

impl NonlinearFriction {
    /// The laws that a link gives.
    pub(super) fn of(given: &GivenProperties) -> Self {
        Self {
            joint: FrictionLaw::of(given, "friction"),
            ground: FrictionLaw::of(given, "drag"),
        }
    }

    /// Returns true if all friction is viscous.
    pub fn is_none(&self) -> bool {
        self.joint.is_none() && self.ground.is_none()
    }

    /// The laws with their names.
    pub(super) fn laws(&self) -> impl Iterator<Item = (&'static str, &FrictionLaw)> {
        let laws = [("friction", &self.joint), ("drag", &self.ground)];
        laws.into_iter()
            .filter_map(|(name, law)| Some((name, law.as_ref()?)))
    }

    /// Friction of so many links that turn as one.
    pub(super) fn times(&mut self, count: usize) {
        let laws = [&mut self.joint, &mut self.ground];
        laws.into_iter().flatten().for_each(|law| law.times(count));
    }

    /// Takes over the drag of links that do not turn by themselves. False where its width
    /// is another one.
    pub(super) fn take_ground(&mut self, other: &mut Self, count: usize) -> bool {
        let Some(mut law) = other.ground.take() else {
            return true;
        };
        law.times(count);
        let Some(own) = &mut self.ground else {
            self.ground = Some(law);
            return true;
        };
        own.coulomb = Quantity::sum([own.coulomb.clone(), law.coulomb]);
        own.quadratic = Quantity::sum([own.quadratic.clone(), law.quadratic]);
        own.width == law.width
    }
}

impl Link {
    /// Returns true if friction acts in the link's pivot.
    pub fn has_friction(&self) -> bool {
        self.friction.is_some() || self.nonlinear.joint.is_some()
    }

    /// Returns true if the link drags at the ground.
    pub fn has_drag(&self) -> bool {
        self.drag.is_some() || self.nonlinear.ground.is_some()
    }

    /// Returns true if the joint has a torque of its own.
    pub fn has_joint_torque(&self) -> bool {
        self.has_friction() || self.spring.is_some()
    }
}

impl Template {
    /// Returns true if friction acts in the pivot.
    pub(super) fn has_friction(&self) -> bool {
        self.friction.is_some() || self.nonlinear.joint.is_some()
    }
}

/// Checks that a width is that of a law.
pub(super) fn check_width(node: &Node, report: &mut Report) {
    for force in ["friction", "drag"] {
        let find = |member: &str| {
            let wanted = format!("{force}({member})");
            node.properties.iter().find(|p| p.key() == wanted)
        };
        if let (Some(width), None, None, false) = (
            find("width"),
            find("coulomb"),
            find("quadratic"),
            node.damaged,
        ) {
            let link = node.name.to_string();
            report.error(width.name.span(), TreeMessage::IdleWidth { link });
        }
    }
}
