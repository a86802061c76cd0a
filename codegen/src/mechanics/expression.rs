//! Plain expressions: results of the algebra in one canonical order.
//!
//! An [`Expr`] only carries a formula. It is read, printed and lowered to operations, but never
//! simplified or differentiated.

use crate::exact::Rational;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// Index of a symbol in its [`Symbols`] table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub u32);

/// Role of a symbol. The declaration order is the canonical order of factors in a product:
/// constants come first, so that they can be folded together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// A parameter of the model: a named number of the description.
    Parameter,
    /// A constant of the model: a combination of masses and lengths, computed once per model.
    Constant,
    /// The time, or a function of time alone in a drive.
    Temporal,
    /// Cosine or sine of a coordinate or of a difference of two.
    Trigonometric,
    /// A quantity defined by a linear system (in-phase velocities, the determinant D).
    Derived,
    /// A generalized coordinate.
    Coordinate,
    /// A generalized velocity.
    Velocity,
    /// Relative angle or rate of a joint.
    Joint,
    /// A quantity of a straight spring's line: its components, its length, and the length's slopes
    /// and rate.
    Line,
    /// A generalized acceleration; used only in rates of observables.
    Acceleration,
    /// A generalized momentum.
    Momentum,
    /// The small factor ε of a series expansion; it never leaves the derivation.
    Bookkeeping,
}

/// A symbol: three spellings and a role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Spelling in emitted code (`cos_child_1`).
    pub code: String,
    /// Spelling in plain-text formulas (`cos θ_child_1`).
    pub text: String,
    /// Spelling in LaTeX.
    pub latex: String,
    /// Role of the symbol in formulas.
    pub role: Role,
}

/// Symbols of one derivation, in the order of their creation.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Symbols {
    entries: Vec<Symbol>,
    by_text: BTreeMap<String, SymbolId>,
    codes: BTreeSet<String>,
}

impl Symbols {
    /// Creates a parameter of the scene. Its name comes from the user and may have the spelling of
    /// another symbol, from which it stays distinct.
    pub fn parameter(&mut self, name: &str, latex: &str) -> SymbolId {
        self.push(Role::Parameter, name.to_owned(), name, latex)
    }

    /// Returns the symbol spelled `text` in formulas, and creates it if it is new. Its spelling in
    /// code is `code`, followed by a number if another symbol has that spelling already:
    /// `coupling_a_b_c` may couple a to b_c or a_b to c.
    pub fn intern(&mut self, role: Role, code: &str, text: &str, latex: &str) -> SymbolId {
        if let Some(&id) = self.by_text.get(text) {
            return id;
        }
        let mut unique = code.to_owned();
        let mut number = 2;
        while !self.codes.insert(unique.clone()) {
            unique = format!("{code}_{number}");
            number += 1;
        }
        let id = self.push(role, unique, text, latex);
        self.by_text.insert(text.to_owned(), id);
        id
    }

    fn push(&mut self, role: Role, code: String, text: &str, latex: &str) -> SymbolId {
        let id = SymbolId(self.entries.len() as u32);
        self.entries.push(Symbol {
            code,
            text: text.to_owned(),
            latex: latex.to_owned(),
            role,
        });
        id
    }

    /// Returns the symbol with this index.
    pub fn get(&self, id: SymbolId) -> &Symbol {
        &self.entries[id.0 as usize]
    }

    /// Returns the symbol spelled `text` in formulas, if it exists; never a parameter.
    pub fn find(&self, text: &str) -> Option<SymbolId> {
        self.by_text.get(text).copied()
    }

    /// Iterates over all symbols, in the order of their creation.
    pub fn iter(&self) -> impl Iterator<Item = (SymbolId, &Symbol)> {
        self.entries
            .iter()
            .enumerate()
            .map(|(index, symbol)| (SymbolId(index as u32), symbol))
    }

    fn rank(&self, id: SymbolId) -> (Role, SymbolId) {
        (self.get(id).role, id)
    }
}

/// A rational expression in symbols, in canonical order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expr {
    /// An exact number.
    Number(Rational),
    /// A symbol.
    Symbol(SymbolId),
    /// A sum of at least two terms.
    Sum(Vec<Expr>),
    /// A product of at least two factors; a numeric factor comes first.
    Product(Vec<Expr>),
    /// An integer power; negative for a divisor.
    Power(Box<Expr>, i32),
}

impl Default for Expr {
    fn default() -> Self {
        Self::zero()
    }
}

impl Expr {
    /// Returns the number zero.
    pub fn zero() -> Self {
        Self::Number(Rational::from(0))
    }

    /// Returns true if the expression is the number zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Number(number) if number.is_zero())
    }

    /// Calls `visit` with every symbol in the expression, including repeated ones.
    pub fn for_each_symbol(&self, visit: &mut impl FnMut(SymbolId)) {
        match self {
            Self::Number(_) => {}
            Self::Symbol(id) => visit(*id),
            Self::Sum(parts) | Self::Product(parts) => {
                for part in parts {
                    part.for_each_symbol(visit);
                }
            }
            Self::Power(base, _) => base.for_each_symbol(visit),
        }
    }

    /// Sorts every sum and product into canonical order, which depends only on the symbols' roles
    /// and creation order. The generated code must not depend on the order in which the algebra
    /// keeps terms.
    pub fn canonical(self, symbols: &Symbols) -> Self {
        match self {
            Self::Number(_) | Self::Symbol(_) => self,
            Self::Power(base, exponent) => Self::Power(Box::new(base.canonical(symbols)), exponent),
            Self::Sum(parts) => Self::Sum(sorted(parts, symbols, compare_terms)),
            Self::Product(parts) => Self::Product(sorted(parts, symbols, compare_factors)),
        }
    }

    /// Returns the factors of a product; any other expression is its own only factor.
    pub fn factors(&self) -> &[Expr] {
        match self {
            Self::Product(parts) => parts,
            other => std::slice::from_ref(other),
        }
    }

    /// Returns the terms of a sum; any other expression is its own only term.
    pub fn terms(&self) -> &[Expr] {
        match self {
            Self::Sum(parts) => parts,
            other => std::slice::from_ref(other),
        }
    }
}

type Compare = fn(&Expr, &Expr, &Symbols) -> Ordering;

fn sorted(parts: Vec<Expr>, symbols: &Symbols, compare: Compare) -> Vec<Expr> {
    let mut parts: Vec<Expr> = parts.into_iter().map(|p| p.canonical(symbols)).collect();
    parts.sort_by(|a, b| compare(a, b, symbols));
    parts
}

/// Orders factors: numbers, then symbols by role, then sums, then divisors.
fn compare_factors(a: &Expr, b: &Expr, symbols: &Symbols) -> Ordering {
    let (base_a, exponent_a) = power(a);
    let (base_b, exponent_b) = power(b);
    (exponent_a < 0)
        .cmp(&(exponent_b < 0))
        .then_with(|| compare_bases(base_a, base_b, symbols))
        .then_with(|| exponent_a.cmp(&exponent_b))
}

fn power(expr: &Expr) -> (&Expr, i32) {
    match expr {
        Expr::Power(base, exponent) => (base, *exponent),
        other => (other, 1),
    }
}

fn compare_bases(a: &Expr, b: &Expr, symbols: &Symbols) -> Ordering {
    fn class(expr: &Expr) -> u8 {
        match expr {
            Expr::Number(_) => 0,
            Expr::Symbol(_) => 1,
            Expr::Power(..) => 2,
            Expr::Product(_) => 3,
            Expr::Sum(_) => 4,
        }
    }
    match (a, b) {
        (Expr::Number(x), Expr::Number(y)) => x.cmp(y),
        (Expr::Symbol(x), Expr::Symbol(y)) => symbols.rank(*x).cmp(&symbols.rank(*y)),
        (Expr::Power(x, n), Expr::Power(y, m)) => {
            compare_bases(x, y, symbols).then_with(|| n.cmp(m))
        }
        (Expr::Product(x), Expr::Product(y)) => compare_all(x, y, symbols, compare_factors),
        (Expr::Sum(x), Expr::Sum(y)) => compare_all(x, y, symbols, compare_terms),
        _ => class(a).cmp(&class(b)),
    }
}

/// Orders terms by the factors other than the number, and then by the number.
fn compare_terms(a: &Expr, b: &Expr, symbols: &Symbols) -> Ordering {
    fn without_number(expr: &Expr) -> &[Expr] {
        let factors = expr.factors();
        match factors.first() {
            Some(Expr::Number(_)) => &factors[1..],
            _ => factors,
        }
    }
    compare_all(
        without_number(a),
        without_number(b),
        symbols,
        compare_factors,
    )
    .then_with(|| compare_all(a.factors(), b.factors(), symbols, compare_factors))
}

fn compare_all(a: &[Expr], b: &[Expr], symbols: &Symbols, compare: Compare) -> Ordering {
    for (x, y) in a.iter().zip(b) {
        let order = compare(x, y, symbols);
        if order != Ordering::Equal {
            return order;
        }
    }
    a.len().cmp(&b.len())
}

/// An equation for documentation: a left side as text and an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFormula {
    /// Left side of the equation as text.
    pub left: String,
    /// Left side of the equation in LaTeX.
    pub left_latex: String,
    /// Right side of the equation.
    pub right: Expr,
}

impl NamedFormula {
    /// Creates the equation left = right.
    pub fn new(left: impl Into<String>, left_latex: impl Into<String>, right: &Expr) -> Self {
        Self {
            left: left.into(),
            left_latex: left_latex.into(),
            right: right.clone(),
        }
    }

    /// Creates an equation whose left side has the same spelling in text and in LaTeX.
    pub fn of_letter(letter: &str, right: &Expr) -> Self {
        Self::new(letter, letter, right)
    }

    /// Creates the equation that defines a symbol.
    pub fn of_symbol(symbols: &Symbols, symbol: SymbolId, right: &Expr) -> Self {
        let symbol = symbols.get(symbol);
        Self::new(&symbol.text, &symbol.latex, right)
    }
}
