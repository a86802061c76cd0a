//! Law of friction that is not viscous: Coulomb, Stribeck and quadratic friction.
//!
//! The order of the constants is that of [`FrictionLaw::into_constants`] everywhere: in
//! descriptions, in the equations of a link and at run time. Code that does the same with every
//! constant takes them as an array of this order.

use super::bodies::GivenProperties;
use super::values::{Usage, Values};
use super::{Quantity, Sign};
use crate::description::Property;
use crate::exact::Rational;
use crate::report::{Faults, TreeMessage};

/// Number of constants of a [`FrictionLaw`].
pub const LAW_CONSTANTS: usize = 5;

/// Law of the friction torque at the angular velocity w: −(A/s + q s) w with the speed s = √(w² +
/// ε²) and A = C + ΔC/(1 + (w/ϖ)²). If |w| is large compared with the width ε, this is −A sign w
/// plus −q w |w|; near w = 0 it is smooth. A falls from the static friction C + ΔC to the Coulomb
/// friction C as |w| passes the Stribeck rate ϖ; without an excess ΔC the law is Coulomb's.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionLaw<V = Quantity> {
    /// Coulomb friction C, in N m.
    pub coulomb: V,
    /// Quadratic friction q, in N m s².
    pub quadratic: V,
    /// Smoothing width ε, in rad/s.
    pub width: V,
    /// Excess ΔC of static over Coulomb friction, in N m.
    pub excess: V,
    /// Stribeck rate ϖ, in rad/s, at which half of the excess is left.
    pub stribeck: V,
}

/// Contact at which friction acts on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionContact {
    /// The link's pivot; acts on the angular velocity relative to the parent.
    Joint,
    /// The ground; acts on the link's own angular velocity.
    Ground,
}

impl FrictionContact {
    /// Both contacts, in the order of [`PassiveTorques::laws`](super::PassiveTorques::laws).
    pub const ALL: [Self; 2] = [Self::Joint, Self::Ground];

    /// Returns the property of a link that contains the friction law.
    pub fn property(self) -> &'static str {
        match self {
            Self::Joint => "friction",
            Self::Ground => "drag",
        }
    }
}

/// Names and unit of one constant of a [`FrictionLaw`].
#[derive(Clone, Copy, Debug)]
pub struct LawConstant {
    /// Name of the constant within a law, as in `friction(coulomb = 0.1)`. A description states the
    /// static friction C + ΔC in place of the excess.
    pub member: &'static str,
    /// Names of the constants that the compiler creates for a link, by [`FrictionContact`]; `None`
    /// if the law at this contact has no such constant.
    pub words: [Option<&'static str>; 2],
    /// Letters of the constant in formulas, in text and in LaTeX.
    pub letters: [&'static str; 2],
    /// First words of the constant's description, which continues with the law and its link.
    pub meaning: &'static str,
    /// Unit.
    pub unit: &'static str,
}

impl FrictionLaw<LawConstant> {
    /// Names and units of all constants.
    pub const NAMES: Self = Self {
        coulomb: LawConstant {
            member: "coulomb",
            words: [Some("coulomb"), None],
            letters: ["C", "C"],
            meaning: "Coulomb ",
            unit: "N m",
        },
        quadratic: LawConstant {
            member: "quadratic",
            words: [Some("quadratic_friction"), Some("quadratic_drag")],
            letters: ["q", "q"],
            meaning: "quadratic ",
            unit: "N m s²",
        },
        width: LawConstant {
            member: "width",
            words: [Some("friction_width"), Some("drag_width")],
            letters: ["ε", "\\varepsilon"],
            meaning: "width of ",
            unit: "rad/s",
        },
        excess: LawConstant {
            member: "excess",
            words: [Some("static_excess"), None],
            letters: ["ΔC", "\\Delta C"],
            meaning: "static excess of ",
            unit: "N m",
        },
        stribeck: LawConstant {
            member: "stribeck",
            words: [Some("stribeck_rate"), None],
            letters: ["ϖ", "\\varpi"],
            meaning: "Stribeck rate of ",
            unit: "rad/s",
        },
    };
}

impl LawConstant {
    /// Returns the name of the constant in words, as in "quadratic drag".
    pub fn in_words(&self, place: FrictionContact) -> String {
        format!("{}{}", self.meaning, place.property())
    }

    /// Returns a property of a friction law, such as `friction(coulomb)`, in words; `None` for other
    /// properties.
    pub(super) fn property_in_words(name: &str) -> Option<String> {
        let (property, member) = name.strip_suffix(')')?.split_once('(')?;
        let mut places = FrictionContact::ALL.into_iter();
        let place = places.find(|place| place.property() == property)?;
        let mut constants = FrictionLaw::NAMES.into_constants().into_iter();
        match constants.find(|constant| constant.member == member) {
            Some(constant) => Some(constant.in_words(place)),
            // The excess follows from this property.
            None => (member == "static").then(|| format!("static {property}")),
        }
    }
}

impl<V> FrictionLaw<V> {
    /// Creates a law from its constants.
    pub fn of_constants([coulomb, quadratic, width, excess, stribeck]: [V; LAW_CONSTANTS]) -> Self {
        Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        }
    }

    /// Returns the constants in the order of the fields.
    pub fn into_constants(self) -> [V; LAW_CONSTANTS] {
        let Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        } = self;
        [coulomb, quadratic, width, excess, stribeck]
    }

    /// Returns references to the constants.
    pub fn each_ref(&self) -> FrictionLaw<&V> {
        let Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        } = self;
        FrictionLaw {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        }
    }

    /// Returns the constants on which the torque depends: none without a law, and neither the excess
    /// nor the Stribeck rate if the excess is zero. `is_zero` recognises a constant that is zero.
    pub fn effective(&self, is_zero: impl Fn(&V) -> bool) -> FrictionLaw<Option<&V>> {
        let is_none = self.strengths().into_iter().all(&is_zero);
        let all = self.each_ref().map(|own| (!is_none).then_some(*own));
        match is_zero(&self.excess) {
            true => FrictionLaw {
                excess: None,
                stribeck: None,
                ..all
            },
            false => all,
        }
    }

    /// Returns the law with `formed` applied to every constant.
    pub fn map<W>(&self, formed: impl FnMut(&V) -> W) -> FrictionLaw<W> {
        FrictionLaw::of_constants(self.each_ref().into_constants().map(formed))
    }

    /// Returns the constants that are proportional to the torque; without them there is no law.
    pub fn strengths(&self) -> [&V; 3] {
        [&self.coulomb, &self.quadratic, &self.excess]
    }

    /// Returns the constants that determine how the torque depends on the rate.
    pub fn shape(&self) -> [&V; 2] {
        [&self.width, &self.stribeck]
    }

    /// Returns the law of two contacts with the same [shape](Self::shape) that move as one. `sum`
    /// adds two constants.
    #[must_use]
    pub fn combined(&self, other: &Self, sum: impl Fn(&V, &V) -> V) -> Self
    where
        V: Clone,
    {
        Self {
            coulomb: sum(&self.coulomb, &other.coulomb),
            quadratic: sum(&self.quadratic, &other.quadratic),
            width: self.width.clone(),
            excess: sum(&self.excess, &other.excess),
            stribeck: self.stribeck.clone(),
        }
    }
}

impl FrictionLaw {
    /// Returns the law of a contact without friction. The width and the Stribeck rate are 1,
    /// because they are divisors.
    pub(super) fn none() -> Self {
        Self {
            coulomb: Quantity::zero(),
            quadratic: Quantity::zero(),
            width: Quantity::integer(1),
            excess: Quantity::zero(),
            stribeck: Quantity::integer(1),
        }
    }

    /// Reads the law of a link at a contact.
    pub(super) fn of(given: &GivenProperties, place: FrictionContact) -> Self {
        let member = |constant: LawConstant| format!("{}({})", place.property(), constant.member);
        let names = FrictionLaw::NAMES.map(|constant| member(*constant));
        let mut law = Self {
            coulomb: given.get(&names.coulomb),
            quadratic: given.get(&names.quadratic),
            ..Self::none()
        };
        if let Some(excess) = excess(given, place) {
            law.excess = excess;
        }
        if !law.is_none() {
            let width = given.value(&names.width).cloned();
            law.width = width.unwrap_or_else(default_width);
        }
        if let (Some(rate), false) = (given.value(&names.stribeck), law.excess.is_zero()) {
            law.stribeck = rate.clone();
        }
        law
    }

    /// Checks that the static friction of the link or clause `owner` is at least its Coulomb
    /// friction. Returns `None` after reporting that it is not.
    pub(super) fn check(
        given: &GivenProperties,
        owner: &str,
        properties: &[Property],
        values: &mut Values,
        report: &mut Faults,
    ) -> Option<()> {
        let own = properties
            .iter()
            .find(|own| own.key() == "friction(static)");
        let (Some(own), Some(excess)) = (own, excess(given, FrictionContact::Joint)) else {
            return Some(());
        };
        let span = own.name.span();
        if excess.exact().is_some_and(Rational::is_negative) {
            let link = owner.to_owned();
            report.error(span, TreeMessage::StaticBelowCoulomb { link });
            return None;
        }
        let usage = Usage {
            what: format!("static friction minus Coulomb friction of `{owner}`"),
            unit: "N m",
            sign: Sign::NonNegative,
        };
        values.accept(excess, &usage, span, report).map(|_| ())
    }

    /// Returns true if the law has no friction.
    pub fn is_none(&self) -> bool {
        self.strengths().into_iter().all(Quantity::is_zero)
    }

    /// Multiplies the torque of the law by the number of links that move as one.
    pub(super) fn times(&mut self, count: usize) {
        for value in [&mut self.coulomb, &mut self.quadratic, &mut self.excess] {
            *value = value.times(count);
        }
    }
}

/// Returns the static friction minus the Coulomb friction; `None` if no static friction is given.
fn excess(given: &GivenProperties, place: FrictionContact) -> Option<Quantity> {
    let property = place.property();
    let breakaway = given.value(&format!("{property}(static)"))?.clone();
    let coulomb = given.get(&format!("{property}(coulomb)"));
    Some(Quantity::sum([breakaway, coulomb.negative()]))
}

/// Returns the default smoothing width, 0.01 rad/s.
fn default_width() -> Quantity {
    Rational::from_ratio(1, 100).map_or_else(Quantity::zero, Quantity::number)
}
