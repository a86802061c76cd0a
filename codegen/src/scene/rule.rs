//! Whole generations by rule.

use proc_macro2::{Ident, Span};

use super::bodies::{BodyShape, COMMON, Dimension, GivenProperties};
use super::shape_names::find_shape;
use super::{Offset, Quantity, Sign};
use crate::description::{Expression, ExpressionKind, Node, Property, Value};
use crate::exact::{ExactError, Rational};
use crate::report::{Faults, SyntaxMessage, TreeMessage};

/// The settings of a generation rule.
pub(super) struct GenerationRule {
    /// Generations, at least one.
    pub(super) count: usize,
    /// Children of a link, at least one.
    pub(super) branching: usize,
    /// Form of its code, where the description gives one.
    pub(super) code: Option<Code>,
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
    report: &mut Faults,
) -> Option<(Code, Span)> {
    let (_, value) = written?;
    let found = Code::named(&value.to_string());
    if found.is_none() {
        report.error(value.span(), SyntaxMessage::NotACode);
    }
    found.map(|code| (code, value.span()))
}

/// A ratio of a rule, and the property whose value over the parent's it is.
pub(super) struct Ratio {
    property: &'static str,
    pub(super) dimension: Dimension,
}

const fn ratio(property: &'static str, name: &'static str, sign: Sign) -> Ratio {
    Ratio {
        property,
        dimension: Dimension {
            name,
            unit: "",
            sign,
            required: false,
        },
    }
}

/// The ratio of all masses, and that of all lengths, that have none of their own.
const MASS: Ratio = ratio("mass", "mass_ratio", Sign::Positive);
const LENGTH: Ratio = ratio("length", "length_ratio", Sign::Positive);

/// Quantities of a generation rule beside those of its body.
const RATIOS: &[Ratio] = &[
    MASS,
    LENGTH,
    ratio("bob_mass", "bob_mass_ratio", Sign::NonNegative),
    ratio("radius", "radius_ratio", Sign::Positive),
    ratio("width", "width_ratio", Sign::Positive),
    ratio("margin", "margin_ratio", Sign::NonNegative),
    ratio("com", "com_ratio", Sign::Any),
    ratio("inertia", "inertia_ratio", Sign::NonNegative),
    ratio("joint", "joint_ratio", Sign::Any),
    ratio("friction", "friction_ratio", Sign::NonNegative),
    ratio("drag", "drag_ratio", Sign::NonNegative),
    ratio("spring", "spring_ratio", Sign::NonNegative),
    ratio("rest", "rest_ratio", Sign::Any),
];

/// The ratios of a rule whose links have these dimensions beside the common ones.
pub(super) fn ratios(own: &[Dimension]) -> impl Iterator<Item = &'static Dimension> {
    let is_known = |ratio: &&Ratio| {
        let mut properties = own.iter().chain(COMMON);
        let always = [MASS.property, LENGTH.property].contains(&ratio.property);
        always || properties.any(|property| property.name == ratio.property)
    };
    RATIOS.iter().filter(is_known).map(|ratio| &ratio.dimension)
}

/// Properties of a generation rule that are no quantities.
pub(super) const COUNTS: &[&str] = &["count", "branching", "shape", "code"];

/// Returns true if a ratio changes the proportions of a shape, so that later
/// generations are no scaled copies of the first.
pub(super) fn changes_shape(first: &GivenProperties) -> bool {
    ["radius_ratio", "width_ratio", "margin_ratio"]
        .iter()
        .any(|name| first.value(name).is_some())
}

/// Properties of the links of a generation, counted from 0: those of the first, each
/// times its ratio, or times the ratio of masses or lengths by its dimension.
pub(super) fn scaled(
    first: &GivenProperties,
    generation: usize,
) -> Result<GivenProperties, ExactError> {
    let exponent = i32::try_from(generation).map_err(|_| ExactError::TooLong)?;
    let power = |name: &str| match first.value(name) {
        Some(ratio) => ratio.clone().power(exponent),
        None => Ok(Quantity::integer(1)),
    };
    let (mass, length) = (power(MASS.dimension.name)?, power(LENGTH.dimension.name)?);
    let mut scaled = GivenProperties::default();
    for (name, Offset { along, lateral }) in &first.0 {
        if RATIOS.iter().any(|ratio| ratio.dimension.name == *name) {
            continue;
        }
        // Friction of all kinds has one ratio; its width has none.
        let (property, member) = name.split_once('(').unwrap_or((name, ""));
        let own = RATIOS.iter().find(|ratio| ratio.property == property);
        let own = own.filter(|_| member != "width)");
        let own = own.map(|ratio| ratio.dimension.name);
        let factor = match (own.filter(|own| first.value(own).is_some()), *name) {
            (Some(own), _) => power(own)?,
            (None, "mass" | "bob_mass") => mass.clone(),
            (None, "inertia") => Quantity::product([mass.clone(), length.clone().power(2)?]),
            (None, _) if ["friction", "drag", "spring", "rest"].contains(&property) => {
                Quantity::integer(1)
            }
            (None, _) => length.clone(),
        };
        let times = |value: &Quantity| Quantity::product([value.clone(), factor.clone()]);
        let (along, lateral) = (times(along), times(lateral));
        scaled.0.push((*name, Offset { along, lateral }));
    }
    Ok(scaled)
}

/// The properties of a rule that are no quantities.
#[derive(Default)]
pub(super) struct Counts {
    /// True if the number of generations is given, right or wrong.
    pub(super) is_named: bool,
    pub(super) count: Option<usize>,
    pub(super) branching: Option<usize>,
    pub(super) shape: Option<Result<&'static BodyShape, ()>>,
    pub(super) code: Option<Code>,
}

impl Counts {
    /// Reads them; what is wrong goes to `report`. Properties given twice are
    /// reported elsewhere.
    pub(super) fn read(&mut self, node: &Node, report: &mut Faults) {
        for property in &node.properties {
            let Property { name, value, .. } = property;
            let text = property.key();
            match text.as_str() {
                "count" | "branching" => {
                    let count = count(value);
                    if count.is_none() {
                        report.error(name.span(), TreeMessage::NotACount { name: text.clone() });
                    }
                    if text == "count" {
                        self.is_named = true;
                        self.count = count;
                    } else {
                        self.branching = count;
                    }
                }
                "code" => {
                    self.code = code(value);
                    if self.code.is_none() {
                        report.error(name.span(), SyntaxMessage::NotACode);
                    }
                }
                "shape" => self.shape = Some(shape(value, name.span(), report)),
                _ => {}
            }
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
fn shape(value: &Value, span: Span, report: &mut Faults) -> Result<&'static BodyShape, ()> {
    let Value::Single(Expression {
        kind: ExpressionKind::Name(name),
        ..
    }) = value
    else {
        report.error(span, TreeMessage::NotAShape);
        return Err(());
    };
    find_shape(&name.to_string()).map_err(|message| report.error(name.span(), message))
}
