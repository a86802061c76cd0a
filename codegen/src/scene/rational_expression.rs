//! Rational expressions, the common form of values, observables and functions of time.

/// Sums, products, quotients and integer powers of operands, in the order in which they were
/// written.
///
/// The type `A` of the operands gives the expression its meaning: numbers and parameters for a
/// [`Quantity`](super::Quantity), moving variables for an [`Observed`](super::Observed), the time
/// for a [`Signal`](super::Signal). Functions of expressions are operands too. Each of these types
/// documents further invariants, which its constructors keep. No divisor is identically zero.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum RationalExpression<A> {
    /// An operand, such as a number, a parameter or the time.
    Atom(A),
    /// A sum of two or more members.
    Sum(Vec<Self>),
    /// A product of two or more factors.
    Product(Vec<Self>),
    /// Dividend and divisor.
    Quotient(Box<Self>, Box<Self>),
    /// An integer power.
    Power(Box<Self>, i32),
    /// The expression with the opposite sign.
    Negative(Box<Self>),
}

impl<A> RationalExpression<A> {
    /// Returns the operands, in the order written.
    pub fn atoms(&self) -> Vec<&A> {
        match self {
            Self::Atom(atom) => vec![atom],
            Self::Sum(parts) | Self::Product(parts) => parts.iter().flat_map(Self::atoms).collect(),
            Self::Quotient(above, below) => [above.atoms(), below.atoms()].concat(),
            Self::Power(base, _) | Self::Negative(base) => base.atoms(),
        }
    }

    /// Returns the expression with every operand replaced by another expression.
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
