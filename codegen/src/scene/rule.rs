//! Whole generations by rule.

use proc_macro2::{Ident, Span};

use super::bodies::{Body, BodyShape, Dimension};
use super::properties::{LinkKind, find_shape};
use super::{Offset, Quantity, Sign};
use crate::description::{Expression, ExpressionKind, Node, Property, Value};
use crate::exact::{ExactError, Rational};
use crate::report::{Message, Report};

/// The settings of a generation rule.
pub(super) struct GenerationRule {
    /// Generations, at least one.
    pub(super) count: usize,
    /// Children of a link, at least one.
    pub(super) branching: usize,
    /// Form of its code, where the description gives one.
    pub(super) code: Option<Code>,
    /// A link's mass over its parent's.
    pub(super) mass_ratio: Quantity,
    /// A link's lengths over its parent's.
    pub(super) length_ratio: Quantity,
}

/// Form of the code of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Code {
    /// Loops over generations.
    Loops,
    /// Statements for each link.
    Unrolled,
}

impl Code {
    /// The form of that name in the attribute.
    fn named(name: &str) -> Option<Self> {
        match name {
            "loops" => Some(Self::Loops),
            "unrolled" => Some(Self::Unrolled),
            _ => None,
        }
    }
}

/// Reads the attribute's own `code = ...`, with its place.
pub(super) fn resolve_code(
    written: Option<&(Ident, Ident)>,
    report: &mut Report,
) -> Option<(Code, Span)> {
    let (_, value) = written?;
    let found = Code::named(&value.to_string());
    if found.is_none() {
        report.error(value.span(), Message::NotACode);
    }
    found.map(|code| (code, value.span()))
}

/// Quantities of a generation rule beside those of its body.
pub(super) const RATIOS: &[Dimension] = &[
    Dimension {
        name: "mass_ratio",
        unit: "",
        sign: Sign::Positive,
        required: false,
    },
    Dimension {
        name: "length_ratio",
        unit: "",
        sign: Sign::Positive,
        required: false,
    },
];

/// Properties of a generation rule that are no quantities.
pub(super) const COUNTS: &[&str] = &["count", "branching", "shape", "code"];

impl GenerationRule {
    /// The body of a generation, counted from 0.
    pub(super) fn body(&self, first: &Body, generation: usize) -> Result<Body, ExactError> {
        let exponent = i32::try_from(generation).map_err(|_| ExactError::TooLong)?;
        let mass = self.mass_ratio.clone().power(exponent)?;
        let length = self.length_ratio.clone().power(exponent)?;
        scaled(first, &mass, &length)
    }
}

/// A body with its mass and its lengths multiplied; its inertia follows.
fn scaled(body: &Body, mass: &Quantity, length: &Quantity) -> Result<Body, ExactError> {
    let times =
        |value: &Quantity, factor: &Quantity| Quantity::product([value.clone(), factor.clone()]);
    let point = |Offset { along, lateral }: &Offset| Offset {
        along: times(along, length),
        lateral: times(lateral, length),
    };
    Ok(Body {
        mass: times(&body.mass, mass),
        inertia: times(&times(&body.inertia, mass), &length.clone().power(2)?),
        com: point(&body.com),
        joint: body.joint.as_ref().map(point),
    })
}

/// The properties of a rule that are no quantities.
#[derive(Default)]
pub(super) struct Counts {
    pub(super) count: Option<usize>,
    pub(super) branching: Option<usize>,
    pub(super) shape: Option<Result<&'static BodyShape, ()>>,
    pub(super) code: Option<Code>,
}

impl Counts {
    /// Reads them; what is wrong goes to `report`. Properties given twice are
    /// reported elsewhere.
    pub(super) fn read(&mut self, node: &Node, report: &mut Report) {
        let mut named = false;
        for Property { name, value } in &node.properties {
            let text = name.to_string();
            match text.as_str() {
                "count" | "branching" => {
                    let count = count(value);
                    if count.is_none() {
                        report.error(name.span(), Message::NotACount { name: text.clone() });
                    }
                    if text == "count" {
                        named = true;
                        self.count = count;
                    } else {
                        self.branching = count;
                    }
                }
                "code" => {
                    self.code = code(value);
                    if self.code.is_none() {
                        report.error(name.span(), Message::NotACode);
                    }
                }
                "shape" => self.shape = Some(shape(value, name.span(), report)),
                _ => {}
            }
        }
        if !named && !node.damaged {
            let message = LinkKind::new(None, true).missing("count", node);
            report.error(node.name.span(), message);
        }
    }
}

/// A literal whole number of at least 1; all beyond `u32` count as `u32::MAX`.
fn count(value: &Value) -> Option<usize> {
    let Value::Single(Expression {
        kind: ExpressionKind::Number(number),
        ..
    }) = value
    else {
        return None;
    };
    if !number.is_integer() || *number < Rational::one() {
        return None;
    }
    Some(number.numerator_text().parse::<u32>().unwrap_or(u32::MAX) as usize)
}

/// Form of the code, as the value of a property.
fn code(value: &Value) -> Option<Code> {
    let Value::Single(Expression {
        kind: ExpressionKind::Name(name),
        ..
    }) = value
    else {
        return None;
    };
    Code::named(&name.to_string())
}

/// A shape as the value of a property.
fn shape(value: &Value, span: Span, report: &mut Report) -> Result<&'static BodyShape, ()> {
    let Value::Single(Expression {
        kind: ExpressionKind::Name(name),
        ..
    }) = value
    else {
        report.error(span, Message::NotAShape);
        return Err(());
    };
    find_shape(&name.to_string()).map_err(|message| report.error(name.span(), message))
}
