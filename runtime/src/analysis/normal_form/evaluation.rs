//! Polynomials in few variables, prepared for many evaluations.

use crate::scalar::Terms;

/// A complex number.
pub(super) type Complex = [f64; 2];

/// Monomial: its degree, its coefficient and the exponents of all variables.
#[derive(Clone, Debug)]
pub(super) struct Monomial {
    pub(super) degree: u32,
    pub(super) coefficient: f64,
    pub(super) powers: Vec<u8>,
}

/// Sum of monomials, sorted by ascending degree.
#[derive(Clone, Debug, Default)]
pub(super) struct Monomials {
    /// Degree and coefficient of each monomial.
    terms: Vec<(u32, f64)>,
    /// Exponents of all monomials, one monomial after the other.
    powers: Vec<u8>,
    variables: usize,
}

impl Monomials {
    /// Creates the sum from the terms of a polynomial in the given variables.
    pub(super) fn of(by_degree: &[Terms], variables: &[usize]) -> Self {
        let mut all = Self::default();
        for (degree, terms) in by_degree.iter().enumerate() {
            for (exponents, coefficient) in terms.iter() {
                let powers = variables.iter();
                all.push(Monomial {
                    degree: degree as u32,
                    coefficient,
                    powers: powers.map(|own| exponents.of(*own) as u8).collect(),
                });
            }
        }
        all
    }

    pub(super) fn push(&mut self, monomial: Monomial) {
        self.variables = monomial.powers.len();
        self.terms.push((monomial.degree, monomial.coefficient));
        self.powers.extend(monomial.powers);
    }

    /// Iterates over the monomials: degree, coefficient and exponents of each.
    fn iter(&self) -> impl Iterator<Item = (u32, f64, &[u8])> {
        let powers = self.powers.chunks_exact(self.variables.max(1));
        let both = self.terms.iter().zip(powers);
        both.map(|((degree, coefficient), powers)| (*degree, *coefficient, powers))
    }

    /// Returns the value of all monomials up to a degree, for real variables whose powers are
    /// given.
    pub(super) fn value(&self, powers: &Powers<f64>, degree: u32) -> f64 {
        let own = self.iter().take_while(|(own, ..)| *own <= degree);
        let values = own.map(|(_, coefficient, exponents)| {
            let factors = exponents.iter().enumerate();
            factors.fold(coefficient, |product, (j, power)| {
                product * powers.of(j, *power)
            })
        });
        values.sum()
    }

    /// Returns two values, each of all monomials up to one of two degrees, for complex variables
    /// whose powers are given.
    pub(super) fn complex_values(
        &self,
        powers: &Powers<Complex>,
        [low, high]: [u32; 2],
    ) -> [Complex; 2] {
        let mut sum = [0.0; 2];
        let mut lower = sum;
        for (degree, coefficient, exponents) in self.iter().take_while(|(own, ..)| *own <= high) {
            let mut product = [coefficient, 0.0];
            for (j, power) in exponents.iter().enumerate().filter(|(_, own)| **own > 0) {
                product = times(product, powers.of(j, *power));
            }
            sum = [sum[0] + product[0], sum[1] + product[1]];
            if degree <= low {
                lower = sum;
            }
        }
        [lower, sum]
    }
}

/// Powers of all variables, with exponents from 0 up to a degree.
pub(super) struct Powers<T> {
    stride: usize,
    values: Vec<T>,
}

impl<T: Copy> Powers<T> {
    pub(super) fn new(variables: &[T], degree: u32, one: T, times: impl Fn(T, T) -> T) -> Self {
        let stride = degree as usize + 1;
        let mut values = Vec::with_capacity(stride * variables.len());
        for variable in variables {
            let mut power = one;
            for _ in 0..stride {
                values.push(power);
                power = times(power, *variable);
            }
        }
        Self { stride, values }
    }

    pub(super) fn of(&self, variable: usize, power: u8) -> T {
        self.values[variable * self.stride + usize::from(power)]
    }
}

/// Product of two complex numbers.
pub(super) fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}
