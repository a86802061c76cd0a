//! Functions of time with their first two derivatives, by truncated Taylor
//! arithmetic: what symbolic time derivatives are compared with.

use std::fmt;
use std::ops::{Add, Mul};

use super::Vector;
use branched_pendulum_compiler_tests::random::Random;

/// The drive of a tree at one time, and the size of the terms from which each
/// figure is summed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Torque on the root, N m.
    pub torque: f64,
    /// Acceleration of the root's pivot, m/s².
    pub acceleration: Vector,
    /// The torque with the absolute value of every term.
    pub torque_terms: f64,
    /// The acceleration likewise.
    pub acceleration_terms: Vector,
}

/// A value, its first and its second time derivative, and the sums of the
/// absolute values of their terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Value, slope, curvature.
    pub value: [f64; 3],
    /// Bounds of their terms.
    pub terms: [f64; 3],
}

impl Jet {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self {
            value: [value, 0.0, 0.0],
            terms: [value.abs(), 0.0, 0.0],
        }
    }

    /// Time itself.
    pub fn time(time: f64) -> Self {
        Self {
            value: [time, 1.0, 0.0],
            terms: [time.abs(), 1.0, 0.0],
        }
    }

    /// f(u) for f, f', f'' at u and bounds of their terms.
    fn chain(self, f: [f64; 3], bounds: [f64; 3]) -> Self {
        let [_, slope, curvature] = self.value;
        let [_, slopes, curvatures] = self.terms;
        Self {
            value: [f[0], f[1] * slope, f[1] * curvature + f[2] * slope * slope],
            terms: [
                bounds[0],
                bounds[1] * slopes,
                bounds[1] * curvatures + bounds[2] * slopes * slopes,
            ],
        }
    }

    /// Sine.
    pub fn sin(self) -> Self {
        let ([sin, cos], [s, c]) = self.sine_and_cosine();
        self.chain([sin, cos, -sin], [s, c, s])
    }

    /// Cosine.
    pub fn cos(self) -> Self {
        let ([sin, cos], [s, c]) = self.sine_and_cosine();
        self.chain([cos, -sin, -cos], [c, s, c])
    }

    /// sin and cos, and their sizes: an error of the argument is one of theirs.
    fn sine_and_cosine(self) -> ([f64; 2], [f64; 2]) {
        let (sin, cos) = self.value[0].sin_cos();
        let size = |own: f64, other: f64| own.abs() + other.abs() * self.terms[0];
        ([sin, cos], [size(sin, cos), size(cos, sin)])
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: std::array::from_fn(|i| self.value[i] + other.value[i]),
            terms: std::array::from_fn(|i| self.terms[i] + other.terms[i]),
        }
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = |a: [f64; 3], b: [f64; 3]| {
            [
                a[0] * b[0],
                a[1] * b[0] + a[0] * b[1],
                a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2],
            ]
        };
        Self {
            value: product(self.value, other.value),
            terms: product(self.terms, other.terms),
        }
    }
}

/// A function of time as a tree of operations.
#[derive(Clone, Debug)]
pub enum Signal {
    /// A decimal number of two digits.
    Number(f64),
    /// Time.
    Time,
    /// a + b.
    Sum(Box<Signal>, Box<Signal>),
    /// a − b.
    Difference(Box<Signal>, Box<Signal>),
    /// a b.
    Product(Box<Signal>, Box<Signal>),
    /// a / number.
    Quotient(Box<Signal>, f64),
    /// a².
    Square(Box<Signal>),
    /// sin a.
    Sin(Box<Signal>),
    /// cos a.
    Cos(Box<Signal>),
}

impl Signal {
    /// A random function of at most `depth` operations inside one another.
    pub fn random(random: &mut Random, depth: usize) -> Self {
        let number = |random: &mut Random| {
            let hundredths = 10 + random.below(190);
            hundredths as f64 / 100.0
        };
        if depth == 0 {
            return match random.below(2) {
                0 => Self::Number(number(random)),
                _ => Self::Time,
            };
        }
        let inner = |random: &mut Random| Box::new(Self::random(random, depth - 1));
        match random.below(8) {
            0 => Self::Sum(inner(random), inner(random)),
            1 => Self::Difference(inner(random), inner(random)),
            2 => Self::Product(inner(random), inner(random)),
            3 => Self::Quotient(inner(random), number(random)),
            4 => Self::Square(inner(random)),
            5 | 6 => Self::Sin(inner(random)),
            _ => Self::Cos(inner(random)),
        }
    }

    /// Value and derivatives at a time.
    pub fn at(&self, time: f64) -> Jet {
        match self {
            Self::Number(value) => Jet::constant(*value),
            Self::Time => Jet::time(time),
            Self::Sum(a, b) => a.at(time) + b.at(time),
            Self::Difference(a, b) => a.at(time) + Jet::constant(-1.0) * b.at(time),
            Self::Product(a, b) => a.at(time) * b.at(time),
            Self::Quotient(a, b) => a.at(time) * Jet::constant(1.0 / b),
            Self::Square(a) => a.at(time) * a.at(time),
            Self::Sin(a) => a.at(time).sin(),
            Self::Cos(a) => a.at(time).cos(),
        }
    }
}

/// In the attribute's notation.
impl fmt::Display for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => write!(f, "{value}"),
            Self::Time => write!(f, "t"),
            Self::Sum(a, b) => write!(f, "({a} + {b})"),
            Self::Difference(a, b) => write!(f, "({a} - {b})"),
            Self::Product(a, b) => write!(f, "{a} * {b}"),
            Self::Quotient(a, b) => write!(f, "({a}) / {b}"),
            Self::Square(a) => write!(f, "({a})^2"),
            Self::Sin(a) => write!(f, "sin({a})"),
            Self::Cos(a) => write!(f, "cos({a})"),
        }
    }
}
