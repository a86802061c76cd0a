//! Energy of the line between two points as a function of its length.

use super::Quantity;
use crate::description::{Expression, ExpressionKind, Property, Value};
use crate::exact::Rational;

/// A term of the potential energy of a line, as a function of the distance ℓ between its end
/// points.
#[derive(Debug, Clone, PartialEq)]
pub enum DescribedLinePotential {
    /// Energy ½ κ (ℓ − L₀)² of a spring.
    Spring {
        /// Stiffness κ, in N/m; not zero.
        stiffness: Quantity,
        /// Rest length L₀, in m.
        rest: Quantity,
    },
    /// Energy A/ℓⁿ of a power law; the force is repulsive if A is positive.
    InversePower {
        /// Strength A, in J mⁿ; not zero.
        strength: Quantity,
        /// Exponent n, from 1 to [`LARGEST_EXPONENT`].
        exponent: u32,
    },
}

/// Units of the strength A for the exponents n = 1, 2, ….
const STRENGTH_UNITS: [&str; 12] = [
    "J m", "J m²", "J m³", "J m⁴", "J m⁵", "J m⁶", "J m⁷", "J m⁸", "J m⁹", "J m¹⁰", "J m¹¹",
    "J m¹²",
];

/// Largest exponent: 12, as in the repulsion of the Lennard-Jones potential.
pub const LARGEST_EXPONENT: u32 = STRENGTH_UNITS.len() as u32;

/// Returns the unit of the strength A for an exponent; empty if the exponent is not supported.
pub fn strength_unit(exponent: u32) -> &'static str {
    let place = usize::try_from(exponent).ok();
    let unit = place.and_then(|exponent| STRENGTH_UNITS.get(exponent.checked_sub(1)?));
    unit.copied().unwrap_or_default()
}

/// Reads the exponent from the value of a property; `None` if it is not a supported integer.
pub(super) fn exponent(property: &Property) -> Option<u32> {
    let Value::Single(Expression {
        kind: ExpressionKind::Number(number),
        ..
    }) = &property.value
    else {
        return None;
    };
    (1..=LARGEST_EXPONENT).find(|&exponent| *number == Rational::from(i64::from(exponent)))
}

impl DescribedLinePotential {
    /// Returns the quantities of this energy term, each with the name of its property and its unit.
    pub fn quantities(&self) -> Vec<(&'static str, &Quantity, &'static str)> {
        match self {
            Self::Spring { stiffness, rest } => {
                vec![("spring", stiffness, "N/m"), ("rest", rest, "m")]
            }
            Self::InversePower { strength, exponent } => {
                vec![("repulsion", strength, strength_unit(*exponent))]
            }
        }
    }

    /// Returns the noun for these terms in messages: "spring", or "repulsion" if there is no
    /// spring.
    pub(super) fn noun(all: &[Self]) -> &'static str {
        let is_repulsion = |own: &Self| matches!(own, Self::InversePower { .. });
        match !all.is_empty() && all.iter().all(is_repulsion) {
            true => "repulsion",
            false => "spring",
        }
    }
}
