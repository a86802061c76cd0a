//! Rational expressions: what values, observables and functions of time have in common.

/// Sums, products, quotients and integer powers of atoms, in the order in which they were
/// written.
///
/// What the atoms are is the meaning of `A`: numbers and parameters for a
/// [`Quantity`](super::Quantity), what moves for an [`Observed`](super::Observed), time for a
/// [`Signal`](super::Signal). Functions of expressions are atoms too. What holds beyond that
/// is said there, and kept by what builds them. No divisor is identically zero.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum RationalExpression<A> {
    /// What is none of the others.
    Atom(A),
    /// A sum of two or more members.
    Sum(Vec<Self>),
    /// A product of two or more factors.
    Product(Vec<Self>),
    /// Dividend and divisor.
    Quotient(Box<Self>, Box<Self>),
    /// An integer power.
    Power(Box<Self>, i32),
    /// The opposite.
    Negative(Box<Self>),
}

impl<A> RationalExpression<A> {
    /// The atoms, in the order written.
    pub fn atoms(&self) -> Vec<&A> {
        match self {
            Self::Atom(atom) => vec![atom],
            Self::Sum(parts) | Self::Product(parts) => parts.iter().flat_map(Self::atoms).collect(),
            Self::Quotient(above, below) => [above.atoms(), below.atoms()].concat(),
            Self::Power(base, _) | Self::Negative(base) => base.atoms(),
        }
    }

    /// The expression with another one in the place of each atom.
    pub fn substitute<B>(
        &self,
        replacement: &impl Fn(&A) -> RationalExpression<B>,
    ) -> RationalExpression<B> {
        let one = |part: &Self| Box::new(part.substitute(replacement));
        let all = |parts: &[Self]| {
            let parts = parts.iter();
            parts.map(|part| part.substitute(replacement)).collect()
        };
        match self {
            Self::Atom(atom) => replacement(atom),
            Self::Sum(members) => RationalExpression::Sum(all(members)),
            Self::Product(factors) => RationalExpression::Product(all(factors)),
            Self::Quotient(above, below) => RationalExpression::Quotient(one(above), one(below)),
            Self::Power(base, exponent) => RationalExpression::Power(one(base), *exponent),
            Self::Negative(value) => RationalExpression::Negative(one(value)),
        }
    }
}
