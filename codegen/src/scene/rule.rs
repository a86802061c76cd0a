//! Generation rules: the links of all generations of a tree, given by the first one and ratios.

use proc_macro2::{Ident, Span};

use super::bodies::{BodyShape, COMMON, Dimension, GivenProperties};
use super::shape_names::find_shape;
use super::{Offset, Quantity, Sign};
use crate::description::{Expression, ExpressionKind, Node, Property, Value};
use crate::exact::{ExactError, Rational};
use crate::report::{Faults, SyntaxMessage, TreeMessage};

/// Settings of a generation rule.
pub(super) struct GenerationRule {
    /// Number of generations, at least one.
    pub(super) count: usize,
    /// Number of children of a link, at least one.
    pub(super) branching: usize,
    /// Layout of the code, if the description gives it.
    pub(super) code: Option<Code>,
    /// True if one branching of each generation is open, and all other copies move in phase.
    pub(super) open: bool,
}

/// Requested layout of the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Code {
    /// Loops over generations.
    Loops,
    /// Statements written out for each link.
    Unrolled,
}

impl Code {
    /// Returns the layout with the given name.
    fn named(name: &str) -> Option<Self> {
        match name {
            "loops" => Some(Self::Loops),
            "unrolled" => Some(Self::Unrolled),
            _ => None,
        }
    }
}

/// Reads the setting `code = ...` of the attribute, with its span.
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

/// A ratio of a rule, and the property that it multiplies from each generation to the next.
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

/// Ratios for all masses and for all lengths that have no ratio of their own.
const MASS: Ratio = ratio("mass", "mass_ratio", Sign::Positive);
const LENGTH: Ratio = ratio("length", "length_ratio", Sign::Positive);

/// Ratios that a generation rule may have.
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

/// Returns the ratios of a rule whose links have the dimensions `own` in addition to the common
/// properties.
pub(super) fn ratios(own: &[Dimension]) -> impl Iterator<Item = &'static Dimension> {
    let is_known = |ratio: &&Ratio| {
        let mut properties = own.iter().chain(COMMON);
        let always = [MASS.property, LENGTH.property].contains(&ratio.property);
        always || properties.any(|property| property.name == ratio.property)
    };
    RATIOS.iter().filter(is_known).map(|ratio| &ratio.dimension)
}

/// Properties of a generation rule that are not quantities.
pub(super) const COUNTS: &[&str] = &["count", "branching", "open", "shape", "code"];

/// Returns true if a ratio changes the proportions of a shape, so that later generations are not
/// scaled copies of the first.
pub(super) fn changes_shape(first: &GivenProperties) -> bool {
    ["radius_ratio", "width_ratio", "margin_ratio"]
        .iter()
        .any(|name| first.value(name).is_some())
}

/// Returns the properties of the links of a generation, counted from 0: those of the first
/// generation, each multiplied by its own ratio, or by the ratio of masses or lengths according to
/// its unit.
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
        // One ratio applies to all kinds of friction; the rates of the laws do not change.
        let (property, member) = name.split_once('(').unwrap_or((name, ""));
        let own = RATIOS.iter().find(|ratio| ratio.property == property);
        let own = own.filter(|_| !["width)", "stribeck)"].contains(&member));
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

/// Values of the properties that are not quantities.
#[derive(Default)]
pub(super) struct Counts {
    /// True if the number of generations is given, whether or not it is valid.
    pub(super) is_named: bool,
    pub(super) count: Option<usize>,
    pub(super) branching: Option<usize>,
    pub(super) shape: Option<Result<&'static BodyShape, ()>>,
    pub(super) code: Option<Code>,
    /// Number of open branchings of each generation, with the span of the word.
    open: Option<(Option<usize>, Span)>,
}

impl Counts {
    /// Reads these properties. Adds mistakes to `report`, except for properties given twice, which
    /// are reported elsewhere.
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
                "open" => self.open = Some((count(value), name.span())),
                "shape" => self.shape = Some(shape(value, name.span(), report)),
                _ => {}
            }
        }
    }

    /// Returns true if one branching of each generation is open. Reports a rule for which that is
    /// impossible.
    pub(super) fn is_open(&self, report: &mut Faults) -> bool {
        let Some((open, span)) = self.open else {
            return false;
        };
        let needs = match (open, self.branching, self.count) {
            (Some(1), Some(2), Some(2..=MOST_OPEN) | None) => return true,
            (Some(1), Some(2), _) => "2 to 32 generations",
            (Some(1), ..) => "`branching = 2`",
            _ => "the value 1",
        };
        report.error(span, TreeMessage::OpenBranching { needs });
        false
    }
}

/// Largest number of generations with one open branching each: the number of copies in phase stays
/// below 2³².
const MOST_OPEN: usize = 32;

/// Reads a literal whole number of at least 1; numbers beyond `u32` become `u32::MAX`.
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

/// Reads the layout of the code from the value of a property.
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

/// Reads a shape from the value of a property.
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
