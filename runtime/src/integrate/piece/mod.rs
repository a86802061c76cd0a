//! The polynomial of one step: what dense output is made of, in all methods.

// A sealed trait names the types.
#![allow(unreachable_pub)]

mod collocation;
mod polynomials;
mod series;

pub use self::collocation::GaussOrder;
pub(super) use self::collocation::{GaussTable, weigh};
pub(super) use self::polynomials::{DEGREE, alternating, bernstein, blend, hermite};
pub(super) use self::series::{Ahead, LastTerms};
use crate::scalar::{Dual, Real, Scalar};
use crate::simd::dispatch::in_fours;

/// How a polynomial is written, s being the fraction of the step and r = 1 − s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Form {
    /// y + s (d₀ + r (d₁ + s (d₂ + …))), the terms being d₀, d₁, ….
    Alternating,
    /// y + Σ_k d_k b_k(s), the b_k being Bernstein polynomials.
    Bernstein,
    /// The cubic through both ends; the terms are the rates at the start and,
    /// apart, those at the end.
    Hermite,
    /// The collocation polynomial; the terms are the rates of the stages and, apart,
    /// a correction that grows with s, if there is one.
    Collocation(GaussOrder),
    /// Σ y\[k\] τᵏ; the terms are the coefficients, order by order from y\[0\] on.
    Taylor,
    /// The straight line.
    Linear,
}

impl Form {
    /// Returns true if the polynomial of a state of `n` components has so many numbers in its
    /// terms of both kinds. A method's has; a file may say anything.
    #[cfg(feature = "serde")]
    pub(super) fn fits(self, n: usize, [terms, apart]: [usize; 2]) -> bool {
        // How many terms are at least there, and at most.
        let (terms_of, apart_of) = match self {
            Self::Alternating => (1..=usize::MAX, 0..=0),
            Self::Bernstein => {
                let terms = bernstein(0.0).len();
                (terms..=terms, 0..=0)
            }
            Self::Hermite => (1..=1, 1..=1),
            Self::Collocation(order) => (order.stages()..=order.stages(), 0..=1),
            Self::Taylor => (2..=usize::MAX, 0..=0),
            Self::Linear => (0..=0, 0..=0),
        };
        let whole = |numbers: usize, terms: core::ops::RangeInclusive<usize>| match n {
            0 => numbers == 0,
            n => numbers.is_multiple_of(n) && terms.contains(&(numbers / n)),
        };
        whole(terms, terms_of) && whole(apart, apart_of)
    }
}

/// A step and the polynomial that leads from its start to its end.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a, T> {
    pub(crate) form: Form,
    /// State at the start.
    pub(crate) start: &'a [T],
    /// State at the end.
    pub(crate) end: &'a [T],
    /// Terms of the form, and those that it has apart.
    pub(crate) terms: [&'a [T]; 2],
    /// Length of the step, with its sign.
    pub(crate) length: T,
}

impl<'a, T: Real> Piece<'a, T> {
    /// A state, and no step.
    pub(crate) fn resting(state: &'a [T]) -> Self {
        Self {
            form: Form::Linear,
            start: state,
            end: state,
            terms: [&[]; 2],
            length: T::ZERO,
        }
    }

    /// Writes the solution at the fraction `fraction` of the step, from 0 to 1.
    pub(crate) fn value(&self, fraction: T, out: &mut [T]) {
        if self.form == Form::Taylor {
            return in_fours::<T, _>(Ahead {
                coefficients: self.terms[0],
                tau: fraction * self.length,
                start: self.start,
                end: out,
                residues: None,
            });
        }
        self.evaluate(fraction, out, |value| value);
    }

    /// Writes the derivative of the solution by the fraction.
    pub(crate) fn slope(&self, fraction: T, out: &mut [T]) {
        let fraction = Dual::<T, 1>::variable(fraction, 0);
        self.evaluate(fraction, out, |value| value.tangents[0]);
    }

    /// Writes what `part` takes of the values at the fraction `s`.
    fn evaluate<S: Lift<T>>(&self, s: S, out: &mut [T], part: impl Fn(S) -> T) {
        let n = self.start.len();
        let [terms, apart] = self.terms;
        match self.form {
            Form::Alternating => {
                for (i, (out, &start)) in out.iter_mut().zip(self.start).enumerate() {
                    *out = part(alternating(s, start, terms, n, i));
                }
            }
            Form::Bernstein => {
                let weights = bernstein(s);
                for (i, (out, &start)) in out.iter_mut().zip(self.start).enumerate() {
                    *out = part(blend(&weights, start, terms, n, i));
                }
            }
            Form::Hermite => {
                let rates = terms.iter().zip(apart);
                let ends = self.start.iter().zip(self.end);
                for (out, ((&start, &end), (&first, &last))) in out.iter_mut().zip(ends.zip(rates))
                {
                    *out = part(hermite(s, self.length, [start, end], [first, last]));
                }
            }
            Form::Collocation(order) => {
                let weights = order.weights(self.length, s);
                for (i, (out, &start)) in out.iter_mut().zip(self.start).enumerate() {
                    let mut value = weigh(&weights, start, terms, n, i);
                    if let Some(&correction) = apart.get(i) {
                        value = value + s * S::lift(correction);
                    }
                    *out = part(value);
                }
            }
            Form::Taylor => {
                let tau = s * S::lift(self.length);
                for (i, out) in out.iter_mut().enumerate() {
                    let coefficients = terms.iter().skip(i).step_by(n).rev();
                    let zero = S::from_f64(0.0);
                    *out = part(coefficients.fold(zero, |sum, &c| sum * tau + S::lift(c)));
                }
            }
            Form::Linear => {
                let ends = self.start.iter().zip(self.end);
                for (out, (&start, &end)) in out.iter_mut().zip(ends) {
                    *out = part(S::lift(start) + s * S::lift(end - start));
                }
            }
        }
    }
}

/// A number that a number `W` is taken for: itself, or a constant among numbers with
/// derivatives.
pub trait Lift<W>: Scalar {
    /// Returns the number.
    fn lift(number: W) -> Self;
}

impl<W: Scalar> Lift<W> for W {
    #[inline(always)]
    fn lift(number: W) -> W {
        number
    }
}

impl<T: Scalar> Lift<T> for Dual<T, 1> {
    #[inline(always)]
    fn lift(number: T) -> Self {
        Self::constant(number)
    }
}
