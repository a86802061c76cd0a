//! Properties in the parentheses of a link: reports unknown and missing ones, and computes the
//! body.

use super::bodies::{Body, BodyShape, COMMON, Condition, Dimension, GivenProperties, PLAIN};
use super::names::motion;
use super::rule::{COUNTS, Counts, GenerationRule, changes_shape, ratios, scaled};
use super::shape_names::{find_shape, forgotten_shape};
use super::values::{Usage, Values, message_for};
use super::{FrictionLaw, LawConstant, Offset, Quantity, Sign};
use crate::description::{Node, Property, Value};
use crate::report::{Faults, SyntaxMessage, TreeMessage, nearest};

/// Evaluated properties of a link or rule.
pub(super) struct Properties {
    /// The body; a placeholder after an error.
    pub(super) body: Body,
    /// The generation rule, if the node is a rule.
    pub(super) rule: Option<GenerationRule>,
    /// All given properties, including those of the body.
    pub(super) given: GivenProperties,
    kind: LinkKind,
}

/// Properties whose value can be a pair.
const POINTS: &[&str] = &["com", "joint", "at"];

/// Required and optional properties of a kind of link.
struct LinkKind {
    /// Name of the kind in messages: "a link", "a `rod`".
    text: String,
    shape: Option<&'static BodyShape>,
    is_rule: bool,
}

impl Properties {
    /// Reads the properties of a link or rule.
    pub(super) fn read(
        node: &Node,
        is_rule: bool,
        values: &mut Values,
        report: &mut Faults,
    ) -> Self {
        let mut counts = Counts::default();
        let shape = if is_rule {
            counts.read(node, report);
            if !counts.is_named && !node.damaged {
                let message = LinkKind::new(None, true).missing("count", node);
                report.error(node.name.span(), message);
            }
            counts.shape
        } else {
            node.shape.as_ref().map(|shape| {
                find_shape(&shape.to_string()).map_err(|message| {
                    report.error(shape.span(), message);
                })
            })
        };
        let forgotten = match is_rule {
            true => None,
            false => forgotten_shape(node),
        };
        let fault = matches!(shape, Some(Err(()))) || forgotten.is_some();
        if let Some(message) = forgotten {
            report.error(node.name.span(), message);
        }
        let kind = LinkKind::new(shape.and_then(Result::ok), is_rule);
        // If the shape is unknown, its properties are too.
        let given = if fault {
            None
        } else {
            kind.evaluate(node, values, report)
        };
        let body = given
            .as_ref()
            .and_then(|given| kind.checked_body(given, node, values, report));
        let given = given.unwrap_or_default();
        let rule = is_rule.then(|| GenerationRule {
            count: counts.count.unwrap_or(1),
            branching: counts.branching.unwrap_or(1),
            code: counts.code,
            open: counts.is_open(report),
        });
        Self {
            body: body.unwrap_or_else(placeholder),
            rule,
            given,
            kind,
        }
    }

    /// Returns the properties of generation number `generation` (from 0) of the rule; `None` after
    /// reporting a mistake.
    pub(super) fn of_generation(
        &self,
        generation: usize,
        node: &Node,
        values: &mut Values,
        report: &mut Faults,
    ) -> Option<(Body, GivenProperties)> {
        let given = match scaled(&self.given, generation) {
            Ok(given) => given,
            Err(error) => {
                report.error(node.name.span(), message_for(error));
                return None;
            }
        };
        let last = self
            .rule
            .as_ref()
            .is_some_and(|rule| rule.count == generation + 1);
        if last && generation > 0 {
            self.kind
                .accept(&given, (node, generation), values, report)?;
        }
        let body = match changes_shape(&self.given) {
            true => self.kind.checked_body(&given, node, values, report),
            false => self.kind.body(&given, node, report),
        };
        Some((body?, given))
    }
}

/// Returns a placeholder body for a link with an error, so that its children can still be checked.
fn placeholder() -> Body {
    let origin = Offset {
        along: Quantity::zero(),
        lateral: Quantity::zero(),
    };
    Body {
        mass: Quantity::zero(),
        inertia: Quantity::zero(),
        com: origin.clone(),
        joint: Some(origin),
    }
}

impl LinkKind {
    fn new(shape: Option<&'static BodyShape>, is_rule: bool) -> Self {
        let text = match (shape, is_rule) {
            (None, false) => "a link without shape".to_owned(),
            (Some(shape), false) => format!("a `{}`", shape.name),
            (None, true) => "a generation rule".to_owned(),
            (Some(shape), true) => format!("a generation rule of `{}`", shape.name),
        };
        Self {
            text,
            shape,
            is_rule,
        }
    }

    /// Returns all properties with a value, required ones first.
    fn dimensions(&self) -> impl Iterator<Item = &'static Dimension> {
        let own = self.shape.map_or(PLAIN, |shape| shape.dimensions);
        let ratios = self.is_rule.then(|| ratios(own));
        own.iter().chain(COMMON).chain(ratios.into_iter().flatten())
    }

    /// Returns the names of all properties outside a friction law (`law` is `None`), or of those in
    /// the parentheses of this law.
    fn known(&self, law: Option<&str>) -> Vec<&'static str> {
        let counts = if self.is_rule && law.is_none() {
            COUNTS
        } else {
            &[]
        };
        let mut known: Vec<&'static str> = counts.to_vec();
        for dimension in self.dimensions() {
            let within = dimension.name.split_once('(').map(|(law, _)| law);
            if within == law && !known.contains(&dimension.name) {
                known.push(dimension.name);
            }
        }
        known
    }

    /// Evaluates all properties in the order written; returns `None` after reporting a mistake.
    fn evaluate(
        &self,
        node: &Node,
        values: &mut Values,
        report: &mut Faults,
    ) -> Option<GivenProperties> {
        let mut given = GivenProperties::default();
        let mut sound = !node.damaged;
        let mut seen: Vec<String> = Vec::new();
        for property in &node.properties {
            let name = property.key();
            if seen.contains(&name) {
                report.error(
                    property.name.span(),
                    SyntaxMessage::duplicate_property(&name),
                );
                sound = false;
                continue;
            }
            let dimension = self.dimensions().find(|known| known.name == name);
            if let Some(dimension) = dimension {
                match evaluate(dimension, property, &node.name.to_string(), values, report) {
                    Some(value) => given.0.push((dimension.name, value)),
                    None => sound = false,
                }
            } else if !(self.is_rule && COUNTS.contains(&name.as_str())) {
                sound = false;
                let (message, meant) = self.unknown(name.clone());
                report.error(property.name.span(), message);
                // A property that is misspelt is not missing.
                seen.extend(meant.map(str::to_owned));
            }
            seen.push(name);
        }
        let missing = self
            .dimensions()
            .filter(|known| known.required && !seen.iter().any(|name| name == known.name));
        for dimension in missing.filter(|_| !node.damaged) {
            sound = false;
            let message = self.missing(dimension.name, node);
            report.error(node.name.span(), message);
        }
        sound.then_some(given)
    }

    /// Returns the message about an unknown property, and the known name that the user probably
    /// meant.
    fn unknown(&self, name: String) -> (TreeMessage, Option<&'static str>) {
        let known = self.known(name.split_once('(').map(|(law, _)| law));
        let in_law = format!("({name})");
        let in_law = COMMON.iter().find(|known| known.name.ends_with(&in_law));
        let nearest = in_law
            .map(|known| known.name)
            .or_else(|| nearest(&name, &known));
        let message = TreeMessage::UnknownProperty {
            name,
            body: self.text.clone(),
            nearest,
            known,
        };
        (message, nearest)
    }

    /// Returns the message about a missing property.
    fn missing(&self, name: &'static str, node: &Node) -> TreeMessage {
        TreeMessage::MissingProperty {
            name,
            link: node.name.to_string(),
            body: self.text.clone(),
        }
    }

    /// Checks the properties of the last generation of a rule. Properties that grow or shrink from
    /// generation to generation have their largest or smallest value there.
    fn accept(
        &self,
        given: &GivenProperties,
        (node, generation): (&Node, usize),
        values: &mut Values,
        report: &mut Faults,
    ) -> Option<()> {
        for (name, Offset { along, lateral }) in &given.0 {
            let dimension = self.dimensions().find(|known| known.name == *name)?;
            let lateral = POINTS.contains(name).then_some((lateral, "lateral "));
            for (value, part) in [(along, "")].into_iter().chain(lateral) {
                let usage = Usage {
                    what: format!(
                        "{part}{} of `{}_{}`",
                        in_words(name),
                        node.name,
                        generation + 1
                    ),
                    unit: dimension.unit,
                    sign: dimension.sign,
                };
                values.accept(value.clone(), &usage, node.name.span(), report)?;
            }
        }
        Some(())
    }

    /// Computes the body and checks that its shape is possible.
    fn checked_body(
        &self,
        given: &GivenProperties,
        node: &Node,
        values: &mut Values,
        report: &mut Faults,
    ) -> Option<Body> {
        if let Some(Condition { what, value }) = self.shape.and_then(|shape| shape.condition) {
            let usage = Usage {
                what: format!("{what} of `{}`", node.name),
                unit: "m",
                sign: Sign::Positive,
            };
            values.accept(value(given), &usage, node.name.span(), report)?;
        }
        FrictionLaw::check(
            given,
            &node.name.to_string(),
            &node.properties,
            values,
            report,
        )?;
        self.body(given, node, report)
    }

    /// Computes the body from the shape; properties of the link override those of the shape.
    fn body(&self, given: &GivenProperties, node: &Node, report: &mut Faults) -> Option<Body> {
        let mut body = match self
            .shape
            .map_or_else(|| Ok(placeholder()), |shape| (shape.body)(given))
        {
            Ok(body) => body,
            Err(error) => {
                report.error(node.name.span(), message_for(error));
                return None;
            }
        };
        if self.shape.is_none() {
            body.mass = given.value("mass")?.clone();
            body.joint = None;
        }
        if let Some(inertia) = given.value("inertia") {
            body.inertia = inertia.clone();
        }
        if let Some(com) = given.point("com") {
            body.com = com.clone();
        }
        if let Some(joint) = given.point("joint") {
            body.joint = Some(joint.clone());
        }
        body.accept(node, report).then_some(body)
    }
}

/// Evaluates a property; `owner` names the link in messages.
pub(super) fn evaluate(
    dimension: &Dimension,
    property: &Property,
    owner: &str,
    values: &mut Values,
    report: &mut Faults,
) -> Option<Offset> {
    let &Dimension {
        name, unit, sign, ..
    } = dimension;
    let usage = |part: &str| Usage {
        what: format!("{part}{} of `{owner}`", in_words(name)),
        unit,
        sign,
    };
    let mut still = true;
    property.value.for_each_name(&mut |name| {
        if let Some(message) = motion(&name.to_string()) {
            still = false;
            report.error(name.span(), message);
        }
    });
    if !still {
        return None;
    }
    match &property.value {
        Value::Single(value) => Some(Offset {
            along: values.evaluate(value, &usage(""), report)?,
            lateral: Quantity::zero(),
        }),
        Value::Pair(along, lateral) if POINTS.contains(&name) => {
            let along = values.evaluate(along, &usage(""), report);
            let lateral = values.evaluate(lateral, &usage("lateral "), report);
            Some(Offset {
                along: along?,
                lateral: lateral?,
            })
        }
        Value::Pair(..) => {
            let name = name.to_owned();
            report.error(property.name.span(), TreeMessage::NotAPoint { name });
            None
        }
        // Reported together with the copies.
        Value::Each { .. } => None,
    }
}

/// Returns the name of a property as messages print it.
fn in_words(name: &str) -> String {
    match name {
        "com" => "centre of mass".to_owned(),
        "at" => "pivot".to_owned(),
        _ => LawConstant::property_in_words(name).unwrap_or_else(|| name.replace('_', " ")),
    }
}
