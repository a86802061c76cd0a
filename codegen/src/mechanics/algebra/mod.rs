//! The only module that uses Symbolica.
//!
//! Symbolica's free mode allows one thread per user and aborts a second process. Therefore [`run`]
//! takes a lock that all processes of this crate share, runs the whole derivation on a new thread,
//! joins it and releases the lock. Results leave this module as our own [`Expr`].

mod cancel;
mod read;
mod work;

use self::read::{expression, integer, symbol_id};
use self::work::{BYTES, CALL, Expansion, TERM_READ, spend_on};
use super::expression::{Expr, SymbolId, Symbols};
use super::lock::{DerivationLock, LockError};
use super::work_limit::{MOST_TERMS, TooManyTerms};
use crate::exact::Rational;
use crate::scene::RationalExpression;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use symbolica::atom::{Atom, AtomCore, AtomView, Symbol as AlgebraSymbol};
use symbolica::id::Replacement;
use symbolica::symbol;

/// Reason why a derivation could not be run.
#[derive(Debug)]
pub enum AlgebraError {
    /// The lock that allows only one derivation per user at a time could not be taken.
    Lock(LockError),
    /// An observable divides by a constant of the model that is zero in this scene. This is known
    /// only after the derivation.
    DivisionByZero {
        /// Name of the observable.
        observable: String,
    },
    /// A formula has more than [`MOST_TERMS`] terms.
    TooManyTerms,
    /// The derivation panicked: an invariant of this crate is broken.
    Broken {
        /// Message of the panic.
        message: String,
    },
}

impl fmt::Display for AlgebraError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lock(error) => error.fmt(f),
            Self::DivisionByZero { observable } => write!(
                f,
                "the observable `{observable}` divides by a constant that is zero in this scene"
            ),
            Self::TooManyTerms => write!(f, "the formulas have more than {MOST_TERMS} terms"),
            Self::Broken { message } => write!(
                f,
                "the derivation violated an internal invariant (a bug of this crate): {message}"
            ),
        }
    }
}

impl std::error::Error for AlgebraError {}

/// Runs `work`, which may use the algebra, on a new thread and while no other process of this user
/// derives.
///
/// Waits while other processes derive, up to two minutes for each of them; after two seconds it
/// prints which process it waits for. Formulas can leave `work` only as [`Expr`].
///
/// # Errors
/// [`AlgebraError::Lock`] if the lock cannot be taken, [`AlgebraError::Broken`] if
/// `work` panics.
pub fn run<R: Send>(work: impl FnOnce() -> R + Send) -> Result<R, AlgebraError> {
    let lock = DerivationLock::acquire().map_err(AlgebraError::Lock)?;
    hide_banner();
    if let Some(folder) = &lock.cache {
        use_cache(folder);
    }
    let outcome = std::thread::scope(|scope| {
        std::thread::Builder::new()
            .name("derivation".into())
            // Symbolica's recursion over expressions needs this much stack in unoptimised builds.
            .stack_size(64 << 20)
            .spawn_scoped(scope, work)
            .map(|handle| handle.join())
    });
    drop(lock);
    match outcome {
        Ok(Ok(result)) => Ok(result),
        Ok(Err(reason)) if reason.is::<TooManyTerms>() => Err(AlgebraError::TooManyTerms),
        Ok(Err(panic)) => Err(AlgebraError::Broken {
            message: panic
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()))
                .unwrap_or_else(|| "no message".into()),
        }),
        Err(source) => Err(AlgebraError::Broken {
            message: format!("no thread for the derivation: {source}"),
        }),
    }
}

/// Suppresses Symbolica's banner. It would go to the compiler's standard output, which Cargo
/// parses; docs/licences.md contains the notice instead.
#[allow(unsafe_code)]
fn hide_banner() {
    const VARIABLE: &str = "SYMBOLICA_HIDE_BANNER";
    if std::env::var_os(VARIABLE).is_none() {
        // SAFETY: called under the process-wide lock, before Symbolica reads
        // it; the standard library serialises its own accesses, and this
        // crate reads the environment through the standard library alone.
        unsafe { std::env::set_var(VARIABLE, "1") };
    }
}

/// Makes Symbolica, and later derivations of this process, use `folder` for their files. In the
/// user's home folder Symbolica would create missing folders.
#[allow(unsafe_code)]
fn use_cache(folder: &Path) {
    const VARIABLE: &str = match cfg!(target_os = "macos") {
        true => "HOME",
        false => "XDG_CACHE_HOME",
    };
    // SAFETY: as for the banner.
    unsafe { std::env::set_var(VARIABLE, folder) };
}

/// A formula of the algebra. It exists only inside [`run`].
#[derive(Clone, PartialEq, Eq)]
pub struct Formula(Atom);

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

thread_local! {
    /// Symbols of the algebra, by number, for the derivation on this thread. Finding a symbol by
    /// its name would take as long as a multiplication.
    static SYMBOLS: RefCell<BTreeMap<SymbolId, AlgebraSymbol>> =
        const { RefCell::new(BTreeMap::new()) };
}

fn algebra_symbol(id: SymbolId) -> AlgebraSymbol {
    let named = || symbol!(format!("branched_pendulum::x{}", id.0).as_str());
    SYMBOLS.with_borrow_mut(|known| *known.entry(id).or_insert_with(named))
}

impl Formula {
    /// Returns the number zero.
    pub fn zero() -> Self {
        Self(Atom::new())
    }

    /// Returns an integer as a formula.
    pub fn integer(value: i64) -> Self {
        Self(Atom::num(value))
    }

    /// Returns an exact number as a formula.
    pub fn number(value: &Rational) -> Self {
        Self(Atom::num(value.as_inner().clone()))
    }

    /// Returns a symbol as a formula.
    pub fn symbol(id: SymbolId) -> Self {
        Self(Atom::var(algebra_symbol(id)))
    }

    /// Converts an expression to a formula.
    pub fn from_expr(expr: &Expr) -> Self {
        match expr {
            Expr::Number(number) => Self::number(number),
            Expr::Symbol(id) => Self::symbol(*id),
            Expr::Sum(parts) => parts.iter().map(Self::from_expr).sum(),
            Expr::Product(parts) => parts
                .iter()
                .map(Self::from_expr)
                .fold(Self::integer(1), |product, factor| product * factor),
            Expr::Power(base, exponent) => Self::from_expr(base).pow(*exponent),
        }
    }

    /// Converts an expression to a formula; `atom` converts its operands, and `divisor` checks
    /// every divisor.
    pub(super) fn of<A, E>(
        expression: &RationalExpression<A>,
        atom: &mut impl FnMut(&A) -> Result<Self, E>,
        divisor: &impl Fn(Self) -> Result<Self, E>,
    ) -> Result<Self, E> {
        let mut at = |part: &RationalExpression<A>| Self::of(part, atom, divisor);
        Ok(match expression {
            RationalExpression::Atom(own) => atom(own)?,
            RationalExpression::Sum(members) => {
                let members: Result<Vec<_>, E> = members.iter().map(at).collect();
                members?.into_iter().sum()
            }
            RationalExpression::Product(factors) => {
                let one = Self::integer(1);
                let mut factors = factors.iter().map(at);
                factors.try_fold(one, |product, factor| Ok(product * factor?))?
            }
            RationalExpression::Quotient(above, below) => at(above)? / divisor(at(below)?)?,
            RationalExpression::Power(base, exponent) if *exponent < 0 => {
                divisor(at(base)?)?.pow(*exponent)
            }
            RationalExpression::Power(base, exponent) => at(base)?.pow(*exponent),
            RationalExpression::Negative(value) => -at(value)?,
        })
    }

    /// Returns an integer power of the formula.
    pub fn pow(&self, exponent: i32) -> Self {
        Self(self.0.pow(Atom::num(i64::from(exponent))))
    }

    /// Returns true if the formula is the number zero. The caller must expand it first.
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// Returns true if the formula is not a sum.
    pub fn is_term(&self) -> bool {
        !matches!(self.0.as_view(), AtomView::Add(_))
    }

    /// Multiplies out all products.
    pub fn expand(&self) -> Self {
        spend_on(Expansion::of(self.0.as_view()).work(), self, TERM_READ);
        Self(self.0.expand())
    }

    /// Combines the formula over one common denominator, with coprime numerator and denominator.
    pub fn together(&self) -> Self {
        spend_on(Expansion::of(self.0.as_view()).work(), self, TERM_READ);
        Self(self.0.together())
    }

    /// Returns the terms of a sum; for any other formula, the formula itself.
    pub fn terms(&self) -> Vec<Self> {
        match self.0.as_view() {
            AtomView::Add(sum) => sum.iter().map(|term| Self(term.to_owned())).collect(),
            _ => vec![self.clone()],
        }
    }

    /// Returns the partial derivative with respect to the symbol itself, without the chain rule.
    pub fn derivative(&self, id: SymbolId) -> Self {
        spend_on(CALL, self, BYTES);
        Self(self.0.derivative(algebra_symbol(id)))
    }

    /// Replaces all given symbols at once.
    pub fn substitute(&self, replacements: &[(SymbolId, Formula)]) -> Self {
        spend_on(CALL, self, BYTES);
        // Each pattern costs a pass over the formula: skip symbols that do not occur.
        let present = self.symbols();
        let replacements: Vec<Replacement> = replacements
            .iter()
            .filter(|(id, _)| present.binary_search(id).is_ok())
            .map(|(id, value)| {
                spend_on(CALL, value, BYTES);
                Replacement::new(
                    Atom::var(algebra_symbol(*id)).to_pattern(),
                    value.0.to_pattern(),
                )
            })
            .collect();
        if replacements.is_empty() {
            return self.clone();
        }
        Self(self.0.replace_multiple(replacements.iter()))
    }

    /// Returns the coefficients of the expanded formula in the given symbols: a map from exponents
    /// (one per symbol, in order) to the coefficient.
    pub fn coefficients(&self, ids: &[SymbolId]) -> BTreeMap<Vec<u32>, Formula> {
        let atoms: Vec<Atom> = ids
            .iter()
            .map(|id| Atom::var(algebra_symbol(*id)))
            .collect();
        let Self(expanded) = self.expand();
        let mut terms: BTreeMap<Vec<u32>, Vec<Atom>> = BTreeMap::new();
        // Term by term, because the algebra's own list of coefficients takes far longer.
        let mut note = |term: AtomView<'_>| {
            let (exponents, rest) = split_term(term, &atoms);
            terms.entry(exponents).or_default().push(rest);
        };
        match expanded.as_view() {
            AtomView::Add(sum) => sum.iter().for_each(&mut note),
            term => note(term),
        }
        let sums = terms.into_iter();
        let sums = sums.map(|(exponents, terms)| (exponents, Self(Atom::add_many(terms.iter()))));
        sums.filter(|(_, sum)| !sum.is_zero()).collect()
    }

    /// Returns the symbols that occur in the formula.
    pub fn symbols(&self) -> Vec<SymbolId> {
        let mut ids: Vec<SymbolId> = self
            .0
            .get_all_symbols(false)
            .into_iter()
            .map(symbol_id)
            .collect();
        ids.sort_unstable();
        ids
    }

    /// Returns the formula as plain data, in canonical order.
    pub fn to_expr(&self, symbols: &Symbols) -> Expr {
        expression(self.0.as_view()).canonical(symbols)
    }
}

/// Splits a term into the powers of the given atoms and the product of its other factors.
fn split_term(term: AtomView<'_>, atoms: &[Atom]) -> (Vec<u32>, Atom) {
    let mut exponents = vec![0; atoms.len()];
    let factors = match term {
        AtomView::Mul(product) => product.iter().collect(),
        other => vec![other],
    };
    let mut rest = Vec::with_capacity(factors.len());
    for factor in factors {
        let (base, exponent) = match factor {
            AtomView::Pow(power) => (power.get_base(), integer(power.get_exp())),
            other => (other, 1),
        };
        match atoms.iter().position(|atom| atom.as_view() == base) {
            Some(place) if exponent > 0 => exponents[place] += exponent.unsigned_abs(),
            _ => rest.push(factor.to_owned()),
        }
    }
    (exponents, Atom::mul_many(rest.iter()))
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl std::ops::$trait for Formula {
            type Output = Formula;
            fn $method(self, other: Formula) -> Formula {
                std::ops::$trait::$method(&self, &other)
            }
        }
        impl std::ops::$trait<&Formula> for &Formula {
            type Output = Formula;
            fn $method(self, other: &Formula) -> Formula {
                spend_on(CALL, self, BYTES);
                spend_on(0, other, BYTES);
                Formula(std::ops::$trait::$method(&self.0, &other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl std::ops::Neg for Formula {
    type Output = Formula;
    fn neg(self) -> Formula {
        Formula(-self.0)
    }
}

impl std::iter::Sum for Formula {
    fn sum<I: Iterator<Item = Formula>>(iter: I) -> Formula {
        let read = |formula: Formula| {
            spend_on(CALL, &formula, BYTES);
            formula.0
        };
        let terms: Vec<Atom> = iter.map(read).collect();
        // Adding all terms at once keeps the cost linear in their number.
        Formula(Atom::add_many(terms.iter()))
    }
}
