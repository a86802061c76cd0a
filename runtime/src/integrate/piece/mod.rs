//! Polynomial of one step, from which all methods compute their dense output.

// The types are public because a sealed trait mentions them.
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

/// Form of the polynomial of a step; s is the fraction of the step, from 0 to 1, and r = 1 − s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Form {
    /// Alternating product form y + s (d₀ + r (d₁ + s (d₂ + …))), with the state y at the start;
    /// the terms are d₀, d₁, ….
    Alternating,
    /// Sum of Bernstein polynomials b_k: y + Σ_k d_k b_k(s), with the state y at the start; the
    /// terms are the d_k.
    Bernstein,
    /// The cubic through both ends of the step. The terms are the rates at the start and, in the
    /// second list, the rates at the end.
    Hermite,
    /// The collocation polynomial. The terms are the rates of the stages; the second list may hold
    /// a correction that grows with s.
    Collocation(GaussOrder),
    /// Taylor polynomial Σ y\[k\] τᵏ in the time τ since the start; the terms are the coefficients
    /// y\[0\], y\[1\], ….
    Taylor,
    /// The straight line between the two ends; there are no terms.
    Linear,
}

impl Form {
    /// Returns true if the two lists of terms have valid lengths for a state of `n` components.
    /// Used for data that are read from files.
    #[cfg(feature = "serde")]
    pub(super) fn fits(self, n: usize, [terms, apart]: [usize; 2]) -> bool {
        // Smallest and largest number of terms.
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

/// A step, with the polynomial that gives the solution between its ends.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a, T> {
    pub(crate) form: Form,
    /// State at the start.
    pub(crate) start: &'a [T],
    /// State at the end.
    pub(crate) end: &'a [T],
    /// The two lists of terms of the polynomial.
    pub(crate) terms: [&'a [T]; 2],
    /// Length of the step; negative in a run backwards in time.
    pub(crate) length: T,
}

impl<'a, T: Real> Piece<'a, T> {
    /// Returns a step of length zero that stays at `state`.
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

    /// Writes the derivative of the solution with respect to the fraction.
    pub(crate) fn slope(&self, fraction: T, out: &mut [T]) {
        let fraction = Dual::<T, 1>::variable(fraction, 0);
        self.evaluate(fraction, out, |value| value.tangents[0]);
    }

    /// Evaluates the polynomial at the fraction `s`, and writes `part` of each component to `out`.
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

/// Conversion of a number of type `W` to `Self`: the same number, or a constant in a number type
/// with derivatives.
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
