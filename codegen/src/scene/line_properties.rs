//! Properties of clauses whose forces act along the line between two points: the end points and the
//! forces.

use super::bodies::{Dimension, optional};
use super::line_potential::{self, DescribedLinePotential, LARGEST_EXPONENT, strength_unit};
use super::link_pairs::SpringDamperEnds;
use super::passive::{check_rest, known_once};
use super::properties::evaluate;
use super::values::{Usage, Values};
use super::{DescribedTranslationalSpringDamper, LineEnds, LinkId, Offset, Quantity, Sign};
use crate::description::{BETWEEN, GUY, Property, SpringDamperClause, Value};
use crate::report::{Faults, TreeMessage, ValueMessage};

/// Properties of a straight spring and damper.
const PROPERTIES: &[Dimension] = &[
    optional("at", "m", Sign::Any),
    optional("to", "m", Sign::Any),
    optional("spring", "N/m", Sign::NonNegative),
    optional("rest", "m", Sign::NonNegative),
    optional("friction", "N s/m", Sign::NonNegative),
    // The unit of a strength depends on the exponent.
    optional("repulsion", "", Sign::Any),
    optional("exponent", "", Sign::Positive),
];

/// Returns the properties that a clause may have.
fn dimensions(clause: &SpringDamperClause) -> impl Iterator<Item = &'static Dimension> {
    let is_guy = clause.name == GUY;
    let known = PROPERTIES.iter();
    known.filter(move |known| known.name != "to" || is_guy)
}

/// Values of the properties of a straight spring and damper.
#[derive(Default)]
pub(super) struct LineProperties {
    /// Attachment points on the links: one for all links, or one per link.
    at: Vec<Offset>,
    to: Option<[Quantity; 2]>,
    spring: Option<Quantity>,
    rest: Option<Quantity>,
    repulsion: Option<Quantity>,
    exponent: Option<u32>,
    friction: Option<Quantity>,
}

/// Reads the properties of a clause. Adds mistakes to `report`.
pub(super) fn line_properties(
    clause: &SpringDamperClause,
    what: &str,
    values: &mut Values,
    report: &mut Faults,
) -> LineProperties {
    let mut properties = clause.properties.iter();
    let exponent = properties.find(|property| property.key() == "exponent");
    let mut given = LineProperties {
        exponent: exponent.and_then(line_potential::exponent),
        ..LineProperties::default()
    };
    let known: Vec<&Dimension> = dimensions(clause).collect();
    let body = format!("a straight `{}`", clause.name);
    for (known, property) in known_once(&clause.properties, &known, body, report) {
        let one =
            |known: &Dimension, property: &Property, values: &mut Values, report: &mut Faults| {
                if let Value::Each { span, .. } = &property.value {
                    report.error(*span, ValueMessage::EachWithoutCopies);
                    return None;
                }
                evaluate(known, property, what, values, report)
            };
        match known.name {
            "at" => given.at = points(property, known, clause, what, values, report),
            "to" => given.to = peg(property, what, values, report),
            "spring" => given.spring = one(known, property, values, report).map(|own| own.along),
            "rest" => given.rest = one(known, property, values, report).map(|own| own.along),
            "repulsion" => {
                let unit = given.exponent.map_or("", strength_unit);
                let known = Dimension { unit, ..*known };
                given.repulsion = one(&known, property, values, report).map(|own| own.along);
            }
            "exponent" if given.exponent.is_some() => {}
            "exponent" => {
                let (what, largest) = (what.to_owned(), LARGEST_EXPONENT);
                let message = TreeMessage::NotAnExponent { what, largest };
                report.error(property.name.span(), message);
            }
            _ => given.friction = one(known, property, values, report).map(|own| own.along),
        }
    }
    if clause.damaged {
        return given;
    }
    check_rest(&clause.properties, what, "N/m", report);
    check_complete(clause, what, report);
    given
}

/// Checks that at least one force acts along the line, and that the properties are complete.
fn check_complete(clause: &SpringDamperClause, what: &str, report: &mut Faults) {
    let span = clause.name.span();
    let acts = ["spring", "friction", "repulsion", "exponent"];
    if !acts.into_iter().any(|name| clause.gives(name)) {
        let what = what.to_owned();
        report.error(span, TreeMessage::IdleStraightSpring { what });
    }
    if clause.gives("exponent") && !clause.gives("repulsion") {
        let what = what.to_owned();
        report.error(span, TreeMessage::IdleExponent { what });
    }
    let (is_guy, repels) = (clause.name == GUY, clause.gives("repulsion"));
    for (needs, name, body) in [
        (is_guy, "at", "a `guy`"),
        (is_guy, "to", "a `guy`"),
        (repels && !is_guy, "at", "a `repulsion`"),
        (repels, "exponent", "a `repulsion`"),
    ] {
        if needs && !clause.gives(name) {
            let (link, body) = (what.to_owned(), body.to_owned());
            let message = TreeMessage::MissingProperty { name, link, body };
            report.error(span, message);
        }
    }
}

/// Reads the value of `at`: one point, or `each(...)` with one point for each of two links.
fn points(
    property: &Property,
    known: &Dimension,
    clause: &SpringDamperClause,
    what: &str,
    values: &mut Values,
    report: &mut Faults,
) -> Vec<Offset> {
    let Value::Each {
        values: points,
        span,
    } = &property.value
    else {
        return Vec::from_iter(evaluate(known, property, what, values, report));
    };
    if clause.name != BETWEEN || points.len() != 2 {
        let what = what.to_owned();
        report.error(*span, TreeMessage::NotTwoPoints { what });
        return Vec::new();
    }
    let points = points.iter().filter_map(|point| {
        let property = Property {
            value: point.clone(),
            ..property.clone()
        };
        evaluate(known, &property, what, values, report)
    });
    points.collect()
}

/// Reads the fixed point to which a guy (a straight spring between a link and the ground) is
/// attached.
fn peg(
    property: &Property,
    what: &str,
    values: &mut Values,
    report: &mut Faults,
) -> Option<[Quantity; 2]> {
    let Value::Pair(x, y) = &property.value else {
        report.error(property.name.span(), TreeMessage::NotAPeg);
        return None;
    };
    let mut at = |axis: &str, value| {
        let usage = Usage {
            what: format!("{axis} of the peg of `{what}`"),
            unit: "m",
            sign: Sign::Any,
        };
        values.evaluate(value, &usage, report)
    };
    let (x, y) = (at("x", x), at("y", y));
    Some([x?, y?])
}

impl LineProperties {
    /// Returns the noun for these forces in messages: "spring", or "repulsion" if there is no
    /// spring.
    pub(super) fn noun(&self) -> &'static str {
        DescribedLinePotential::noun(&self.potentials())
    }

    /// Creates the straight spring between points of the given links.
    pub(super) fn between(
        self,
        what: String,
        ends: SpringDamperEnds,
    ) -> Option<DescribedTranslationalSpringDamper> {
        let mut points = self.at.iter().cloned().cycle();
        let points = [points.next()?, points.next()?];
        Some(self.spring_damper(what, LineEnds::Links(ends, points)))
    }

    /// Creates the guy (a straight spring to the ground) of a link.
    pub(super) fn guy(
        self,
        what: String,
        link: LinkId,
    ) -> Option<DescribedTranslationalSpringDamper> {
        let (at, to) = (self.at.first()?.clone(), self.to.clone()?);
        Some(self.spring_damper(what, LineEnds::Guy(link, at, to)))
    }

    fn spring_damper(self, what: String, ends: LineEnds) -> DescribedTranslationalSpringDamper {
        DescribedTranslationalSpringDamper {
            what,
            ends,
            potentials: self.potentials(),
            friction: self.friction.unwrap_or_else(Quantity::zero),
        }
    }

    /// Returns the terms of the potential energy whose strength is not zero.
    fn potentials(&self) -> Vec<DescribedLinePotential> {
        let is_there = |value: &&Quantity| !value.is_zero();
        let spring = self.spring.as_ref().filter(is_there).cloned();
        let spring = spring.map(|stiffness| DescribedLinePotential::Spring {
            stiffness,
            rest: self.rest.clone().unwrap_or_else(Quantity::zero),
        });
        let strength = self.repulsion.as_ref().filter(is_there).cloned();
        let repulsion = strength.zip(self.exponent);
        let repulsion =
            repulsion.map(
                |(strength, exponent)| DescribedLinePotential::InversePower { strength, exponent },
            );
        spring.into_iter().chain(repulsion).collect()
    }
}
