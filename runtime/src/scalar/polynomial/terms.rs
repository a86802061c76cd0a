//! Sparse polynomials: sorted lists of monomials with their coefficients.

use core::hash::BuildHasherDefault;
use std::collections::HashMap;

use super::exponents::{ExponentHasher, Exponents};

/// Limits on the degree of the monomials that a computation keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Truncation {
    /// Largest total degree.
    pub degree: u32,
    /// Largest degree that a monomial may have in the limited variables alone.
    pub limited_degree: u32,
    /// Mask of the limited variables.
    mask: u128,
}

impl Truncation {
    /// Returns a limit on the total degree only; it is at most [`Exponents::MOST_DEGREE`].
    pub fn by_degree(degree: u32) -> Self {
        Self {
            degree: degree.min(Exponents::MOST_DEGREE),
            limited_degree: degree,
            mask: 0,
        }
    }

    /// Returns the same limit, with an additional limit on the degree in some of the variables.
    #[must_use]
    pub fn limited(self, variables: impl Iterator<Item = usize>, degree: u32) -> Self {
        Self {
            limited_degree: degree,
            mask: Exponents::mask(variables),
            ..self
        }
    }

    /// Returns the degree of a monomial in those variables that have an additional limit.
    pub fn limited_part(&self, exponents: Exponents) -> u32 {
        exponents.masked(self.mask).degree()
    }
}

/// A polynomial as the list of its monomials with coefficients, by degree and exponents.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Terms(Vec<(Exponents, f64)>);

/// Sum of monomials, which may be added in any order.
#[derive(Clone, Debug, Default)]
pub struct TermSum(HashMap<Exponents, f64, BuildHasherDefault<ExponentHasher>>);

impl TermSum {
    /// Adds a monomial.
    #[inline]
    pub fn add(&mut self, exponents: Exponents, coefficient: f64) {
        *self.0.entry(exponents).or_insert(0.0) += coefficient;
    }

    /// Adds a polynomial, multiplied by `factor`.
    pub fn add_terms(&mut self, terms: &Terms, factor: f64) {
        for (exponents, coefficient) in terms.iter() {
            self.add(exponents, factor * coefficient);
        }
    }

    /// Adds the product of two polynomials, multiplied by `factor`; monomials above the limits are
    /// dropped.
    pub fn add_product(&mut self, one: &Terms, other: &Terms, factor: f64, to: &Truncation) {
        let limited: Vec<(u32, u32)> = other
            .iter()
            .map(|(exponents, _)| (exponents.degree(), to.limited_part(exponents)))
            .collect();
        for (own, coefficient) in one.iter() {
            let (Some(left), Some(limited_left)) = (
                to.degree.checked_sub(own.degree()),
                to.limited_degree.checked_sub(to.limited_part(own)),
            ) else {
                continue;
            };
            let coefficient = factor * coefficient;
            for ((exponents, value), (degree, part)) in other.iter().zip(&limited) {
                if *degree > left {
                    break;
                }
                if *part <= limited_left {
                    self.add(own.times(exponents), coefficient * value);
                }
            }
        }
    }

    /// Returns the polynomial without coefficients that are exactly zero.
    pub fn into_terms(self) -> Terms {
        let terms = self.0.into_iter().filter(|(_, value)| *value != 0.0);
        let mut terms: Vec<(Exponents, f64)> = terms.collect();
        terms.sort_unstable_by_key(|(exponents, _)| (exponents.degree(), *exponents));
        Terms(terms)
    }
}

impl Terms {
    /// Returns one monomial.
    pub fn monomial(exponents: Exponents, coefficient: f64) -> Self {
        Self(vec![(exponents, coefficient)])
    }

    /// Returns true if the polynomial is zero.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the number of monomials.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the monomials with their coefficients, by ascending degree.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (Exponents, f64)> + '_ {
        self.0.iter().copied()
    }

    /// Returns the coefficient of a monomial.
    pub fn coefficient(&self, exponents: Exponents) -> f64 {
        let key = (exponents.degree(), exponents);
        let found = self
            .0
            .binary_search_by_key(&key, |(own, _)| (own.degree(), *own));
        found
            .ok()
            .and_then(|place| self.0.get(place))
            .map_or(0.0, |(_, value)| *value)
    }

    /// Returns the lowest degree of a monomial; `None` if the polynomial is zero.
    pub fn lowest_degree(&self) -> Option<u32> {
        self.0.first().map(|(exponents, _)| exponents.degree())
    }

    /// Returns a multiple.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let terms = self
            .iter()
            .map(|(exponents, value)| (exponents, factor * value));
        Self(terms.collect())
    }

    /// Returns the polynomial of those monomials that `keeps` accepts.
    #[must_use]
    pub fn filtered(&self, keeps: impl Fn(Exponents) -> bool) -> Self {
        Self(
            self.iter()
                .filter(|(exponents, _)| keeps(*exponents))
                .collect(),
        )
    }

    /// Returns this polynomial plus `factor` times another one.
    #[must_use]
    pub fn plus(&self, other: &Self, factor: f64) -> Self {
        let key = |(exponents, _): &(Exponents, f64)| (exponents.degree(), *exponents);
        let mut merged = Vec::with_capacity(self.len() + other.len());
        let (mut own, mut rest) = (self.0.iter().peekable(), other.0.iter().peekable());
        loop {
            match (own.peek(), rest.peek()) {
                (None, None) => return Self(merged),
                (Some(one), Some(two)) if key(one) == key(two) => {
                    let sum = one.1 + factor * two.1;
                    if sum != 0.0 {
                        merged.push((one.0, sum));
                    }
                    own.next();
                    rest.next();
                }
                (Some(one), two) if two.is_none_or(|two| key(one) < key(two)) => {
                    merged.push(**one);
                    own.next();
                }
                (_, Some(two)) => {
                    merged.push((two.0, factor * two.1));
                    rest.next();
                }
                (Some(_), None) => return Self(merged),
            }
        }
    }

    /// Returns the product of two polynomials, without monomials above the limits.
    #[must_use]
    pub fn times(&self, other: &Self, to: &Truncation) -> Self {
        let mut sum = TermSum::default();
        sum.add_product(self, other, 1.0, to);
        sum.into_terms()
    }

    /// Returns the derivative of the polynomial by a variable.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        let terms = self.iter().filter_map(|(exponents, value)| {
            let rest = exponents.without(variable)?;
            Some((rest, f64::from(exponents.of(variable)) * value))
        });
        // Dividing by one variable keeps the order.
        Self(terms.collect())
    }

    /// Returns the value of the polynomial at a point with one number per variable.
    pub fn value(&self, point: &[f64]) -> f64 {
        let terms = self.iter().map(|(exponents, coefficient)| {
            let powers = point
                .iter()
                .enumerate()
                .map(|(variable, value)| value.powi(exponents.of(variable) as i32));
            coefficient * powers.product::<f64>()
        });
        terms.sum()
    }
}

impl FromIterator<(Exponents, f64)> for Terms {
    fn from_iter<I: IntoIterator<Item = (Exponents, f64)>>(terms: I) -> Self {
        let mut sum = TermSum::default();
        for (exponents, coefficient) in terms {
            sum.add(exponents, coefficient);
        }
        sum.into_terms()
    }
}
