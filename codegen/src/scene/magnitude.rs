//! Magnitudes that values may have: far beyond any pendulum, and such that what is formed of
//! them fits an `f64` with room for products of two.
//!
//! One definition for literals, which are refused where they stand, for parameters of
//! compiled models and for those of trees at run time.

use super::Sign;

/// Magnitudes of the values of one unit that are not 0, which is a matter of the sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Magnitudes {
    /// Least magnitude.
    pub least: f64,
    /// Largest magnitude.
    pub largest: f64,
    /// The condition in words, as in "of a magnitude up to 1e30 m".
    pub text: &'static str,
}

/// Mass in kg, length in m and moment of inertia in kg m² below which a link counts as having
/// none: the mass matrix must not be singular to rounding.
pub const NEGLIGIBLE: [f64; 3] = [1e-60, 1e-30, 1e-120];

impl Magnitudes {
    /// The magnitudes of a unit; of an empty one, for pure numbers and what functions of time are
    /// formed of.
    pub(super) fn of(unit: &str, sign: Sign) -> Self {
        let [mass, length, inertia] = NEGLIGIBLE;
        let (least, largest, text) = match (unit, sign) {
            ("kg", Sign::Positive) => (mass, 1e40, "of a magnitude from 1e-60 to 1e40 kg"),
            ("kg", _) => (mass, 1e40, "0 or of a magnitude from 1e-60 to 1e40 kg"),
            ("kg m²", _) => (
                inertia,
                1e100,
                "0 or of a magnitude from 1e-120 to 1e100 kg m²",
            ),
            ("m", Sign::Positive) => (length, 1e30, "of a magnitude from 1e-30 to 1e30 m"),
            ("m", _) => (0.0, 1e30, "of a magnitude up to 1e30 m"),
            ("m/s²", _) => (0.0, 1e30, "of a magnitude up to 1e30 m/s²"),
            ("rad", _) => (0.0, 1e30, "of a magnitude up to 1e30 rad"),
            // Widths of friction, which divide.
            ("rad/s", _) => (1e-30, 1e30, "of a magnitude from 1e-30 to 1e30 rad/s"),
            ("N/m", _) => (0.0, 1e100, "of a magnitude up to 1e100 N/m"),
            ("N s/m", _) => (0.0, 1e100, "of a magnitude up to 1e100 N s/m"),
            ("N m", _) => (0.0, 1e100, "of a magnitude up to 1e100 N m"),
            ("N m s", _) => (0.0, 1e100, "of a magnitude up to 1e100 N m s"),
            ("N m s²", _) => (0.0, 1e100, "of a magnitude up to 1e100 N m s²"),
            _ => (0.0, 1e30, "of a magnitude up to 1e30"),
        };
        Self {
            least,
            largest,
            text,
        }
    }

    /// Returns true if others hold whatever these do.
    pub(super) fn are_within(&self, others: &Self) -> bool {
        self.least >= others.least && self.largest <= others.largest
    }

    /// Returns true if a value is 0 or has such a magnitude; a NaN has none.
    pub(super) fn hold(&self, value: f64) -> bool {
        value == 0.0 || (self.least..=self.largest).contains(&value.abs())
    }
}
