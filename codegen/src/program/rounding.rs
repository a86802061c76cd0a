//! Rounding error of a function, measured when its code is generated: `f64` compared with
//! double-double numbers, at a few fixed states of the model.
//!
//! Both evaluations start from the same `f64` numbers, including sines, cosines and constants of
//! the model. The result is therefore the error of the arithmetic, with each operation rounded and
//! none fused. Only operations that every machine rounds identically are used, so that the docs are
//! the same everywhere.

use super::wide::Wide;
use super::{Entry, Op, Program, ValueId};
use crate::functions::{Argument, Purpose};

/// Largest number of states at which a function is evaluated.
const MOST_STATES: usize = 16;

/// Smallest number of states from which an error is reported.
const FEWEST_STATES: usize = 4;

/// Largest number of values computed for one function, so that the measurement takes a few
/// milliseconds.
const MOST_VALUES: usize = 1 << 13;

/// Largest angle and largest angular velocity of a state, in rad and rad/s.
const LARGEST: [f64; 2] = [3.0, 8.0];

/// Largest tangent of half an angle, which belongs to an angle of 1.97 rad.
const LARGEST_TANGENT: f64 = 1.5;

/// A measured rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// Largest error of a result, in units in the last place of the largest result of the same
    /// state.
    pub ulps: f64,
    /// Number of states.
    pub states: usize,
}

/// A function prepared for evaluation; operands are indices in its list of operations.
struct Steps {
    steps: Vec<Step>,
    outputs: Vec<usize>,
}

struct Step {
    op: Op,
    /// Value of an operation that is a number or a constant of the model.
    fixed: Option<f64>,
}

/// Inputs and angles of one state.
struct Sample {
    state: u64,
    /// Momenta that belong to the state's velocities, if the function takes momenta.
    momenta: Vec<f64>,
}

impl Program {
    /// Measures the rounding error of a function. Returns `None` if constants depend on parameters,
    /// if the function is too long, or if it takes torques, whose magnitude depends on the model.
    pub fn rounding(&self, entry: &Entry) -> Option<Rounding> {
        // The program contains only the first terms of the recurrences.
        if entry.purpose == Purpose::TaylorCoefficients {
            return None;
        }
        let function = self.steps(entry)?;
        let states = MOST_STATES.min(MOST_VALUES / function.steps.len().max(1));
        if states < FEWEST_STATES {
            return None;
        }
        let of_momenta = [
            (Argument::AbsoluteMomenta, Purpose::AbsoluteMomenta),
            (Argument::Momenta, Purpose::SymmetricMomenta),
        ];
        let momenta = of_momenta
            .into_iter()
            .find(|(argument, _)| entry.arguments.contains(argument))
            .map(|(_, purpose)| purpose);
        let momenta = match momenta {
            Some(purpose) => {
                let mut entries = self.entries.iter();
                Some(self.steps(entries.find(|entry| entry.purpose == purpose)?)?)
            }
            None => None,
        };
        let mut worst = 0.0_f64;
        for state in 0..states {
            let mut sample = Sample {
                state: state as u64,
                momenta: Vec::new(),
            };
            if let Some(momenta) = &momenta {
                sample.momenta = sample.evaluate(momenta)?.0;
            }
            let (rounded, exact) = sample.evaluate(&function)?;
            let sizes = exact.iter().map(|value| value.high.abs());
            let size = sizes.fold(0.0, f64::max);
            let errors = rounded.iter().zip(&exact);
            let errors = errors.map(|(rounded, exact)| exact.distance(*rounded));
            let error = errors.fold(0.0, f64::max);
            if !(size.is_normal() && error.is_finite()) {
                return None;
            }
            worst = worst.max(error / (size.next_up() - size));
        }
        Some(Rounding {
            ulps: worst,
            states,
        })
    }

    fn steps(&self, entry: &Entry) -> Option<Steps> {
        // In the order of the program.
        let needed = self.needed(&entry.outputs);
        let place = |id: ValueId| match needed.binary_search(&id) {
            Ok(place) => place,
            Err(_) => unreachable!("what a value is formed of is needed"),
        };
        let step = |id: &ValueId| {
            let op = &self.definition(*id).op;
            let fixed = match op {
                Op::Number(number) => Some(number.to_f64()),
                Op::Constant(constant) => Some(self.setup.get(*constant).exact.as_ref()?.to_f64()),
                _ => None,
            };
            let op = op.with_operands(|operand| ValueId(place(operand) as u32));
            Some(Step { op, fixed })
        };
        Some(Steps {
            steps: needed.iter().map(step).collect::<Option<_>>()?,
            outputs: entry.outputs.iter().map(|&id| place(id)).collect(),
        })
    }
}

impl Sample {
    /// Evaluates the outputs, rounded and in double-double numbers.
    fn evaluate(&self, function: &Steps) -> Option<(Vec<f64>, Vec<Wide>)> {
        let mut values: Vec<(f64, Wide)> = Vec::with_capacity(function.steps.len());
        for Step { op, fixed } in &function.steps {
            let at = |id: ValueId| values[id.0 as usize];
            let both = |a: ValueId, b: ValueId| {
                let ((a, wide_a), (b, wide_b)) = (at(a), at(b));
                ([a, b], [wide_a, wide_b])
            };
            let same = |value: f64| (value, Wide::from(value));
            let angle = |id: ValueId| self.sin_cos(&function.steps[id.0 as usize].op, id);
            values.push(match *op {
                Op::Number(_) | Op::Constant(_) => same((*fixed)?),
                Op::Input(argument, index) => same(self.input(argument, index)?),
                Op::Sin(a) => same(angle(a)[0]),
                Op::Cos(a) => same(angle(a)[1]),
                Op::Sqrt(a) => (at(a).0.sqrt(), at(a).1.sqrt()),
                Op::Neg(a) => (-at(a).0, -at(a).1),
                Op::Add(a, b) => {
                    let ([a, b], [wide_a, wide_b]) = both(a, b);
                    (a + b, wide_a + wide_b)
                }
                Op::Sub(a, b) => {
                    let ([a, b], [wide_a, wide_b]) = both(a, b);
                    (a - b, wide_a + -wide_b)
                }
                Op::Mul(a, b) => {
                    let ([a, b], [wide_a, wide_b]) = both(a, b);
                    (a * b, wide_a * wide_b)
                }
                Op::Div(a, b) => {
                    let ([a, b], [wide_a, wide_b]) = both(a, b);
                    (a / b, wide_a / wide_b)
                }
            });
        }
        Some(function.outputs.iter().map(|&place| values[place]).unzip())
    }

    /// Returns an element of an argument.
    fn input(&self, argument: Argument, index: usize) -> Option<f64> {
        let (kind, angles) = match argument {
            Argument::Theta => (1, true),
            Argument::Omega => (2, false),
            Argument::Coordinates => (3, true),
            Argument::Rates => (4, false),
            Argument::Absolute | Argument::Symmetric => (5, true),
            Argument::Time => (6, false),
            Argument::AbsoluteMomenta | Argument::Momenta => {
                return self.momenta.get(index).copied();
            }
            Argument::Forces
            | Argument::Alpha
            | Argument::Weights
            | Argument::Actions
            | Argument::Difference(_)
            | Argument::DifferenceRate(_)
            | Argument::SmallDifferences
            | Argument::SmallRates
            | Argument::Torques
            | Argument::SmallTorques
            | Argument::Prescribed(_)
            | Argument::Constants
            | Argument::Body
            | Argument::Motion
            | Argument::Response
            | Argument::Sums
            | Argument::Elimination
            | Argument::Carried
            | Argument::Pivot
            | Argument::Given(_) => return None,
        };
        let largest = LARGEST[usize::from(!angles)];
        Some(largest * self.fraction(kind, index as u64))
    }

    /// Computes sine and cosine of an angle from the tangent of half of it.
    fn sin_cos(&self, angle: &Op, place: ValueId) -> [f64; 2] {
        // An element of an argument has the same angle in every function.
        let (kind, index) = match *angle {
            Op::Input(Argument::Theta, index) => (7, index as u64),
            Op::Input(Argument::Coordinates, index) => (8, index as u64),
            _ => (9, place.0.into()),
        };
        let tangent = LARGEST_TANGENT * self.fraction(kind, index);
        let below = tangent * tangent + 1.0;
        [2.0 * tangent / below, (2.0 - below) / below]
    }

    /// Returns a pseudo-random number from −1 to 1 (SplitMix64).
    fn fraction(&self, kind: u64, index: u64) -> f64 {
        let seed = (self.state << 48) ^ (kind << 32) ^ index;
        let mut bits = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
