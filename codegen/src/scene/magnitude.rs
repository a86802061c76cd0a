//! Accepted magnitudes of values. They are far beyond those of any pendulum, but small enough that
//! the constants computed from them, and products of two constants, fit an `f64`.
//!
//! The same limits hold for literals, which are refused in the description, for parameters of
//! compiled models and for parameters of trees at run time.

use super::Sign;

/// Accepted magnitudes of nonzero values of one unit. Whether zero is accepted depends on the
/// condition on the sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Magnitudes {
    /// Smallest accepted magnitude.
    pub least: f64,
    /// Largest accepted magnitude.
    pub largest: f64,
    /// Condition in words, as in "of a magnitude up to 1e30 m".
    pub text: &'static str,
}

/// Mass in kg, length in m and moment of inertia in kg m² that are so small that they count as
/// zero, since the mass matrix would be singular up to rounding errors.
pub const NEGLIGIBLE: [f64; 3] = [1e-60, 1e-30, 1e-120];

impl Magnitudes {
    /// Returns the accepted magnitudes for a unit. The empty unit stands for pure numbers and for
    /// operands of functions of time.
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
            // Smoothing widths of friction, which are divisors.
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

    /// Returns true if `others` accept every magnitude that these accept.
    pub(super) fn are_within(&self, others: &Self) -> bool {
        self.least >= others.least && self.largest <= others.largest
    }

    /// Returns true if a value is 0 or has an accepted magnitude; false for NaN.
    pub(super) fn hold(&self, value: f64) -> bool {
        value == 0.0 || (self.least..=self.largest).contains(&value.abs())
    }
}
