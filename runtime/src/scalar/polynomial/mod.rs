//! Truncated polynomials in many variables.

mod exponents;
mod terms;

use core::ops::{Add, Div, Mul, Neg, Sub};
use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering};

pub use self::exponents::Exponents;
pub use self::terms::{TermSum, Terms, Truncation};
use super::Scalar;

/// A polynomial in several variables, truncated at a total degree: a function computed with
/// these gives its Taylor expansion about the point where all variables are zero.
///
/// [`expand`](Self::expand) provides the variables and returns the coefficients of the results.
/// The coefficients are kept in memory of the thread while it runs, so that a polynomial is a
/// small value that can be copied. Constants can be used anywhere. A polynomial that is used
/// after its expansion has ended, or on another thread, is not a number.
///
/// Only monomials with a coefficient other than zero are stored: of an even function only even
/// degrees cost anything. Functions of a polynomial are their Taylor series at its constant
/// part. A. Griewank and A. Walther, *Evaluating Derivatives*, 2nd ed. 2008, ch. 13.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::{Exponents, Polynomial, Scalar, Truncation};
///
/// // sin(x + y²) = x + y² − x³/6 − x² y²/2 + …
/// let to = Truncation::by_degree(4);
/// let expanded = Polynomial::expand(2, to, |variables| {
///     let [x, y] = [variables[0], variables[1]];
///     vec![(x + y * y).sin_cos().0]
/// });
/// let [x, y] = [0, 1].map(Exponents::of_variable);
/// assert_eq!(expanded[0].coefficient(x), 1.0);
/// assert_eq!(expanded[0].coefficient(x.times(x).times(y).times(y)), -0.5);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Polynomial {
    /// Coefficient of degree zero.
    constant: f64,
    /// Monomials of degree one and above; `None` if the polynomial is a constant.
    stored: Option<Stored>,
}

/// Index of a polynomial's monomials in the memory of an expansion.
#[derive(Clone, Copy, Debug)]
struct Stored {
    expansion: u64,
    index: usize,
}

/// Expansion in polynomials that is being computed: its identifying number, the limits on degrees,
/// and all polynomials computed so far.
struct ExpansionStore {
    number: u64,
    truncation: Truncation,
    stored: Vec<Terms>,
}

thread_local! {
    /// Expansions that are being computed on this thread. If they are nested, the innermost is the
    /// last.
    static EXPANSIONS: RefCell<Vec<ExpansionStore>> = const { RefCell::new(Vec::new()) };
}

/// Identifying number of the next expansion.
static NEXT: AtomicU64 = AtomicU64::new(0);

/// Frees the memory of an expansion, also if the function panics.
struct EndOfExpansion;

impl Drop for EndOfExpansion {
    fn drop(&mut self) {
        EXPANSIONS.with_borrow_mut(|all| all.pop());
    }
}

impl Polynomial {
    /// Calls `function` with the variables and returns its results, which are polynomials in these
    /// variables. Variables beyond [`Exponents::MOST_VARIABLES`] are zero. A result that is not a
    /// finite number has a constant term of NaN.
    pub fn expand(
        variables: usize,
        truncation: Truncation,
        function: impl FnOnce(&[Self]) -> Vec<Self>,
    ) -> Vec<Terms> {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        EXPANSIONS.with_borrow_mut(|all| {
            all.push(ExpansionStore {
                number,
                truncation,
                stored: Vec::new(),
            });
        });
        let end = EndOfExpansion;
        let variables: Vec<Self> = (0..variables)
            .map(|variable| {
                let own = Exponents::of_variable(variable);
                match own.degree() {
                    0 => Self::from_f64(0.0),
                    _ => Self::store(0.0, Terms::monomial(own, 1.0)),
                }
            })
            .collect();
        let results = function(&variables).into_iter().map(|result| {
            let constant = Terms::monomial(Exponents::default(), result.constant);
            let constant = constant.filtered(|_| result.constant != 0.0);
            match result.with_terms(|terms, _| constant.plus(terms, 1.0)) {
                Some(all) => all,
                None => constant,
            }
        });
        let results = results.collect();
        drop(end);
        results
    }

    /// Returns a polynomial with the given coefficients, for use within an expansion.
    pub fn from_terms(terms: &Terms) -> Self {
        let one = Exponents::default();
        let above = terms.filtered(|exponents| exponents != one);
        Self::store(terms.coefficient(one), above)
    }

    /// Stores monomials in the memory of the innermost expansion and returns their polynomial.
    fn store(constant: f64, terms: Terms) -> Self {
        if terms.is_empty() {
            return Self::from_f64(constant);
        }
        EXPANSIONS.with_borrow_mut(|all| match all.last_mut() {
            None => Self::from_f64(f64::NAN),
            Some(own) => {
                own.stored.push(terms);
                let stored = Stored {
                    expansion: own.number,
                    index: own.stored.len() - 1,
                };
                Self {
                    constant,
                    stored: Some(stored),
                }
            }
        })
    }

    /// Calls a function with the monomials above degree zero. Returns `None` for a constant, and
    /// for a polynomial that belongs to another expansion.
    fn with_terms<R>(self, function: impl FnOnce(&Terms, &Truncation) -> R) -> Option<R> {
        let stored = self.stored?;
        EXPANSIONS.with_borrow(|all| {
            let own = all.last().filter(|own| own.number == stored.expansion)?;
            Some(function(own.stored.get(stored.index)?, &own.truncation))
        })
    }

    /// Computes a polynomial from two others by `function`, which gets their monomials above degree
    /// zero; `constant` is the constant term of the result. NaN if one of the two belongs to
    /// another expansion.
    fn of_both(
        self,
        other: Self,
        constant: f64,
        function: impl FnOnce(&Terms, &Terms, &Truncation) -> Terms,
    ) -> Self {
        let zero = Terms::default();
        let terms = match (self.stored, other.stored) {
            (None, None) => return Self::from_f64(constant),
            (Some(_), None) => self.with_terms(|own, to| function(own, &zero, to)),
            (None, Some(_)) => other.with_terms(|own, to| function(&zero, own, to)),
            (Some(_), Some(_)) => self
                .with_terms(|one, to| other.with_terms(|two, _| function(one, two, to)))
                .flatten(),
        };
        match terms {
            Some(terms) => Self::store(constant, terms),
            None => Self::from_f64(f64::NAN),
        }
    }

    /// Returns Σ c_k N^k, where N is this polynomial without its constant term and `coefficient`
    /// returns c_k.
    fn series(self, coefficient: impl Fn(u32) -> f64) -> Self {
        let Some(_) = self.stored else {
            return Self::from_f64(coefficient(0));
        };
        let highest = self.with_terms(|own, to| own.lowest_degree().map(|d| to.degree / d.max(1)));
        let Some(Some(highest)) = highest else {
            return Self::from_f64(f64::NAN);
        };
        let nilpotent = Self {
            constant: 0.0,
            ..self
        };
        let last = Self::from_f64(coefficient(highest));
        (0..highest).rev().fold(last, |sum, order| {
            sum * nilpotent + Self::from_f64(coefficient(order))
        })
    }
}

impl Scalar for Polynomial {
    fn from_f64(value: f64) -> Self {
        Self {
            constant: value,
            stored: None,
        }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.constant.sin_cos();
        let nilpotent = Self {
            constant: 0.0,
            ..self
        };
        // Both are series in the square: cos N = Σ (−N²)^k/(2k)!, sin N = N Σ (−N²)^k/(2k+1)!.
        let square = -(nilpotent * nilpotent);
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        let of_cosine = square.series(|k| 1.0 / factorial(2 * k));
        let of_sine = nilpotent * square.series(|k| 1.0 / factorial(2 * k + 1));
        let [sine, cosine] = [sine, cosine].map(Self::from_f64);
        (
            sine * of_cosine + cosine * of_sine,
            cosine * of_cosine - sine * of_sine,
        )
    }

    fn sqrt(self) -> Self {
        let root = self.constant.sqrt();
        self.series(|order| {
            // Binomial coefficients of 1/2.
            let binomial = (0..order).map(|k| (0.5 - f64::from(k)) / f64::from(k + 1));
            root * binomial.product::<f64>() / self.constant.powi(order as i32)
        })
    }
}

impl Add for Polynomial {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let constant = self.constant + other.constant;
        if self.stored.is_none() || other.stored.is_none() {
            let stored = self.stored.or(other.stored);
            return Self { constant, stored };
        }
        self.of_both(other, constant, |one, two, _| one.plus(two, 1.0))
    }
}

impl Sub for Polynomial {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let constant = self.constant - other.constant;
        self.of_both(other, constant, |one, two, _| one.plus(two, -1.0))
    }
}

impl Neg for Polynomial {
    type Output = Self;

    fn neg(self) -> Self {
        Self::from_f64(0.0) - self
    }
}

impl Mul for Polynomial {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let [left, right] = [self.constant, other.constant];
        self.of_both(other, left * right, |one, two, to| {
            let parts = [(one, right), (two, left)].into_iter();
            let parts = parts.filter(|(terms, factor)| !terms.is_empty() && *factor != 0.0);
            let product = match one.is_empty() || two.is_empty() {
                true => Terms::default(),
                false => one.times(two, to),
            };
            parts.fold(product, |sum, (terms, factor)| match sum.is_empty() {
                true => terms.scaled(factor),
                false => sum.plus(terms, factor),
            })
        })
    }
}

impl Div for Polynomial {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.constant;
        // 1/(c + N) = Σ (−N)^k/c^(k+1)
        self * other.series(|order| inverse * (-inverse).powi(order as i32))
    }
}
