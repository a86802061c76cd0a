//! The probe of an observable's part: is it zero whatever its variables are? It
//! is tried at a few points, in numbers, since the algebra comes later and may
//! not divide by zero.

use super::Quantity;
use super::observables::{Function, Observed};

/// Points to try. A value that is not identically zero vanishes at all of them
/// only if someone looked for that.
const POINTS: [u64; 3] = [1, 2, 3];

/// A value and the largest absolute value met on the way, with which its
/// rounding error grows.
#[derive(Clone, Copy)]
struct Probe {
    value: f64,
    size: f64,
}

impl Probe {
    fn leaf(value: f64) -> Self {
        let size = value.abs();
        Self { value, size }
    }
}

impl Observed {
    /// Returns true if the value vanishes at all points, within rounding.
    pub(super) fn is_zero(&self) -> bool {
        POINTS.iter().all(|&point| {
            let Probe { value, size } = self.probe(point);
            value.abs() <= 1e-13 * size
        })
    }

    /// Returns true if the value is too large for an `f64` at all points.
    pub(super) fn is_out_of_range(&self) -> bool {
        POINTS
            .iter()
            .all(|&point| self.probe(point).size == f64::INFINITY)
    }

    fn probe(&self, point: u64) -> Probe {
        match self {
            Self::Known(quantity) => Probe::leaf(quantity_at(quantity, point)),
            Self::Variable(variable) => Probe::leaf(number(&variable.name, point)),
            Self::Constant(name) => Probe::leaf(number(name, point)),
            Self::KineticEnergy => Probe::leaf(number("kinetic_energy", point)),
            Self::PotentialEnergy => Probe::leaf(number("potential_energy", point)),
            Self::Sum(parts) => {
                let parts = parts.iter().map(|part| part.probe(point));
                parts.fold(Probe::leaf(0.0), |sum, part| Probe {
                    value: sum.value + part.value,
                    size: sum.size.max(part.size),
                })
            }
            Self::Product(parts) => {
                let parts = parts.iter().map(|part| part.probe(point));
                parts.fold(Probe::leaf(1.0), |product, part| Probe {
                    value: product.value * part.value,
                    size: product.size * part.size,
                })
            }
            Self::Quotient(above, below) => {
                let (above, below) = (above.probe(point), below.probe(point));
                Probe {
                    value: above.value / below.value,
                    size: above.size / below.value.abs(),
                }
            }
            Self::Power(base, exponent) => {
                let base = base.probe(point);
                let value = base.value.powi(*exponent);
                let size = match *exponent < 0 {
                    true => value.abs(),
                    false => base.size.powi(*exponent),
                };
                Probe { value, size }
            }
            Self::Negative(inner) => {
                let Probe { value, size } = inner.probe(point);
                Probe {
                    value: -value,
                    size,
                }
            }
            Self::Call(function, inner) => {
                let Probe { value, size } = inner.probe(point);
                match function {
                    Function::Sin => Probe {
                        value: value.sin(),
                        size,
                    },
                    Function::Cos => Probe::leaf(value.cos()),
                    // Of either sign: only whether it is zero matters.
                    Function::Sqrt => Probe {
                        value: value.abs().sqrt(),
                        size: size.sqrt(),
                    },
                }
            }
        }
    }
}

fn quantity_at(quantity: &Quantity, point: u64) -> f64 {
    let at = |quantity: &Quantity| quantity_at(quantity, point);
    match quantity {
        Quantity::Exact(number) => number.to_f64(),
        Quantity::Parameter(id) => number(&format!("parameter {}", id.0), point),
        Quantity::Sum(parts) => parts.iter().map(at).sum(),
        Quantity::Product(parts) => parts.iter().map(at).product(),
        Quantity::Quotient(above, below) => at(above) / at(below),
        Quantity::Power(base, exponent) => at(base).powi(*exponent),
        Quantity::Negative(inner) => -at(inner),
    }
}

/// A number between 0.5 and 1.5 that depends on the name and the point
/// (FNV-1a).
fn number(name: &str, point: u64) -> f64 {
    let hash = name
        .bytes()
        .chain(point.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    0.5 + (hash >> 11) as f64 / (1_u64 << 53) as f64
}
