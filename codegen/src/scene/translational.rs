//! Translational spring-dampers: straight springs and dampers between points of links, and guys
//! from a link to the ground.

use std::collections::BTreeMap;

use super::bodies::{Dimension, optional};
use super::link_pairs::SpringDamperEnds;
use super::passive::{check_rest, known_once};
use super::properties::evaluate;
use super::values::{Usage, Values};
use super::{Layout, Link, LinkId, Offset, Quantity, Scene, Sign};
use crate::description::{BETWEEN, GUY, Property, SpringDamperClause, Value};
use crate::report::{Faults, TreeMessage, ValueMessage};

/// A straight spring and a viscous damper along the line between two points.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedTranslationalSpringDamper {
    /// The clause in words, as in `between(a, b)`.
    pub what: String,
    /// The points.
    pub ends: LineEnds,
    /// Stiffness κ of the spring, N/m.
    pub spring: Quantity,
    /// Length L₀ of the spring at rest, m.
    pub rest: Quantity,
    /// Viscous friction c of the damper, N s/m.
    pub friction: Quantity,
}

/// The points between which a straight spring is.
#[derive(Debug, Clone, PartialEq)]
pub enum LineEnds {
    /// Points of links: of two, or of all copies of a node under one link, two by two.
    Links(SpringDamperEnds, [Offset; 2]),
    /// A point of a link, and a place x, y that does not move, from the root's pivot, y upwards.
    Guy(LinkId, Offset, [Quantity; 2]),
}

impl DescribedTranslationalSpringDamper {
    /// Components of the points.
    pub fn places(&self) -> [&Quantity; 4] {
        match &self.ends {
            LineEnds::Links(_, [first, second]) => {
                [&first.along, &first.lateral, &second.along, &second.lateral]
            }
            LineEnds::Guy(_, at, [x, y]) => [&at.along, &at.lateral, x, y],
        }
    }
}

/// The line between two points, in the links that turn it.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLine {
    /// Index of the spring in [`Scene::translational`].
    pub spring_damper: usize,
    /// The links that the points are on: the first one, and the second one unless it is the
    /// ground.
    pub links: Vec<LinkId>,
    /// Arms r_i of the line d = d₀ + Σ R(θ_i) r_i.
    pub arms: Vec<(LinkId, Offset)>,
    /// d₀: x, and y against the direction of links of angle 0.
    pub offset: [Quantity; 2],
}

impl SpringLine {
    /// Returns true if no angle changes the length: of less than two parts that turn by
    /// themselves.
    pub fn is_rigid(&self) -> bool {
        let is_fixed = self.offset.iter().all(Quantity::is_zero);
        self.arms.len() < 1 + usize::from(is_fixed)
    }
}

/// A link on the way from a point to the root.
struct Step<'s> {
    link: usize,
    /// The link below, whose pivot counts.
    via: Option<usize>,
    /// The point of the link where the way goes on.
    offset: &'s Offset,
}

impl Scene {
    /// The lines of all straight springs, whose links are those of the whole tree.
    pub fn lines(&self) -> Vec<SpringLine> {
        let mut lines = Vec::new();
        for (spring_damper, own) in self.translational.iter().enumerate() {
            match &own.ends {
                LineEnds::Links(ends, [first, second]) => {
                    let pairs = self.pair_runs(ends).into_iter();
                    let pairs = pairs.flat_map(|run| run.pairs());
                    lines.extend(pairs.map(|[a, b]| SpringLine {
                        spring_damper,
                        links: vec![LinkId(a), LinkId(b)],
                        arms: self.arms((a, first), Some((b, second))),
                        offset: [Quantity::zero(), Quantity::zero()],
                    }));
                }
                LineEnds::Guy(LinkId(link), at, [x, y]) => lines.push(SpringLine {
                    spring_damper,
                    links: vec![LinkId(*link)],
                    arms: self.arms((*link, at), None),
                    offset: [
                        x.clone(),
                        match self.stands() {
                            true => y.clone().negative(),
                            false => y.clone(),
                        },
                    ],
                }),
            }
        }
        lines
    }

    /// A link of the whole tree, and the index of its parent there. Copy c under link i of a
    /// generation of n links is number c n + i of the next one.
    fn place(&self, index: usize) -> Option<(&Link, Option<usize>)> {
        let Layout::Generations { branching, .. } = self.layout else {
            let link = self.links.get(index)?;
            return Some((link, link.parent.map(|LinkId(parent)| parent)));
        };
        let (mut start, mut above, mut count): (usize, Option<[usize; 2]>, usize) = (0, None, 1);
        for link in &self.links {
            if index < start.saturating_add(count) {
                let parent = above.map(|[first, count]| first + (index - start) % count);
                return Some((link, parent));
            }
            above = Some([start, count]);
            start = start.saturating_add(count);
            count = count.saturating_mul(branching);
        }
        None
    }

    /// The steps from a point of a link to the root.
    fn way<'s>(&'s self, (link, at): (usize, &'s Offset)) -> Vec<Step<'s>> {
        let (mut next, mut via, mut offset) = (Some(link), None, at);
        let mut steps = Vec::new();
        while let Some(link) = next {
            steps.push(Step { link, via, offset });
            let Some((own, parent)) = self.place(link) else {
                break;
            };
            (via, offset, next) = (Some(link), &own.pivot, parent);
        }
        steps
    }

    /// Arms of the line from the first point to the second one, or to the ground: those of the
    /// second one's way less those of the first one's, as far as the ways are two.
    fn arms(
        &self,
        first: (usize, &Offset),
        second: Option<(usize, &Offset)>,
    ) -> Vec<(LinkId, Offset)> {
        let mut ways = [
            self.way(first),
            second.map_or_else(Vec::new, |second| self.way(second)),
        ];
        while let [Some(a), Some(b)] = ways.each_ref().map(|way| way.last())
            && a.via.is_some()
            && (a.link, a.via) == (b.link, b.via)
        {
            ways.iter_mut().for_each(|way| {
                way.pop();
            });
        }
        let [first, second] = ways;
        let mut arms: BTreeMap<usize, [Option<&Offset>; 2]> = BTreeMap::new();
        for (side, way) in [first, second].into_iter().enumerate() {
            for Step { link, offset, .. } in way {
                arms.entry(link).or_default()[side] = Some(offset);
            }
        }
        let arms = arms.into_iter().map(|(link, [first, second])| {
            let component = |of: fn(&Offset) -> &Quantity| match (first.map(of), second.map(of)) {
                (Some(first), Some(second)) if first == second => Quantity::zero(),
                (first, second) => {
                    let first = first.map(|first| first.clone().negative());
                    Quantity::sum(second.cloned().into_iter().chain(first))
                }
            };
            let arm = Offset {
                along: component(|offset| &offset.along),
                lateral: component(|offset| &offset.lateral),
            };
            (LinkId(link), arm)
        });
        arms.filter(|(_, arm)| !(arm.along.is_zero() && arm.lateral.is_zero()))
            .collect()
    }
}

/// Properties of a straight spring and damper.
const PROPERTIES: &[Dimension] = &[
    optional("at", "m", Sign::Any),
    optional("to", "m", Sign::Any),
    optional("spring", "N/m", Sign::NonNegative),
    optional("rest", "m", Sign::NonNegative),
    optional("friction", "N s/m", Sign::NonNegative),
];

/// Properties that a clause may have.
fn dimensions(clause: &SpringDamperClause) -> impl Iterator<Item = &'static Dimension> {
    let is_guy = clause.name == GUY;
    let known = PROPERTIES.iter();
    known.filter(move |known| known.name != "to" || is_guy)
}

/// The properties of a straight spring and damper.
#[derive(Default)]
pub(super) struct LineProperties {
    /// Points of the links, one or two.
    at: Vec<Offset>,
    to: Option<[Quantity; 2]>,
    spring: Option<Quantity>,
    rest: Option<Quantity>,
    friction: Option<Quantity>,
}

/// Reads the properties of a clause; what is wrong goes to `report`.
pub(super) fn line_properties(
    clause: &SpringDamperClause,
    what: &str,
    values: &mut Values,
    report: &mut Faults,
) -> LineProperties {
    let mut given = LineProperties::default();
    let known: Vec<&Dimension> = dimensions(clause).collect();
    let body = format!("a straight `{}`", clause.name);
    for (known, property) in known_once(&clause.properties, &known, body, report) {
        let one = |property: &Property, values: &mut Values, report: &mut Faults| {
            if let Value::Each { span, .. } = &property.value {
                report.error(*span, ValueMessage::EachWithoutCopies);
                return None;
            }
            evaluate(known, property, what, values, report)
        };
        match known.name {
            "at" => given.at = points(property, known, clause, what, values, report),
            "to" => given.to = peg(property, what, values, report),
            "spring" => given.spring = one(property, values, report).map(|own| own.along),
            "rest" => given.rest = one(property, values, report).map(|own| own.along),
            _ => given.friction = one(property, values, report).map(|own| own.along),
        }
    }
    if clause.damaged {
        return given;
    }
    check_rest(&clause.properties, what, "N/m", report);
    if !clause.gives("spring") && !clause.gives("friction") {
        let what = what.to_owned();
        report.error(clause.name.span(), TreeMessage::IdleStraightSpring { what });
    }
    for name in ["at", "to"] {
        if clause.name == GUY && !clause.gives(name) {
            let (link, body) = (what.to_owned(), "a `guy`".to_owned());
            let message = TreeMessage::MissingProperty { name, link, body };
            report.error(clause.name.span(), message);
        }
    }
    given
}

/// The points of `at`: one, or `each(...)` with one for each of two links.
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

/// The place that a guy is tied to.
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
    /// The spring between points of these links.
    pub(super) fn between(
        self,
        what: String,
        ends: SpringDamperEnds,
    ) -> Option<DescribedTranslationalSpringDamper> {
        let mut points = self.at.iter().cloned().cycle();
        let points = [points.next()?, points.next()?];
        Some(self.spring_damper(what, LineEnds::Links(ends, points)))
    }

    /// The guy of a link.
    pub(super) fn guy(
        self,
        what: String,
        link: LinkId,
    ) -> Option<DescribedTranslationalSpringDamper> {
        let (at, to) = (self.at.first()?.clone(), self.to.clone()?);
        Some(self.spring_damper(what, LineEnds::Guy(link, at, to)))
    }

    fn spring_damper(self, what: String, ends: LineEnds) -> DescribedTranslationalSpringDamper {
        let or_zero = |value: Option<Quantity>| value.unwrap_or_else(Quantity::zero);
        let spring = or_zero(self.spring);
        DescribedTranslationalSpringDamper {
            what,
            ends,
            rest: match spring.is_zero() {
                true => Quantity::zero(),
                false => or_zero(self.rest),
            },
            spring,
            friction: or_zero(self.friction),
        }
    }
}
