//! Laws of the energy that the line between two points stores.

use super::Quantity;
use crate::description::{Expression, ExpressionKind, Property, Value};
use crate::exact::Rational;

/// A term of the energy that a line stores, by the length ℓ between its points.
#[derive(Debug, Clone, PartialEq)]
pub enum DescribedLinePotential {
    /// The energy ½ κ (ℓ − L₀)² of a spring.
    Spring {
        /// Stiffness κ, N/m; not zero.
        stiffness: Quantity,
        /// Length L₀ at rest, m.
        rest: Quantity,
    },
    /// The energy A/ℓⁿ of a force by a power of the distance, which repels where A is positive.
    InversePower {
        /// Strength A, J mⁿ; not zero.
        strength: Quantity,
        /// Exponent n, from 1 to [`LARGEST_EXPONENT`].
        exponent: u32,
    },
}

/// Units of strengths, by exponents from 1 on.
const STRENGTH_UNITS: [&str; 12] = [
    "J m", "J m²", "J m³", "J m⁴", "J m⁵", "J m⁶", "J m⁷", "J m⁸", "J m⁹", "J m¹⁰", "J m¹¹",
    "J m¹²",
];

/// The largest exponent: that of the repulsion of Lennard-Jones.
pub const LARGEST_EXPONENT: u32 = STRENGTH_UNITS.len() as u32;

/// The unit of a strength; empty for an exponent that no law has.
pub fn strength_unit(exponent: u32) -> &'static str {
    let place = usize::try_from(exponent).ok();
    let unit = place.and_then(|exponent| STRENGTH_UNITS.get(exponent.checked_sub(1)?));
    unit.copied().unwrap_or_default()
}

/// The exponent that a property states, if there is a law with it.
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
    /// The quantities of the law, by the names of their properties and with their units.
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

    /// What these are of: a "spring", or a "repulsion" where there is nothing else.
    pub(super) fn noun(all: &[Self]) -> &'static str {
        let is_repulsion = |own: &Self| matches!(own, Self::InversePower { .. });
        match !all.is_empty() && all.iter().all(is_repulsion) {
            true => "repulsion",
            false => "spring",
        }
    }
}
