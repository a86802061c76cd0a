//! Rigid bodies of links, computed from their shape and its dimensions.
//!
//! A new shape needs one entry of [`SHAPES`] and one function. Every formula is homogeneous: if all
//! masses are multiplied by a and all lengths by b, an inertia is multiplied by a b². A generation
//! rule can therefore scale the finished body.

use super::values::unrepresentable;
use super::{Offset, Quantity, Sign};
use crate::description::Node;
use crate::exact::ExactError;
use crate::report::Faults;

/// Body of a link, independent of its position in the tree.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    /// Mass, in kg.
    pub(super) mass: Quantity,
    /// Moment of inertia about the centre of mass, in kg m².
    pub(super) inertia: Quantity,
    /// Centre of mass, relative to the pivot.
    pub(super) com: Offset,
    /// Point from which the children hang, relative to the pivot, unless a child specifies another
    /// one.
    pub(super) joint: Option<Offset>,
}

impl Body {
    /// Checks that all numbers of the body fit an `f64`. Reports the first that does not, and
    /// returns false.
    pub(super) fn accept(&self, node: &Node, report: &mut Faults) -> bool {
        let Self {
            mass,
            inertia,
            com,
            joint,
        } = self;
        let points = [Some(com), joint.as_ref()].into_iter().flatten();
        let parts = points.flat_map(|Offset { along, lateral }| [along, lateral]);
        // Stop at the first: one message per body is enough.
        [mass, inertia].into_iter().chain(parts).all(|part| {
            let fault = unrepresentable(part);
            let fits = fault.is_none();
            if let Some(message) = fault {
                report.error(node.name.span(), message);
            }
            fits
        })
    }
}

/// A shape, and the function that computes its body from its dimensions.
pub(super) struct BodyShape {
    /// Word after the colon.
    pub(super) name: &'static str,
    /// Required and optional properties.
    pub(super) dimensions: &'static [Dimension],
    /// Computes the body from the given properties.
    pub(super) body: fn(&GivenProperties) -> Result<Body, ExactError>,
    /// A derived length that must be positive, in addition to the conditions on the dimensions.
    pub(super) condition: Option<Condition>,
}

/// Condition that a derived length is positive.
#[derive(Clone, Copy)]
pub(super) struct Condition {
    /// Name of the length in messages.
    pub(super) what: &'static str,
    /// Computes the length, in m.
    pub(super) value: fn(&GivenProperties) -> Quantity,
}

/// A property, with its unit and a condition on its sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dimension {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) sign: Sign,
    pub(super) required: bool,
}

const fn required(name: &'static str, unit: &'static str, sign: Sign) -> Dimension {
    Dimension {
        name,
        unit,
        sign,
        required: true,
    }
}

pub(super) const fn optional(name: &'static str, unit: &'static str, sign: Sign) -> Dimension {
    Dimension {
        name,
        unit,
        sign,
        required: false,
    }
}

const MASS: Dimension = required("mass", "kg", Sign::NonNegative);
const LENGTH: Dimension = required("length", "m", Sign::Positive);
const RADIUS: Dimension = required("radius", "m", Sign::Positive);
/// Distance from the pivot to the centre, which may be zero: a disc can turn about its centre.
const DISTANCE: Dimension = required("length", "m", Sign::NonNegative);

/// Properties that a link of any shape may have.
pub(super) const COMMON: &[Dimension] = &[
    optional("com", "m", Sign::Any),
    optional("inertia", "kg m²", Sign::NonNegative),
    optional("joint", "m", Sign::Any),
    optional("at", "m", Sign::Any),
    optional("friction", "N m s", Sign::NonNegative),
    optional("drag", "N m s", Sign::NonNegative),
    optional("friction(coulomb)", "N m", Sign::NonNegative),
    optional("friction(static)", "N m", Sign::NonNegative),
    optional("friction(stribeck)", "rad/s", Sign::Positive),
    optional("friction(quadratic)", "N m s²", Sign::NonNegative),
    optional("friction(width)", "rad/s", Sign::Positive),
    optional("drag(quadratic)", "N m s²", Sign::NonNegative),
    optional("drag(width)", "rad/s", Sign::Positive),
    optional("spring", "N m", Sign::NonNegative),
    optional("rest", "rad", Sign::Any),
];

/// Required properties of a link without a shape.
pub(super) const PLAIN: &[Dimension] = &[
    MASS,
    required("com", "m", Sign::Any),
    required("inertia", "kg m²", Sign::NonNegative),
];

/// All known shapes.
pub(super) const SHAPES: &[BodyShape] = &[
    BodyShape {
        name: "point",
        dimensions: &[MASS, LENGTH],
        body: point,
        condition: None,
    },
    BodyShape {
        name: "rod",
        dimensions: &[MASS, LENGTH],
        body: rod,
        condition: None,
    },
    BodyShape {
        name: "rod_with_bob",
        dimensions: &[
            required("mass", "kg", Sign::Positive),
            LENGTH,
            required("bob_mass", "kg", Sign::NonNegative),
        ],
        body: rod_with_bob,
        condition: None,
    },
    BodyShape {
        name: "cylinder",
        dimensions: &[MASS, LENGTH, RADIUS],
        body: cylinder,
        condition: None,
    },
    BodyShape {
        name: "plate",
        dimensions: &[
            MASS,
            LENGTH,
            required("width", "m", Sign::Positive),
            optional("margin", "m", Sign::NonNegative),
        ],
        body: plate,
        condition: Some(Condition {
            what: "`length - 2 * margin`",
            value: plate_span,
        }),
    },
    BodyShape {
        name: "disc",
        dimensions: &[MASS, DISTANCE, RADIUS],
        body: disc,
        condition: None,
    },
    BodyShape {
        name: "ring",
        dimensions: &[MASS, DISTANCE, RADIUS],
        body: ring,
        condition: None,
    },
    BodyShape {
        name: "ball",
        dimensions: &[MASS, DISTANCE, RADIUS],
        body: ball,
        condition: None,
    },
    BodyShape {
        name: "shell",
        dimensions: &[MASS, DISTANCE, RADIUS],
        body: shell,
        condition: None,
    },
];

/// Values of the properties that are given for a link, by name.
#[derive(Debug, Default)]
pub(super) struct GivenProperties(pub(super) Vec<(&'static str, Offset)>);

impl GivenProperties {
    /// Returns the value of a property that may be a pair.
    pub(super) fn point(&self, name: &str) -> Option<&Offset> {
        self.0
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, value)| value)
    }

    /// Returns the value of a property that is a single value.
    pub(super) fn value(&self, name: &str) -> Option<&Quantity> {
        self.point(name).map(|point| &point.along)
    }

    /// Returns the value of a dimension; zero for an optional one that is not given.
    pub(super) fn get(&self, name: &str) -> Quantity {
        self.value(name).cloned().unwrap_or_else(Quantity::zero)
    }
}

/// Returns a point on the axis of a link, at the distance `along` from the pivot.
fn on_axis(along: Quantity) -> Offset {
    Offset {
        along,
        lateral: Quantity::zero(),
    }
}

/// Returns `value` times `numerator / denominator`.
fn fraction(numerator: i64, denominator: i64, value: Quantity) -> Result<Quantity, ExactError> {
    Quantity::product([Quantity::integer(numerator), value])
        .divided_by(Quantity::integer(denominator))
}

fn square(value: &Quantity) -> Result<Quantity, ExactError> {
    value.clone().power(2)
}

fn product(a: &Quantity, b: Quantity) -> Quantity {
    Quantity::product([a.clone(), b])
}

/// Computes the body of a point mass m on a massless rod: com = joint = L, I = 0.
fn point(given: &GivenProperties) -> Result<Body, ExactError> {
    let length = given.get("length");
    Ok(Body {
        mass: given.get("mass"),
        inertia: Quantity::zero(),
        com: on_axis(length.clone()),
        joint: Some(on_axis(length)),
    })
}

/// Computes the body of a uniform thin rod on its end: com = L/2, I = m L²/12, joint = L.
fn rod(given: &GivenProperties) -> Result<Body, ExactError> {
    let (mass, length) = (given.get("mass"), given.get("length"));
    Ok(Body {
        inertia: fraction(1, 12, product(&mass, square(&length)?))?,
        mass,
        com: on_axis(fraction(1, 2, length.clone())?),
        joint: Some(on_axis(length)),
    })
}

/// Computes the body of a uniform thin rod of mass m with a point mass b at its end: com = (m/2 +
/// b) L/(m + b), I = m L²/12 + m b/(m + b) (L/2)², joint = L.
fn rod_with_bob(given: &GivenProperties) -> Result<Body, ExactError> {
    let (rod, bob) = (given.get("mass"), given.get("bob_mass"));
    let length = given.get("length");
    let mass = Quantity::sum([rod.clone(), bob.clone()]);
    let moment = Quantity::sum([fraction(1, 2, rod.clone())?, bob.clone()]);
    let reduced = product(&rod, bob).divided_by(mass.clone())?;
    let parts = Quantity::sum([fraction(1, 12, rod)?, fraction(1, 4, reduced)?]);
    Ok(Body {
        com: on_axis(product(&moment, length.clone()).divided_by(mass.clone())?),
        mass,
        inertia: product(&parts, square(&length)?),
        joint: Some(on_axis(length)),
    })
}

/// Computes the body of a uniform solid cylinder that hangs from the centre of one end and turns
/// about an axis across it: com = L/2, I = m (L²/12 + r²/4), joint = L.
fn cylinder(given: &GivenProperties) -> Result<Body, ExactError> {
    let (mass, length) = (given.get("mass"), given.get("length"));
    let along = fraction(1, 12, square(&length)?)?;
    let across = fraction(1, 4, square(&given.get("radius"))?)?;
    Ok(Body {
        inertia: product(&mass, Quantity::sum([along, across])),
        mass,
        com: on_axis(fraction(1, 2, length.clone())?),
        joint: Some(on_axis(length)),
    })
}

/// Computes the body of a uniform rectangular plate with a pivot hole at the distance `margin` from
/// each end: com = L/2 - margin, I = m (L² + w²)/12, joint = L - 2 margin.
fn plate(given: &GivenProperties) -> Result<Body, ExactError> {
    let (mass, length) = (given.get("mass"), given.get("length"));
    let squares = Quantity::sum([square(&length)?, square(&given.get("width"))?]);
    let half = fraction(1, 2, length)?;
    Ok(Body {
        inertia: fraction(1, 12, product(&mass, squares))?,
        mass,
        com: on_axis(Quantity::sum([half, given.get("margin").negative()])),
        joint: Some(on_axis(plate_span(given))),
    })
}

/// Returns the distance between the two holes of a plate, in m.
fn plate_span(given: &GivenProperties) -> Quantity {
    let margins = product(&Quantity::integer(-2), given.get("margin"));
    Quantity::sum([given.get("length"), margins])
}

/// Computes the body of a round object with its centre at the distance `length`: com = joint = L, I
/// = factor · m r². The factor is `numerator / denominator`.
fn round(given: &GivenProperties, numerator: i64, denominator: i64) -> Result<Body, ExactError> {
    let (mass, length) = (given.get("mass"), given.get("length"));
    let square = square(&given.get("radius"))?;
    Ok(Body {
        inertia: fraction(numerator, denominator, product(&mass, square))?,
        mass,
        com: on_axis(length.clone()),
        joint: Some(on_axis(length)),
    })
}

/// Computes the body of a uniform disc on a massless arm: I = m r²/2.
fn disc(given: &GivenProperties) -> Result<Body, ExactError> {
    round(given, 1, 2)
}

/// Computes the body of a thin ring on a massless arm: I = m r².
fn ring(given: &GivenProperties) -> Result<Body, ExactError> {
    round(given, 1, 1)
}

/// Computes the body of a uniform ball on a massless arm: I = 2 m r²/5.
fn ball(given: &GivenProperties) -> Result<Body, ExactError> {
    round(given, 2, 5)
}

/// Computes the body of a thin spherical shell on a massless arm: I = 2 m r²/3.
fn shell(given: &GivenProperties) -> Result<Body, ExactError> {
    round(given, 2, 3)
}
